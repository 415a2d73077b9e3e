#include "flank/tool/compliance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace flank::internal {
namespace {

/// Gauss and Legendre's rule of four points on [-1, 1]: exact for polynomials of degree 7.
constexpr std::array<double, 4> kNodes = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                          0.8611363115940526};
constexpr std::array<double, 4> kWeights = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                            0.3478548451374538};

/// Equal parts of the axis, each smooth: a multiple of a spline's spans, and enough for the accuracy that the header
/// states.
int part_count(const RadialFunction& radial) {
  constexpr int kLeast = 48;
  if (radial.family() != ToolFamily::kSpline) return kLeast;
  const int spans = radial.parameter_count() - 3;
  return spans * ((kLeast + spans - 1) / spans);
}

/// Calls visit(s, r, weight) at every node.
template <class Visit>
void for_each_node(const RadialFunction& radial, const Visit& visit) {
  const int parts = part_count(radial);
  const double half = 0.5 * radial.axis_length() / parts;
  for (int k = 0; k < parts; ++k)
    for (std::size_t g = 0; g < kNodes.size(); ++g) {
      const double s = half * (2 * k + 1 + kNodes[g]);
      visit(s, radial.at(s).r, half * kWeights[g]);
    }
}

/// Integral of weight(z) / rho^4 over a frustum from (z0, rho0) to (z1, rho1), by the same rule on a few parts.
template <class Weight>
double frustum(const Vec2& from, const Vec2& to, const Weight& weight) {
  constexpr int kParts = 16;
  double sum = 0.0;
  for (int k = 0; k < kParts; ++k)
    for (std::size_t g = 0; g < kNodes.size(); ++g) {
      const double u = (k + 0.5 + 0.5 * kNodes[g]) / kParts;
      const Vec2 p = from + u * (to - from);
      sum += kWeights[g] * weight(p.x()) / std::pow(p.y(), 4);
    }
  return sum * 0.5 * (to.x() - from.x()) / kParts;
}

/// The pieces of the shank below the clamp, from the flank's upper end on: visit(from, to), each (z, radius).
template <class Visit>
void for_each_frustum(const Tool& tool, const Visit& visit) {
  const double length = tool.radial.axis_length();
  const double clamped = tool.holder.empty() ? std::numeric_limits<double>::infinity() : tool.holder.front().x();
  Vec2 from(length, tool.radial.at(length).r);
  for (const Vec2& point : tool.shank) {
    Vec2 to = point;
    if (from.x() >= clamped) break;
    if (to.x() > clamped) to = from + (clamped - from.x()) / (to.x() - from.x()) * (to - from);
    if (to.x() > from.x() && from.y() > 0.0 && to.y() > 0.0) visit(from, to);
    from = to;
  }
}

}  // namespace

double compliance(const RadialFunction& radial) {
  double sum = 0.0;
  for_each_node(radial, [&](double s, double r, double weight) {
    sum += r > 0.0 ? weight * s * s / (r * r * r * r) : std::numeric_limits<double>::infinity();
  });
  return sum;
}

double compliance(const RadialFunction& radial, Eigen::VectorXd& gradient) {
  gradient = Eigen::VectorXd::Zero(radial.parameter_count());
  Eigen::VectorXd active(radial.active_count());
  double sum = 0.0;
  for_each_node(radial, [&](double s, double r, double weight) {
    const double value = r > 0.0 ? weight * s * s / (r * r * r * r) : std::numeric_limits<double>::infinity();
    sum += value;
    radial.active_gradient(s, active.data());
    gradient.segment(radial.first_active(s), active.size()) += (-4.0 * value / r) * active;
  });
  return sum;
}

double clamped_at(const Tool& tool) {
  double end = tool.radial.axis_length();
  for_each_frustum(tool, [&](const Vec2&, const Vec2& to) { end = to.x(); });
  return end;
}

double influence_mm(const Tool& tool, double force_at, double moved_at) {
  // Unit forces at both places bend the beam above the higher one alone.
  const double begin = std::max(force_at, moved_at), length = tool.radial.axis_length();
  const auto bent = [&](double s) { return s > begin ? (s - force_at) * (s - moved_at) : 0.0; };
  constexpr int kParts = 64;
  double sum = 0.0;
  for (int k = 0; k < kParts && begin < length; ++k)
    for (std::size_t g = 0; g < kNodes.size(); ++g) {
      const double s = begin + (length - begin) * (k + 0.5 + 0.5 * kNodes[g]) / kParts, r = tool.radial.at(s).r;
      const double weight = 0.5 * (length - begin) / kParts * kWeights[g];
      sum += r > 0.0 ? weight * bent(s) / std::pow(r, 4) : std::numeric_limits<double>::infinity();
    }
  for_each_frustum(tool, [&](const Vec2& from, const Vec2& to) { sum += frustum(from, to, bent); });
  return 4.0 * sum / (std::numbers::pi * kCarbideModulus);
}

double slenderness(double length_mm, double compliance_per_mm) {
  const double radius = std::pow(length_mm * length_mm * length_mm / (3.0 * compliance_per_mm), 0.25);
  return 0.5 * length_mm / radius;
}

}  // namespace flank::internal

namespace flank {

Stiffness stiffness(const Tool& tool) {
  double sum = internal::compliance(tool.radial);
  // The shank bends too, as far down as the holder clamps it.
  internal::for_each_frustum(tool, [&](const Vec2& from, const Vec2& to) {
    sum += internal::frustum(from, to, [](double z) { return z * z; });
  });
  const double length = internal::clamped_at(tool);
  Stiffness out;
  out.length_mm = length;
  out.slenderness = internal::slenderness(length, sum);
  out.equivalent_diameter_mm = length / out.slenderness;
  // N / (N/mm^2) x 1/mm, in micrometres.
  out.deflection_um = 1e3 * kStiffnessForce * 4.0 * sum / (std::numbers::pi * kCarbideModulus);
  return out;
}

}  // namespace flank

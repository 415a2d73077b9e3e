#include "flank/fit/model/tool_excess.h"

#include <algorithm>
#include <cmath>

#include "flank/tool/compliance.h"

namespace flank::internal {
namespace {

/// What 1 - r'^2 - r r'' is held above: at zero the spheres are no longer inscribed (MATH section 1). A little more,
/// because a soft term gives a little, and is seen at the samples of s only.
constexpr double kLeastConvexity = 0.05;
/// Slenderness and neck are held this share inside their bounds, for the same reason: so the result is within them.
constexpr double kInside = 0.002;

Eigen::VectorXd gradient_at(const RadialFunction& tool, double s) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(tool.parameter_count());
  tool.gradient(s, all.data());
  return all;
}

/// How r, r' and r'' at one s change with the parameters.
struct JetGradient {
  Eigen::VectorXd r, d1, d2;
};

JetGradient jet_gradient(const RadialFunction& tool, double s) {
  // Shares of the axis length. First derivatives: the error of a central difference is h^2 / 6 of the third, 1e-8 here,
  // far more digits than normal equations need. Central also at the ends, where the end polynomial goes on.
  constexpr double kStep = 1e-4;
  // At a knot r'' has a corner, and the difference is wrong within a step of it, so the step is smaller. Round-off is
  // 1e-16 / kStep2^2, 1e-5 of the second derivative: enough.
  constexpr double kStep2 = 5e-6;
  const double h = tool.axis_length() * kStep, h2 = tool.axis_length() * kStep2;
  JetGradient out;
  out.r = gradient_at(tool, s);
  out.d1 = (gradient_at(tool, s + h) - gradient_at(tool, s - h)) / (2.0 * h);
  out.d2 = (gradient_at(tool, s + h2) - 2.0 * out.r + gradient_at(tool, s - h2)) / (h2 * h2);
  return out;
}

/// At one s, in mm; zero inside the bounds. Radius and slope have the sign of the side on which the bound is broken.
struct LocalExcess {
  double radius = 0.0, slope = 0.0, convexity = 0.0, concavity = 0.0;
  [[nodiscard]] double square() const {
    return radius * radius + slope * slope + convexity * convexity + concavity * concavity;
  }
};

LocalExcess local_excess(const RadialJet& jet, const RadiusBounds& bounds, double length) {
  LocalExcess out;
  // A little above the smallest: clamping there would make the tool cut deeper, and what a last look finds too deep is
  // taken off the radii.
  const double smallest = std::min((1.0 + kInside) * bounds.smallest, bounds.largest);
  out.radius = std::max(0.0, jet.r - bounds.largest) - std::max(0.0, smallest - jet.r);
  out.slope = (std::max(0.0, jet.d1 - bounds.steepest) - std::max(0.0, -bounds.steepest - jet.d1)) * length;
  out.convexity = std::max(0.0, kLeastConvexity - (1.0 - jet.d1 * jet.d1 - jet.r * jet.d2)) * length;
  // The meridian's curvature is r'' / (1 - r'^2 - r r''), positive where it is concave: at most 1 / R says the same as
  // (R + r) r'' <= 1 - r'^2.
  if (bounds.wheel_radius > 0.0)
    out.concavity = std::max(0.0, (bounds.wheel_radius + jet.r) * jet.d2 - (1.0 - jet.d1 * jet.d1)) * length;
  return out;
}

/// Of each sample the one below it with the largest radius, and by how much the radius has fallen beyond the bound.
struct Fall {
  std::size_t from = 0;
  double mm = 0.0;
};

std::vector<Fall> falls(const std::vector<double>& radii, double neck) {
  std::vector<Fall> out(radii.size());
  const double kept = (1.0 - neck) * (1.0 + kInside);
  std::size_t widest = 0;
  for (std::size_t j = 0; j < radii.size(); ++j) {
    if (radii[j] > radii[widest]) widest = j;
    out[j] = {widest, widest < j ? std::max(0.0, kept * radii[widest] - radii[j]) : 0.0};
  }
  return out;
}

std::vector<double> radii_at(const RadialFunction& tool, const std::vector<double>& s) {
  std::vector<double> radii;
  for (const double x : s) radii.push_back(tool.at(x).r);
  return radii;
}

constexpr double kLeastCosine = 0.01;  ///< squared: of a flank so steep that nothing stands above it

/// Compliance of the shank above a flank whose upper end is `top` from the axis: the integral of z^2 / r^4.
double shank_compliance(const RadiusBounds& bounds, double length, double top) {
  if (bounds.shank_length <= 0.0) return 0.0;
  const double radius = bounds.shank_radius > 0.0 ? bounds.shank_radius : top;
  const double end = length + bounds.shank_length;
  return (end * end * end - length * length * length) / (3.0 * std::pow(radius, 4));
}

/// By how much the tool is too slender, in mm, and that by the parameters if asked.
double slenderness_excess(const RadialFunction& tool, const RadiusBounds& bounds, Eigen::VectorXd* gradient) {
  if (bounds.slenderest >= 1e300) return 0.0;
  const double length = tool.axis_length();
  const RadialJet upper = tool.at(length);
  const double cosine = std::sqrt(std::max(kLeastCosine, 1.0 - upper.d1 * upper.d1)), top = upper.r * cosine;
  Eigen::VectorXd by_parameters;
  const double flank = gradient != nullptr ? compliance(tool, by_parameters) : compliance(tool);
  const double shank = shank_compliance(bounds, length, top);
  const double lambda = slenderness(length + bounds.shank_length, flank + shank);
  const double limit = (1.0 - kInside) * bounds.slenderest;
  // Without a radius there is nothing to follow: the bound on the radius pulls it back.
  if (!(lambda > limit) || !std::isfinite(lambda)) return 0.0;
  if (gradient != nullptr) {
    if (shank > 0.0 && bounds.shank_radius <= 0.0) {
      const JetGradient by = jet_gradient(tool, length);
      by_parameters -= (4.0 * shank / top) * (cosine * by.r - (upper.r * upper.d1 / cosine) * by.d1);
    }
    // lambda grows as the fourth root of the compliance.
    *gradient = (length * lambda / (limit * 4.0 * (flank + shank))) * by_parameters;
  }
  return length * (lambda / limit - 1.0);
}

}  // namespace

std::vector<double> bound_places(const RadialFunction& tool, const std::vector<double>& s) {
  if (tool.family() != ToolFamily::kSpline) return s;
  std::vector<double> all = s;
  const int spans = tool.parameter_count() - 3;  // equal ones, of a clamped cubic
  for (int k = 1; k < spans; ++k) all.push_back(tool.axis_length() * k / spans);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<ToolExcess> tool_excesses(const RadialFunction& tool, const RadiusBounds& bounds,
                                      const std::vector<double>& s) {
  std::vector<ToolExcess> out;
  const double length = tool.axis_length(), share = 1.0 / static_cast<double>(s.size());
  const auto add = [&](double mm, Eigen::VectorXd gradient) {
    if (mm != 0.0) out.push_back({mm, share, std::move(gradient)});
  };
  for (const double x : s) {
    const RadialJet jet = tool.at(x);
    const LocalExcess excess = local_excess(jet, bounds, length);
    if (excess.square() == 0.0) continue;
    const JetGradient by = jet_gradient(tool, x);
    add(excess.radius, by.r);
    add(excess.slope, length * by.d1);
    add(excess.convexity, length * (2.0 * jet.d1 * by.d1 + jet.d2 * by.r + jet.r * by.d2));
    add(excess.concavity, length * ((bounds.wheel_radius + jet.r) * by.d2 + jet.d2 * by.r + 2.0 * jet.d1 * by.d1));
  }
  if (bounds.neck < 1.0) {
    const std::vector<Fall> fallen = falls(radii_at(tool, s), bounds.neck);
    const double kept = (1.0 - bounds.neck) * (1.0 + kInside);
    for (std::size_t j = 0; j < s.size(); ++j)
      if (fallen[j].mm > 0.0) add(fallen[j].mm, kept * gradient_at(tool, s[fallen[j].from]) - gradient_at(tool, s[j]));
  }
  Eigen::VectorXd gradient;
  const double slender = slenderness_excess(tool, bounds, &gradient);
  if (slender > 0.0) out.push_back({slender, 1.0, std::move(gradient)});
  return out;
}

double tool_excess_square(const RadialFunction& tool, const RadiusBounds& bounds, const std::vector<double>& s) {
  double sum = 0.0;
  for (const double x : s) sum += local_excess(tool.at(x), bounds, tool.axis_length()).square();
  if (bounds.neck < 1.0)
    for (const Fall& fall : falls(radii_at(tool, s), bounds.neck)) sum += fall.mm * fall.mm;
  const double slender = slenderness_excess(tool, bounds, nullptr);
  return sum / static_cast<double>(s.size()) + slender * slender;
}

}  // namespace flank::internal

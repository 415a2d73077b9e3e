#include "flank/example/example_envelope.h"

#include <algorithm>
#include <cmath>

#include "flank/envelope.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr int kDegree = 5;                            // errors fall with the sixth power of the step
constexpr int kFirstCount = 12, kLargestCount = 300;  // points in a direction
constexpr int kDensity = 3;                           // of the grid on which the error is looked for

/// Exact contact points as a function of u = t and v = s / L.
struct Envelope {
  const RuledMotion& motion;
  const RadialFunction& radial;
  [[nodiscard]] Vec3 at(double u, double v) const {
    const ContactPoint contact = contact_point(motion, radial, v * radial.axis_length(), u, +1);
    if (!contact.exists) throw InternalError("an example has a gap in its surface");
    return contact.point;
  }
};

/// From 0 to 1, both ends among them.
std::vector<double> equal_steps(int count) {
  std::vector<double> x(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = static_cast<double>(i) / (count - 1);
  return x;
}

/// A surface through exact contact points at equal steps of u and v.
BSplineSurface interpolate(const Envelope& envelope, int count_u, int count_v) {
  const std::vector<double> u = equal_steps(count_u), v = equal_steps(count_v);
  std::vector<Vec3> points;
  points.reserve(u.size() * v.size());
  for (const double a : u)
    for (const double b : v) points.push_back(envelope.at(a, b));
  return interpolate_grid(points, u, v, kDegree);
}

/// mm, between points at equal parameters: at least the distance of the surfaces, since equal parameters are not
/// closest points.
double largest_error(const Envelope& envelope, const BSplineSurface& surface, int count_u, int count_v) {
  double worst = 0.0;
  for (const double a : equal_steps(count_u))
    for (const double b : equal_steps(count_v))
      worst = std::max(worst, (surface.value(a, b) - envelope.at(a, b)).norm());
  return worst;
}

/// mm, of the box of exact points.
double diagonal(const Envelope& envelope) {
  constexpr int kCount = 41;
  Box3 box;
  for (const double a : equal_steps(kCount))
    for (const double b : equal_steps(kCount)) box.add(envelope.at(a, b));
  return box.diagonal();
}

/// So many points that those of the interpolation, where the error is 0, are among them and others lie between.
int denser(int count) { return kDensity * (count - 1) + 1; }

}  // namespace

EnvelopeFace envelope_face(const RuledMotion& motion, const RadialFunction& radial, double relative_accuracy) {
  const Envelope envelope{motion, radial};
  EnvelopeFace out;
  out.diagonal_mm = diagonal(envelope);
  const double tolerance_mm = relative_accuracy * out.diagonal_mm;
  int count_u = kFirstCount, count_v = kFirstCount;
  for (;;) {
    out.face.surface = interpolate(envelope, count_u, count_v);
    out.error_mm = largest_error(envelope, out.face.surface, denser(count_u), denser(count_v));
    if (out.error_mm <= tolerance_mm) break;
    // On a grid line only the interpolation across it shows: that tells which direction needs points.
    const double error_u = largest_error(envelope, out.face.surface, denser(count_u), count_v);
    const double error_v = largest_error(envelope, out.face.surface, count_u, denser(count_v));
    // The direction with the larger error always grows, or the loop would not end; the other one as well where it
    // alone would use up half of the tolerance.
    const double limit = std::min(0.5 * tolerance_mm, std::max(error_u, error_v));
    if (error_u >= limit) count_u = count_u + std::max(2, count_u / 4);
    if (error_v >= limit) count_v = count_v + std::max(2, count_v / 4);
    if (std::max(count_u, count_v) > kLargestCount)
      throw InternalError("an example's envelope is not smooth enough for the required accuracy");
  }
  out.face.id = "F1";
  return out;
}

BSplineSurface with_bump(const BSplineSurface& surface, double height_mm) {
  constexpr int kCountU = 81, kCountV = 61;
  constexpr double kReach = 0.4;
  const std::vector<double> u = equal_steps(kCountU), v = equal_steps(kCountV);
  std::vector<Vec3> points;
  for (const double a : u) {
    for (const double b : v) {
      const SurfaceJet jet = surface.jet(a, b);
      const double d2 = (std::pow(a - 0.5, 2) + std::pow(b - 0.5, 2)) / (kReach * kReach);
      // Three continuous derivatives at its rim: a bump with a visible edge would be another problem.
      const double height = d2 < 1.0 ? height_mm * std::pow(1.0 - d2, 4) : 0.0;
      points.push_back(jet.p + height * jet.du.cross(jet.dv).normalized());
    }
  }
  return interpolate_grid(points, u, v, kDegree);
}

}  // namespace flank::internal

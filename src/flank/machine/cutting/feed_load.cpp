#include "flank/machine/cutting/feed_load.h"

#include <algorithm>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// What grows with the chip, and what the edge alone asks.
ForceCoefficients by_chip(const ForceCoefficients& k) {
  return {.tangential = k.tangential, .normal = k.normal, .binormal = k.binormal};
}
ForceCoefficients by_edge(const ForceCoefficients& k) {
  return {.tangential_edge = k.tangential_edge, .normal_edge = k.normal_edge, .binormal_edge = k.binormal_edge};
}

Vec3 force_of(const std::vector<CuttingLoad>& rings) {
  Vec3 sum = Vec3::Zero();
  for (const CuttingLoad& ring : rings) sum += ring.force;
  return sum;
}

Vec2 deflection_of(const std::vector<CuttingLoad>& rings, std::span<const double> compliance) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < rings.size(); ++k) sum += compliance[k] * rings[k].force.head<2>();
  return sum;
}

/// The largest x >= 0 with |slope x + rest| <= limit: infinite if there is no end to it, below 0 if there is none.
template <class Vec>
double largest_within(const Vec& slope, const Vec& rest, double limit) {
  const double a = slope.squaredNorm(), b = slope.dot(rest), c = rest.squaredNorm() - limit * limit;
  if (!(limit < LoadLimits::kNone)) return LoadLimits::kNone;
  if (c > 0.0) return -1.0;
  if (!(a > 0.0)) return LoadLimits::kNone;
  // The larger root, without the difference of two numbers that are nearly the same.
  const double root = std::sqrt(b * b - a * c);
  return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

}  // namespace

FeedLoad::FeedLoad(const RotatingCutter& cutter, const CutterMotion& per_mm, const ForceCoefficients& coefficients,
                   std::span<const double> compliance, int even) {
  if (compliance.size() != cutter.rings.size()) throw InternalError("the stiffness figures belong to another tool");
  const ForceCoefficients chip = by_chip(coefficients), edge = by_edge(coefficients);
  for (const CutterRing& ring : cutter.rings) chip_ = std::max(chip_, thickest_chip(cutter, per_mm, ring));
  power_ = {mean_power_w(cutter, mean_load(cutter, per_mm, chip)),
            mean_power_w(cutter, mean_load(cutter, per_mm, edge))};
  for (const double phase : peak_phases(cutter, per_mm, even)) {
    const std::vector<CuttingLoad> of_chip = ring_loads(cutter, per_mm, chip, phase),
                                   of_edge = ring_loads(cutter, per_mm, edge, phase);
    force_.push_back({force_of(of_chip), force_of(of_edge)});
    deflection_.push_back({deflection_of(of_chip, compliance), deflection_of(of_edge, compliance)});
  }
}

CutterLoad FeedLoad::at(double feed) const {
  CutterLoad load{.chip_mm = feed * chip_, .power_w = feed * power_.slope + power_.rest};
  for (const Affine<Vec3>& force : force_)
    load.force_n = std::max(load.force_n, (feed * force.slope + force.rest).norm());
  for (const Affine<Vec2>& deflection : deflection_)
    load.deflection_mm = std::max(load.deflection_mm, (feed * deflection.slope + deflection.rest).norm());
  return load;
}

FeedBound FeedLoad::fastest(const LoadLimits& limits, double most) const {
  FeedBound bound{most, LoadKind::kNone};
  const auto hold = [&](double feed, LoadKind by) {
    if (feed < bound.feed) bound = {std::max(0.0, feed), by};
  };
  if (chip_ > 0.0) hold(limits.chip_mm / chip_, LoadKind::kChip);
  if (power_.slope > 0.0) hold((limits.power_w - power_.rest) / power_.slope, LoadKind::kPower);
  for (const Affine<Vec3>& force : force_)
    hold(largest_within(force.slope, force.rest, limits.force_n), LoadKind::kForce);
  for (const Affine<Vec2>& deflection : deflection_)
    hold(largest_within(deflection.slope, deflection.rest, limits.deflection_mm), LoadKind::kDeflection);
  return bound;
}

}  // namespace flank::internal

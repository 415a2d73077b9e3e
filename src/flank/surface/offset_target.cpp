#include "flank/surface/offset_target.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr double kSamples = 2000.0;
/// An offset that comes near a focal point makes curvatures without bound there: they end at 1 / this of the target's own.
constexpr double kLeastShrink = 1e-3;
/// Sideways part of p - point, as a share of its length, from which on p is above a sharp edge.
constexpr double kAboveEdge = 1e-6;

double few_mm(const Target& target) { return std::sqrt(target.area() / kSamples); }

Footpoint at_sample(const Target& target, const SurfaceSample& sample) {
  Footpoint hint;
  hint.point = sample.point;
  hint.patch = sample.patch, hint.u = sample.u, hint.v = sample.v;
  return target.track(sample.point, hint);
}

class OffsetTarget final : public Target {
 public:
  OffsetTarget(std::unique_ptr<Target> target, double offset_mm) : target_(std::move(target)), offset_(offset_mm) {
    double before = 0.0, after = 0.0;
    for (const SurfaceSample& sample : target_->samples(few_mm(*target_))) {
      const SurfaceSample out = moved(sample);
      before += sample.area, after += out.area;
      box_.add(out.point);
    }
    area_ = before > 0.0 ? target_->area() * after / before : target_->area();
    for (const Vec3& p : border_points(few_mm(*target_))) box_.add(p);
  }

  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    Footpoint foot = target_->closest_within(p, horizon_mm + offset_);
    if (foot.patch < 0) return foot;
    foot = moved(p, foot);
    if (std::abs(foot.distance) < horizon_mm) return foot;
    Footpoint nothing;
    nothing.distance = std::numeric_limits<double>::quiet_NaN();
    return nothing;
  }
  [[nodiscard]] Footpoint track(const Vec3& p, const Footpoint& hint) const override {
    Footpoint before = hint;
    before.point -= offset_ * before.normal;
    return moved(p, target_->track(p, before));
  }
  [[nodiscard]] std::vector<SurfaceSample> samples(double spacing_mm) const override {
    std::vector<SurfaceSample> samples = target_->samples(spacing_mm);
    for (SurfaceSample& sample : samples) sample = moved(sample);
    return samples;
  }
  [[nodiscard]] SurfaceSample as_given(const SurfaceSample& sample) const override {
    SurfaceSample before = sample;
    before.point -= offset_ * sample.normal;
    SurfaceSample given = target_->as_given(before);
    given.point += offset_ * given.normal;
    return given;
  }
  [[nodiscard]] bool is_nearer(const Vec3& p, double mm) const override { return target_->is_nearer(p, mm + offset_); }
  [[nodiscard]] double samples_off_mm() const override { return target_->samples_off_mm(); }
  [[nodiscard]] std::vector<Vec3> border_points(double spacing_mm) const override {
    std::vector<Vec3> points = target_->border_points(spacing_mm);
    for (Vec3& p : points) p += offset_ * target_->closest(p).normal;
    return points;
  }
  [[nodiscard]] int patch_count() const override { return target_->patch_count(); }

 private:
  [[nodiscard]] double shrink(double curvature) const { return std::max(1.0 - offset_ * curvature, kLeastShrink); }

  [[nodiscard]] SurfaceSample moved(SurfaceSample sample) const {
    const Footpoint foot = at_sample(*target_, sample);
    sample.area *= shrink(foot.k1) * shrink(foot.k2);
    sample.point += offset_ * sample.normal;
    return sample;
  }

  [[nodiscard]] Footpoint moved(const Vec3& p, Footpoint foot) const {
    const Vec3 gap = p - foot.point;
    const double length = gap.norm();
    foot.k1 /= shrink(foot.k1);
    foot.k2 /= shrink(foot.k2);
    if (foot.location == Location::kBorder) return beside_border(gap, length, foot);
    const bool above_edge = foot.location == Location::kInside &&
                            (gap - gap.dot(foot.normal) * foot.normal).norm() > kAboveEdge * (length + offset_);
    if (above_edge) foot.normal = gap / foot.distance;
    foot.point += offset_ * foot.normal;
    foot.distance -= offset_;
    return foot;
  }

  /// The moved surface goes round the border, too: the nearest place lies towards p.
  [[nodiscard]] Footpoint beside_border(const Vec3& gap, double length, Footpoint foot) const {
    foot.point += offset_ * (length > 0.0 ? Vec3(gap / length) : foot.normal);
    foot.distance = foot.distance < 0.0 ? -std::abs(length - offset_) : length - offset_;
    return foot;
  }

  std::unique_ptr<Target> target_;
  double offset_;
};

}  // namespace

std::unique_ptr<Target> offset_target(std::unique_ptr<Target> target, double offset_mm) {
  FLANK_ASSERT(offset_mm > 0.0);
  return std::make_unique<OffsetTarget>(std::move(target), offset_mm);
}

double sharpest_bend(const Target& target) {
  double sharpest = -std::numeric_limits<double>::infinity();
  for (const SurfaceSample& sample : target.samples(few_mm(target)))
    sharpest = std::max(sharpest, at_sample(target, sample).k2);
  return sharpest;
}

}  // namespace flank::internal

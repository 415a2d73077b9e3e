/// Faces whose nearest points are formulas.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/target.h"

namespace flank::internal {

/// What a bound asks of a face, and nothing else.
class AnalyticTarget : public Target {
 public:
  [[nodiscard]] Footpoint track(const Vec3& p, const Footpoint&) const override { return closest(p); }
  [[nodiscard]] std::vector<SurfaceSample> samples(double) const override { return {}; }
  [[nodiscard]] std::vector<Vec3> border_points(double) const override { return {}; }
  [[nodiscard]] int patch_count() const override { return 1; }

 protected:
  void set_box(const Vec3& half) {
    box_.add(half);
    box_.add(Vec3(-half));
  }
};

/// A sphere about the origin, machined from outside (side +1) or inside (-1).
class SphereTarget : public AnalyticTarget {
 public:
  SphereTarget(double radius, int side) : radius_(radius), side_(side) { set_box(Vec3::Constant(radius)); }
  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    Footpoint foot;
    const Vec3 out = p.norm() > 0.0 ? Vec3(p.normalized()) : Vec3(Vec3::UnitX());
    foot.point = radius_ * out;
    foot.normal = side_ * out;
    foot.distance = side_ * (p.norm() - radius_);
    foot.k1 = foot.k2 = -side_ / radius_;
    foot.patch = std::abs(foot.distance) < horizon_mm ? 0 : -1;
    return foot;
  }

 private:
  double radius_, side_;
};

/// The torus about the z axis, machined from outside its tube.
class TorusTarget : public AnalyticTarget {
 public:
  TorusTarget(double radius, double tube) : radius_(radius), tube_(tube) {
    set_box(Vec3(radius + tube, radius + tube, tube));
  }
  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    Footpoint foot;
    const Vec3 out = Vec3(p.x(), p.y(), 0.0).normalized();
    const Vec3 from = p - radius_ * out;
    const Vec3 normal = from.normalized();
    foot.point = radius_ * out + tube_ * normal;
    foot.normal = normal;
    foot.distance = from.norm() - tube_;
    const double round = -1.0 / tube_, along = -normal.dot(out) / (radius_ + tube_ * normal.dot(out));
    foot.k1 = std::min(round, along);
    foot.k2 = std::max(round, along);
    foot.patch = std::abs(foot.distance) < horizon_mm ? 0 : -1;
    return foot;
  }

 private:
  double radius_, tube_;
};

/// A plane through a point, seen from any side.
class PlaneTarget : public AnalyticTarget {
 public:
  PlaneTarget(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal.normalized()) {
    set_box(Vec3::Constant(10.0));
  }
  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    Footpoint foot;
    foot.distance = (p - point_).dot(normal_);
    foot.point = p - foot.distance * normal_;
    foot.normal = normal_;
    foot.patch = std::abs(foot.distance) < horizon_mm ? 0 : -1;
    return foot;
  }

 private:
  Vec3 point_, normal_;
};

}  // namespace flank::internal

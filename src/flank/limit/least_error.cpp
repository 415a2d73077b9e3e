#include "flank/limit/least_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

namespace flank::internal {
namespace {

constexpr double kBehind = 0.5;  ///< of the radius, by which a centre may be behind a sheet's plane
/// Of the radius: so far from all faces it is certain on which side of its triangles a point is.
constexpr double kCertain = 0.3;
constexpr double kLeastDistance = 1e-3;  ///< of the radius, of a face from a centre that has a direction
constexpr double kRounding =
    1e-11;  ///< of the size: what a footpoint may be off, with what sums of its coordinates lose

/// What a ball leaves at the site, or cuts at one point of a face: if its centre moves by d, at least value + slope.dot(d) - bend d.dot(d).
struct Limit {
  double value = 0.0;
  Vec3 slope = Vec3::Zero();  ///< of length 1
  double bend = 0.0;
};

/// The largest of the limits is nowhere within `reach` less than this. Any mean of them is no more than the largest, and where slopes
/// cancel it hardly falls: the mean is mixed, one limit after another, so that this is large.
double least_of_largest(const std::vector<Limit>& limits, double reach) {
  constexpr int kRounds = 4;
  const auto level = [&](const Limit& limit) { return limit.value - limit.bend * reach * reach; };
  const auto first = std::max_element(limits.begin(), limits.end(),
                                      [&](const Limit& a, const Limit& b) { return level(a) < level(b); });
  double mean = level(*first);
  Vec3 slope = first->slope;
  for (int round = 0; round < kRounds; ++round)
    for (const Limit& limit : limits) {
      // The share t of this limit at which mean + t (level - mean) - reach |slope + t way| is largest.
      const Vec3 way = limit.slope - slope;
      const double length = way.norm(), gain = level(limit) - mean;
      if (length < 1e-9) continue;
      const double along = slope.dot(way) / length, off = std::sqrt(std::max(0.0, slope.squaredNorm() - along * along));
      const double m = gain / (reach * length);
      const double best =
          std::abs(m) >= 1.0 ? (m > 0.0 ? 1.0 : 0.0) : (m * off / std::sqrt(1.0 - m * m) - along) / length;
      const double share = std::clamp(best, 0.0, 1.0);
      mean += share * gain;
      slope += share * way;
    }
  return mean - reach * slope.norm();
}

/// A cube of centres. In all of it a ball leaves or cuts at least `least_mm`.
struct Cube {
  Vec3 middle;
  double half = 0.0, least_mm = 0.0;
  int index = 0;
  [[nodiscard]] double reach() const { return std::numbers::sqrt3 * half; }
  bool operator<(const Cube& other) const {
    return least_mm != other.least_mm ? least_mm > other.least_mm : index > other.index;
  }
};

class Search {
 public:
  Search(const Vec3& point, const Vec3& normal, const BallScene& scene, double radius_mm, const BallSearch& options)
      : point_(point), normal_(normal), scene_(scene), radius_(radius_mm), options_(options) {
    for (const Target* face : scene.faces)
      rounding_ =
          std::max(rounding_, kRounding * (face->diagonal() + face->box().low.norm() + face->box().high.norm()));
  }

  LeastError run() {
    // The ball that would be the best on the face alone; where it is in a solid, the one of no use.
    result_.centre = point_ + radius_ * normal_;
    std::vector<Limit> limits;
    const double clear = clear_of(result_.centre, limits);
    result_.found_mm = buried(result_.centre, clear) ? radius_ : radius_ - clear;
    result_.cubes = 1;
    if (!enough()) {
      add({.middle = point_, .half = radius_ + result_.found_mm}, 0.0);
      while (!open_.empty() && !enough() && !close() && result_.cubes < options_.cubes) split();
      if (!enough())
        result_.bound_mm = std::min(result_.found_mm, open_.empty() ? result_.found_mm : open_.top().least_mm);
    }
    result_.bound_mm = std::max(0.0, result_.bound_mm - rounding_);
    return result_;
  }

 private:
  [[nodiscard]] bool enough() const { return result_.found_mm <= std::max(options_.enough_mm, rounding_); }
  [[nodiscard]] bool close() const { return open_.top().least_mm >= (1.0 - options_.gap) * result_.found_mm; }

  /// What the ball about the centre leaves at the point.
  [[nodiscard]] double left_by(const Vec3& centre) const { return (centre - point_).norm() - radius_; }

  /// How far the centre is from all faces, at most a radius. `limits`: gets how deep a ball about it cuts each of them.
  double clear_of(const Vec3& centre, std::vector<Limit>& limits) const {
    double nearest = radius_;
    for (const Target* face : scene_.faces) {
      const Footpoint foot = face->closest_within(centre, radius_);
      if (foot.patch < 0) continue;
      const Vec3 away = centre - foot.point;
      const double distance = away.norm();
      nearest = std::min(nearest, distance);
      // Nearer than this the ball cuts by nearly all of its radius.
      if (distance > kLeastDistance * radius_) limits.push_back({radius_ - distance, -away / distance, 0.5 / distance});
    }
    return nearest;
  }

  /// Is the centre, so far from all faces, in a solid? False where that is not certain.
  [[nodiscard]] bool buried(const Vec3& centre, double clear_mm) const {
    return clear_mm > kCertain * radius_ &&
           std::any_of(scene_.solids.begin(), scene_.solids.end(),
                       [&](const verify::Winding* solid) { return solid->inside(centre); });
  }

  void add(Cube cube, double least_mm) {
    const double height = (cube.middle - point_).dot(normal_), behind = -kBehind * radius_, reach = cube.reach();
    if (!scene_.of_solid && height + reach < behind) return;
    // A ball that leaves too much needs no look at the faces.
    const double left = left_by(cube.middle);
    if (left - reach >= result_.found_mm) return;
    cube.index = ++result_.cubes;
    limits_.clear();
    const double clear = clear_of(cube.middle, limits_), error = std::max(left, radius_ - clear);
    const Vec3 away = cube.middle - point_;
    if (const double off = away.norm(); off > 0.0) limits_.push_back({left, away / off, 0.0});
    cube.least_mm = std::max(least_mm, error - reach);
    if (!limits_.empty()) cube.least_mm = std::max(cube.least_mm, least_of_largest(limits_, reach));
    if (cube.least_mm >= result_.found_mm) return;
    // Where no face is in the cube, all of it is in the solid, or none.
    const bool whole = reach < clear, better = error < result_.found_mm && (scene_.of_solid || height >= behind);
    const bool inside = (whole || better) && buried(cube.middle, clear);
    if (inside && whole) return;
    if (better && !inside) {
      result_.found_mm = error;
      result_.centre = cube.middle;
    }
    if (cube.least_mm < result_.found_mm) open_.push(cube);
  }

  void split() {
    const Cube cube = open_.top();
    open_.pop();
    const double h = 0.5 * cube.half;
    for (const double x : {-h, h})
      for (const double y : {-h, h})
        for (const double z : {-h, h}) add({.middle = cube.middle + Vec3(x, y, z), .half = h}, cube.least_mm);
  }

  const Vec3 point_, normal_;
  const BallScene& scene_;
  const double radius_;
  const BallSearch options_;
  double rounding_ = 0.0;
  std::priority_queue<Cube> open_;
  std::vector<Limit> limits_;  ///< of one cube; kept for its memory
  LeastError result_;
};

}  // namespace

LeastError least_error(const Vec3& point, const Vec3& normal, const BallScene& scene, double radius_mm,
                       const BallSearch& search) {
  return Search(point, normal, scene, radius_mm, search).run();
}

}  // namespace flank::internal

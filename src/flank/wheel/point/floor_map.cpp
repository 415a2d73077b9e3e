#include "flank/wheel/point/floor_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kCellMm = 0.5;         ///< of the meridian
constexpr double kSideCellMm = 1.0;     ///< of a side's line
constexpr double kNearFloor = 0.08;     ///< of a side's size: samples so near the floor say where it stands
constexpr double kSampleShare = 0.004;  ///< of the size of a face: between its samples

/// The two coordinates rise together, or one falls: along which of the diagonals the meridian runs.
double sign_of(const std::vector<Vec2>& all) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& q : all) mean += q / static_cast<double>(all.size());
  double together = 0.0;
  for (const Vec2& q : all) together += (q.x() - mean.x()) * (q.y() - mean.y());
  return together < 0.0 ? -1.0 : 1.0;
}

struct Cell {
  Vec2 sum = Vec2::Zero();
  int count = 0;
};

double value_at(const std::vector<double>& at, const std::vector<double>& values, double x) {
  const auto next = std::upper_bound(at.begin(), at.end(), x);
  if (next == at.begin()) return values.front();
  if (next == at.end()) return values.back();
  const auto k = static_cast<std::size_t>(next - at.begin());
  const double t = (x - at[k - 1]) / std::max(at[k] - at[k - 1], 1e-12);
  return values[k - 1] + t * (values[k] - values[k - 1]);
}

}  // namespace

FloorMap::FloorMap(const std::vector<const Target*>& floor, const WheelAxis& axis) : axis_(axis) {
  out_ = axis.direction.unitOrthogonal();
  zero_ = axis.angle(axis.point + out_);
  std::vector<Vec2> all;
  for (const Target* target : floor)
    for (const SurfaceSample& s : target->samples(std::max(0.2, kSampleShare * target->diagonal())))
      all.emplace_back(axis.along(s.point), axis.radius(s.point));
  if (all.size() < 2) return;
  const double sign = sign_of(all);
  std::map<int, Cell> cells;
  for (const Vec2& q : all) {
    Cell& cell = cells[static_cast<int>(std::floor((sign * q.x() + q.y()) / kCellMm))];
    cell.sum += q, ++cell.count;
  }
  for (const auto& [key, cell] : cells) points_.emplace_back(cell.sum / cell.count);
  if (points_.size() < 2) return;
  // The means of the outermost cells lie inside of them.
  const std::size_t n = points_.size();
  points_.insert(points_.begin(), points_[0] + (points_[0] - points_[1]));
  points_.push_back(points_[n] + (points_[n] - points_[n - 1]));
  ways_.push_back(0.0);
  for (std::size_t k = 1; k < points_.size(); ++k) ways_.push_back(ways_.back() + (points_[k] - points_[k - 1]).norm());
}

double FloorMap::way(const Vec3& p) const {
  const Vec2 q(axis_.along(p), axis_.radius(p));
  double least = 1e300, out = 0.0;
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const Vec2 along = points_[k + 1] - points_[k];
    const double x = std::clamp((q - points_[k]).dot(along) / std::max(along.squaredNorm(), 1e-24), 0.0, 1.0);
    const double off = (points_[k] + x * along - q).squaredNorm();
    if (off < least) least = off, out = ways_[k] + x * (ways_[k + 1] - ways_[k]);
  }
  return out;
}

Vec2 FloorMap::meridian(double way) const {
  const auto next = std::upper_bound(ways_.begin(), ways_.end(), way);
  if (next == ways_.begin()) return points_.front();
  if (next == ways_.end()) return points_.back();
  const auto k = static_cast<std::size_t>(next - ways_.begin());
  const double t = (way - ways_[k - 1]) / std::max(ways_[k] - ways_[k - 1], 1e-12);
  return points_[k - 1] + t * (points_[k] - points_[k - 1]);
}

Vec3 FloorMap::place(double way, double angle) const {
  const Vec2 q = meridian(way);
  return axis_.turn(angle) * Vec3(axis_.point + q.x() * axis_.direction + q.y() * out_);
}

SideLine::SideLine(const std::vector<const Target*>& side, const std::vector<const Target*>& floor, const FloorMap& map,
                   double looks) {
  struct Low {
    bool away;
    double height, way, angle;
    [[nodiscard]] bool is_before(const Low& other) const {
      return away != other.away ? other.away : height < other.height;
    }
  };
  std::map<int, Low> cells;
  for (const Target* target : side)
    for (const SurfaceSample& s : target->samples(std::max(0.2, kSampleShare * target->diagonal()))) {
      Footpoint foot;
      double least = kNearFloor * target->diagonal();
      for (const Target* one : floor)
        if (const Footpoint here = one->closest_within(s.point, least); here.patch >= 0)
          least = std::abs(here.distance), foot = here;
      // A floor that ends where a leaning side begins has its border there.
      if (foot.patch < 0) continue;
      const double way = map.way(foot.point);
      const Low low{looks * map.ahead(s.point, s.normal) < 0.0, std::abs(foot.distance), way, map.angle(s.point)};
      const auto [cell, fresh] = cells.try_emplace(static_cast<int>(std::floor(way / kSideCellMm)), low);
      if (!fresh && low.is_before(cell->second)) cell->second = low;
    }
  for (const auto& [key, low] : cells) {
    double angle = low.angle;
    if (!angles_.empty())
      angle += 2.0 * std::numbers::pi * std::round((angles_.back() - angle) / (2.0 * std::numbers::pi));
    ways_.push_back(low.way), angles_.push_back(angle);
  }
}

double SideLine::angle(double way) const { return value_at(ways_, angles_, way); }

}  // namespace flank::internal

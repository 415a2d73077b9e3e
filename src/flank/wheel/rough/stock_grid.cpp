#include "flank/wheel/rough/stock_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr double kFarCells = 2.0;
constexpr int kSteps = 24;  ///< of what is in front of a circle
constexpr double kStillMm = 1e-9;

/// std::lerp sees to infinities, too.
double between(double a, double b, double t) { return a + t * (b - a); }

/// How far to either side of ahead a circle goes into what is there, radians, from 0 to pi: a cone that goes down is in front all round. The normal of
/// the flank there and the way say it.
double front_half(const Cutter::Circle& circle, double across, double down) {
  const double lean = (circle.s - circle.middle) / circle.radius, rise = lean * down;
  if (across < kStillMm) return rise > kStillMm ? std::numbers::pi : 0.0;
  return std::acos(std::clamp(-rise / across, -1.0, 1.0));
}

}  // namespace

StockGrid::StockGrid(const Box3& box, double cell_mm, const std::function<double(const Vec3&)>& depth)
    : cell_(cell_mm), far_(kFarCells * cell_mm), low_(box.low) {
  for (int k = 0; k < 3; ++k)
    bricks_[static_cast<std::size_t>(k)] = 1 + static_cast<int>(std::ceil((box.high[k] - box.low[k]) / cell_)) / kSide;
  air_.resize(brick(bricks_[0], 0, 0));
  depths_.resize(air_.size() * kCorners);
  parallel_for(air_.size(), [&](std::size_t one) {
    const Vec3 first = corner(one);
    float* here = depths_.data() + one * kCorners;
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z)
          *here++ =
              static_cast<float>(std::clamp(depth(first + cell_ * Vec3(static_cast<double>(x), y, z)), -far_, far_));
    air_[one] = std::all_of(here - kCorners, here, [&](float d) { return d <= static_cast<float>(-far_); }) ? 1 : 0;
  });
}

Vec3 StockGrid::corner(std::size_t brick) const {
  const auto y = static_cast<std::size_t>(bricks_[1]), z = static_cast<std::size_t>(bricks_[2]);
  return low_ + kSide * cell_ *
                    Vec3(static_cast<double>(brick / (y * z)), static_cast<double>(brick / z % y),
                         static_cast<double>(brick % z));
}

double StockGrid::depth(const Vec3& p) const {
  const Vec3 q = (p - low_) / cell_;
  std::array<std::size_t, 3> at{};
  std::array<bool, 3> inside{};
  Vec3 t;
  for (std::size_t k = 0; k < 3; ++k) {
    const double floor = std::floor(q[static_cast<int>(k)]);
    if (!(floor >= 0.0 && floor < kSide * bricks_[k] - 1)) return -far_;
    at[k] = static_cast<std::size_t>(floor), t[static_cast<int>(k)] = q[static_cast<int>(k)] - floor;
    inside[k] = at[k] % kSide != kSide - 1;
  }
  const auto place = [&](std::size_t x, std::size_t y, std::size_t z) {
    const std::size_t one =
        brick(static_cast<int>(x / kSide), static_cast<int>(y / kSide), static_cast<int>(z / kSide));
    return one * kCorners + ((x % kSide) * kSide + y % kSide) * kSide + z % kSide;
  };
  const std::size_t first = place(at[0], at[1], at[2]);
  const bool one_brick = inside[0] && inside[1] && inside[2];
  if (one_brick && air_[first / kCorners] != 0) return -far_;
  const auto row = [&](std::size_t dx, std::size_t dy) {
    const std::size_t n = one_brick ? first + (dx * kSide + dy) * kSide : place(at[0] + dx, at[1] + dy, at[2]),
                      next = one_brick ? n + 1 : place(at[0] + dx, at[1] + dy, at[2] + 1);
    return between(static_cast<double>(depths_[n]), static_cast<double>(depths_[next]), t.z());
  };
  return between(between(row(0, 0), row(0, 1), t.y()), between(row(1, 0), row(1, 1), t.y()), t.x());
}

double StockGrid::Motion::distance(const Cutter& cutter, const Vec3& p) const {
  const Vec3 off = p - from.tip;
  const double s = std::clamp(off.dot(from.axis), 0.0, cutter.length());
  const Vec3 way = tip_way + s * axis_way;
  const double length = way.squaredNorm(),
               t = length > kStillMm * kStillMm ? std::clamp((off - s * from.axis).dot(way) / length, 0.0, 1.0) : 0.0;
  const Vec3 here = off - t * tip_way, axis = from.axis + t * axis_way;
  // Between two unit vectors one is shorter.
  const double z = here.dot(axis) / std::sqrt(axis.squaredNorm());
  return cutter.distance(z, std::sqrt(std::max(0.0, here.squaredNorm() - z * z)));
}

std::vector<StockGrid::Motion> StockGrid::motions_of(const Cutter& cutter, const std::vector<Pose>& poses) {
  std::vector<Motion> out;
  double sum = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k == 0 && poses.size() > 1) continue;
    const Pose &from = poses[k - std::min<std::size_t>(k, 1)], &to = poses[k];
    const Vec3 tip = to.tip - from.tip, axis = to.axis - from.axis;
    const double moved = std::max(tip.norm(), (tip + cutter.length() * axis).norm()) + cutter.largest() * axis.norm();
    out.push_back({from, tip, axis, moved, sum += moved});
  }
  return out;
}

void StockGrid::cut(const Cutter& cutter, const std::vector<Pose>& poses) {
  const std::vector<Motion> motions = motions_of(cutter, poses);
  std::vector<Touch> all;
  for (std::size_t k = 0; k < motions.size(); ++k) touched(cutter, motions[k], k, all);
  std::sort(all.begin(), all.end(), [](const Touch& a, const Touch& b) {
    return a.brick != b.brick ? a.brick < b.brick : a.motion < b.motion;
  });
  std::vector<std::size_t> runs;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k == 0 || all[k].brick != all[k - 1].brick) runs.push_back(k);
  runs.push_back(all.size());
  parallel_for(runs.size() - 1,
               [&](std::size_t k) { cut(cutter, motions, all.data() + runs[k], all.data() + runs[k + 1]); });
}

void StockGrid::touched(const Cutter& cutter, const Motion& motion, std::size_t number, std::vector<Touch>& out) const {
  // Slab by slab across the direction that the axis goes along most.
  int main = 0;
  motion.from.axis.cwiseAbs().maxCoeff(&main);
  const double along = motion.from.axis[main], side = kSide * cell_;
  const double tilt = std::sqrt(std::max(0.0, 1.0 - along * along)) / std::abs(along);
  const int one = (main + 1) % 3, two = (main + 2) % 3;
  const double a = motion.from.tip[main], b = a + cutter.length() * along,
               beyond = cutter.largest() + far_ + motion.moved;
  const auto slab = [&](double mm, int k) {
    return static_cast<int>(std::clamp((mm - low_[k]) / side, 0.0, bricks_[static_cast<std::size_t>(k)] - 1.0));
  };
  const double around = 0.5 * std::numbers::sqrt3 * side;  // a brick, and the cell beyond it
  for (int i = slab(std::min(a, b) - beyond, main), end = slab(std::max(a, b) + beyond, main); i <= end; ++i) {
    const double s = (low_[main] + side * (i + 0.5) - a) / along;
    const Vec3 middle = motion.from.at(s);
    const double far = 0.5 * side / std::abs(along);
    const double reach =
        (cutter.largest_near(s, far + cutter.largest() * tilt) + far_ + motion.moved) / std::abs(along) + far * tilt;
    std::array<int, 3> at{};
    at[static_cast<std::size_t>(main)] = i;
    for (int j = slab(middle[one] - reach, one), j_end = slab(middle[one] + reach, one); j <= j_end; ++j)
      for (int k = slab(middle[two] - reach, two), k_end = slab(middle[two] + reach, two); k <= k_end; ++k) {
        at[static_cast<std::size_t>(one)] = j, at[static_cast<std::size_t>(two)] = k;
        const std::size_t here = brick(at[0], at[1], at[2]);
        if (air_[here] != 0) continue;
        const Vec3 center = corner(here) + Vec3::Constant(0.5 * (kSide - 1) * cell_);
        if (motion.distance(cutter, center) <= around + far_) out.push_back({here, number});
      }
  }
}

void StockGrid::cut(const Cutter& cutter, const std::vector<Motion>& motions, const Touch* first, const Touch* last) {
  const std::size_t one = first->brick;
  const Vec3 low = corner(one);
  const auto outside = static_cast<float>(-far_);
  float* here = depths_.data() + one * kCorners;
  bool air = true;
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y)
      for (int z = 0; z < kSide; ++z, ++here) {
        const Vec3 p = low + cell_ * Vec3(static_cast<double>(x), y, z);
        // The tool comes nearer by no more than it moves: motions that are still too far off are passed over.
        double off = -1e300, since = 0.0;
        for (const Touch* touch = first; touch != last && *here > outside; ++touch) {
          const Motion& motion = motions[touch->motion];
          if (off - (motion.before - since) >= static_cast<double>(*here)) continue;
          off = motion.distance(cutter, p), since = motion.before;
          *here = std::min(*here, static_cast<float>(std::max(-far_, off)));
        }
        air = air && *here <= outside;
      }
  air_[one] = air ? 1 : 0;
}

bool StockGrid::meets(const Cutter& cutter, const Pose& pose) const {
  constexpr int kRound = 8;
  constexpr double kLeastCells = 0.2;
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x);
  const auto meets = [&](const Vec3& p) { return depth(p) > kLeastCells * cell_; };
  if (meets(pose.at(-cutter.tip()))) return true;
  for (int k = 0; k < kRound; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRound;
    const Vec3 out = std::cos(angle) * x + std::sin(angle) * y;
    if (meets(pose.tip + std::numbers::sqrt2 / 2.0 * cutter.tip() * (out - pose.axis))) return true;
    for (const Cutter::Circle& circle : cutter.circles())
      if (meets(pose.at(circle.middle) + circle.radius * out)) return true;
  }
  return false;
}

bool StockGrid::is_air(const Vec3& middle, double radius) const {
  std::array<int, 3> low{}, high{};
  for (int k = 0; k < 3; ++k) {
    const auto one = static_cast<std::size_t>(k);
    const auto slab = [&](double mm) {
      return static_cast<int>(std::clamp((mm - low_[k]) / (kSide * cell_), 0.0, bricks_[one] - 1.0));
    };
    // A place between the last corner of a brick and the next one's first is of both.
    low[one] = slab(middle[k] - radius), high[one] = slab(middle[k] + radius + cell_);
  }
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z)
        if (air_[brick(x, y, z)] == 0) return false;
  return true;
}

double StockGrid::engagement(const Cutter& cutter, const Pose& from, const Pose& to) const {
  double most = 0.0;
  for (const Cutter::Circle& circle : cutter.circles())
    if (!is_air(to.at(circle.middle), circle.radius))
      most = std::max(most, in_material(circle, to, to.at(circle.s) - from.at(circle.s)));
  return most;
}

double StockGrid::in_material(const Cutter::Circle& circle, const Pose& pose, const Vec3& way) const {
  const double down = -way.dot(pose.axis);
  const Vec3 across = way + down * pose.axis;
  const double half = front_half(circle, across.norm(), down), step = 2.0 * half / kSteps;
  if (!(half > 0.0)) return 0.0;
  const Vec3 ahead = across.norm() < kStillMm ? Vec3(pose.axis.unitOrthogonal()) : Vec3(across.normalized()),
             aside = pose.axis.cross(ahead), middle = pose.at(circle.middle);
  const Vec2 turn(std::cos(step), std::sin(step));
  Vec2 at(std::cos(half), -std::sin(half));
  double in = 0.0, last = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double here = depth(middle + circle.radius * (at.x() * ahead + at.y() * aside));
    if (k > 0 && (last > 0.0 || here > 0.0))
      in +=
          last > 0.0 && here > 0.0 ? step : step * std::max(last, here) / (std::max(last, here) - std::min(last, here));
    last = here;
    at = {turn.x() * at.x() - turn.y() * at.y(), turn.y() * at.x() + turn.x() * at.y()};
  }
  return in;
}

}  // namespace flank::internal

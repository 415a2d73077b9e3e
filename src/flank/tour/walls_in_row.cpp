#include "flank/tour/walls_in_row.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kSmoothRad = 1e-5;
/// In tolerances: what a flat corner may keep, how far a tool stays off what it stops before, and how deep rounding may let it be.
constexpr double kNothing = 0.1, kOff = 0.05, kRounding = 0.3;

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

bool is_too_tight(const Wall& wall, const StraightFlank& flank, double foot_s) {
  constexpr double kRoundEnough = 1.0 + 1e-4;
  constexpr int kLines = 5;
  if (wall.flat()) return false;
  const WallLine a = wall.first({}), b = wall.last({});
  for (int k = 0; k < kLines; ++k) {
    const WallLine line = wall.between(a, b, (k + 0.5) / kLines);
    const double foot_r = flank.at(std::max(0.0, foot_s)), head_r = flank.at(foot_s + flank.axis_over(line.length()));
    // Beside the ends: at the apex of a cone no curvature is known.
    constexpr double kBeside = 0.02;
    if (wall.bend(line.foot + kBeside * (line.head - line.foot)) * foot_r > kRoundEnough ||
        wall.bend(line.head + kBeside * (line.foot - line.head)) * head_r > kRoundEnough)
      return true;
  }
  return false;
}

Corner corner_between(const Wall& wall, const Wall& next, double radius, double tolerance_mm, double& turn) {
  const WallLine end = wall.last({}), begin = next.first({});
  turn = std::max(angle(end.foot_normal, begin.foot_normal), angle(end.head_normal, begin.head_normal));
  if (turn <= kSmoothRad) return Corner::kSmooth;
  constexpr double kBeyond = 0.05;
  const WallLine beyond = next.between(begin, next.last({}), kBeyond);
  const Vec3 way = beyond.foot + beyond.head - begin.foot - begin.head;
  if (way.dot(end.foot_normal + end.head_normal) < 0.0) return Corner::kRoll;
  const double stays = radius * (1.0 / std::cos(0.5 * turn) - 1.0);
  return stays <= kNothing * tolerance_mm ? Corner::kPass : Corner::kLeft;
}

}  // namespace

Corner WallsInRow::before(std::size_t i) const {
  if (i > 0) return corners[i - 1];
  return corners.back();
}

std::optional<WallsInRow> walls_in_row(const std::vector<Face>& faces, const Chain& chain) {
  WallsInRow row;
  row.chain = chain;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    std::optional<Wall> wall = Wall::of(faces[chain.order[i]], chain.begin_of(i), chain.end_of(i));
    if (!wall) return {};
    row.walls.push_back(std::move(*wall));
  }
  row.too_tight.assign(chain.size(), 0);
  row.corners.assign(chain.size(), Corner::kNone);
  row.turns.assign(chain.size(), 0.0);
  return row;
}

void look_at_corners(const StraightFlank& flank, double foot_s, double tolerance_mm, WallsInRow& row) {
  for (std::size_t i = 0; i < row.walls.size(); ++i)
    row.too_tight[i] = is_too_tight(row.walls[i], flank, foot_s) ? 1 : 0;
  for (std::size_t i = 0; i < row.walls.size(); ++i) {
    if (i + 1 == row.walls.size() && !row.chain.closed) continue;
    const std::size_t next = row.next(i);
    const double radius = std::max(flank.radius, flank.at(foot_s + flank.axis_over(row.walls[i].last({}).length())));
    row.corners[i] = corner_between(row.walls[i], row.walls[next], radius, tolerance_mm, row.turns[i]);
    if (row.too_tight[i] != 0 || row.too_tight[next] != 0) row.corners[i] = Corner::kLeft;
  }
}

bool is_clear_of_others(const Pose& pose, const StraightFlank& flank, double length, double tip_off_mm,
                        const TourScene& scene) {
  constexpr int kPlaces = 16;
  if (scene.obstacles == nullptr) return true;
  for (int k = 0; k <= kPlaces; ++k) {
    const double s = length * k / kPlaces, r = flank.at(s) - scene.allowance_mm;
    // Beside the border of the wall its neighbours are as near as the wall.
    const double spare = k == 0 ? tip_off_mm : -kRounding * scene.tolerance_mm;
    if (scene.obstacles->at(pose.at(s), r + 1.0).distance_mm < r + spare) return false;
  }
  return true;
}

bool is_clear(const Pose& pose, const StraightFlank& flank, double length, const WallsInRow& row, std::size_t own,
              const TourScene& scene) {
  constexpr int kPlaces = 12;
  for (std::size_t i = 0; i < row.walls.size(); ++i) {
    if (i == own) continue;
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = length * k / kPlaces, r = flank.at(s) + kOff * scene.tolerance_mm;
      const Footpoint foot = row.walls[i].target().closest_within(pose.at(s), r);
      if (foot.patch >= 0) return false;
    }
  }
  return is_clear_of_others(pose, flank, length, 0.0, scene);
}

std::optional<WallEnd> end_of_wall(const WallsInRow& row, std::size_t i, bool last, const StraightFlank& flank,
                                   double foot_s, const TourScene& scene) {
  const Corner corner = last ? row.corners[i] : row.before(i);
  const Wall& wall = row.walls[i];
  const auto back_by = [&](double share) {
    const double line = (last ? wall.last({}) : wall.first({})).length();
    return WallEnd{share * flank.at(std::max(0.0, foot_s)), share * flank.at(foot_s + flank.axis_over(line))};
  };
  if (corner == Corner::kSmooth || corner == Corner::kRoll) return WallEnd{};
  if (corner == Corner::kPass)
    return back_by(std::tan(0.5 * (last ? row.turns[i] : row.turns[i > 0 ? i - 1 : row.walls.size() - 1])));
  const auto clear = [&](double share) {
    const WallLine line = last ? wall.last(back_by(share)) : wall.first(back_by(share));
    const double length = std::max(0.0, foot_s + flank.axis_over(line.length()));
    return is_clear(laid_against(line, flank, foot_s), flank, length, row, i, scene);
  };
  if (clear(0.0)) return WallEnd{};
  constexpr int kSteps = 48, kHalvings = 30;
  const double most = wall.way() / std::min(back_by(1.0).foot_back, back_by(1.0).head_back);
  int step = 1;
  while (step <= kSteps && !clear(most * step / kSteps)) ++step;
  if (step > kSteps) return {};
  double low = most * (step - 1) / kSteps, high = most * step / kSteps;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (clear(middle) ? high : low) = middle;
  }
  return back_by(high);
}

}  // namespace flank::internal

#include "flank/wheel/rough/lean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

using Row = std::vector<Pose>;

constexpr double kMostRad = 0.5, kStepRad = 0.1;  ///< of an axis at an end, and of the search for it
constexpr int kHalvings = 3;                      ///< of that
constexpr double kPerRow = 0.03;                  ///< radians that the turn may change by from row to row
constexpr int kRounds = 6;                        ///< in which neighbours become alike
constexpr int kAround = 3;                        ///< rows, by which the way of the channel is known

/// How far the axes at the first and the last place turn, radians, and about what.
struct Lean {
  std::array<double, 2> most{};
  Vec3 way = Vec3::Zero();
};

const Pose& end_of(const Row& row, std::size_t side) { return side == 0 ? row.front() : row.back(); }

/// Towards the first side for `side` 0, the last one for 1.
Pose turned(const Pose& pose, const Vec3& way, double angle) {
  return {pose.tip, Eigen::AngleAxisd(angle, way) * pose.axis};
}

/// Along the channel; so that a turn by a positive angle leads towards the last side.
Vec3 way_of(const std::vector<Row>& rows, std::size_t k) {
  const auto middle = [](const Row& row) { return row[row.size() / 2].tip; };
  std::size_t first = k, last = k;
  for (int n = 0; n < kAround; ++n) {
    if (first > 0 && !rows[first - 1].empty()) --first;
    if (last + 1 < rows.size() && !rows[last + 1].empty()) ++last;
  }
  const Vec3 way = middle(rows[last]) - middle(rows[first]), across = rows[k].back().tip - rows[k].front().tip;
  if (way.norm() < 1e-9) return Vec3::Zero();
  const Vec3 unit = way.normalized(), &axis = rows[k][rows[k].size() / 2].axis;
  return unit.cross(axis).dot(across) > 0.0 ? unit : Vec3(-unit);
}

double most_turn(const Pose& pose, const Vec3& way, double sign, const TipRoom& room) {
  double good = 0.0, bad = kStepRad;
  for (; bad <= kMostRad && room.is_free(turned(pose, way, sign * bad)); bad += kStepRad) good = bad;
  // No side is there.
  if (bad > kMostRad) return 0.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (good + bad);
    (room.is_free(turned(pose, way, sign * middle)) ? good : bad) = middle;
  }
  return good;
}

/// No row turns more than its neighbours by more than they may change: each comes down to what the others allow.
void even_out(std::vector<Lean>& leans, const std::vector<Row>& rows) {
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const auto limit = [&](std::size_t at, std::size_t from) {
      if (!rows[at].empty() && !rows[from].empty())
        leans[at].most[side] = std::min(leans[at].most[side], leans[from].most[side] + kPerRow);
    };
    for (std::size_t k = 1; k < rows.size(); ++k) limit(k, k - 1);
    for (std::size_t k = rows.size() - 1; k-- > 0;) limit(k, k + 1);
  }
}

/// The mean of an axis and of those beside it: at the ends of a row, of the rows beside alone.
Vec3 mean_axis(const std::vector<Row>& rows, std::size_t k, std::size_t c) {
  Vec3 sum = 2.0 * rows[k][c].axis;
  const auto add = [&](std::size_t row, std::size_t column) {
    if (row < rows.size() && !rows[row].empty()) sum += rows[row][column].axis;
  };
  add(k - 1, c), add(k + 1, c);
  if (c > 0 && c + 1 < rows[k].size()) add(k, c - 1), add(k, c + 1);
  return sum.normalized();
}

/// Of two colours, as on a chess board: what is turned at once has no common sides.
void steady(std::vector<Row>& rows, const TipRoom& room) {
  for (int round = 0; round < kRounds; ++round)
    for (const std::size_t colour : {std::size_t{0}, std::size_t{1}})
      parallel_for(rows.size(), [&](std::size_t k) {
        for (std::size_t c = (k + colour) % 2; c < rows[k].size(); c += 2) {
          const Pose pose{rows[k][c].tip, mean_axis(rows, k, c)};
          if (room.is_free(pose)) rows[k][c] = pose;
        }
      });
}

}  // namespace

void lean_to_sides(std::vector<Row>& rows, const TipRoom& room) {
  if (rows.empty()) return;
  std::vector<Lean> leans(rows.size());
  parallel_for(rows.size(), [&](std::size_t k) {
    if (rows[k].empty()) return;
    leans[k].way = way_of(rows, k);
    if (leans[k].way.isZero()) return;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      leans[k].most[side] = most_turn(end_of(rows[k], side), leans[k].way, side == 0 ? -1.0 : 1.0, room);
  });
  even_out(leans, rows);
  parallel_for(rows.size(), [&](std::size_t k) {
    const double last = static_cast<double>(rows[k].size()) - 1.0;
    for (std::size_t c = 0; c < rows[k].size(); ++c) {
      const double share = 2.0 * static_cast<double>(c) / last - 1.0,  // -1 at the first side, 1 at the last one
          angle = share * leans[k].most[share < 0.0 ? 0 : 1];
      const Pose pose = turned(rows[k][c], leans[k].way, angle);
      if (angle != 0.0 && room.is_free(pose)) rows[k][c] = pose;
    }
  });
  steady(rows, room);
}

}  // namespace flank::internal

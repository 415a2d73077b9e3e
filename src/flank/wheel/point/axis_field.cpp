#include "flank/wheel/point/axis_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr int kTilts = 8, kRound = 24;  ///< directions that are tried: tilts from the normal, and turns about it
constexpr std::size_t kDirections = kTilts * kRound;
constexpr double kTilt = 10.0;  ///< degrees between tilts; the least keeps the contact off the tip's pole
constexpr int kChoices = 30, kSmoothings = 12;  ///< rounds over all nodes
constexpr double kShortOfRoom = 4.0;            ///< radians that neighbours may differ for a millimetre of room more

constexpr double kRoomEnough = 0.6 * TipRoom::kEnoughMm;  ///< mm: a direction with so much need not be given up

/// Four nodes beside a place of 0 ... count - 1 and what they weigh: a uniform cubic B-spline, so that neither the direction nor how fast
/// it turns jumps at a node. Beyond the ends the last node stands for those that are not there.
struct Span {
  std::array<int, 4> node;
  std::array<double, 4> weight;
};
Span span_of(double at, int count) {
  const double x = std::clamp(at, 0.0, count - 1.0);
  const int first = std::min(static_cast<int>(x), std::max(0, count - 2));
  const double t = x - first, u = 1.0 - t;
  Span out{{},
           {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
            t * t * t / 6.0}};
  for (int k = 0; k < 4; ++k) out.node[static_cast<std::size_t>(k)] = std::clamp(first - 1 + k, 0, count - 1);
  return out;
}

double angle_of(const Vec3& a, const Vec3& b) { return 2.0 * std::atan2((a - b).norm(), (a + b).norm()); }

/// The k-th one about a normal.
Vec3 direction(const Vec3& normal, std::size_t k) {
  const double tilt = kTilt * (1.0 + static_cast<double>(k / kRound)) * std::numbers::pi / 180.0,
               round = 2.0 * std::numbers::pi * static_cast<double>(k % kRound) / kRound;
  const Vec3 e = normal.unitOrthogonal(), f = normal.cross(e);
  return std::cos(tilt) * normal + std::sin(tilt) * (std::cos(round) * e + std::sin(round) * f);
}

}  // namespace

AxisField::AxisField(const TipRoom& room, const std::vector<std::optional<TipRoom::Rest>>& places, int rows,
                     int columns, const AxisField* before)
    : rows_(rows), columns_(columns), held_(room.held()), nodes_(places.size()) {
  parallel_for(places.size(), [&](std::size_t k) {
    if (!places[k]) return;
    nodes_[k].present = true, nodes_[k].center = places[k]->center, nodes_[k].normal = places[k]->normal;
    if (before == nullptr || !takes(room, before->nodes_[k].axis, nodes_[k])) look(room, nodes_[k]);
  });
  choose();
  fill();
  smooth(room);
}

bool AxisField::takes(const TipRoom& room, const Vec3& axis, Node& node) {
  const double here = room.rough_room({node.center, axis}, kRoomEnough);
  if (here <= kRoomEnough) return false;
  node.axis = axis, node.room = here;
  return true;
}

void AxisField::look(const TipRoom& room, Node& node) const {
  node.rooms.resize(kDirections);
  for (std::size_t k = 0; k < node.rooms.size(); ++k) {
    // What enters something by far need not be known closely.
    node.rooms[k] = room.rough_room({node.center, direction(node.normal, k)}, -2.0 * TipRoom::kEnoughMm);
    if (node.rooms[k] > node.room) node.room = node.rooms[k], node.axis = direction(node.normal, k);
  }
}

std::vector<std::size_t> AxisField::beside(std::size_t k) const {
  const int row = static_cast<int>(k) / columns_, column = static_cast<int>(k) % columns_;
  std::vector<std::size_t> out;
  for (const auto& [r, c] :
       {std::pair(row - 1, column), std::pair(row + 1, column), std::pair(row, column - 1), std::pair(row, column + 1)})
    if (r >= 0 && r < rows_ && c >= 0 && c < columns_) {
      const auto at = static_cast<std::size_t>(r * columns_ + c);
      if (nodes_[at].present) out.push_back(at);
    }
  return out;
}

/// Each node in turn takes the direction that costs least beside those of its neighbours: what they differ by, and what it lacks of
/// room.
void AxisField::choose() {
  for (int round = 0; round < kChoices; ++round)
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      Node& node = nodes_[n];
      if (!node.present || node.rooms.empty()) continue;
      const std::vector<std::size_t> others = beside(n);
      double least = 1e300;
      for (std::size_t k = 0; k < node.rooms.size(); ++k) {
        const Vec3 axis = direction(node.normal, k);
        const double lack = kShortOfRoom * (TipRoom::kEnoughMm - node.rooms[k]);
        double cost = static_cast<double>(others.size()) * lack * lack;
        for (const std::size_t other : others) {
          const double angle = angle_of(axis, nodes_[other].axis);
          cost += angle * angle;
        }
        if (cost < least) least = cost, node.axis = axis, node.room = node.rooms[k];
      }
    }
}

/// What has no place of its own takes the direction of the nearest node that has one.
void AxisField::fill() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].present) continue;
    double least = 1e300;
    const int row = static_cast<int>(n) / columns_, column = static_cast<int>(n) % columns_;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!nodes_[k].present) continue;
      const int dr = static_cast<int>(k) / columns_ - row, dc = static_cast<int>(k) % columns_ - column;
      const double off = dr * dr + dc * dc;
      if (off < least) least = off, nodes_[n].axis = nodes_[k].axis;
    }
  }
}

void AxisField::smooth(const TipRoom& room) {
  for (int round = 0; round < kSmoothings; ++round) {
    // Of two colours, as on a chess board: what is moved at once has no common sides.
    for (std::size_t colour = 0; colour < 2; ++colour)
      parallel_for(nodes_.size(), [&](std::size_t n) {
        const int row = static_cast<int>(n) / columns_, column = static_cast<int>(n) % columns_;
        Node& node = nodes_[n];
        if (!node.present || static_cast<std::size_t>((row + column) % 2) != colour) return;
        Vec3 sum = node.axis;
        for (const std::size_t other : beside(n)) sum += nodes_[other].axis;
        const double enough = std::min(node.room, kRoomEnough);
        const Vec3 axis = held_.nearest(sum.normalized());
        const double here = room.rough_room({node.center, axis}, enough - 1e-9);
        if (here >= enough - 1e-9) node.axis = axis, node.room = here;
      });
  }
}

Vec3 AxisField::at(double row, double column) const {
  const Span rows = span_of(row, rows_), columns = span_of(column, columns_);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      sum += rows.weight[i] * columns.weight[j] *
             nodes_[static_cast<std::size_t>(rows.node[i] * columns_ + columns.node[j])].axis;
  return held_.nearest(sum.normalized());
}

std::array<Vec3, 4> AxisField::around(double row, double column) const {
  const auto pair_of = [](double at, int count) {
    const double x = std::clamp(at, 0.0, count - 1.0);
    const int low = std::min(static_cast<int>(x), std::max(0, count - 2)), high = std::min(low + 1, count - 1);
    return x - low < 0.5 ? std::pair(low, high) : std::pair(high, low);
  };
  const auto [row_near, row_far] = pair_of(row, rows_);
  const auto [column_near, column_far] = pair_of(column, columns_);
  const auto axis = [&](int r, int c) { return nodes_[static_cast<std::size_t>(r * columns_ + c)].axis; };
  return {axis(row_near, column_near), axis(row_far, column_near), axis(row_near, column_far),
          axis(row_far, column_far)};
}

std::optional<Vec3> AxisField::nearest_free(const TipRoom& room, const TipRoom::Rest& place, const Vec3& wish,
                                            double deeper_mm) {
  std::vector<Vec3> axes(kDirections);
  for (std::size_t k = 0; k < kDirections; ++k) axes[k] = direction(place.normal, k);
  std::stable_sort(axes.begin(), axes.end(), [&](const Vec3& a, const Vec3& b) { return a.dot(wish) > b.dot(wish); });
  const auto free = std::find_if(axes.begin(), axes.end(), [&](const Vec3& axis) {
    const Pose pose{place.center, axis};
    return room.rough_room(pose, 0.0) > 0.0 && room.is_free(pose, deeper_mm);
  });
  return free != axes.end() ? std::optional(*free) : std::nullopt;
}

double AxisField::least_room() const {
  double least = 1e300;
  for (const Node& node : nodes_)
    if (node.present) least = std::min(least, node.room);
  return least;
}

}  // namespace flank::internal

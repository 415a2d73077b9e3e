#include "flank/trochoid/paths/side_pairing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

constexpr int kCells = 160;
/// Of the squared logarithm of how fast one goes against the other, against the squared sine of the skew.
constexpr double kSteady = 0.02;
/// A place right across within so many cells of the pair is taken: the grid's kinks are none of the sides.
constexpr double kNear = 6.0;

struct Place {
  Vec3 at, velocity;
};

std::vector<Place> places_of(const SidePath& path, double beyond) {
  const double middle = 0.5 * path.axis_length(), step = (path.length() + 2.0 * beyond) / kCells;
  std::vector<Place> out;
  for (int k = 0; k <= kCells; ++k) {
    const AxisPlace place = path.at(-beyond + k * step);
    out.push_back({place.at(middle), place.velocity(middle).normalized()});
  }
  return out;
}

double skew_cost(const Place& a, const Place& b) {
  const Vec3 across = b.at - a.at;
  const double gap = across.norm();
  if (!(gap > 0.0)) return 0.0;
  const double sine = 0.5 * across.dot(a.velocity + b.velocity) / gap;
  return sine * sine;
}

/// A cell of the grid, or how far one is from another.
struct Cell {
  int x, y;
};
constexpr std::array<Cell, 5> kMoves = {{{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}}};

/// The place within some cells of `guess` that lies right across from x, where there is one.
double right_across(const SidePath& from, double x, const SidePath& to, double guess, double reach) {
  const double middle = 0.5 * from.axis_length();
  const AxisPlace here = from.at(x);
  const auto ahead = [&](double y) {
    const AxisPlace there = to.at(y);
    return (there.at(middle) - here.at(middle)).dot(here.velocity(middle) + there.velocity(middle));
  };
  double low = guess - reach, high = guess + reach;
  if (!(ahead(low) < 0.0 && ahead(high) > 0.0)) return guess;
  constexpr int kHalvings = 20;
  for (int k = 0; k < kHalvings; ++k) {
    const double y = 0.5 * (low + high);
    (ahead(y) < 0.0 ? low : high) = y;
  }
  return 0.5 * (low + high);
}

/// Least cost of a pairing that ends at each cell, and the move that came there.
class Table {
 public:
  Table(const std::vector<Place>& from, const std::vector<Place>& to) {
    for (int x = 0; x <= kCells; ++x)
      for (int y = 0; y <= kCells; ++y) {
        const double here = skew_cost(from[static_cast<std::size_t>(x)], to[static_cast<std::size_t>(y)]);
        double least =
            (x == 0 && 2 * y <= kCells) || (y == 0 && 2 * x <= kCells) ? 0.0 : std::numeric_limits<double>::infinity();
        int move = -1;
        for (std::size_t m = 0; m < kMoves.size() && x > 0 && y > 0; ++m) {
          const auto [dx, dy] = kMoves[m];
          if (x < dx || y < dy) continue;
          const double speed = std::log(static_cast<double>(dy) / dx);
          const double sum = cost_at(x - dx, y - dy) + 0.5 * (dx + dy) * (here + kSteady * speed * speed);
          if (sum < least) least = sum, move = static_cast<int>(m);
        }
        cost_.push_back(least);
        move_.push_back(move);
      }
  }
  /// From the end to the start. Pairings may end wherever one of the paths does; longer ones cost more: the mean counts.
  [[nodiscard]] std::vector<Cell> best() const {
    Cell at{kCells, kCells};
    double least = std::numeric_limits<double>::infinity();
    for (int k = kCells / 2; k <= kCells; ++k)
      for (const Cell end : {Cell{kCells, k}, Cell{k, kCells}}) {
        const double mean = cost_at(end.x, end.y) / (end.x + end.y);
        if (mean < least) least = mean, at = end;
      }
    std::vector<Cell> out{at};
    for (int m = move_at(at); m >= 0; m = move_at(at)) {
      at = {at.x - kMoves[static_cast<std::size_t>(m)].x, at.y - kMoves[static_cast<std::size_t>(m)].y};
      out.push_back(at);
    }
    return out;
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(x * (kCells + 1) + y); }
  [[nodiscard]] double cost_at(int x, int y) const { return cost_[index(x, y)]; }
  [[nodiscard]] int move_at(const Cell& at) const { return move_[index(at.x, at.y)]; }
  std::vector<double> cost_;
  std::vector<int> move_;
};

/// The nearest values that never fall: what falls is averaged with what is before it.
std::vector<double> forwards(std::vector<double> values) {
  struct Block {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks.back().mean() < blocks[blocks.size() - 2].mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum, blocks.back().count += last.count;
    }
  }
  values.clear();
  for (const Block& block : blocks) values.insert(values.end(), block.count, block.mean());
  return values;
}

}  // namespace

SidePairing::SidePairing(const SidePath& from, const SidePath& to, double beyond_mm)
    : first_(-beyond_mm), step_((from.length() + 2.0 * beyond_mm) / kCells) {
  std::vector<Cell> pairs = Table(places_of(from, beyond_mm), places_of(to, beyond_mm)).best();
  std::reverse(pairs.begin(), pairs.end());
  const double step_y = (to.length() + 2.0 * beyond_mm) / kCells;
  std::vector<double> raw;
  std::size_t k = 0;
  for (int x = 0; x <= kCells; ++x) {
    while (k + 1 < pairs.size() && pairs[k + 1].x < x) ++k;
    const Cell &a = pairs[k], &b = pairs[std::min(k + 1, pairs.size() - 1)];
    // Beyond the pairs both go equally fast.
    if (x < a.x || a.x == b.x || x > b.x) {
      const Cell& near = x < a.x ? a : b;
      raw.push_back(-beyond_mm + near.y * step_y + (x - near.x) * step_);
    } else {
      raw.push_back(-beyond_mm + (a.y + static_cast<double>(b.y - a.y) * (x - a.x) / (b.x - a.x)) * step_y);
    }
  }
  const double reach = kNear * std::max(step_, step_y);
  for (int x = 0; x <= kCells; ++x)
    raw[static_cast<std::size_t>(x)] =
        right_across(from, first_ + x * step_, to, raw[static_cast<std::size_t>(x)], reach);
  place_ = forwards(std::move(raw));
}

double SidePairing::at(double x) const {
  const double cell = (x - first_) / step_;
  if (cell <= 0.0) return place_.front() + (x - first_);
  if (cell >= kCells) return place_.back() + (x - first_ - kCells * step_);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(cell), kCells - 1);
  const double share = cell - static_cast<double>(k);
  return (1.0 - share) * place_[k] + share * place_[k + 1];
}

}  // namespace flank::internal

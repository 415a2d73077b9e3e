#include "flank/verify/proof/depth_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"

namespace flank::internal::verify {
namespace {

constexpr double kExactMm = 1e-8;     ///< f is exact to a tenth of this
constexpr double kSmallestMm = 1e-7;  ///< cells that reach no farther are not cut again
constexpr std::size_t kBlock = 32;    ///< cells per task. Fixed, so that the number of threads changes nothing
constexpr std::size_t kFreeEvaluations =
    20000;  ///< for coming nearer to the deepest place after the proof, besides as many as the proof took

/// f at which nothing of a cell can be cut: beyond it, f need not be known.
double horizon_of(const Probe& probe, double least_radius) {
  const double inner = least_radius - probe.reach;
  if (!(inner > 0.0)) return probe.reach;
  return std::min(probe.reach, probe.bend + 0.5 * probe.reach * probe.reach / inner);
}

/// How deep the face can be cut in a cell, from f at its probe. To first order f has slope 1; to second order the
/// deepest place is one where a ball of at least that radius touches the cell.
double depth_bound(const Probe& probe, double f, double least_radius) {
  double more = probe.reach;
  const double inner = least_radius + f - probe.reach;
  if (inner > 0.0) more = std::min(more, probe.bend + 0.5 * probe.reach * probe.reach / inner);
  return more - f;
}

class Search {
 public:
  Search(const SweptVolume& volume, double least_radius, const Shape& shape, const DepthLimits& limits)
      : volume_(volume), least_radius_(least_radius), shape_(shape), limits_(limits) {}

  ProvedDepth run(double found) {
    out_.deepest_mm = std::max(0.0, found);
    open_ = evaluate(shape_.first());
    std::size_t proved_at = 0;
    while (true) {
      stop_here();
      const bool decided = out_.deepest_mm > limits_.tolerance_mm || top() <= limits_.tolerance_mm;
      if (decided && proved_at == 0) proved_at = std::max<std::size_t>(1, out_.evaluations);
      const double goal = decided ? out_.deepest_mm + limits_.gap_mm : limits_.tolerance_mm;
      const std::size_t most =
          decided ? std::min(limits_.evaluations, 2 * proved_at + kFreeEvaluations) : limits_.evaluations;
      if (!refine(goal, most)) {
        out_.exhausted = !decided;
        break;
      }
    }
    finish();
    return out_;
  }

 private:
  [[nodiscard]] double top() const {
    double most = 0.0;
    for (const Cell& c : open_) most = std::max(most, c.bound);
    return most;
  }

  /// One round: cuts the cells that may be deeper than the goal. False if there are none or a limit is met.
  bool refine(double goal, std::size_t most) {
    std::vector<double> bounds;
    for (const Cell& c : open_)
      if (c.bound > goal && !c.final) bounds.push_back(c.bound);
    if (bounds.empty() || out_.evaluations >= most || open_.size() >= limits_.cells) return false;
    // The deepest first, as many as there is room for.
    const std::size_t room = std::max(kBlock, std::min(most - out_.evaluations, limits_.cells - open_.size()) / 3);
    double least = goal;
    if (bounds.size() > room) {
      const auto at = bounds.begin() + static_cast<std::ptrdiff_t>(room);
      std::nth_element(bounds.begin(), at, bounds.end(), std::greater<>());
      least = *at;
    }
    std::vector<Cell> parts, kept;
    std::size_t cut = 0;
    for (const Cell& c : open_) {
      if (c.final || !(c.bound > goal) || c.bound < least || cut >= room) {
        if (c.bound > out_.deepest_mm) kept.push_back(c);
        continue;
      }
      ++cut;
      shape_.split(c, parts);
    }
    open_ = std::move(kept);
    const std::vector<Cell> more = evaluate(std::move(parts));
    open_.insert(open_.end(), more.begin(), more.end());
    return true;
  }

  struct Block {
    std::vector<Cell> cells;
    double deepest = 0.0;
    SweptDistance place;
    Vec3 point = Vec3::Zero();
    std::size_t evaluations = 0;
  };

  /// Looks at cells, and returns those that may be deeper than the deepest place that is known.
  std::vector<Cell> evaluate(std::vector<Cell> cells) {
    std::vector<Block> blocks((cells.size() + kBlock - 1) / kBlock);
    parallel_blocks(cells.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      look(std::span(cells).subspan(begin, end - begin), blocks[begin / kBlock]);
    });
    std::vector<Cell> out;
    for (const Block& block : blocks) {
      out_.evaluations += block.evaluations;
      if (block.deepest > out_.deepest_mm) {
        out_.deepest_mm = block.deepest;
        out_.place = block.place;
        out_.point = block.point;
      }
    }
    for (const Block& block : blocks)
      for (const Cell& c : block.cells)
        if (c.bound > out_.deepest_mm + kExactMm) out.push_back(c);
    return out;
  }

  void look(std::span<Cell> cells, Block& block) const {
    std::vector<Probe> probes;
    std::vector<Vec3> points;
    std::vector<double> horizons;
    std::vector<SweptDistance> distances;
    for (Cell& cell : cells) {
      const Probe probe = shape_.look(cell);
      if (probe.empty) continue;
      block.cells.push_back(cell);
      probes.push_back(probe);
      points.push_back(probe.point);
      horizons.push_back(horizon_of(probe, least_radius_) + kExactMm);
    }
    distances.resize(points.size());
    volume_.distances(points, horizons, distances);
    block.evaluations = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      Cell& cell = block.cells[i];
      cell.bound = std::min(cell.bound, depth_bound(probes[i], distances[i].f, least_radius_));
      cell.final = probes[i].reach < kSmallestMm;
      if (!probes[i].on_face || -distances[i].f <= block.deepest) continue;
      block.deepest = -distances[i].f;
      block.place = distances[i];
      block.point = points[i];
    }
  }

  void finish() {
    out_.bound_mm = out_.deepest_mm;
    for (const Cell& c : open_) {
      if (c.bound <= out_.bound_mm) continue;
      out_.bound_mm = c.bound;
      Cell cell = c;
      const Probe probe = shape_.look(cell);
      out_.open_point = probe.point;
      out_.open_reach_mm = probe.reach;
    }
  }

  const SweptVolume& volume_;
  double least_radius_;
  const Shape& shape_;
  const DepthLimits& limits_;
  std::vector<Cell> open_;
  ProvedDepth out_;
};

}  // namespace

ProvedDepth search_depth(const SweptVolume& volume, double least_radius_mm, const Shape& shape, double found_mm,
                         const DepthLimits& limits) {
  return Search(volume, least_radius_mm, shape, limits).run(found_mm);
}

}  // namespace flank::internal::verify

#include "flank/verify/proof/cover_search.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"

namespace flank::internal::verify {
namespace {

constexpr std::size_t kBlock = 128;       ///< cells per task. Fixed, so that the number of threads changes nothing
constexpr std::size_t kLot = 4096;        ///< cells of samples that are cut together
constexpr double kRounding = 1.0 + 1e-9;  ///< sums of areas are not too small by more
constexpr int kDeepest = 8;               ///< times that the cell of a sample is cut at most

/// A part of a sample's cell that is still open.
struct Open {
  Cell cell;
  std::size_t sample = 0;
  SweptDistance near;  ///< where the path is near it, about
};

/// Area of a sample's cell that is given up, mm^2.
struct Lost {
  std::size_t sample = 0;
  double area = 0.0;
};

/// Parts whose nearest place of the path is looked for anew, up to a horizon each.
class Asked {
 public:
  void add(Open& part, const Vec3& point, double horizon) {
    parts_.push_back(&part), points_.push_back(point), horizons_.push_back(horizon);
  }
  /// Strip -1: nothing is as near as that.
  void answer(const SweptVolume& volume) {
    std::vector<SweptDistance> found(parts_.size());
    volume.distances(points_, horizons_, found);
    for (std::size_t k = 0; k < found.size(); ++k) {
      parts_[k]->near = found[k];
      if (found[k].f > horizons_[k]) parts_[k]->near.strip = -1;
    }
  }

 private:
  std::vector<Open*> parts_;
  std::vector<Vec3> points_;
  std::vector<double> horizons_;
};

class CoverSearch {
 public:
  CoverSearch(const SweptVolume& volume, const Shape& shape, const FaceSamples& samples, const CoverLimits& limits)
      : volume_(volume), shape_(shape), samples_(samples), limits_(limits) {}

  ProvedCover run(std::span<const SweptDistance> distances) {
    out_.open_mm2.assign(samples_.points.size(), 0.0);
    const std::vector<Open> all = begin(distances);
    // Some after the other: cells of a whole face would not fit into memory, and a finer look at some of them is worth more than none
    // at all of them. What one lot does not use the next may.
    for (std::size_t first = 0; first < all.size(); first += kLot) {
      const std::size_t end = std::min(all.size(), first + kLot);
      const double share = static_cast<double>(end) / static_cast<double>(all.size());
      search({all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(end)},
             limits_.gap_mm2 * static_cast<double>(end - first) / static_cast<double>(all.size()),
             static_cast<std::size_t>(share * static_cast<double>(limits_.evaluations)));
    }
    for (std::size_t i = 0; i < out_.open_mm2.size(); ++i)
      out_.open_mm2[i] = std::min(out_.open_mm2[i] * kRounding, samples_.areas[i]);
    return std::move(out_);
  }

 private:
  /// Cuts cells until no more than `gap_mm2` of them is open, or `evaluations` are reached, those before them included. What the last of
  /// them do not suffice for stays open; the cells before it are cut all the same.
  void search(std::vector<Open> open, double gap_mm2, std::size_t evaluations) {
    for (int depth = 0; !open.empty(); ++depth) {
      stop_here();
      std::size_t most = std::min(limits_.cells, evaluations - std::min(evaluations, out_.evaluations));
      if (depth == kDeepest || settled(open, gap_mm2)) most = 0;
      Cut cut_now = cut(open, most);
      for (std::size_t k = cut_now.cells; k < open.size(); ++k)
        out_.open_mm2[open[k].sample] += shape_.area_bound(open[k].cell);
      open = {};  // a cell takes 150 bytes, and there may be a million
      open = look(std::move(cut_now.parts));
    }
  }

  struct Block {
    std::vector<Open> open;
    std::vector<Lost> lost;
    std::vector<Vec3> hull;
    std::size_t evaluations = 0;
  };

  template <class Body>
  std::vector<Open> in_blocks(std::size_t count, const Body& body) {
    std::vector<Block> blocks((count + kBlock - 1) / kBlock);
    parallel_blocks(count, kBlock,
                    [&](std::size_t begin, std::size_t end) { body(begin, end, blocks[begin / kBlock]); });
    std::size_t left = 0;
    for (const Block& block : blocks) left += block.open.size();
    std::vector<Open> open;
    open.reserve(left);
    for (Block& block : blocks) {
      out_.evaluations += block.evaluations;
      for (const Lost& lost : block.lost) out_.open_mm2[lost.sample] += lost.area;
      open.insert(open.end(), block.open.begin(), block.open.end());
      block.open = {};
    }
    return open;
  }

  /// The cells of the samples that the nearest ball of their sample does not settle.
  std::vector<Open> begin(std::span<const SweptDistance> distances) {
    return in_blocks(distances.size(), [&](std::size_t from, std::size_t to, Block& block) {
      for (std::size_t i = from; i < to; ++i) {
        const SweptDistance& d = distances[i];
        const double reach = samples_.reaches_mm.empty() ? samples_.spacing_mm : samples_.reaches_mm[i];
        if (d.strip < 0 || d.f - reach > limits_.tolerance_mm) {
          block.lost.push_back({i, samples_.areas[i]});
          continue;
        }
        Open open{shape_.cell_of(samples_.cells[i]), i, d};
        if (near_all_of(open, block)) continue;
        (void)shape_.look(open.cell);  // what splitting needs
        block.open.push_back(open);
      }
    });
  }

  /// Whether a ball, as it goes from one pose to the next, leaves no place of the cell farther away than the tolerance: the distance from
  /// its way is convex, so the corners of a hull tell.
  [[nodiscard]] bool near_all_of(const Open& open, Block& block) const {
    if (!shape_.hull(open.cell, block.hull)) return false;
    const SweptVolume::Ball ball = volume_.ball(open.near);
    const double reach = ball.radius + limits_.tolerance_mm;
    if (std::all_of(block.hull.begin(), block.hull.end(),
                    [&](const Vec3& p) { return (p - ball.center).norm() <= reach; }))
      return true;
    const SweptVolume::BallWay way = volume_.ball_way(open.near);
    const double most = reach - way.off, squared = way.along.squaredNorm();
    return std::all_of(block.hull.begin(), block.hull.end(), [&](const Vec3& p) {
      const Vec3 d = p - way.from;
      const double t = squared > 0.0 ? std::clamp(d.dot(way.along) / squared, 0.0, 1.0) : 0.0;
      return (d - t * way.along).norm() <= most;
    });
  }

  struct Cut {
    std::vector<Open> parts;
    std::size_t cells = 0;  ///< the first ones, that were cut
  };

  /// As many cells as have no more than `most` parts. Counted, not guessed, because a long cell is cut in two, a square one in four.
  [[nodiscard]] Cut cut(const std::vector<Open>& open, std::size_t most) const {
    Cut out;
    std::vector<Cell> cells;
    for (; out.cells < open.size() && out.parts.size() < most; ++out.cells) {
      const Open& o = open[out.cells];
      cells.clear();
      shape_.split(o.cell, cells);
      if (out.parts.size() + cells.size() > most) break;
      for (const Cell& cell : cells) out.parts.push_back({cell, o.sample, o.near});
    }
    return out;
  }

  std::vector<Open> look(std::vector<Open> parts) {
    return in_blocks(parts.size(), [&](std::size_t from, std::size_t to, Block& block) {
      look(std::span(parts).subspan(from, to - from), block);
    });
  }

  /// The same of a block. Descent keeps to the pass of the cell that a part is of, and the one beside it may be nearer by far: what does
  /// not even touch the middle settles no part of the cell, however small. All of those are asked anew together, as neighbours share
  /// most of their search.
  void look(std::span<Open> parts, Block& block) const {
    std::vector<Open*> there;
    Asked asked;
    for (Open& part : parts) {
      const Probe probe = shape_.look(part.cell);
      if (probe.empty) continue;
      there.push_back(&part);
      part.near = volume_.distance_from(probe.point, part.near);
      if (part.near.f > limits_.tolerance_mm) asked.add(part, probe.point, limits_.tolerance_mm + probe.reach);
    }
    block.evaluations += there.size();
    asked.answer(volume_);
    for (Open* part : there) {
      if (part->near.strip < 0)
        block.lost.push_back({part->sample, shape_.area_bound(part->cell)});
      else if (!near_all_of(*part, block))
        block.open.push_back(*part);
    }
  }

  /// Whether the cells' area is too small to matter. Mostly a few of them tell that it is not.
  [[nodiscard]] bool settled(const std::vector<Open>& open, double gap_mm2) const {
    double sum = 0.0;
    return std::all_of(open.begin(), open.end(), [&](const Open& o) {
      sum += std::min(shape_.area_bound(o.cell), samples_.areas[o.sample]);
      return sum <= gap_mm2;
    });
  }

  const SweptVolume& volume_;
  const Shape& shape_;
  const FaceSamples& samples_;
  const CoverLimits& limits_;
  ProvedCover out_;
};

}  // namespace

ProvedCover search_cover(const SweptVolume& volume, const Shape& shape, const FaceSamples& samples,
                         std::span<const SweptDistance> distances, const CoverLimits& limits) {
  FLANK_ASSERT(samples.cells.size() == samples.points.size() && distances.size() == samples.points.size());
  return CoverSearch(volume, shape, samples, limits).run(distances);
}

}  // namespace flank::internal::verify

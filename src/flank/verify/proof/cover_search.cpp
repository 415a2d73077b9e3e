#include "flank/verify/proof/cover_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/verify/proof/two_ways.h"

namespace flank::internal::verify {
namespace {

constexpr std::size_t kBlock = 128;       ///< cells per task. Fixed, so that the number of threads changes nothing
constexpr std::size_t kLot = 4096;        ///< cells of samples that are cut together
constexpr double kRounding = 1.0 + 1e-9;  ///< sums of areas are not too small by more
constexpr double kOffShare = 0.02;  ///< of the tolerance: what a ball's way may be off its chord, over several poses
constexpr int kDeepest = 8;         ///< times that the cell of a sample is cut at most

/// A part of a sample's cell that is still open.
struct Open {
  Cell cell;
  std::size_t sample = 0;
  SweptDistance near;   ///< where the path is near it, about
  SweptDistance other;  ///< where it is near what that ball is not near to, about; strip -1: not looked for
};

/// Area of a sample's cell that is given up, mm^2.
struct Lost {
  std::size_t sample = 0;
  double area = 0.0;
};

/// Places of the path that are nearest to points, looked for up to a horizon each.
class Asked {
 public:
  void add(SweptDistance& place, const Vec3& point, double horizon) {
    places_.push_back(&place), points_.push_back(point), horizons_.push_back(horizon);
  }
  /// Strip -1: nothing is as near as that.
  void answer(const SweptVolume& volume) {
    std::vector<SweptDistance> found(places_.size());
    volume.distances(points_, horizons_, found);
    for (std::size_t k = 0; k < found.size(); ++k) {
      *places_[k] = found[k];
      if (found[k].f > horizons_[k]) places_[k]->strip = -1;
    }
  }

 private:
  std::vector<SweptDistance*> places_;
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
    std::vector<double> sides;
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
        block.open.push_back({shape_.cell_of(samples_.cells[i]), i, d, {}});
      }
      settle(block);
      for (Open& open : block.open) (void)shape_.look(open.cell);  // what splitting needs
    });
  }

  /// Leaves in a block the cells that no ball, as it goes from one pose to the next, is near all of, nor two of them together: the
  /// distance from a straight way is convex, so the corners of a hull tell. The others are looked for together, as neighbours share most
  /// of their search.
  void settle(Block& block) const {
    std::vector<char> settled(block.open.size(), 0);
    std::vector<std::size_t> doubted;
    Asked asked;
    for (std::size_t k = 0; k < block.open.size(); ++k) {
      Open& open = block.open[k];
      const std::optional<Vec3> missed = missed_by_near(open, block);
      if (!missed && !block.hull.empty()) settled[k] = 1;
      // Its own middle is not finished, or its own hull is not known.
      if (!missed || open.near.f > limits_.tolerance_mm) continue;
      if (open.other.strip >= 0) open.other = volume_.distance_from(*missed, open.other);
      if (open.other.strip < 0 || open.other.f > limits_.tolerance_mm)
        asked.add(open.other, *missed, limits_.tolerance_mm);
      doubted.push_back(k);
    }
    asked.answer(volume_);
    for (const std::size_t k : doubted)
      if (block.open[k].other.strip >= 0 && near_together(block.open[k], block)) settled[k] = 1;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < block.open.size(); ++k)
      if (settled[k] == 0) block.open[kept++] = block.open[k];
    block.open.resize(kept);
  }

  /// The place of a cell's hull that its ball is farthest from being near to; none where it is near all of them, or no hull is known,
  /// which is empty then.
  [[nodiscard]] std::optional<Vec3> missed_by_near(const Open& open, Block& block) const {
    if (!shape_.hull(open.cell, block.hull)) {
      block.hull.clear();
      return {};
    }
    const SweptVolume::Ball ball = volume_.ball(open.near);
    const double reach = ball.radius + limits_.tolerance_mm;
    if (std::all_of(block.hull.begin(), block.hull.end(),
                    [&](const Vec3& p) { return (p - ball.center).norm() <= reach; }))
      return {};
    const Near near = near_of(open.near, block);
    std::optional<Vec3> missed;
    double most = 0.0;
    for (const Vec3& p : block.hull)
      if (const double beyond = near.beyond(p); beyond > most) most = beyond, missed = p;
    return missed;
  }

  [[nodiscard]] bool near_together(const Open& open, Block& block) const {
    if (!shape_.hull(open.cell, block.hull)) return false;
    block.sides.resize(block.hull.size());
    return hold_together(block.hull, near_of(open.near, block), near_of(open.other, block), box_of(block.hull).center(),
                         block.sides);
  }

  /// What the ball of a place reaches on its way along the cell whose hull is the block's.
  [[nodiscard]] Near near_of(const SweptDistance& place, const Block& block) const {
    return {volume_.ball_way(place, box_of(block.hull).diagonal(), kOffShare * limits_.tolerance_mm),
            limits_.tolerance_mm};
  }

  [[nodiscard]] static Box3 box_of(const std::vector<Vec3>& hull) {
    Box3 box;
    for (const Vec3& p : hull) box.add(p);
    return box;
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
      for (const Cell& cell : cells) out.parts.push_back({cell, o.sample, o.near, o.other});
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
      if (part.near.f > limits_.tolerance_mm) asked.add(part.near, probe.point, limits_.tolerance_mm + probe.reach);
    }
    block.evaluations += there.size();
    asked.answer(volume_);
    for (Open* part : there) {
      if (part->near.strip < 0)
        block.lost.push_back({part->sample, shape_.area_bound(part->cell)});
      else
        block.open.push_back(*part);
    }
    settle(block);
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

#include "flank/verify/proof/cover_search.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"

namespace flank::internal::verify {
namespace {

constexpr std::size_t kBlock = 128;       ///< cells per task. Fixed, so that the number of threads changes nothing
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

class CoverSearch {
 public:
  CoverSearch(const SweptVolume& volume, const Shape& shape, const FaceSamples& samples, const CoverLimits& limits)
      : volume_(volume), shape_(shape), samples_(samples), limits_(limits) {}

  ProvedCover run(std::span<const SweptDistance> distances) {
    out_.open_mm2.assign(samples_.points.size(), 0.0);
    std::vector<Open> open = begin(distances);
    for (int depth = 0; !open.empty(); ++depth) {
      stop_here();
      const bool enough = settled(open);
      const std::size_t most = std::min(limits_.cells, limits_.evaluations - out_.evaluations);
      std::vector<Open> parts;
      if (depth < kDeepest && !enough) parts = cut(open, most);
      if (parts.empty() || parts.size() > most) {
        for (const Open& o : open) out_.open_mm2[o.sample] += shape_.area_bound(o.cell);
        break;
      }
      open = {};  // a cell takes 150 bytes, and there may be a million
      open = look(std::move(parts));
    }
    for (std::size_t i = 0; i < out_.open_mm2.size(); ++i)
      out_.open_mm2[i] = std::min(out_.open_mm2[i] * kRounding, samples_.areas[i]);
    return std::move(out_);
  }

 private:
  struct Block {
    std::vector<Open> open;
    std::vector<Lost> lost;
    std::vector<Vec3> hull;
    std::size_t evaluations = 0;
  };

  template <class Body>
  std::vector<Open> in_blocks(std::size_t count, const Body& body) {
    std::vector<Block> blocks((count + kBlock - 1) / kBlock);
    parallel_blocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i, blocks[begin / kBlock]);
    });
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
    return in_blocks(distances.size(), [&](std::size_t i, Block& block) {
      const SweptDistance& d = distances[i];
      const double reach = samples_.reaches_mm.empty() ? samples_.spacing_mm : samples_.reaches_mm[i];
      if (d.strip < 0 || d.f - reach > limits_.tolerance_mm) {
        block.lost.push_back({i, samples_.areas[i]});
        return;
      }
      Open open{shape_.cell_of(samples_.cells[i]), i, d};
      if (near_all_of(open, block)) return;
      (void)shape_.look(open.cell);  // what splitting needs
      block.open.push_back(open);
    });
  }

  /// Whether the ball leaves no place of the cell farther away than the tolerance: a distance is convex, so the corners
  /// of a hull tell.
  [[nodiscard]] bool near_all_of(const Open& open, Block& block) const {
    if (!shape_.hull(open.cell, block.hull)) return false;
    const SweptVolume::Ball ball = volume_.ball(open.near);
    const double most = ball.radius + limits_.tolerance_mm;
    return std::all_of(block.hull.begin(), block.hull.end(),
                       [&](const Vec3& p) { return (p - ball.center).norm() <= most; });
  }

  /// Counted, not guessed, because a long cell is cut in two, a square one in four; ends where it has more than `most`.
  [[nodiscard]] std::vector<Open> cut(const std::vector<Open>& open, std::size_t most) const {
    std::vector<Open> parts;
    std::vector<Cell> cells;
    for (const Open& o : open) {
      if (parts.size() > most) break;
      cells.clear();
      shape_.split(o.cell, cells);
      for (const Cell& cell : cells) parts.push_back({cell, o.sample, o.near});
    }
    return parts;
  }

  std::vector<Open> look(std::vector<Open> parts) {
    return in_blocks(parts.size(), [&](std::size_t i, Block& block) {
      Open& part = parts[i];
      const Probe probe = shape_.look(part.cell);
      if (probe.empty) return;
      ++block.evaluations;
      const double far = limits_.tolerance_mm + probe.reach;
      part.near = volume_.distance_from(probe.point, part.near);
      // Descent may have missed the best ball.
      if (part.near.f > far) {
        const SweptDistance best = volume_.distance(probe.point, far);
        if (best.strip < 0 || best.f > far) {
          block.lost.push_back({part.sample, shape_.area_bound(part.cell)});
          return;
        }
        part.near = best;
      }
      if (!near_all_of(part, block)) block.open.push_back(part);
    });
  }

  /// Whether the cells' area is too small to matter. Mostly a few of them tell that it is not.
  [[nodiscard]] bool settled(const std::vector<Open>& open) const {
    double sum = 0.0;
    return std::all_of(open.begin(), open.end(), [&](const Open& o) {
      sum += std::min(shape_.area_bound(o.cell), samples_.areas[o.sample]);
      return sum <= limits_.gap_mm2;
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

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/judge.h"
#include "flank/verify/swept/swept_search.h"

namespace flank {
namespace {

using namespace internal::verify;

/// A piece moves the axis by at most this share of the smallest radius: so short that one minimum over time belongs to
/// each minimum over s (tested, not proved: docs/algorithms/judge.md). For needles, a share of the axis bounds the
/// number of pieces.
constexpr double kPieceReachRadii = 0.1, kPieceReachLengths = 1e-3;

double piece_reach(const RadialTable& radial) {
  return std::max(kPieceReachRadii * radial.least_radius(), kPieceReachLengths * radial.length());
}

}  // namespace

struct SweptVolume::Data {
  Tool tool;
  ToolDistance distance;
  PoseTree tree;
  Data(const Tool& t, const Path& path)
      : tool(t), distance(t.radial), tree(path, t.radial.axis_length(), piece_reach(distance.radial())) {}

  /// The value at a place, by the tool's own radial function.
  [[nodiscard]] SweptDistance at(const Vec3& x, const SweptPlace& place) const {
    if (place.piece < 0) return {place.f, -1, 0.0, 0.0};
    const Segment& g = tree.segment_of(place.piece);
    const double f = (x - g.at(place.tau).at(place.s)).norm() - tool.radial.at(place.s).r;
    return {f, g.strip, g.pose + place.tau, place.s};
  }
};

SweptVolume::SweptVolume(const Tool& tool, const Path& path) : data_(std::make_unique<const Data>(tool, path)) {}
SweptVolume::~SweptVolume() = default;
SweptVolume::SweptVolume(SweptVolume&&) noexcept = default;

SweptDistance SweptVolume::distance(const Vec3& x, double horizon_mm) const {
  return data_->at(x, SweptSearch(data_->distance, data_->tree, x).run(horizon_mm, {}));
}

void SweptVolume::distances(std::span<const Vec3> points, double horizon_mm, std::span<SweptDistance> out) const {
  distances(points, std::vector<double>(points.size(), horizon_mm), out);
}

void SweptVolume::distances(std::span<const Vec3> points, std::span<const double> horizons_mm,
                            std::span<SweptDistance> out) const {
  FLANK_ASSERT(out.size() == points.size() && horizons_mm.size() == points.size());
  SweptPlace near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweptPlace place = SweptSearch(data_->distance, data_->tree, points[i]).run(horizons_mm[i], near);
    out[i] = data_->at(points[i], place);
    if (place.piece >= 0) near = place;
  }
}

}  // namespace flank

#include "flank/verify/swept_volume.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

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

SweptVolume::Data::Data(const Tool& t, const Path& path)
    : tool(t), distance(t.radial), tree(path, t.radial.axis_length(), piece_reach(distance.radial())) {}

SweptDistance SweptVolume::Data::at(const Vec3& x, const SweptPlace& place) const {
  if (place.piece < 0) return {place.f, -1, 0.0, 0.0};
  const Segment& g = tree.segment_of(place.piece);
  const double f = (x - g.at(place.tau).at(place.s)).norm() - tool.radial.at(place.s).r;
  return {f, g.strip, g.pose + place.tau, place.s};
}

SweptPlace SweptVolume::Data::find(const SweptDistance& place) const {
  const auto before = [&](const Piece& piece) {
    const Segment& g = tree.segments[static_cast<std::size_t>(piece.segment)];
    return g.strip < place.strip || (g.strip == place.strip && g.pose + piece.high < place.t);
  };
  const auto at = std::partition_point(tree.pieces.begin(), tree.pieces.end(), before);
  const int piece = static_cast<int>(std::min(at, tree.pieces.end() - 1) - tree.pieces.begin());
  return {place.f, piece, place.t - tree.segment_of(piece).pose, place.s};
}

SweptVolume::SweptVolume(const Tool& tool, const Path& path) : data_(std::make_unique<const Data>(tool, path)) {}
SweptVolume::~SweptVolume() = default;
SweptVolume::SweptVolume(SweptVolume&&) noexcept = default;

SweptDistance SweptVolume::distance(const Vec3& x, double horizon_mm) const {
  return data_->at(x, data_->search(x).run(horizon_mm, {}));
}

void SweptVolume::distances(std::span<const Vec3> points, double horizon_mm, std::span<SweptDistance> out) const {
  distances(points, std::vector<double>(points.size(), horizon_mm), out);
}

void SweptVolume::distances(std::span<const Vec3> points, std::span<const double> horizons_mm,
                            std::span<SweptDistance> out) const {
  FLANK_ASSERT(out.size() == points.size() && horizons_mm.size() == points.size());
  SweptPlace near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweptPlace place = data_->search(points[i]).run(horizons_mm[i], near);
    out[i] = data_->at(points[i], place);
    if (place.piece >= 0) near = place;
  }
}

SweptDistance SweptVolume::distance_from(const Vec3& x, const SweptDistance& near) const {
  FLANK_ASSERT(near.strip >= 0);
  SweptSearch search = data_->search(x);
  const SweptPlace start = data_->find(near);
  const SweptPlace place = search.descend_from(start);
  return data_->at(x, place.piece >= 0 ? place : start);
}

SweptVolume::Ball SweptVolume::ball(const SweptDistance& place) const {
  FLANK_ASSERT(place.strip >= 0);
  const SweptPlace at = data_->find(place);
  return {data_->tree.segment_of(at.piece).at(at.tau).at(at.s), data_->tool.radial.at(at.s).r};
}

}  // namespace flank

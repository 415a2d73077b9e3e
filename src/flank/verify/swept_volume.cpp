#include "flank/verify/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"

namespace flank {
namespace {

using namespace internal::verify;

/// A piece moves the axis by at most this share of the smallest radius: so short that one minimum over time belongs to
/// each minimum over s (tested, not proved: docs/algorithms/judge.md). For needles, a share of the axis bounds the
/// number of pieces.
constexpr double kPieceReachRadii = 0.1, kPieceReachLengths = 1e-3;

/// Points that follow each other begin their searches below the same nodes of the tree, where they are at least so many and
/// within this share of the smallest radius of their middle; and how far such nodes reach, in smallest radii.
constexpr std::size_t kFewest = 3, kMost = 16;
constexpr double kTogether = 0.1, kRootReach = 0.25;
/// What rounding may make of a bound, mm.
constexpr double kRounding = 1e-9;

/// How many of the points from the first one on lie together; then their box.
std::size_t together(std::span<const Vec3> points, double apart, Box3& box) {
  std::size_t count = 0;
  for (; count < std::min(points.size(), kMost); ++count) {
    Box3 wider = box;
    wider.add(points[count]);
    if (wider.diagonal() > 2.0 * apart) break;
    box = wider;
  }
  return count;
}

double piece_reach(const RadialTable& radial) {
  return std::max(kPieceReachRadii * radial.least_radius(), kPieceReachLengths * radial.length());
}

}  // namespace

SweptVolume::Data::Data(const Tool& t, std::shared_ptr<const ToolDistance> of_tool, const Path& path)
    : tool(t), distance(std::move(of_tool)), tree(path, t.radial.axis_length(), piece_reach(distance->radial())) {}

SweptDistance SweptVolume::Data::at(const Vec3& x, const SweptPlace& place) const {
  if (place.piece < 0) return {place.f, -1, 0.0, 0.0};
  const Segment& g = tree.segment_of(place.piece);
  const double f = (x - g.at(place.tau).at(place.s)).norm() - tool.radial.at(place.s).r;
  return {f, g.strip, g.pose + place.tau, place.s};
}

// f has slope 1, by x and for every ball.
std::vector<int> SweptVolume::Data::roots(const Vec3& x, double spread, double horizon, const SweptPlace& near) const {
  const RadialTable& radial = distance->radial();
  if (near.piece >= 0) {
    const Vec3 centre = tree.segment_of(near.piece).at(near.tau).at(near.s);
    horizon = std::min(horizon, (x - centre).norm() - radial.radius(near.s) + spread);
  }
  return search(x).roots_below(horizon + spread + kRounding, kRootReach * radial.least_radius());
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

SweptVolume::SweptVolume(const Tool& tool, const Path& path)
    : data_(std::make_unique<const Data>(tool, std::make_shared<const ToolDistance>(tool.radial), path)) {}
SweptVolume::SweptVolume(const SweptVolume& of_tool, const Path& path)
    : data_(std::make_unique<const Data>(of_tool.data_->tool, of_tool.data_->distance, path)) {}
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
  const double apart = kTogether * data_->distance->radial().least_radius();
  for (std::size_t i = 0; i < points.size();) {
    Box3 box;
    const std::size_t count = std::max<std::size_t>(1, together(points.subspan(i), apart, box));
    std::vector<int> roots{0};
    if (count >= kFewest) {
      const double horizon = *std::max_element(horizons_mm.begin() + i, horizons_mm.begin() + i + count);
      roots = data_->roots(box.center(), 0.5 * box.diagonal(), horizon, near);
    }
    for (const std::size_t end = i + count; i < end; ++i) {
      SweptSearch search = data_->search(points[i]);
      const SweptPlace place = search.run(horizons_mm[i], near, roots);
      out[i] = data_->at(points[i], place);
      if (place.piece >= 0) near = place;
    }
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

SweptVolume::BallWay SweptVolume::ball_way(const SweptDistance& place) const {
  FLANK_ASSERT(place.strip >= 0);
  const SweptPlace at = data_->find(place);
  const auto& g = data_->tree.segment_of(at.piece);
  const Vec3 w1 = g.w0 + g.dw, u0 = g.w0.normalized(), u1 = w1.normalized();
  BallWay way{g.a0 + at.s * u0, g.da + at.s * (u1 - u0), data_->tool.radial.at(at.s).r, 0.0};
  // Between unit vectors the chord has the directions of the arc, at the same tau, and is shorter than 1 by c^2 / 4 at most; what
  // their lengths lack to 1 moves tau.
  const double lengths = std::abs(g.w0.norm() - 1.0) + std::abs(w1.norm() - 1.0);
  way.off = at.s * (0.25 * (u1 - u0).squaredNorm() + 2.0 * lengths);
  return way;
}

}  // namespace flank

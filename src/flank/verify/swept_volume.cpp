#include "flank/verify/swept_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/verify/swept/chord_way.h"

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
constexpr double kTogether = 2.0, kRootReach = 2.0;
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

/// Strips [0, count).
Path first_strips(const Path& path, std::size_t count) {
  if (count == path.strips.size()) return path;
  Path out;
  out.strips.assign(path.strips.begin(), path.strips.begin() + static_cast<std::ptrdiff_t>(count));
  return out;
}

double piece_reach(const RadialTable& radial) {
  return std::max(kPieceReachRadii * radial.least_radius(), kPieceReachLengths * radial.length());
}

}  // namespace

SweptVolume::Data::Data(const Tool& t, std::shared_ptr<const ToolDistance> of_tool, const Path& path)
    : tool(t),
      distance(std::move(of_tool)),
      copies(find_copies(path, t.radial.axis_length())),
      tree(first_strips(path, copies.strips), t.radial.axis_length(), piece_reach(distance->radial())) {}

const std::vector<std::pair<double, int>>& SweptVolume::Data::near_copies(const Vec3& x, double horizon) const {
  thread_local std::vector<std::pair<double, int>> found;
  found.clear();
  const int count = static_cast<int>(copies.turns.size());
  for (int copy = 0; copy < count; ++copy) {
    const Vec3 y = turned_back(x, copy);
    const double least = count > 1 ? SweptSearch(*distance, tree, y).least() : -1e300;
    if (least < horizon) found.emplace_back(least, copy);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void SweptVolume::Data::search_copy(const Vec3& x, int copy, std::span<const int> nodes, const CopyPlace& near,
                                    CopyPlace& best) const {
  const Vec3 y = turned_back(x, copy);
  SweptSearch search(*distance, tree, y);
  const SweptPlace found = search.run(best.place.f, copy == near.copy ? near.place : SweptPlace{}, nodes);
  if (found.piece >= 0) best = {copy, found};
}

CopyPlace SweptVolume::Data::nearest(const Vec3& x, double horizon, const CopyPlace& near,
                                     const std::vector<CopyRoots>& roots) const {
  CopyPlace best{0, {horizon, -1, 0.0, 0.0}};
  for (const CopyRoots& start : roots)
    if (start.least < best.place.f) search_copy(x, start.copy, start.nodes, near, best);
  return best;
}

CopyPlace SweptVolume::Data::nearest(const Vec3& x, double horizon, const CopyPlace& near) const {
  constexpr std::array<int, 1> kRoot{0};
  CopyPlace best{0, {horizon, -1, 0.0, 0.0}};
  for (const auto& [least, copy] : near_copies(x, horizon))
    if (least < best.place.f) search_copy(x, copy, kRoot, near, best);
  return best;
}

SweptDistance SweptVolume::Data::at(const Vec3& x, const CopyPlace& found) const {
  const SweptPlace& place = found.place;
  if (place.piece < 0) return {place.f, -1, 0.0, 0.0};
  const Segment& g = tree.segment_of(place.piece);
  const double f = (turned_back(x, found.copy) - g.at(place.tau).at(place.s)).norm() - tool.radial.at(place.s).r;
  return {f, found.copy * static_cast<int>(copies.strips) + g.strip, g.pose + place.tau, place.s};
}

// f has slope 1, by x and for every ball.
std::vector<CopyRoots> SweptVolume::Data::roots(const Vec3& x, double spread, double horizon,
                                                const CopyPlace& near) const {
  const RadialTable& radial = distance->radial();
  if (near.place.piece >= 0) {
    const SweptPlace& place = near.place;
    const Vec3 centre = tree.segment_of(place.piece).at(place.tau).at(place.s);
    horizon = std::min(horizon, (turned_back(x, near.copy) - centre).norm() - radial.radius(place.s) + spread);
  }
  const double value = horizon + spread + kRounding;
  std::vector<CopyRoots> out;
  for (const auto& [least, copy] : near_copies(x, value)) out.push_back({copy, least - spread, {}});
  for (CopyRoots& start : out) {
    const Vec3 y = turned_back(x, start.copy);
    start.nodes = SweptSearch(*distance, tree, y).roots_below(value, kRootReach * radial.least_radius());
  }
  return out;
}

CopyPlace SweptVolume::Data::find(const SweptDistance& place) const {
  const int strips = static_cast<int>(copies.strips), strip = place.strip % strips;
  const auto before = [&](const Piece& piece) {
    const Segment& g = tree.segments[static_cast<std::size_t>(piece.segment)];
    return g.strip < strip || (g.strip == strip && g.pose + piece.high < place.t);
  };
  const auto at = std::partition_point(tree.pieces.begin(), tree.pieces.end(), before);
  const int piece = static_cast<int>(std::min(at, tree.pieces.end() - 1) - tree.pieces.begin());
  return {place.strip / strips, {place.f, piece, place.t - tree.segment_of(piece).pose, place.s}};
}

SweptVolume::SweptVolume(const Tool& tool, const Path& path)
    : data_(std::make_unique<const Data>(tool, std::make_shared<const ToolDistance>(tool.radial), path)) {}
SweptVolume::SweptVolume(const SweptVolume& of_tool, const Path& path)
    : data_(std::make_unique<const Data>(of_tool.data_->tool, of_tool.data_->distance, path)) {}
SweptVolume::~SweptVolume() = default;
SweptVolume::SweptVolume(SweptVolume&&) noexcept = default;

SweptDistance SweptVolume::distance(const Vec3& x, double horizon_mm) const {
  return data_->at(x, data_->nearest(x, horizon_mm, {}));
}

void SweptVolume::distances(std::span<const Vec3> points, double horizon_mm, std::span<SweptDistance> out) const {
  distances(points, std::vector<double>(points.size(), horizon_mm), out);
}

void SweptVolume::distances(std::span<const Vec3> points, std::span<const double> horizons_mm,
                            std::span<SweptDistance> out) const {
  FLANK_ASSERT(out.size() == points.size() && horizons_mm.size() == points.size());
  CopyPlace near;
  const double apart = kTogether * data_->distance->radial().least_radius();
  for (std::size_t i = 0; i < points.size();) {
    Box3 box;
    const std::size_t count = std::max<std::size_t>(1, together(points.subspan(i), apart, box));
    std::vector<CopyRoots> shared;
    if (count >= kFewest) {
      const double horizon = *std::max_element(horizons_mm.begin() + i, horizons_mm.begin() + i + count);
      shared = data_->roots(box.center(), 0.5 * box.diagonal(), horizon, near);
    }
    for (const std::size_t end = i + count; i < end; ++i) {
      const CopyPlace found = count >= kFewest ? data_->nearest(points[i], horizons_mm[i], near, shared)
                                               : data_->nearest(points[i], horizons_mm[i], near);
      out[i] = data_->at(points[i], found);
      if (found.place.piece >= 0) near = found;
    }
  }
}

SweptDistance SweptVolume::distance_from(const Vec3& x, const SweptDistance& near) const {
  FLANK_ASSERT(near.strip >= 0);
  const CopyPlace start = data_->find(near);
  const Vec3 y = data_->turned_back(x, start.copy);
  const SweptPlace place = SweptSearch(*data_->distance, data_->tree, y).descend_from(start.place);
  return data_->at(x, place.piece >= 0 ? CopyPlace{start.copy, place} : start);
}

SweptVolume::Ball SweptVolume::ball(const SweptDistance& place) const {
  FLANK_ASSERT(place.strip >= 0);
  const auto [copy, at] = data_->find(place);
  return {data_->turn(copy).forth * data_->tree.segment_of(at.piece).at(at.tau).at(at.s),
          data_->tool.radial.at(at.s).r};
}

SweptVolume::BallWay SweptVolume::ball_way(const SweptDistance& place) const { return ball_way(place, 0.0, 0.0); }

SweptVolume::BallWay SweptVolume::ball_way(const SweptDistance& place, double reach_mm, double most_off_mm) const {
  FLANK_ASSERT(place.strip >= 0);
  const auto [copy, at] = data_->find(place);
  const int own = data_->tree.pieces[static_cast<std::size_t>(at.piece)].segment;
  const Vec3 here = data_->tree.segments[static_cast<std::size_t>(own)].at(at.tau).at(at.s);
  ChordWay way(data_->tree.segments, own, at.s, most_off_mm);
  for (const int step : {1, -1})
    while ((way.end(step) - here).squaredNorm() < reach_mm * reach_mm)
      if (!way.go_on(step)) break;
  const Eigen::Isometry3d& forth = data_->turn(copy).forth;
  return {forth * way.end(-1), forth.linear() * (way.end(1) - way.end(-1)), data_->tool.radial.at(at.s).r, way.off()};
}

}  // namespace flank

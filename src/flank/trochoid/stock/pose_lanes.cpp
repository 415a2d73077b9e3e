#include "flank/trochoid/stock/pose_lanes.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// What single precision may lose, mm: places are some tool radii from the row's.
constexpr double kSpareMm = 1e-3;

struct SeenArrays {
  double *x, *y, *along, *tilt, *beyond;
};

FLANK_LANES void see_bundles(std::size_t count, const RowFrame& frame, const ToolReach& tool, const RowDisc& disc,
                             const std::array<const double*, 7>& at, const SeenArrays& out) {
  const double* __restrict mx = at[0];
  const double* __restrict my = at[1];
  const double* __restrict mz = at[2];
  const double* __restrict ax = at[3];
  const double* __restrict ay = at[4];
  const double* __restrict az = at[5];
  const double* __restrict spread = at[6];
  double* __restrict seen_x = out.x;
  double* __restrict seen_y = out.y;
  double* __restrict along = out.along;
  double* __restrict tilt = out.tilt;
  double* __restrict beyond = out.beyond;
  const Vec3 middle = frame.axis.at(0.5 * tool.length), u = frame.axis.u, x = frame.x, y = frame.y;
  for (std::size_t k = 0; k < count; ++k) {
    const double ex = mx[k] - middle.x(), ey = my[k] - middle.y(), ez = mz[k] - middle.z();
    seen_x[k] = ex * x.x() + ey * x.y() + ez * x.z();
    seen_y[k] = ex * y.x() + ey * y.y() + ez * y.z();
    along[k] = ex * u.x() + ey * u.y() + ez * u.z();
    // At least the length of the difference, without its root.
    const double tx = std::abs(ax[k] - u.x()), ty = std::abs(ay[k] - u.y()), tz = std::abs(az[k] - u.z());
    const double xy = tx < ty ? ty : tx, most = xy < tz ? tz : xy;
    tilt[k] = 0.5 * (most + (tx + ty + tz));
  }
  for (std::size_t k = 0; k < count; ++k) {
    // How far the axes may be away and still reach the disc: tilts bring them nearer at one end.
    const double most = spread[k] + tool.largest + disc.radius + (0.75 * tool.length + std::abs(along[k])) * tilt[k];
    const double dx = seen_x[k] - disc.x, dy = seen_y[k] - disc.y;
    // Layers above or below: their tools do not come down or up to these rings.
    const double height = along[k] + 0.5 * tool.length, slack = tool.half + spread[k] + most * tilt[k];
    const double far = dx * dx + dy * dy > most * most ? 1.0 : 0.0, below = height + slack < disc.low ? 1.0 : far;
    beyond[k] = height - slack > disc.high ? 1.0 : below;
  }
}

/// A bundle, in the frame of a row.
struct SeenBundle {
  double x, y, along, tilt, spread;
};

FLANK_LANES void meet_discs(std::size_t count, const SeenBundle& bundle, const ToolReach& tool,
                            const std::array<const double*, 5>& at, std::int64_t* __restrict met) {
  const double* __restrict x = at[0];
  const double* __restrict y = at[1];
  const double* __restrict radius = at[2];
  const double* __restrict low = at[3];
  const double* __restrict high = at[4];
  const double reach = bundle.spread + tool.largest + (0.75 * tool.length + std::abs(bundle.along)) * bundle.tilt;
  const double height = bundle.along + 0.5 * tool.length, half = tool.half + bundle.spread;
  for (std::size_t k = 0; k < count; ++k) {
    const double most = reach + radius[k], dx = bundle.x - x[k], dy = bundle.y - y[k];
    const double slack = half + most * bundle.tilt;
    const std::int64_t near = dx * dx + dy * dy > most * most ? 0 : 1, above = height + slack < low[k] ? 0 : near;
    met[k] = height - slack > high[k] ? 0 : above;
  }
}

/// A disc that holds these, one at least: about the box that holds them.
RowDisc around(std::span<const RowDisc> discs) {
  double left = discs[0].x, right = left, down = discs[0].y, up = down;
  RowDisc out = discs[0];
  for (const RowDisc& disc : discs) {
    left = std::min(left, disc.x - disc.radius), right = std::max(right, disc.x + disc.radius);
    down = std::min(down, disc.y - disc.radius), up = std::max(up, disc.y + disc.radius);
    out.low = std::min(out.low, disc.low), out.high = std::max(out.high, disc.high);
  }
  out.x = 0.5 * (left + right), out.y = 0.5 * (down + up);
  out.radius = 0.5 * std::hypot(right - left, up - down);
  return out;
}

/// Where axes meet the plane of a row.
FLANK_LANES void look_at_lanes(const RowFrame& frame, const std::array<const double*, 6>& from, PoseLanes& out) {
  constexpr std::size_t kCount = PoseLanes::kCount;
  const double *px = from[0], *py = from[1], *pz = from[2], *ax = from[3], *ay = from[4], *az = from[5];
  const Vec3 tip = frame.axis.tip, u = frame.axis.u, x = frame.x, y = frame.y;
  PoseLanes::Doubles ex, ey, ez, up, along;
  for (std::size_t k = 0; k < kCount; ++k) {
    ex[k] = px[k] - tip.x(), ey[k] = py[k] - tip.y(), ez[k] = pz[k] - tip.z();
    along[k] = ax[k] * u.x() + ay[k] * u.y() + az[k] * u.z();
    up[k] = ex[k] * u.x() + ey[k] * u.y() + ez[k] * u.z();
    out.forward[k] = static_cast<float>(along[k]);
    out.below[k] = static_cast<float>(-(ex[k] * ax[k] + ey[k] * ay[k] + ez[k] * az[k]));
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    out.dh[k] = 1.0 / along[k];
    out.h0[k] = -up[k] * out.dh[k];
    out.dx[k] = (ax[k] * x.x() + ay[k] * x.y() + az[k] * x.z()) * out.dh[k];
    out.dy[k] = (ax[k] * y.x() + ay[k] * y.y() + az[k] * y.z()) * out.dh[k];
    out.x0[k] = ex[k] * x.x() + ey[k] * x.y() + ez[k] * x.z() - up[k] * out.dx[k];
    out.y0[k] = ex[k] * y.x() + ey[k] * y.y() + ez[k] * y.z() - up[k] * out.dy[k];
  }
}

/// Where they begin in the plane and how far they go on, over the heights of the tool, and a little more where they lean.
FLANK_LANES void extend_lanes(const ToolReach& tool, PoseLanes& out) {
  const auto low = static_cast<float>(tool.low), height = static_cast<float>(tool.high - tool.low),
             largest = static_cast<float>(tool.largest);
  for (std::size_t k = 0; k < PoseLanes::kCount; ++k) {
    const auto dx = static_cast<float>(out.dx[k]), dy = static_cast<float>(out.dy[k]);
    const float wide = std::abs(dx), narrow = std::abs(dy);
    // At least the length of (dx, dy), without its root.
    const float slope = (wide < narrow ? narrow : wide) + 0.5F * (wide < narrow ? wide : narrow);
    const float slack = largest * slope, first = low - slack, range = height + 2.0F * slack;
    out.from_x[k] = static_cast<float>(out.x0[k]) + first * dx;
    out.from_y[k] = static_cast<float>(out.y0[k]) + first * dy;
    out.by_x[k] = range * dx, out.by_y[k] = range * dy;
    const float by2 = out.by_x[k] * out.by_x[k] + out.by_y[k] * out.by_y[k];
    out.per_by2[k] = 1.0F / (by2 > 1e-12F ? by2 : 1e-12F);
    out.lean_x[k] = out.forward[k] * dx, out.lean_y[k] = out.forward[k] * dy;
    out.lean[k] = out.forward[k] * slope;
  }
}

using Hits = std::array<std::int32_t, PoseLanes::kCount>;

/// Adds to `hit` which of them may cover something of the disc.
FLANK_LANES void meet_disc(const PoseLanes& lanes, const ToolReach& tool, const RowDisc& disc, Hits& hit) {
  const auto x = static_cast<float>(disc.x), y = static_cast<float>(disc.y),
             radius = static_cast<float>(disc.radius + kSpareMm), reach = static_cast<float>(tool.largest) + radius,
             low = static_cast<float>(disc.low - kSpareMm), high = static_cast<float>(disc.high + kSpareMm),
             tool_low = static_cast<float>(tool.low - kSpareMm), tool_high = static_cast<float>(tool.high + kSpareMm);
  for (std::size_t k = 0; k < PoseLanes::kCount; ++k) {
    const float ax = lanes.from_x[k] - x, ay = lanes.from_y[k] - y;
    const float share = -(ax * lanes.by_x[k] + ay * lanes.by_y[k]) * lanes.per_by2[k];
    const float above = share > 0.0F ? share : 0.0F, within = above < 1.0F ? above : 1.0F;
    const float nx = ax + within * lanes.by_x[k], ny = ay + within * lanes.by_y[k];
    // Heights of the places of the disc along this axis.
    const float middle = x * lanes.lean_x[k] + y * lanes.lean_y[k] + lanes.below[k];
    const float swing = radius * lanes.lean[k];
    const float most = reach + lanes.spread[k], more = swing + 2.0F * lanes.spread[k];
    const std::int32_t near = nx * nx + ny * ny <= most * most ? 1 : 0;
    const std::int32_t over = middle + more + high * lanes.forward[k] >= tool_low ? near : 0;
    hit[k] |= middle - more + low * lanes.forward[k] <= tool_high ? over : 0;
  }
}

bool any_of(const Hits& hits) {
  return std::any_of(hits.begin(), hits.end(), [](std::int32_t hit) { return hit != 0; });
}

}  // namespace

void BundleLanes::add(const Sweep::Chunk& chunk, const Vec3& axis, double past_ends) {
  for (int c = 0; c < 3; ++c) {
    at[static_cast<std::size_t>(c)].push_back(chunk.middle[c]);
    at[static_cast<std::size_t>(c) + 3].push_back(axis[c]);
    poses[static_cast<std::size_t>(c)].push_back(chunk.pose.tip[c]);
    poses[static_cast<std::size_t>(c) + 3].push_back(chunk.pose.axis[c]);
  }
  at[6].push_back(chunk.reach);
  poses[6].push_back((1.0 + 2.0 * past_ends) * chunk.spread + kSpareMm);
}

void BundleLanes::clear() {
  for (std::vector<double>& values : at) values.clear();
  for (std::vector<double>& values : poses) values.clear();
}

void SeenBundles::look(const RowFrame& frame, const ToolReach& tool, const BundleLanes& bundles, std::size_t count,
                       const RowDisc& whole) {
  for (std::vector<double>* values : {&x, &y, &along, &tilt, &beyond}) values->resize(count);
  std::array<const double*, 7> at{};
  for (std::size_t c = 0; c < at.size(); ++c) at[c] = bundles.at[c].data();
  see_bundles(count, frame, tool, whole, at, {x.data(), y.data(), along.data(), tilt.data(), beyond.data()});
}

void DiscLanes::take(std::span<const RowDisc> discs) {
  for (std::vector<double>& values : at) values.clear();
  for (const RowDisc& disc : discs) {
    const std::array<double, 5> values = {disc.x, disc.y, disc.radius, disc.low, disc.high};
    for (std::size_t c = 0; c < at.size(); ++c) at[c].push_back(values[c]);
  }
  met.resize(discs.size());
}

void DiscLanes::meet(const SeenBundles& seen, std::size_t k, double spread, const ToolReach& tool,
                     std::span<const RowDisc> discs, std::vector<RowDisc>& some) {
  std::array<const double*, 5> from{};
  for (std::size_t c = 0; c < at.size(); ++c) from[c] = at[c].data();
  meet_discs(discs.size(), {seen.x[k], seen.y[k], seen.along[k], seen.tilt[k], spread}, tool, from, met.data());
  some.clear();
  for (std::size_t d = 0; d < discs.size(); ++d)
    if (met[d] != 0) some.push_back(discs[d]);
}

void PoseLanes::look(const RowFrame& frame, const ToolReach& tool, const Sweep& sweep, std::size_t first) {
  project(frame, sweep, first);
  extend_lanes(tool, *this);
  spread.fill(0.0F);
}

void PoseLanes::look_roughly(const RowFrame& frame, const ToolReach& tool, const Sweep& sweep, std::size_t first) {
  std::array<const double*, 6> from{};
  for (std::size_t c = 0; c < from.size(); ++c) from[c] = sweep.rough_lanes[c].data() + first;
  look_at_lanes(frame, from, *this);
  extend_lanes(tool, *this);
  spread.fill(0.0F);
}

void PoseLanes::look(const RowFrame& frame, const ToolReach& tool, const BundleLanes& bundles,
                     std::span<const std::size_t> which) {
  std::array<Doubles, 6> some;  // not set
  std::array<const double*, 6> from{};
  for (std::size_t c = 0; c < from.size(); ++c) {
    for (std::size_t k = 0; k < kCount; ++k) some[c][k] = bundles.poses[c][which[std::min(k, which.size() - 1)]];
    from[c] = some[c].data();
  }
  look_at_lanes(frame, from, *this);
  extend_lanes(tool, *this);
  for (std::size_t k = 0; k < kCount; ++k)
    spread[k] = static_cast<float>(bundles.poses[6][which[std::min(k, which.size() - 1)]]);
}

void PoseLanes::project(const RowFrame& frame, const Sweep& sweep, std::size_t first) {
  look_at_lanes(frame, sweep.lanes_at(first), *this);
}

bool PoseLanes::meets(const ToolReach& tool, const RowDisc& all, std::span<const RowDisc> discs) {
  Hits in_all{};
  meet_disc(*this, tool, discs.empty() ? all : around(discs), in_all);
  for (std::size_t k = 0; k < kCount; ++k) in_all[k] = is_near(k) || spread[k] > 0.0F ? in_all[k] : 0;
  hit = in_all;
  if (discs.empty() || !any_of(in_all)) return any_of(in_all);
  Hits some{};
  for (const RowDisc& disc : discs) {
    meet_disc(*this, tool, disc, some);
    std::int32_t missing = 0;
    for (std::size_t k = 0; k < kCount; ++k) missing |= in_all[k] & ~some[k];
    if (missing == 0) break;
  }
  for (std::size_t k = 0; k < kCount; ++k) hit[k] &= some[k];
  return true;
}

}  // namespace flank::internal

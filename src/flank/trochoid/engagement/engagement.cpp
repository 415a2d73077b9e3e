#include "flank/trochoid/engagement/engagement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "flank/base/assert.h"
#include "flank/trochoid/engagement/arc_end.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;
/// Arcs that are shorter than this between two poses may be the scallops between sampled poses: radians.
constexpr double kSliver = 0.35;

double simpson(int i, int count) {
  const double third = 1.0 / (3.0 * (count - 1));
  return i == 0 || i == count - 1 ? third : (i % 2 == 1 ? 4.0 : 2.0) * third;
}

/// The rows that are larger than their neighbours, the largest few.
std::vector<std::size_t> largest_rows(const std::vector<EngagementRow>& rows) {
  constexpr std::size_t kPeaks = 3;
  const int n = static_cast<int>(rows.size());
  const auto at = [&](int k) { return rows[static_cast<std::size_t>(std::clamp(k, 0, n - 1))].angle_rad; };
  std::vector<std::size_t> order;
  for (int i = 0; i < n; ++i)
    if (at(i) > 0.0 && at(i) >= at(i - 1) && at(i) >= at(i + 1)) order.push_back(static_cast<std::size_t>(i));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].angle_rad > rows[b].angle_rad; });
  order.resize(std::min(order.size(), kPeaks));
  return order;
}

/// Golden section for the largest value between two places; returns where.
template <class F>
double golden(double low, double high, const F& f) {
  constexpr int kSections = 14;
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), fa = f(a), fb = f(b);
  for (int k = 0; k < kSections; ++k) {
    if (fa > fb) {
      high = b, b = a, fb = fa;
      fa = f(a = high - kGolden * (high - low));
    } else {
      low = a, a = b, fa = fb;
      fb = f(b = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

Vec3 radial_direction(const Vec3& x, const Vec3& y, double angle) { return std::cos(angle) * x + std::sin(angle) * y; }

}  // namespace

void EngagementMeter::begin(const RuledMotion& motion) { own_ = Sweep::of(motion, kOwnIntervals); }

EngagementMeter::Frame EngagementMeter::frame_of(const RuledMotion& motion, double t) const {
  Frame frame{motion.jet(t), {}, {}};
  frame.x = frame.axis.u.unitOrthogonal();
  frame.y = frame.axis.u.cross(frame.x);
  return frame;
}

void EngagementMeter::gather(const Frame& frame, const Sweep& sweep, int index, double last, const Disc& disc,
                             int stride) {
  const double length = sweep.axis_length, reach = stock_.profile().largest() + disc.radius;
  const Vec3 centre = frame.axis.at(0.5 * length) + disc.x * frame.x + disc.y * frame.y;
  // Of another tool, how far it reaches from its middle along its axis.
  const double half = std::max(stock_.profile().high() - 0.5 * length, 0.5 * length - stock_.profile().low());
  // How far a bundle of axes may be away and still reach the disc: tilts bring them nearer at one end.
  const auto beyond = [&](const Vec3& middle, double spread, double tilt) {
    const Vec3 apart = middle - centre;
    const double along = apart.dot(frame.axis.u), across2 = apart.squaredNorm() - along * along;
    const double most = spread + reach + (0.75 * length + std::abs(along)) * tilt;
    if (across2 > most * most) return true;
    // Layers above or below: their tools do not come down or up to these rings.
    const double height = along + 0.5 * length, slack = half + spread + most * tilt;
    return height + slack < disc.low || height - slack > disc.high;
  };
  if (beyond(sweep.whole.middle, sweep.whole.reach, (sweep.direction - frame.axis.u).norm() + sweep.turn)) return;
  for (std::size_t c = 0; c < sweep.chunks.size(); ++c) {
    const Sweep::Chunk& chunk = sweep.chunks[c];
    const std::size_t first = c * Sweep::kChunk;
    if (beyond(chunk.middle, chunk.reach, (sweep.poses[first].direction.normalized() - frame.axis.u).norm())) continue;
    const std::size_t end =
        std::min(first + Sweep::kChunk + (c + 1 == sweep.chunks.size() ? 1 : 0), sweep.poses.size());
    for (std::size_t p = first; p < end && static_cast<double>(p) <= last; p += static_cast<std::size_t>(stride)) {
      Candidate candidate{.sweep = index, .pose = static_cast<int>(p)};
      if (meets(frame, sweep.poses[p], disc, candidate)) candidates_.push_back(candidate);
    }
  }
}

bool EngagementMeter::meets(const Frame& frame, const SweepPose& pose, const Disc& disc, Candidate& out) const {
  const double reach = stock_.profile().largest() + disc.radius;
  const double low = stock_.profile().low(), high = stock_.profile().high();
  const Vec3 u = pose.direction.normalized(), d = pose.tip - frame.axis.tip;
  const double forward = u.dot(frame.axis.u);
  if (forward < 0.5) return false;
  const double up = d.dot(frame.axis.u);
  out.dx = u.dot(frame.x) / forward, out.dy = u.dot(frame.y) / forward;
  out.x0 = d.dot(frame.x) - up * out.dx, out.y0 = d.dot(frame.y) - up * out.dy;
  out.h0 = -up / forward, out.dh = 1.0 / forward;
  if (out.h0 + disc.high * out.dh < low || out.h0 + disc.low * out.dh > high) return false;
  // Nearest that the axis comes to the disc over the heights of the tool.
  const double ax = out.x0 + low * out.dx - disc.x, ay = out.y0 + low * out.dy - disc.y;
  const double ex = (high - low) * out.dx, ey = (high - low) * out.dy, e2 = ex * ex + ey * ey;
  const double share = e2 > 0.0 ? std::clamp(-(ax * ex + ay * ey) / e2, 0.0, 1.0) : 0.0;
  const double nx = ax + share * ex, ny = ay + share * ey;
  return nx * nx + ny * ny <= reach * reach;
}

EngagementMeter::Disc EngagementMeter::disc_of_found(std::span<const ToolRing> rings) const {
  constexpr double kSpare = 1.02;
  Box3 box;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RingArc& found : found_) {
    const double r = rings[found.ring].radius, z = rings[found.ring].z;
    low = std::min(low, z), high = std::max(high, z);
    for (int k = 0; k <= 4; ++k) {
      const double angle = found.motion_angle + found.arc.low + 0.25 * k * (found.arc.high - found.arc.low);
      box.add(Vec3(r * std::cos(angle), r * std::sin(angle), 0.0));
    }
  }
  const Vec3 centre = box.center();
  return {centre.x(), centre.y(), kSpare * 0.5 * box.diagonal(), low, high};
}

void EngagementMeter::engage_all(const Frame& frame, std::span<const ToolRing> rings, bool rough) {
  found_.clear();
  hints_.clear();
  for (std::size_t k = 0; k < rings.size(); ++k) engage(frame, rings[k], k, rough);
}

void EngagementMeter::find_arcs(const Frame& frame, double t, std::span<const ToolRing> rings) {
  const std::vector<Sweep>& sweeps = stock_.sweeps();
  const auto look = [&](std::size_t from, const Disc& disc, int stride) {
    // The newest first: they end most gaps.
    if (own_last_ >= 0.0) gather(frame, own_, kOwn, own_last_, disc, stride);
    for (std::size_t k = sweeps.size(); k-- > from;)
      gather(frame, sweeps[k], static_cast<int>(k), sweeps[k].last(), disc, stride);
    engage_all(frame, rings, stride > 1);
  };
  own_last_ = t * kOwnIntervals - 1.0;
  candidates_.clear();
  const Disc all{0.0, 0.0, stock_.profile().largest(), stock_.profile().low(), stock_.profile().high()};
  look(sweeps.size() > kRecent ? sweeps.size() - kRecent : 0, all, kStride);
  // What the first look covers stays covered: the disc holds what it left open, and nothing else.
  if (!found_.empty()) look(0, disc_of_found(rings), 1);
}

void EngagementMeter::cut(double low, double high, const Bound& bound) {
  cut_.clear();
  for (const Gap& gap : gaps_) {
    Gap rest = gap;
    bool left = true;
    for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
      const double from = low + turn, to = high + turn;
      if (!left || to <= rest.low || from >= rest.high) continue;
      if (from > rest.low) {
        Gap before = rest;
        before.high = from;
        before.at_high = bound;
        before.to = Vec2(std::cos(from), std::sin(from));
        cut_.push_back(before);
      }
      left = to < rest.high;
      if (!left) continue;
      rest.low = to;
      rest.at_low = bound;
      rest.from = Vec2(std::cos(to), std::sin(to));
    }
    if (left) cut_.push_back(rest);
  }
  gaps_.swap(cut_);
}

void EngagementMeter::cut_by_blank(const Frame& frame, const ToolRing& ring, double motion_angle) {
  const Vec3 centre = frame.axis.at(ring.z);
  for (const HalfSpace& h : stock_.blank()) {
    const double a = h.normal.dot(frame.x), b = h.normal.dot(frame.y), amplitude = ring.radius * std::hypot(a, b);
    const double room = h.offset - h.normal.dot(centre);
    if (room >= amplitude) continue;
    if (room <= -amplitude) {
      gaps_.clear();
      return;
    }
    const double at = std::remainder(std::atan2(b, a) - motion_angle, 2.0 * kPi), width = std::acos(room / amplitude);
    cut(at - width, at + width, {});
  }
}

bool EngagementMeter::cut_by(const Candidate& c, const ToolRing& ring, const Vec2& motion) {
  const double px = c.x0 + ring.z * c.dx, py = c.y0 + ring.z * c.dy;
  const Vec2 o(motion.x() * px + motion.y() * py, motion.x() * py - motion.y() * px);
  // An interval that reaches into a gap holds one of its ends, or lies within.
  const auto matters = [&](double p2) {
    return std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
      return (ring.radius * gap.from - o).squaredNorm() < p2 || (ring.radius * gap.to - o).squaredNorm() < p2 ||
             gap.high - gap.low > 3.0 ||
             (gap.from.x() * o.y() - gap.from.y() * o.x() > 0.0 && o.x() * gap.to.y() - o.y() * gap.to.x() > 0.0);
    });
  };
  // Most do not reach one even where the tool is thickest: that is cheaper to see than the radius at a height.
  const double d2 = o.squaredNorm(), largest = stock_.profile().largest(), most = ring.radius + largest;
  if (d2 >= most * most || !matters(largest * largest)) return true;
  ToolProfile::Place place;
  if (!stock_.profile().at(c.h0 + ring.z * c.dh, place)) return true;
  const double sum = ring.radius + place.radius, less = place.radius - ring.radius;
  if (d2 >= sum * sum) return true;
  if (d2 <= less * less) return less < 0.0;
  const double p2 = place.radius * place.radius;
  if (!matters(p2)) return true;
  const double cosine = (ring.radius * ring.radius + d2 - p2) / (2.0 * ring.radius * std::sqrt(d2));
  const double width = std::acos(std::clamp(cosine, -1.0, 1.0)), at = std::atan2(o.y(), o.x());
  cut(at - width, at + width, {c.sweep, c.pose});
  return true;
}

void EngagementMeter::cut_by_poses(const ToolRing& ring, double motion_angle) {
  const Vec2 motion(std::cos(motion_angle), std::sin(motion_angle));
  // The poses that end the gaps of one ring end those of the next one, or nearly so: then all others are seen not to matter.
  bool open = true;
  for (const std::size_t k : hints_)
    if (open && !gaps_.empty()) open = cut_by(candidates_[k], ring, motion);
  for (std::size_t k = 0; k < candidates_.size() && open && !gaps_.empty(); ++k)
    open = cut_by(candidates_[k], ring, motion);
  if (!open) gaps_.clear();
  hints_.clear();
  for (const Gap& gap : gaps_)
    for (const Bound& bound : {gap.at_low, gap.at_high})
      for (std::size_t k = 0; k < candidates_.size() && bound.sweep != kNoSweep; ++k)
        if (candidates_[k].sweep == bound.sweep && candidates_[k].pose == bound.pose) {
          hints_.push_back(k);
          break;
        }
}

SweepPlace EngagementMeter::place_of(const Bound& bound) const {
  const Sweep& sweep = sweep_of(bound.sweep);
  return {&sweep, bound.sweep == kOwn ? own_last_ : sweep.last(), static_cast<double>(bound.pose)};
}

bool EngagementMeter::is_sliver(const RingCircle& circle, const Gap& gap) const {
  if (gap.high - gap.low > kSliver) return false;
  const Vec3 x = circle.at(0.5 * (gap.low + gap.high));
  for (const Bound& bound : {gap.at_low, gap.at_high})
    if (bound.sweep != kNoSweep && is_taken_near(stock_.profile(), place_of(bound), x)) return true;
  return false;
}

void EngagementMeter::settle(const Frame& frame, const ToolRing& ring, std::size_t index, double motion_angle,
                             double half, bool rough) {
  const Vec3 forward = radial_direction(frame.x, frame.y, motion_angle);
  const RingCircle circle{frame.axis.at(ring.z), forward, frame.axis.u.cross(forward), ring.radius};
  const auto end = [&](const Bound& bound, double angle) {
    return bound.sweep == kNoSweep ? angle : arc_end(stock_.profile(), circle, place_of(bound), angle);
  };
  for (const Gap& gap : gaps_) {
    if (rough) found_.push_back({index, motion_angle, {gap.low, gap.high}});
    if (rough || is_sliver(circle, gap)) continue;
    const Arc arc{std::max(-half, end(gap.at_low, gap.low)), std::min(half, end(gap.at_high, gap.high))};
    if (arc.high > arc.low) found_.push_back({index, motion_angle, arc});
  }
}

void EngagementMeter::engage(const Frame& frame, const ToolRing& ring, std::size_t index, bool rough) {
  const Vec3 v = frame.axis.velocity(ring.s);
  const double vx = v.dot(frame.x), vy = v.dot(frame.y), across = std::hypot(vx, vy), along = v.dot(frame.axis.u);
  // <nu, v> = sine <v, u> + cosine |v_perp| cos(theta) > 0.
  const double c = across > 0.0 ? -ring.sine * along / (ring.cosine * across) : (ring.sine * along > 0.0 ? -2.0 : 2.0);
  if (c >= 1.0) return;
  const double half = c <= -1.0 ? kPi : std::acos(c), motion_angle = std::atan2(vy, vx);
  gaps_.assign(1,
               Gap{-half, half, {}, {}, Vec2(std::cos(half), -std::sin(half)), Vec2(std::cos(half), std::sin(half))});
  cut_by_blank(frame, ring, motion_angle);
  if (!gaps_.empty()) cut_by_poses(ring, motion_angle);
  settle(frame, ring, index, motion_angle, half, rough);
}

EngagementRow EngagementMeter::sum_row(const Frame& frame, double t, std::span<const ToolRing> rings) const {
  EngagementRow row;
  row.t = t;
  int flank = 0;
  auto found = found_.begin();
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const ToolRing& ring = rings[k];
    const Vec3 v = frame.axis.velocity(ring.s);
    const double along = v.dot(frame.axis.u), across = std::sqrt(std::max(0.0, v.squaredNorm() - along * along));
    double angle = 0.0;
    for (; found != found_.end() && found->ring == k; ++found) {
      const Arc& arc = found->arc;
      angle += arc.high - arc.low;
      row.rate_mm3 += ring.area * (ring.sine * along * (arc.high - arc.low) +
                                   ring.cosine * across * (std::sin(arc.high) - std::sin(arc.low)));
    }
    if (!ring.flank) continue;
    ++flank;
    row.mean_rad += angle;
    if (angle <= row.angle_rad) continue;
    row.angle_rad = angle;
    row.s = ring.s;
  }
  if (flank > 0) row.mean_rad /= flank;
  return row;
}

Engagement EngagementMeter::measure(const RuledMotion& motion, std::span<const ToolRing> rings, int rows) {
  FLANK_ASSERT(rows >= 3 && rows % 2 == 1);
  begin(motion);
  Engagement out;
  out.rows.reserve(static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) / (rows - 1);
    const Frame frame = frame_of(motion, t);
    find_arcs(frame, t, rings);
    const EngagementRow row = sum_row(frame, t, rings);
    if (row.angle_rad > out.peak.angle_rad) out.peak = {row.angle_rad, row.t, row.s};
    out.volume_mm3 += row.rate_mm3 * simpson(i, rows);
    out.rows.push_back(row);
  }
  return out;
}

double EngagementMeter::angle(const RuledMotion& motion, double t, const ToolRing& ring) {
  begin(motion);
  const Frame frame = frame_of(motion, t);
  find_arcs(frame, t, {&ring, 1});
  return sum_row(frame, t, {&ring, 1}).angle_rad;
}

double EngagementMeter::value(const RuledMotion& motion, double t, double s, EngagementPeak& best) {
  const ToolRing ring = ring_at(stock_.radial(), s);
  const Frame frame = frame_of(motion, t);
  find_arcs(frame, t, {&ring, 1});
  const double angle = sum_row(frame, t, {&ring, 1}).angle_rad;
  if (angle > best.angle_rad) best = {angle, t, s};
  return angle;
}

EngagementPeak EngagementMeter::refine(const RuledMotion& motion, const Engagement& measured, int flank_rings) {
  EngagementPeak best = measured.peak;
  begin(motion);
  const double length = motion.axis_length;
  const double step = 1.0 / (static_cast<double>(measured.rows.size()) - 1.0), ds = length / (flank_rings - 1);
  for (const std::size_t row : largest_rows(measured.rows)) {
    double t = measured.rows[row].t, s = measured.rows[row].s;
    const auto by_time = [&](double x) { return value(motion, x, s, best); };
    t = golden(std::max(0.0, t - step), std::min(1.0, t + step), by_time);
    if (s <= 0.0 || s >= length) continue;
    s = golden(std::max(0.0, s - ds), std::min(length, s + ds), [&](double x) { return value(motion, t, x, best); });
    (void)golden(std::max(0.0, t - 0.5 * step), std::min(1.0, t + 0.5 * step), by_time);
  }
  return best;
}

}  // namespace flank::internal

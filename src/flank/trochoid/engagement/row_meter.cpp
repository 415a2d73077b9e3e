#include "flank/trochoid/engagement/row_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;
/// Arcs that are shorter than this between two poses may be the scallops between sampled poses: radians.
constexpr double kSliver = 0.35;

}  // namespace

RowFrame RowMeter::frame_of(const RuledMotion& motion, double t) {
  RowFrame frame{motion.jet(t), {}, {}};
  frame.x = frame.axis.u.unitOrthogonal();
  frame.y = frame.axis.u.cross(frame.x);
  return frame;
}

void RowMeter::look_roughly(const RowFrame& frame, std::span<const ToolRing> rings) {
  // What settled the row before settles nearly all of this one: then little is open for the close look.
  for (const Settler& settler : settlers_) near_.add_pose(frame, settler.sweep, settler.pose, own_last_, candidates_);
  near_.add(frame, {0.0, 0.0, stock_.profile().largest(), stock_.profile().low(), stock_.profile().high()}, {},
            own_last_, kRecent, kStride, scratch_, candidates_);
  filter_.take(candidates_);
  group_.clear();
  first_asked_ = 0;
  hints_.clear();
  for (std::size_t k = 0; k < rings.size(); ++k) {
    Front front = front_of(frame, rings[k]);
    if (!gaps_.empty()) {
      cut_by_poses(rings[k], front);
      if (gaps_.empty()) keep_settlers();
    }
    for (const Gap& gap : gaps_) found_.push_back({k, front.angle, {gap.low, gap.high}});
    open_gaps_.insert(open_gaps_.end(), gaps_.begin(), gaps_.end());
    front.end = open_gaps_.size();
    fronts_.push_back(front);
  }
}

void RowMeter::look_closely(const RowFrame& frame, std::span<const ToolRing> rings) {
  // What the first look covers stays covered: the discs hold what it left open, and little else.
  const RowDisc open = discs_of(found_, rings, stock_.profile().largest(), parts_);
  found_.clear();
  hints_.clear();
  if (rings.size() < kManyRings) {
    first_asked_ = candidates_.size();
    near_.add(frame, open, parts_, own_last_, 0, 1, scratch_, candidates_);
    filter_.take(std::span<const NearPose>(candidates_).subspan(first_asked_));
    for (std::size_t k = 0; k < rings.size(); ++k) settle_ring(frame, rings, k);
    return;
  }
  // What a group of near rings does not need is left out at once; so poses are not looked at one by one before.
  near_.see(frame, open, parts_, own_last_, seen_);
  seen_filter_.take(seen_);
  wanted_.begin(rings);
  look_at_groups(frame, rings);
  const auto rough = [&](std::size_t k) {
    double sum = 0.0;
    for (std::size_t g = first_gap(k); g < fronts_[k].end; ++g)
      sum += open_gaps_[g].within().high - open_gaps_[g].within().low;
    return sum;
  };
  if (wanted_.go_on(rings, rough, found_)) look_at_groups(frame, rings);
  const auto by_ring = [](const RingArc& a, const RingArc& b) { return a.ring < b.ring; };
  std::stable_sort(found_.begin(), found_.end(), by_ring);
}

void RowMeter::look_at_groups(const RowFrame& frame, std::span<const ToolRing> rings) {
  hints_.clear();
  for (std::size_t first = 0, end = 0; first < rings.size(); first = end) {
    end = end_of_group(rings, first, seen_filter_.group_height());
    find_group(rings, first, end);
    for (std::size_t k = first; k < end; ++k)
      if (wanted_[k]) settle_ring(frame, rings, k);
  }
}

void RowMeter::settle_ring(const RowFrame& frame, std::span<const ToolRing> rings, std::size_t k) {
  const auto from = open_gaps_.cbegin();
  gaps_.assign(from + static_cast<std::ptrdiff_t>(first_gap(k)), from + static_cast<std::ptrdiff_t>(fronts_[k].end));
  if (gaps_.empty()) return;
  cut_by_poses(rings[k], fronts_[k]);
  keep_settlers();
  settle(frame, rings[k], k, fronts_[k]);
}

void RowMeter::find_group(std::span<const ToolRing> rings, std::size_t first, std::size_t end) {
  sectors_.clear();
  for (std::size_t k = first; k < end; ++k)
    for (std::size_t g = first_gap(k); wanted_[k] && g < fronts_[k].end; ++g)
      sectors_.add(fronts_[k].angle + open_gaps_[g].low, fronts_[k].angle + open_gaps_[g].high);
  const RingGroup group = group_of(rings.subspan(first, end - first));
  sectors_.arcs_on(group.radius, open_);
  if (open_.empty()) return;
  group_ = seen_filter_.reaching(group, open_);
  if (group_.empty() || group_.size() > kFewPoses) filter_.take(seen_filter_, group_);
}

void RowMeter::find_arcs(const RowFrame& frame, double t, std::span<const ToolRing> rings) {
  frame_ = frame;
  own_last_ = t * NearPoses::kOwnIntervals - 1.0;
  candidates_.clear();
  found_.clear();
  fronts_.clear();
  open_gaps_.clear();
  look_at_blank(frame);
  look_roughly(frame, rings);
  if (!found_.empty()) look_closely(frame, rings);
  settlers_.swap(next_settlers_);
  next_settlers_.clear();
}

void RowMeter::keep_settlers() {
  for (const Gap& gap : gaps_)
    for (const Bound& bound : {gap.at_low, gap.at_high})
      if (bound.is_pose()) keep_settler(bound.candidate);
  if (!gaps_.empty()) return;
  for (const std::size_t candidate : cutters_) keep_settler(candidate);
}

void RowMeter::keep_settler(std::size_t candidate) {
  const Settler settler{candidates_[candidate].sweep, candidates_[candidate].pose};
  if (next_settlers_.size() >= kMostSettlers) return;
  if (std::find(next_settlers_.begin(), next_settlers_.end(), settler) == next_settlers_.end())
    next_settlers_.push_back(settler);
}

SweepPlace RowMeter::place_of(const Bound& bound) const {
  const NearPose& pose = candidates_[bound.candidate];
  const Sweep& sweep = sweep_of(pose.sweep);
  const double last = pose.sweep == kOwnSweep ? own_last_ : sweep.last();
  return {&sweep, last, std::clamp(pose.pose + bound.shift, 0.0, last)};
}

bool RowMeter::is_sliver(const RingCircle& circle, const Gap& gap) const {
  if (gap.high - gap.low > kSliver) return false;
  const Arc arc = gap.within();
  const Vec3 x = circle.at(0.5 * (arc.low + arc.high));
  for (const Bound& bound : {gap.at_low, gap.at_high})
    if (bound.is_pose() && is_taken_near(stock_.profile(), place_of(bound), x)) return true;
  return false;
}

void RowMeter::settle(const RowFrame& frame, const ToolRing& ring, std::size_t index, const Front& front) {
  const Vec3 forward = front.motion.x() * frame.x + front.motion.y() * frame.y;
  const RingCircle circle{frame.axis.at(ring.z), forward, frame.axis.u.cross(forward), ring.radius};
  const auto end = [&](const Bound& bound, double angle) {
    return bound.is_pose() ? arc_end(stock_.profile(), circle, place_of(bound), angle) : angle;
  };
  const std::size_t before = found_.size();
  for (const Gap& gap : gaps_) {
    if (is_sliver(circle, gap)) continue;
    const Arc arc{std::max(gap.limits.low, end(gap.at_low, gap.low)),
                  std::min(gap.limits.high, end(gap.at_high, gap.high))};
    if (!(arc.high > arc.low)) continue;
    if (found_.size() == before || arc.low > found_.back().arc.high) {
      found_.push_back({index, front.angle, arc});
      continue;
    }
    Arc& last = found_.back().arc;
    last = {std::min(last.low, arc.low), std::max(last.high, arc.high)};
  }
}

RowMeter::Front RowMeter::front_of(const RowFrame& frame, const ToolRing& ring) {
  Front front;
  gaps_.clear();
  const Vec3 v = frame.axis.velocity(ring.s);
  const double vx = v.dot(frame.x), vy = v.dot(frame.y), across = std::hypot(vx, vy), along = v.dot(frame.axis.u);
  // <nu, v> = sine <v, u> + cosine |v_perp| cos(theta) > 0.
  const double c = across > 0.0 ? -ring.sine * along / (ring.cosine * across) : (ring.sine * along > 0.0 ? -2.0 : 2.0);
  if (c < 1.0) {
    front.half = c <= -1.0 ? kPi : std::acos(c);
    front.angle = std::atan2(vy, vx);
    front.motion = Vec2(std::cos(front.angle), std::sin(front.angle));
    const double x = std::max(c, -1.0), y = std::sqrt(1.0 - x * x);
    gaps_.push_back({-front.half, front.half, {}, {}, Vec2(x, -y), Vec2(x, y), {-front.half, front.half}});
    cut_by_blank(frame, ring, front.angle);
    go_beyond();
  }
  return front;
}

void RowMeter::go_beyond() {
  constexpr double kBeyond = 0.03;  // radians
  for (Gap& gap : gaps_) {
    gap.limits = {gap.low, gap.high};
    gap.low -= kBeyond;
    gap.high += kBeyond;
    gap.from = Vec2(std::cos(gap.low), std::sin(gap.low));
    gap.to = Vec2(std::cos(gap.high), std::sin(gap.high));
  }
}

EngagementRow RowMeter::sum_row(const RowFrame& frame, double t, std::span<const ToolRing> rings) const {
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
    if (!ring.flank || !ring.asked) continue;
    if (!ring.between) ++flank, row.mean_rad += angle;
    if (angle <= row.angle_rad) continue;
    row.angle_rad = angle;
    row.s = ring.s;
  }
  if (flank > 0) row.mean_rad /= flank;
  return row;
}

EngagementRow RowMeter::row(const RuledMotion& motion, double t, std::span<const ToolRing> rings) {
  const RowFrame frame = frame_of(motion, t);
  find_arcs(frame, t, rings);
  return sum_row(frame, t, rings);
}

}  // namespace flank::internal

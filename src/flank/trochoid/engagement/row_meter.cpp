#include "flank/trochoid/engagement/row_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "flank/base/work_count.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;
/// Of the largest radius: by so much more an earlier pose covers than it cuts. Halves that end at one place have one last pose,
/// and what it left of a ring is its own outline, whichever way its radius is rounded.
constexpr double kSame = 1e-7;

/// Slope from which on a tool is leaning wherever the ring meets it (10 degrees), not beside its round ends alone.
constexpr double kSteep = 0.18;

double sq(double x) { return x * x; }

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
  near_.add_roughly(frame, {0.0, 0.0, stock_.profile().largest(), stock_.profile().low(), stock_.profile().high()},
                    own_last_, kRecent, scratch_, candidates_);
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
    for (const RingGap& gap : gaps_) found_.push_back({k, front.angle, {gap.low, gap.high}});
    open_gaps_.insert(open_gaps_.end(), gaps_.begin(), gaps_.end());
    front.end = open_gaps_.size();
    fronts_.push_back(front);
  }
}

void RowMeter::leave_out(std::span<const ToolRing> rings, double least_rad) {
  // Ends of arcs hardly move where they are settled.
  constexpr double kSpare = 0.1;  // radians
  std::size_t from = 0, kept = 0;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const std::size_t end = fronts_[k].end;
    double open = 0.0;
    for (std::size_t g = from; g < end; ++g) open += open_gaps_[g].within().high - open_gaps_[g].within().low;
    const bool wanted = rings[k].area > 0.0 || open + kSpare > least_rad;
    for (std::size_t g = from; g < end; ++g) {
      if (!wanted) {
        keep_bounds_of(open_gaps_[g]);
        continue;
      }
      open_gaps_[kept] = open_gaps_[g];
      found_[kept++] = found_[g];
    }
    from = end;
    fronts_[k].end = kept;
  }
  open_gaps_.resize(kept);
  found_.resize(kept);
}

void RowMeter::look_closely(const RowFrame& frame, std::span<const ToolRing> rings) {
  // What the first look covers stays covered: the discs hold what it left open, and little else.
  const RowDisc open = discs_of(found_, rings, stock_.profile().largest(), parts_);
  found_.clear();
  hints_.clear();
  if (rings.size() < kManyRings) {
    first_asked_ = candidates_.size();
    near_.add(frame, open, parts_, own_last_, scratch_, candidates_);
    filter_.take(std::span<const NearPose>(candidates_).subspan(first_asked_));
    for (std::size_t k = 0; k < rings.size(); ++k) settle_ring(frame, rings, k);
    return;
  }
  // What a group of near rings does not need is left out at once; so poses are not looked at one by one before.
  near_.see(frame, open, parts_, own_last_, scratch_, seen_);
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

void RowMeter::find_arcs(const RowFrame& frame, double t, std::span<const ToolRing> rings, double least_rad) {
  frame_ = frame;
  own_last_ = t * NearPoses::kOwnIntervals - 1.0;
  candidates_.clear();
  found_.clear();
  fronts_.clear();
  open_gaps_.clear();
  look_at_blank(frame);
  look_roughly(frame, rings);
  if (least_rad > 0.0) leave_out(rings, least_rad);
  if (!found_.empty()) look_closely(frame, rings);
  settlers_.swap(next_settlers_);
  next_settlers_.clear();
}

void RowMeter::keep_settlers() {
  for (const RingGap& gap : gaps_) keep_bounds_of(gap);
  if (!gaps_.empty()) return;
  for (const std::size_t candidate : cutters_) keep_settler(candidate);
}

void RowMeter::keep_bounds_of(const RingGap& gap) {
  for (const GapBound& bound : {gap.at_low, gap.at_high})
    if (bound.is_pose()) keep_settler(bound.candidate);
}

void RowMeter::keep_settler(std::size_t candidate) {
  const Settler settler{candidates_[candidate].sweep, candidates_[candidate].pose};
  if (next_settlers_.size() >= kMostSettlers) return;
  if (std::find(next_settlers_.begin(), next_settlers_.end(), settler) == next_settlers_.end())
    next_settlers_.push_back(settler);
}

SweepPlace RowMeter::place_of(const GapBound& bound) const {
  const NearPose& pose = candidates_[bound.candidate];
  const Sweep& sweep = sweep_of(pose.sweep);
  const double last = pose.sweep == kOwnSweep ? own_last_ : sweep.last();
  return {&sweep, last, std::clamp(pose.pose + bound.shift, 0.0, last)};
}

bool RowMeter::is_sliver(const RingCircle& circle, const RingGap& gap) const {
  if (gap.high - gap.low > kSliver) return false;
  const Arc arc = gap.within();
  const Vec3 x = circle.at(0.5 * (arc.low + arc.high));
  for (const GapBound& bound : {gap.at_low, gap.at_high})
    if (bound.is_pose() && is_taken_near(stock_.profile(), place_of(bound), x)) return true;
  return false;
}

void RowMeter::settle(const RowFrame& frame, const ToolRing& ring, std::size_t index, const Front& front) {
  const Vec3 forward = front.motion.x() * frame.x + front.motion.y() * frame.y;
  const RingCircle circle{frame.axis.at(ring.z), forward, frame.axis.u.cross(forward), ring.radius};
  const auto end = [&](const GapBound& bound, double angle, Taken taken) {
    return bound.is_pose() ? arc_end(stock_.profile(), circle, place_of(bound), angle, taken) : angle;
  };
  const std::size_t before = found_.size();
  for (const RingGap& gap : gaps_) {
    if (is_sliver(circle, gap)) continue;
    const Arc arc{std::max(gap.limits.low, end(gap.at_low, gap.low, Taken::kBelow)),
                  std::min(gap.limits.high, end(gap.at_high, gap.high, Taken::kAbove))};
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
    gaps_.open(front.half, x, y);
    cut_by_blank(frame, ring, front.angle);
    gaps_.go_beyond();
  }
  return front;
}

void RowMeter::cut(double low, double high, const GapBound& bound) {
  if (gaps_.cut(low, high, bound) && bound.is_pose()) cutters_.push_back(bound.candidate);
}

void RowMeter::look_at_blank(const RowFrame& frame) {
  planes_.clear();
  for (const HalfSpace& h : stock_.blank()) {
    const double a = h.normal.dot(frame.x), b = h.normal.dot(frame.y);
    planes_.push_back({std::hypot(a, b), std::atan2(b, a)});
  }
}

void RowMeter::cut_by_blank(const RowFrame& frame, const ToolRing& ring, double motion_angle) {
  const Vec3 centre = frame.axis.at(ring.z);
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const HalfSpace& h = stock_.blank()[k];
    const double amplitude = ring.radius * planes_[k].across, room = h.offset - h.normal.dot(centre);
    if (room >= amplitude) continue;
    if (room <= -amplitude) {
      gaps_.clear();
      return;
    }
    const double at = std::remainder(planes_[k].angle - motion_angle, 2.0 * kPi), width = std::acos(room / amplitude);
    cut(at - width, at + width, {});
  }
}

bool RowMeter::cut_by(std::size_t candidate, const ToolRing& ring, const Vec2& motion) {
  const NearPose& c = candidates_[candidate];
  const double px = c.x0 + ring.z * c.dx, py = c.y0 + ring.z * c.dy;
  const Vec2 o(motion.x() * px + motion.y() * py, motion.x() * py - motion.y() * px);
  const auto matters = [&](const Vec2& p, double p2) { return gaps_.reached_by(ring.radius, p, p2); };
  // Most do not reach one even where the tool is thickest: that is cheaper to see than the radius at a height.
  const double d2 = o.squaredNorm(), largest = stock_.profile().largest(), most = ring.radius + largest;
  if (is_leaning(c, ring)) {
    const double stretched = reach_of_leaning(c);
    if (d2 >= sq(ring.radius + stretched) || !matters(o, sq(stretched))) return true;
    cut_by_leaning(candidate, ring, o,
                   Vec2(motion.x() * c.dx + motion.y() * c.dy, motion.x() * c.dy - motion.y() * c.dx) / c.dh);
    // The sphere of its round end is part of it: what that covers is known without a look.
    return !ring.flank || cut_by_round_end(candidate, ring, motion, matters);
  }
  const double height = c.h0 + ring.z * c.dh;
  if (ring.flank && (height < stock_.profile().flank_low() || height > stock_.profile().flank_high()))
    return cut_by_round_end(candidate, ring, motion, matters);
  ToolProfile::Place place;
  if (d2 >= most * most || !matters(o, largest * largest) || !stock_.profile().at(height, place)) return true;
  return cut_by_disc({candidate}, ring, {o, place.radius + kSame * largest}, matters);
}

template <class Matters>
bool RowMeter::cut_by_round_end(std::size_t candidate, const ToolRing& ring, const Vec2& motion,
                                const Matters& matters) {
  // Of the sphere's radius: in so small a disc a round end grazes the plane, and so little above it may between two poses.
  constexpr double kGrazing = 0.25, kDip = 0.1;
  const NearPose c = candidates_[candidate];
  const ToolProfile::RoundEnd end = stock_.profile().round_end(c.h0 + ring.z * c.dh);
  const double same = kSame * stock_.profile().largest();
  const auto cut_at = [&](const Vec3& middle, double shift) {
    const double up = middle.z() - ring.z, radius2 = sq(end.radius) - sq(up);
    const Vec2 at(motion.x() * middle.x() + motion.y() * middle.y(), motion.x() * middle.y() - motion.y() * middle.x());
    return !(radius2 > 0.0) || cut_by_disc({candidate, shift}, ring, {at, std::sqrt(radius2) + same}, matters);
  };
  const double z = (end.centre - c.h0) / c.dh;
  if (!cut_at(Vec3(c.x0 + z * c.dx, c.y0 + z * c.dy, z), 0.0)) return false;
  const double radius2 = sq(end.radius) - sq(z - ring.z);
  if (radius2 > sq(kGrazing * end.radius) || radius2 < -sq(kDip * end.radius)) return true;
  // Then the discs of two poses may leave what all between them cover, or have none where those do.
  for (const double shift : {-0.75, -0.5, -0.25, 0.25, 0.5, 0.75})
    if (!cut_at(round_end_at(c, shift, end.centre), shift)) return false;
  return true;
}

Vec3 RowMeter::round_end_at(const NearPose& candidate, double shift, double centre) const {
  const Sweep& sweep = sweep_of(candidate.sweep);
  const double last = candidate.sweep == kOwnSweep ? own_last_ : sweep.last();
  const SweepPose pose = sweep.at(std::clamp(candidate.pose + shift, 0.0, last));
  const Vec3 from = pose.tip + centre * pose.direction.normalized() - frame_.axis.tip;
  return {from.dot(frame_.x), from.dot(frame_.y), from.dot(frame_.axis.u)};
}

template <class Matters>
bool RowMeter::cut_by_disc(const GapBound& bound, const ToolRing& ring, const RingDisc& disc, const Matters& matters) {
  const Vec2& o = disc.centre;
  const double d2 = o.squaredNorm(), sum = ring.radius + disc.radius, less = disc.radius - ring.radius;
  if (d2 >= sum * sum) return true;
  if (d2 <= less * less) return less < 0.0;
  const double p2 = disc.radius * disc.radius;
  if (!matters(o, p2)) return true;
  const double cosine = (ring.radius * ring.radius + d2 - p2) / (2.0 * ring.radius * std::sqrt(d2));
  const double width = std::acos(std::clamp(cosine, -1.0, 1.0)), at = std::atan2(o.y(), o.x());
  cut(at - width, at + width, bound);
  return true;
}

double RowMeter::reach_of_leaning(const NearPose& c) const {
  return std::sqrt(1.0 + c.slope2()) * stock_.profile().largest();
}

bool RowMeter::is_leaning(const NearPose& c, const ToolRing& ring) const {
  const double slope2 = c.slope2();
  if (slope2 <= sq(kLeaning)) return false;
  // Rings of round ends count for the volume alone, where a circle is near enough.
  if (slope2 > sq(kSteep) || !ring.flank) return slope2 > sq(kSteep);
  const double height = c.h0 + ring.z * c.dh, swing = ring.radius * std::sqrt(slope2);
  // Where a round end begins it is hardly narrower than the flank.
  constexpr double kBegins = 0.3;
  const ToolProfile& p = stock_.profile();
  return height - swing < std::lerp(p.flank_low(), p.low(), kBegins) ||
         height + swing > std::lerp(p.flank_high(), p.high(), kBegins);
}

void RowMeter::cut_by_leaning(std::size_t candidate, const ToolRing& ring, const Vec2& foot, const Vec2& lean) {
  const NearPose& c = candidates_[candidate];
  const LeaningTool tool{stock_.profile(), ring.radius, foot, lean, c.h0 + ring.z * c.dh, sq(reach_of_leaning(c))};
  const double window = tool.window(), at = std::atan2(foot.y(), foot.x());
  if (window < 0.0) return;
  // Looked at where its own window says, not what is open: so what it covers does not depend on who was asked before.
  constexpr double kApart = 0.1;  // radians: less is not seen
  const int looks = std::max(2, static_cast<int>(std::ceil(2.0 * window / kApart)));
  covered_.clear();
  for (const RingGap& gap : gaps_)
    for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi})
      tool.visit_covered({at, window, looks}, gap.low - turn, gap.high - turn, [&](double low, double high) {
        covered_.push_back({low, high});
      });
  for (const Arc& arc : covered_) cut(arc.low, arc.high, {candidate});
}

void RowMeter::cut_by_poses(const ToolRing& ring, const Front& front) {
  const Vec2& motion = front.motion;
  cutters_.clear();
  const auto ask = [&](std::size_t candidate) {
    if (cut_by(candidate, ring, motion)) return;
    cutters_.push_back(candidate);
    gaps_.clear();
  };
  // The poses that cover most of one ring cover most of the next one: then nearly all others are seen not to matter.
  for (const std::size_t candidate : hints_)
    if (!gaps_.empty()) ask(candidate);
  const auto ask_seen = [&](std::size_t pose) {
    // Those that cut something become candidates.
    const std::size_t before = cutters_.size();
    candidates_.push_back(seen_[pose]);
    ask(candidates_.size() - 1);
    if (cutters_.size() == before) candidates_.pop_back();
  };
  const bool few = !group_.empty() && group_.size() <= kFewPoses;
  for (auto k = group_.begin(); few && k != group_.end() && !gaps_.empty(); ++k) ask_seen(*k);
  if (!few && !gaps_.empty()) {
    gaps_.arcs(ring.radius, motion, open_);
    const std::vector<std::size_t>& reaching = filter_.reaching(ring, open_);
    for (auto k = reaching.begin(); k != reaching.end() && !gaps_.empty(); ++k)
      group_.empty() ? ask(first_asked_ + *k) : ask_seen(group_[*k]);
  }
  // The last ones first: they are those that end the gaps, or close the last of them.
  hints_.assign(cutters_.rbegin(), cutters_.rend());
}

EngagementRow RowMeter::row(const RuledMotion& motion, double t, std::span<const ToolRing> rings, double least_rad) {
  // What is known of other rows decides how many poses are asked, and after a stop less is known: that is no measure. Six of these take
  // about as long as a look.
  count_work((near_.count() + rings.size()) / 6);
  const RowFrame frame = frame_of(motion, t);
  find_arcs(frame, t, rings, least_rad);
  return sum_of(frame.axis, t, rings, found_);
}

}  // namespace flank::internal

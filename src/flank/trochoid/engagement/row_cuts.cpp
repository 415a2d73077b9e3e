#include "flank/trochoid/engagement/row_meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of the largest radius: by so much more an earlier pose covers than it cuts. Halves that end at one place have one last pose,
/// and what it left of a ring is its own outline, whichever way its radius is rounded.
constexpr double kSame = 1e-7;

/// Slope from which on a tool is leaning wherever the ring meets it (10 degrees), not beside its round ends alone.
constexpr double kSteep = 0.18;

double sq(double x) { return x * x; }

}  // namespace

void RowMeter::cut(double low, double high, const Bound& bound) {
  cut_.clear();
  bool changed = false;
  for (const Gap& gap : gaps_) {
    Gap rest = gap;
    bool left = true;
    for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
      const double from = low + turn, to = high + turn;
      if (!left || to <= rest.low || from >= rest.high) continue;
      changed = true;
      if (from > rest.low) {
        Gap before = rest;
        before.high = from;
        before.at_high = bound;
        before.to = Vec2(std::cos(from), std::sin(from));
        if (before.is_some()) cut_.push_back(before);
      }
      left = to < rest.high;
      if (!left) continue;
      rest.low = to;
      rest.at_low = bound;
      rest.from = Vec2(std::cos(to), std::sin(to));
    }
    if (left && rest.is_some()) cut_.push_back(rest);
  }
  gaps_.swap(cut_);
  if (changed && bound.is_pose()) cutters_.push_back(bound.candidate);
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
  // An interval that reaches into a gap holds one of its ends, or lies within.
  const auto matters = [&](const Vec2& p, double p2) {
    return std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
      return (ring.radius * gap.from - p).squaredNorm() < p2 || (ring.radius * gap.to - p).squaredNorm() < p2 ||
             gap.high - gap.low > kWide ||
             (gap.from.x() * p.y() - gap.from.y() * p.x() > 0.0 && p.x() * gap.to.y() - p.y() * gap.to.x() > 0.0);
    });
  };
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
bool RowMeter::cut_by_disc(const Bound& bound, const ToolRing& ring, const RingDisc& disc, const Matters& matters) {
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
  for (const Gap& gap : gaps_)
    for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi})
      tool.visit_covered({at, window, looks}, gap.low - turn, gap.high - turn, [&](double low, double high) {
        covered_.push_back({low, high});
      });
  for (const Arc& arc : covered_) cut(arc.low, arc.high, {candidate});
}

const std::vector<OpenArc>& RowMeter::open_arcs(const ToolRing& ring, const Vec2& motion) {
  const auto turned = [&](const Vec2& v) {
    return Vec2(motion.x() * v.x() - motion.y() * v.y(), motion.y() * v.x() + motion.x() * v.y());
  };
  open_.clear();
  for (const Gap& gap : gaps_)
    open_.push_back({ring.radius * turned(gap.from), ring.radius * turned(gap.to), gap.high - gap.low > kWide});
  return open_;
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
    const std::vector<std::size_t>& reaching = filter_.reaching(ring, open_arcs(ring, motion));
    for (auto k = reaching.begin(); k != reaching.end() && !gaps_.empty(); ++k)
      group_.empty() ? ask(first_asked_ + *k) : ask_seen(group_[*k]);
  }
  // The last ones first: they are those that end the gaps, or close the last of them.
  hints_.assign(cutters_.rbegin(), cutters_.rend());
}

}  // namespace flank::internal

#include "flank/trochoid/cycle_search.h"

#include <algorithm>
#include <cmath>

#include "flank/trochoid/front_adjustment.h"

namespace flank::internal {
namespace {

/// Rows of a motion, rings of the flank for its engagement and for its volume.
constexpr int kRows = 34, kRings = 7, kVolumeRings = 5;
/// Rings of a slender tool are so many radii apart, up to so many: an edge that it meets between two would not be seen.
constexpr double kRingsApart = 3.0;
/// Where rows are farther apart than so many radii, in a cavity that is wide for its tool, the engagement rises and falls between two of
/// them by as much as it is: there is a second look.
constexpr double kRowsApart = 0.2;
constexpr int kMostRings = 31;
/// The engagement that a search aims at is at least so much below the limit, radians: what lies between rows.
constexpr double kSearchMargin = 0.004;
/// So near to a wall, in radii, by this share of it: chips in its corners are thin, and a replay in cells reads more than there is.
constexpr double kCornerRadii = 0.5, kCornerMargin = 0.1;
/// Of the limit: who saw nothing where the fine samples saw much would aim at nothing.
constexpr double kMostExcess = 0.5;
/// In radii: shorter than this no step is one, and shorter than this another shape is looked for.
constexpr double kLeastStep = 0.004, kShortStep = 0.06;
/// So many radii before and behind the sides places are paired; farther out both ends go equally fast.
constexpr double kBeyond = 6.0;
/// Before a wall what one side has left of its way is at most so many times that of the other.
constexpr double kMostPace = 1.25;
constexpr double kLeastLiftMm = 0.02;
/// A lift grows by so much of what the tips enter, and is taken back unless it leaves less than this share of that.
constexpr double kLiftMore = 1.6, kLiftHelps = 0.7;
/// Before a cycle is looked for, this share of what tips may enter is aimed at: its step is not known yet. Lifts, or a lift and the
/// tolerance, that are apart by less than this share are alike.
constexpr double kLiftAim = 0.95, kSameLift = 0.1;
/// Of the shares of a shape: by which the change that is tried grows where it gained, and shrinks where it did not. Where
/// even a small one gains nothing, the share is left alone for some turns: after those the cavity is another.
constexpr double kGrow = 1.3, kShrink = 0.7, kMostSpan = 0.15, kLeastSpan = 0.008, kSpanAfterRest = 0.03;
constexpr int kRest = 10;
/// How near to the aim a step ends.
constexpr double kAimBand = 0.009;
/// Of the aim: a back that engages farther leaves its front no step.
constexpr double kFitBack = 0.95;
double way_of(const Trial& trial) {
  return way_of_middle(trial.front) + (trial.back ? way_of_middle(*trial.back) : 0.0);
}

/// How deep a cylinder's cut is that engages so far, in radii: it grows with the step, about linearly.
double depth_of_cut(double engagement_rad) { return std::max(1e-3, 1.0 - std::cos(engagement_rad)); }

}  // namespace

CycleSearch::CycleSearch(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock,
                         const CycleOptions& options)
    : sides_(sides),
      guard_(guard, options.tolerance_mm),
      stock_(stock),
      options_(options),
      meter_(stock),
      rings_(stock.radial(), ring_count(stock.radial(), kRingsApart, kRings, kMostRings), 0),
      volume_rings_(stock.radial(), 0, kVolumeRings),
      both_rings_(stock.radial(), ring_count(stock.radial(), kRingsApart, kRings, kMostRings), kVolumeRings),
      pairing_(sides.from, sides.to, kBeyond * stock.profile().largest()),
      radius_(stock.profile().largest()) {}

double CycleSearch::least_step() const { return kLeastStep * radius_; }

CycleState CycleSearch::anew(const CycleState& now) const {
  CycleState out;
  out.last = now.last;
  out.step_mm = 0.2 * radius_;
  out.largest_front_mm3 = now.largest_front_mm3;
  out.sweeps = now.sweeps;
  return out;
}

double CycleSearch::aim(const CycleState& now) const {
  const bool at_wall = sides_.from.stops_at_end() && sides_.from.last() - now.last.from_x < kCornerRadii * radius_;
  const double margin = at_wall ? kCornerMargin * options_.largest_rad : kSearchMargin;
  return options_.largest_rad - std::clamp(now.excess_rad, margin, kMostExcess * options_.largest_rad);
}

double CycleSearch::gap(double from_x, double to_x) const {
  const double middle = 0.5 * sides_.from.axis_length();
  return (sides_.from.at(from_x).at(middle) - sides_.to.at(to_x).at(middle)).norm();
}

double CycleSearch::partner(double from_x, double ahead) const {
  const double y = paired_abscissa(from_x), wanted = y + ahead * gap(from_x, y);
  if (!sides_.from.stops_at_end()) return wanted;
  // At a wall both come to their ends together: who is there first turns on the spot, in a corner as round as the tool.
  const double left = std::max(0.0, sides_.from.last() - from_x);
  return std::clamp(wanted, sides_.to.last() - kMostPace * left, sides_.to.last() - left / kMostPace);
}

Trial CycleSearch::plan(const CycleState& now, const CycleShape& shape, double step) const {
  Trial trial;
  trial.from_x = now.last.from_x + step;
  trial.to_x = std::max(now.last.to_x, partner(trial.from_x, shape.ahead));
  const auto room_ahead = [](const SidePath& side, double x) { return std::max(0.0, side.last() - x); };
  const auto room_behind = [](const SidePath& side, double x) { return std::max(0.0, x - side.first()); };
  const double length = sides_.from.axis_length(), wide = gap(trial.from_x, trial.to_x);
  const AxisPlace start = sides_.from.at(trial.from_x);
  trial.front =
      half_before_wall(length, start, sides_.to.at(trial.to_x).reversed(), shape.front.of(wide, shape.lift_mm),
                       room_ahead(sides_.from, trial.from_x), room_ahead(sides_.to, trial.to_x));
  if (now.last.way_mm > 0.0)
    trial.back =
        half_off_wall(length, sides_.to.at(now.last.to_x).reversed(), start, shape.back.of(wide, shape.lift_mm),
                      room_behind(sides_.to, now.last.to_x), room_behind(sides_.from, trial.from_x));
  trial.way_mm = way_of(trial);
  return trial;
}

Trial CycleSearch::measured(const CycleState& now, double step) {
  Trial trial = plan(now, now.shape, step);
  measure(aim(now), Asked::kPeak, trial);
  return trial;
}

Trial CycleSearch::lifted(CycleState& now, double step) {
  now.shape.lift_mm = needed_lift(now, now.shape, step);
  return measured(now, step);
}

bool CycleSearch::has_rows_apart(const RuledMotion& half) const {
  return way_of_middle(half) > kRowsApart * radius_ * kRows;
}

void CycleSearch::measure(double enough_rad, Asked asked, Trial& trial) {
  const bool peak = asked != Asked::kVolume, volume = asked != Asked::kPeak;
  const MeasureRings rings{rings_, volume_rings_, both_rings_};
  KeptMeasures::Kept back{EngagementPeak{}, 0.0};
  if (trial.back) {
    back = backs_.measure(*trial.back, peak, volume, kRows, rings, has_rows_apart(*trial.back), meter_);
    stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  }
  const bool between = has_rows_apart(trial.front);
  const RowRings& used = rings.of(peak, volume);
  const Engagement front = peak && !between
                               ? meter_.measure_peak(trial.front, used, kRows, front_guess_, back.peak->angle_rad)
                               : meter_.measure(trial.front, used, kRows);
  if (peak) {
    trial.largest_rad = std::max(back.peak->angle_rad, front.peak.angle_rad);
    if (front.peak.angle_rad > 0.0) front_guess_ = front.peak.t;
    // What is too much already need not be known.
    if (between && trial.largest_rad <= enough_rad)
      trial.largest_rad = std::max(trial.largest_rad, meter_.look_between(trial.front, front).angle_rad);
  }
  if (trial.back) stock_.remove_last();
  if (volume) trial.volume_mm3 = *back.volume_mm3 + front.volume_mm3;
}

FoundCycle CycleSearch::adjusted(FoundCycle found) {
  // Of the longest step that the whole front may take: the first of the published method's paths that is too far.
  constexpr double kFarther = 1.1;
  if (found.trial.largest_rad <= 0.0) return found;
  const double most = aim(found.now);
  Trial trial = plan(found.now, found.now.shape, kFarther * found.step());
  if (trial.back) stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  const std::optional<RuledMotion> front = adjusted_front(trial.front, meter_, stock_, most);
  if (trial.back) stock_.remove_last();
  if (!front) return found;
  trial.front = *front;
  trial.way_mm = way_of(trial);
  measure(most, Asked::kPeak, trial);
  if (trial.largest_rad <= most && !enters_anything(trial)) found.trial = std::move(trial);
  return found;
}

Trial CycleSearch::longest_step(CycleState& now, const CycleShape& shape, double guess) {
  const double allowed = aim(now), most = 1.2 * radius_, goal = depth_of_cut(allowed - 0.5 * kAimBand);
  double low = 0.0, low_depth = 0.0, high = 0.0, high_depth = 0.0;
  Trial best;
  best.largest_rad = -1.0;
  double step = std::clamp(guess, least_step(), most);
  for (int k = 0; k < 12; ++k) {
    Trial trial = plan(now, shape, step);
    measure(allowed, Asked::kPeak, trial);
    const double depth = depth_of_cut(trial.largest_rad);
    if (trial.largest_rad <= allowed) {
      low = step, low_depth = depth;
      best = std::move(trial);
      if (best.largest_rad > allowed - kAimBand || step >= most) break;
    } else {
      high = step, high_depth = depth;
      now.refuse(step, trial.largest_rad, options_.largest_rad);
    }
    if (high == 0.0) {
      step = std::min(most, step * std::clamp(goal / low_depth, 1.02, 1.8));
      continue;
    }
    if (high - low < 0.3 * least_step()) break;
    // Regula falsi, kept off the ends of the bracket: the engagement may jump.
    const double share = std::clamp((goal - low_depth) / (high_depth - low_depth), 0.15, 0.9);
    step = low + share * (high - low);
  }
  if (best.largest_rad >= 0.0) weigh(best);
  return best;
}

CycleSearch::Prospect CycleSearch::prospect(const CycleState& now, const CycleShape& shape, double step) {
  Prospect out{shape, plan(now, shape, step)};
  measure(aim(now), Asked::kBoth, out.probe);
  const double longer = depth_of_cut(aim(now)) / depth_of_cut(out.probe.largest_rad);
  out.step = longer * step;
  out.worth = longer * out.probe.worth();
  return out;
}

FoundCycle CycleSearch::improved(FoundCycle found) {
  if (!found.some() || found.trial.worth() <= 0.0) return found;
  constexpr double kBetter = 1.002;
  // Of seven, in turn: shapes change little from cycle to cycle. The first ones, which begin with a guess, try them all.
  constexpr std::size_t kVariables = 2, kAll = CycleShape::kShares;
  constexpr int kFirst = 8;
  CycleState& now = found.now;
  const std::size_t count = ++now.improved <= kFirst ? kAll : kVariables;
  for (std::size_t k = 0, looked = 0; k < kAll && looked < count; ++k) {
    const std::size_t v = now.turn++ % kAll;
    if (now.rest[v] > 0) {
      --now.rest[v];
      continue;
    }
    ++looked;
    bool better = false;
    for (const double sign : {1.0, -1.0}) {
      CycleShape shape = now.shape;
      double& share = *shape.shares()[v];
      const double before = share;
      share = std::clamp(share + sign * now.span[v], kLeastShare[v], kMostShare[v]);
      if (share == before) continue;
      // What it would be worth at the aim is known well enough to see what is not worth a search.
      const Prospect likely = prospect(now, shape, found.step());
      if (likely.worth <= depth_of_cut(aim(now)) / depth_of_cut(found.trial.largest_rad) * found.trial.worth())
        continue;
      Trial trial = longest_step(now, shape, likely.step);
      if (trial.largest_rad < 0.0 || !(trial.worth() > kBetter * found.trial.worth())) continue;
      if (enters_anything(trial)) continue;
      found.trial = std::move(trial), now.shape = shape, better = true;
      break;
    }
    now.span[v] = std::min(now.span[v] * (better ? kGrow : kShrink), kMostSpan);
    if (now.span[v] >= kLeastSpan) continue;
    now.span[v] = kSpanAfterRest;
    now.rest[v] = kRest;
  }
  return found;
}

CycleShape CycleSearch::replace_back_pass(const CycleState& now, double step) {
  const MeasureRings rings{rings_, volume_rings_, both_rings_};
  CycleShape best = now.shape;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const CycleShape& other) {
    CycleShape lifted = other;
    lifted.lift_mm = needed_lift(now, other, step);
    const Trial trial = plan(now, lifted, step);
    if (!trial.back) return;
    const bool enters = guard_.enters_with_back(trial);
    const double angle =
        backs_.measure(*trial.back, true, false, kRows, rings, has_rows_apart(*trial.back), meter_).peak->angle_rad;
    const double excess = std::max(angle - kFitBack * aim(now), 0.0) + (enters ? options_.largest_rad : 0.0);
    if (excess < least) least = excess, best = other;
  };
  look(now.shape);
  for (const double handle : {0.12, 0.06, 0.2})
    for (const double bulge : {0.0, -0.08}) {
      if (least <= 0.0) return best;
      CycleShape other = now.shape;
      other.back = {handle, handle, bulge};
      look(other);
    }
  return best;
}

std::vector<CycleSearch::Prospect> CycleSearch::prospects(const CycleState& now) {
  const double step = kShortStep * radius_;
  CycleShape shape = replace_back_pass(now, step);
  std::vector<Prospect> out;
  for (const double handle : {0.08, 0.16, 0.26}) {
    for (const double bulge : {-0.08, 0.0, 0.08, 0.16, 0.28}) {
      shape.front = {handle, handle, bulge};
      shape.lift_mm = needed_lift(now, shape, step);
      out.push_back(prospect(now, shape, step));
      out.back().enters = enters_anything(out.back().probe);
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Prospect& a, const Prospect& b) {
    return a.enters != b.enters ? b.enters : a.worth > b.worth;
  });
  return out;
}

FoundCycle CycleSearch::reshaped(FoundCycle found) {
  /// Of those that promise most so many are searched, and more only where none of them gets on.
  constexpr int kSearched = 4;
  bool entering = found.some() && enters_anything(found.trial);
  int searched = 0;
  for (const Prospect& likely : prospects(found.now)) {
    if (searched >= kSearched && found.some() && !entering) break;
    ++searched;
    Trial trial = longest_step(found.now, likely.shape, likely.step);
    if (trial.largest_rad < 0.0 || (!entering && trial.worth() <= found.trial.worth())) continue;
    const bool enters = enters_anything(trial);
    if (enters && (!entering || trial.worth() <= found.trial.worth())) continue;
    entering = enters;
    found.trial = std::move(trial);
    found.now.shape = likely.shape;
  }
  return found;
}

double CycleSearch::needed_lift(const CycleState& now, const CycleShape& shape, double step) const {
  constexpr int kTries = 8;
  double allowed = 0.0;
  const auto depth_with = [&](double lift) {
    CycleShape lifted = shape;
    lifted.lift_mm = lift;
    const Trial trial = plan(now, lifted, step);
    allowed = kLiftAim * guard_.aim_at_tips(trial);
    return guard_.coarse_depth_of_tips(trial);
  };
  // No more than this cycle needs, and no less: what a lifted cycle leaves on a floor the next ones cut besides their own, and where
  // lifts went up and down from cycle to cycle, so did steps.
  double low = 0.0, deep = depth_with(0.0), lift = 0.0;
  double more = std::max(shape.lift_mm, kLiftMore * deep + kLeastLiftMm);
  for (int k = 0; k < kTries && deep > allowed; ++k) {
    const double next = depth_with(more);
    // What the ends of the half enter themselves stays, however high it is lifted between them.
    if (next > allowed && next >= kLiftHelps * deep) break;
    deep = next;
    if (deep > allowed) low = more, more += kLiftMore * deep + kLeastLiftMm;
    lift = more;
  }
  while (deep <= allowed && lift - low > kSameLift * std::max(lift, options_.tolerance_mm)) {
    const double middle = 0.5 * (low + lift);
    (depth_with(middle) <= allowed ? lift : low) = middle;
  }
  return lift;
}

FoundCycle CycleSearch::raised(FoundCycle found) {
  constexpr int kTries = 4;
  const double allowed = guard_.allowed_at_tips(found.trial);
  FoundCycle higher = found;
  for (int k = 0; k < kTries && enters_anything(higher.trial); ++k) {
    const double deep = guard_.depth_of_tips(higher.trial);
    if (deep <= allowed) break;
    higher.now.shape.lift_mm += kLiftMore * (deep - kLiftAim * allowed) + kSameLift * options_.tolerance_mm;
    higher.trial = longest_step(higher.now, higher.now.shape, found.step());
    if (!higher.some()) break;
  }
  found.now.refused = higher.now.refused;
  return higher.some() && !enters_anything(higher.trial) ? higher : found;
}

FoundCycle CycleSearch::best(CycleState now, bool improving) {
  constexpr double kGain = 1.05;
  backs_.clear();
  now.refused = {};
  // Lifted before anything is judged: another shape is not looked for where a lift does.
  now.shape.lift_mm = needed_lift(now, now.shape, now.step_mm);
  FoundCycle found;
  found.trial = longest_step(now, now.shape, now.step_mm);
  found.now = std::move(now);
  if (found.some() && enters_anything(found.trial)) found = raised(std::move(found));
  if (!found.some() || enters_anything(found.trial)) {
    found = reshaped(std::move(found));
  } else if (found.step() < kShortStep * radius_ && --found.now.short_rest < 0) {
    // A step that is only short: not at every cycle where that gains nothing.
    const double before = found.trial.worth();
    found = reshaped(std::move(found));
    found.now.short_rest = found.trial.worth() < kGain * before ? kRest : 0;
  }
  if (improving) found = improved(std::move(found));
  if (options_.strategy == CycleStrategy::kAdjusted) found = adjusted(std::move(found));
  if (found.step() < least_step()) found.trial.largest_rad = -1.0;
  if (found.some() && enters_anything(found.trial)) found = raised(std::move(found));
  return found;
}

}  // namespace flank::internal

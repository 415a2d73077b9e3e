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
      radius_(stock.profile().largest()) {
  reset_shape();
}

double CycleSearch::least_step() const { return kLeastStep * radius_; }

void CycleSearch::reset_shape() {
  const CycleState usual;
  now_.shape = usual.shape;
  now_.span = usual.span;
  now_.rest = usual.rest;
  now_.turn = 0, now_.improved = 0, now_.short_rest = 0;
  now_.excess_rad = 0.0;
  now_.step_mm = 0.2 * radius_;
  now_.lift_mm = 0.0;
}

void CycleSearch::refuse(double step_mm, double largest_rad) {
  // A search that aims lower refuses what the limit allows.
  if (largest_rad <= options_.largest_rad) return;
  if (refused_.largest_rad == 0.0 || largest_rad < refused_.largest_rad) refused_ = {step_mm, largest_rad};
}

double CycleSearch::aim() const {
  const bool at_wall = sides_.from.stops_at_end() && sides_.from.last() - now_.last.from_x < kCornerRadii * radius_;
  const double margin = at_wall ? kCornerMargin * options_.largest_rad : kSearchMargin;
  return options_.largest_rad - std::clamp(now_.excess_rad, margin, kMostExcess * options_.largest_rad);
}

double CycleSearch::partner(double from_x, const CycleShape& shape) const {
  const double y = across(from_x);
  const double middle = 0.5 * sides_.from.axis_length();
  const double gap = (sides_.from.at(from_x).at(middle) - sides_.to.at(y).at(middle)).norm();
  const double wanted = y + shape.share[CycleShape::kAhead] * gap;
  if (!sides_.from.stops_at_end()) return wanted;
  // At a wall both come to their ends together: who is there first turns on the spot, in a corner as round as the tool.
  const double left = std::max(0.0, sides_.from.last() - from_x);
  return std::clamp(wanted, sides_.to.last() - kMostPace * left, sides_.to.last() - left / kMostPace);
}

void CycleSearch::shape_halves(const CycleShape& shape, Trial& trial) const {
  const double gap = gap_at(trial);
  const auto ahead = [](const SidePath& side, double x) { return std::max(0.0, side.last() - x); };
  const auto behind = [](const SidePath& side, double x) { return std::max(0.0, x - side.first()); };
  const double length = sides_.from.axis_length();
  trial.front = half_before_wall(length, start(trial), end(trial).reversed(), shape.front(gap, now_.lift_mm),
                                 ahead(sides_.from, trial.from_x), ahead(sides_.to, trial.to_x));
  if (now_.last.way_mm > 0.0)
    trial.back = half_off_wall(length, end(now_.last).reversed(), start(trial), shape.back(gap, now_.lift_mm),
                               behind(sides_.to, now_.last.to_x), behind(sides_.from, trial.from_x));
}

Trial CycleSearch::tried(double step, const CycleShape& shape, bool measured) {
  Trial trial;
  trial.from_x = now_.last.from_x + step;
  trial.to_x = std::max(now_.last.to_x, partner(trial.from_x, shape));
  shape_halves(shape, trial);
  trial.way_mm = way_of(trial);
  if (measured) measure(trial);
  return trial;
}

bool CycleSearch::has_rows_apart(const RuledMotion& half) const {
  return way_of_middle(half) > kRowsApart * radius_ * kRows;
}

void CycleSearch::take(Trial& trial, bool peak, bool volume) {
  const MeasureRings rings{rings_, volume_rings_, both_rings_};
  KeptMeasures::Kept back{EngagementPeak{}, 0.0};
  if (trial.back) {
    back = backs_.measure(*trial.back, peak, volume, kRows, rings, has_rows_apart(*trial.back), meter_);
    stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  }
  const bool between = has_rows_apart(trial.front);
  const RowRings& asked = rings.of(peak, volume);
  const Engagement front = peak && !between
                               ? meter_.measure_peak(trial.front, asked, kRows, front_guess_, back.peak->angle_rad)
                               : meter_.measure(trial.front, asked, kRows);
  if (peak) {
    trial.largest_rad = std::max(back.peak->angle_rad, front.peak.angle_rad);
    if (front.peak.angle_rad > 0.0) front_guess_ = front.peak.t;
  }
  // What is too much already need not be known.
  if (peak && trial.largest_rad <= aim() && between)
    trial.largest_rad = std::max(trial.largest_rad, meter_.look_between(trial.front, front).angle_rad);
  if (trial.back) stock_.remove_last();
  if (volume) trial.volume_mm3 = *back.volume_mm3 + front.volume_mm3;
}

void CycleSearch::adjust(Trial& best) {
  // Of the longest step that the whole front may take: the first of the published method's paths that is too far.
  constexpr double kFarther = 1.1;
  if (best.largest_rad <= 0.0) return;
  Trial trial = tried(kFarther * (best.from_x - now_.last.from_x), now_.shape, false);
  if (trial.back) stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  const std::optional<RuledMotion> front = adjusted_front(trial.front, meter_, stock_, aim());
  if (trial.back) stock_.remove_last();
  if (!front) return;
  trial.front = *front;
  trial.way_mm = way_of(trial);
  measure(trial);
  if (trial.largest_rad <= aim() && !enters_anything(trial)) best = std::move(trial);
}

Trial CycleSearch::longest_step(const CycleShape& shape, double guess) {
  const double most = 1.2 * radius_, goal = depth_of_cut(aim() - 0.5 * kAimBand);
  double low = 0.0, low_depth = 0.0, high = 0.0, high_depth = 0.0;
  Trial best;
  best.largest_rad = -1.0;
  double step = std::clamp(guess, least_step(), most);
  for (int k = 0; k < 12; ++k) {
    Trial trial = tried(step, shape, true);
    const double depth = depth_of_cut(trial.largest_rad);
    if (trial.largest_rad <= aim()) {
      low = step, low_depth = depth;
      best = std::move(trial);
      if (best.largest_rad > aim() - kAimBand || step >= most) break;
    } else {
      high = step, high_depth = depth;
      refuse(step, trial.largest_rad);
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

void CycleSearch::improve(Trial& best) {
  if (best.largest_rad < 0.0 || best.worth() <= 0.0) return;
  constexpr double kBetter = 1.002;
  // Of seven, in turn: shapes change little from cycle to cycle. The first ones, which begin with a guess, try them all.
  constexpr int kVariables = 2, kFirst = 8;
  const int all = static_cast<int>(now_.shape.share.size());
  const int count = ++now_.improved <= kFirst ? all : kVariables;
  for (int k = 0, looked = 0; k < all && looked < count; ++k) {
    const std::size_t v = now_.turn++ % now_.shape.share.size();
    if (now_.rest[v] > 0) {
      --now_.rest[v];
      continue;
    }
    ++looked;
    bool better = false;
    for (const double sign : {1.0, -1.0}) {
      CycleShape shape = now_.shape;
      shape.share[v] = std::clamp(shape.share[v] + sign * now_.span[v], kLeastShare[v], kMostShare[v]);
      if (shape.share[v] == now_.shape.share[v]) continue;
      const double step = best.from_x - now_.last.from_x;
      // What it would be worth at the aim is known well enough to see what is not worth a search.
      Trial probe = tried(step, shape, false);
      measure_and_weigh(probe);
      const double longer = depth_of_cut(aim()) / depth_of_cut(probe.largest_rad);
      if (longer * probe.worth() <= depth_of_cut(aim()) / depth_of_cut(best.largest_rad) * best.worth()) continue;
      Trial trial = longest_step(shape, longer * step);
      if (trial.largest_rad < 0.0 || !(trial.worth() > kBetter * best.worth())) continue;
      if (enters_anything(trial)) continue;
      best = std::move(trial);
      now_.shape = shape;
      better = true;
      break;
    }
    now_.span[v] = std::min(now_.span[v] * (better ? kGrow : kShrink), kMostSpan);
    if (now_.span[v] >= kLeastSpan) continue;
    now_.span[v] = kSpanAfterRest;
    now_.rest[v] = kRest;
  }
}

CycleShape CycleSearch::with_fit_back(const CycleShape& shape, double step) {
  const MeasureRings rings{rings_, volume_rings_, both_rings_};
  CycleShape best = shape;
  double least = std::numeric_limits<double>::infinity();
  const double lift = now_.lift_mm;
  const auto look = [&](const CycleShape& other) {
    now_.lift_mm = needed_lift(other, step);
    const Trial trial = tried(step, other, false);
    now_.lift_mm = lift;
    if (!trial.back) return;
    const bool enters = guard_.enters_with_back(trial);
    const double angle =
        backs_.measure(*trial.back, true, false, kRows, rings, has_rows_apart(*trial.back), meter_).peak->angle_rad;
    const double excess = std::max(angle - kFitBack * aim(), 0.0) + (enters ? options_.largest_rad : 0.0);
    if (excess < least) least = excess, best = other;
  };
  look(shape);
  for (const double handle : {0.12, 0.06, 0.2})
    for (const double bulge : {0.0, -0.08}) {
      if (least <= 0.0) return best;
      CycleShape other = shape;
      other.share[3] = other.share[4] = handle;
      other.share[5] = bulge;
      look(other);
    }
  return best;
}

std::vector<CycleSearch::Prospect> CycleSearch::prospects() {
  const double step = kShortStep * radius_, lift = now_.lift_mm;
  const CycleShape shape = with_fit_back(now_.shape, step);
  std::vector<Prospect> out;
  for (const double handle : {0.08, 0.16, 0.26}) {
    for (const double bulge : {-0.08, 0.0, 0.08, 0.16, 0.28}) {
      Prospect prospect{shape};
      prospect.shape.share[0] = prospect.shape.share[1] = handle;
      prospect.shape.share[2] = bulge;
      prospect.lift_mm = now_.lift_mm = needed_lift(prospect.shape, step);
      Trial probe = tried(step, prospect.shape, false);
      measure_and_weigh(probe);
      const double longer = depth_of_cut(aim()) / depth_of_cut(probe.largest_rad);
      prospect.enters = enters_anything(probe);
      prospect.step = longer * step;
      prospect.worth = longer * probe.worth();
      out.push_back(prospect);
    }
  }
  now_.lift_mm = lift;
  std::stable_sort(out.begin(), out.end(), [](const Prospect& a, const Prospect& b) {
    return a.enters != b.enters ? b.enters : a.worth > b.worth;
  });
  return out;
}

void CycleSearch::reshape(Trial& best) {
  /// Of those that promise most so many are searched, and more only where none of them gets on.
  constexpr int kSearched = 4;
  bool entering = best.largest_rad >= 0.0 && enters_anything(best);
  int searched = 0;
  double lift = now_.lift_mm;
  for (const Prospect& prospect : prospects()) {
    if (searched >= kSearched && best.largest_rad >= 0.0 && !entering) break;
    ++searched;
    now_.lift_mm = prospect.lift_mm;
    Trial trial = longest_step(prospect.shape, prospect.step);
    if (trial.largest_rad < 0.0 || (!entering && trial.worth() <= best.worth())) continue;
    const bool enters = enters_anything(trial);
    if (enters && (!entering || trial.worth() <= best.worth())) continue;
    entering = enters;
    best = std::move(trial);
    now_.shape = prospect.shape;
    lift = prospect.lift_mm;
  }
  now_.lift_mm = lift;
}

void CycleSearch::reshape_short(Trial& best) {
  constexpr double kGain = 1.05;
  if (now_.short_rest > 0) {
    --now_.short_rest;
    return;
  }
  const double before = best.worth();
  reshape(best);
  if (best.worth() < kGain * before) now_.short_rest = kRest;
}

double CycleSearch::needed_lift(const CycleShape& shape, double step) {
  constexpr int kTries = 8;
  const double before = now_.lift_mm;
  double allowed = 0.0;
  const auto depth_with = [&](double lift) {
    now_.lift_mm = lift;
    const Trial trial = tried(step, shape, false);
    allowed = kLiftAim * guard_.aim_at_tips(trial);
    return guard_.coarse_depth_of_tips(trial);
  };
  // No more than this cycle needs, and no less: what a lifted cycle leaves on a floor the next ones cut besides their own, and where
  // lifts went up and down from cycle to cycle, so did steps.
  double low = 0.0, deep = depth_with(0.0), lift = 0.0;
  double more = std::max(before, kLiftMore * deep + kLeastLiftMm);
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
  now_.lift_mm = before;
  return lift;
}

Trial CycleSearch::lifted(double step) {
  now_.lift_mm = needed_lift(now_.shape, step);
  return tried(step, true);
}

void CycleSearch::lift(Trial& best) {
  constexpr int kTries = 4;
  const double before = now_.lift_mm;
  const double allowed = guard_.allowed_at_tips(best);
  Trial lifted = best;
  for (int k = 0; k < kTries && enters_anything(lifted); ++k) {
    const double deep = guard_.depth_of_tips(lifted);
    if (deep <= allowed) break;
    now_.lift_mm += kLiftMore * (deep - kLiftAim * allowed) + kSameLift * options_.tolerance_mm;
    lifted = longest_step(now_.shape, best.from_x - now_.last.from_x);
    if (lifted.largest_rad < 0.0) break;
  }
  if (lifted.largest_rad >= 0.0 && !enters_anything(lifted))
    best = std::move(lifted);
  else
    now_.lift_mm = before;
}

Trial CycleSearch::best(bool improving) {
  refused_ = {};
  backs_.clear();
  // Lifted before anything is judged: another shape is not looked for where a lift does.
  now_.lift_mm = needed_lift(now_.shape, now_.step_mm);
  Trial best = longest_step(now_.shape, now_.step_mm);
  if (best.largest_rad >= 0.0 && enters_anything(best)) lift(best);
  if (best.largest_rad < 0.0 || enters_anything(best))
    reshape(best);
  else if (best.from_x - now_.last.from_x < kShortStep * radius_)
    reshape_short(best);
  if (improving) improve(best);
  if (options_.strategy == CycleStrategy::kAdjusted) adjust(best);
  if (best.from_x - now_.last.from_x < least_step()) best.largest_rad = -1.0;
  if (best.largest_rad >= 0.0 && enters_anything(best)) lift(best);
  return best;
}

}  // namespace flank::internal

#include "flank/trochoid/cycles.h"

#include <algorithm>
#include <cmath>

#include "flank/base/tolerance_budget.h"
#include "flank/trochoid/cycle_shape.h"

namespace flank::internal {
namespace {

/// Rows and rings while steps and shapes are searched, and when a cycle is accepted.
constexpr int kCoarseRows = 33, kCoarseRings = 7, kFineRows = 101, kFineRings = 21, kCaps = 5;
/// The engagement that a search aims at, below the limit, radians: what lies between rows.
constexpr double kSearchMargin = 0.004;
/// How near to the aim a step ends.
constexpr double kAimBand = 0.009;
/// Before the start, in radii: there the first front is looked for, and twice as far out for as long as it cuts, up to so
/// many times.
constexpr double kFarOut = 4.0;
constexpr int kMostDoublings = 5;
/// Steps shorter than this share of the tool's radius are none.
constexpr double kLeastStep = 0.004;
/// Of the largest front's volume: a front behind the end that takes less is the last.
constexpr double kNothing = 1e-3;
/// Deeper than at the ends of a half by this share counts as deeper.
constexpr double kSpare = 1.1;
constexpr double kLeastLiftMm = 0.02;
/// Shorter than this another shape is looked for.
constexpr double kShortStep = 0.06;

/// Both halves of a cycle under trial.
struct Trial {
  double from_x = 0.0, to_x = 0.0;
  std::optional<RuledMotion> back;
  RuledMotion front;
  double largest_rad = 0.0, volume_mm3 = 0.0, way_mm = 0.0;
  /// What is maximised: removed volume per way of front and back.
  [[nodiscard]] double worth() const { return way_mm > 0.0 ? volume_mm3 / way_mm : 0.0; }
};

/// How deep a cylinder's cut is that engages so far, in radii: it grows with the step, about linearly.
double depth_of_cut(double engagement_rad) { return std::max(1e-3, 1.0 - std::cos(engagement_rad)); }

bool cuts_nothing(const Trial& trial) { return !(trial.largest_rad > 0.0 || trial.volume_mm3 > 0.0); }

class CyclePlanner {
 public:
  CyclePlanner(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options)
      : sides_(sides),
        guard_(guard),
        stock_(stock),
        options_(options),
        meter_(stock),
        coarse_(tool_rings(stock.radial(), kCoarseRings, kCaps)),
        fine_(tool_rings(stock.radial(), kFineRings, kCaps)),
        radius_(stock.profile().largest()),
        aim_(options.largest_rad - kSearchMargin) {}

  LayerCycles run(const Progress& progress);

 private:
  [[nodiscard]] AxisPlace start(const Trial& t) const { return sides_.from.at(t.from_x); }
  [[nodiscard]] AxisPlace end(const Trial& t) const { return sides_.to.at(t.to_x); }
  [[nodiscard]] double gap_at(const Trial& t) const {
    const double middle = 0.5 * sides_.from.axis_length();
    return (start(t).at(middle) - end(t).at(middle)).norm();
  }
  [[nodiscard]] double partner(double from_x, const CycleShape& shape) const;
  void shape_halves(const CycleShape& shape, Trial& trial) const;
  [[nodiscard]] Trial tried(double step, const CycleShape& shape, bool measured);
  [[nodiscard]] Trial longest_step(const CycleShape& shape, double guess);
  void improve(Trial& best);
  void reshape(Trial& best);
  [[nodiscard]] Half accepted(const RuledMotion& motion);
  [[nodiscard]] bool accept(Trial trial, LayerCycles& out);
  /// The trial, or one with a smaller aim where its fine measure is above the limit.
  [[nodiscard]] bool accept_some(Trial trial, LayerCycles& out);
  void place_first(LayerCycles& out);
  [[nodiscard]] GuardDepth depth_of(const Trial& trial, int times, int places) const;
  /// What the side paths themselves enter there: no shape of a cycle changes it.
  [[nodiscard]] GuardDepth depth_at_ends(const Trial& trial, int places) const;
  /// Lifts the inner points of both halves for as long as their tips enter something, if that helps.
  void lift(Trial& best);
  /// Whether a half enters a face by more than the tolerance and more than its ends; no lift and no shorter step helps there, another shape may.
  [[nodiscard]] bool enters_anything(const Trial& trial) const;
  [[nodiscard]] bool passed_everything() const {
    return last_.from_x > sides_.from.length() + out_ && last_.to_x > sides_.to.length() + out_;
  }

  const LayerSides& sides_;
  const HalfGuard& guard_;
  SweptStock& stock_;
  const CycleOptions& options_;
  EngagementMeter meter_;
  std::vector<ToolRing> coarse_, fine_;
  double radius_, aim_;
  double out_ = 0.0;  ///< so far behind the sides nothing of the blank is left, mm
  Trial last_;
  CycleShape shape_;
  std::array<double, 7> span_ = {0.05, 0.05, 0.08, 0.05, 0.05, 0.08, 0.05};
  double step_ = 0.0, lift_ = 0.0, refused_ = 0.0;
  double largest_front_ = 0.0;  ///< volume, mm^3
  std::size_t turn_ = 0;
  int improved_ = 0;  ///< cycles whose shape was searched
};

double CyclePlanner::partner(double from_x, const CycleShape& shape) const {
  const double guess = last_.to_x + from_x - last_.from_x;
  const double y = across_from(sides_.from, from_x, sides_.to, guess);
  const double middle = 0.5 * sides_.from.axis_length();
  const double gap = (sides_.from.at(from_x).at(middle) - sides_.to.at(y).at(middle)).norm();
  return y + shape.share[CycleShape::kAhead] * gap;
}

void CyclePlanner::shape_halves(const CycleShape& shape, Trial& trial) const {
  const double length = sides_.from.axis_length(), gap = gap_at(trial);
  trial.front = half_path(length, start(trial), end(trial).reversed(), shape.front(gap, lift_));
  if (last_.way_mm > 0.0) trial.back = half_path(length, end(last_).reversed(), start(trial), shape.back(gap, lift_));
}

Trial CyclePlanner::tried(double step, const CycleShape& shape, bool measured) {
  Trial trial;
  trial.from_x = last_.from_x + step;
  trial.to_x = std::max(last_.to_x, partner(trial.from_x, shape));
  shape_halves(shape, trial);
  trial.way_mm = way_of_middle(trial.front) + (trial.back ? way_of_middle(*trial.back) : 0.0);
  if (!measured) return trial;
  if (trial.back) {
    const Engagement e = meter_.measure(*trial.back, coarse_, kCoarseRows);
    trial.largest_rad = e.peak.angle_rad;
    trial.volume_mm3 = e.volume_mm3;
    stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  }
  const Engagement e = meter_.measure(trial.front, coarse_, kCoarseRows);
  trial.largest_rad = std::max(trial.largest_rad, e.peak.angle_rad);
  trial.volume_mm3 += e.volume_mm3;
  if (trial.back) stock_.remove_last();
  return trial;
}

Trial CyclePlanner::longest_step(const CycleShape& shape, double guess) {
  const double most = 1.2 * radius_, goal = depth_of_cut(aim_ - 0.5 * kAimBand);
  double low = 0.0, low_depth = 0.0, high = 0.0, high_depth = 0.0;
  Trial best;
  best.largest_rad = -1.0;
  double step = std::clamp(guess, kLeastStep * radius_, most);
  for (int k = 0; k < 12; ++k) {
    Trial trial = tried(step, shape, true);
    const double depth = depth_of_cut(trial.largest_rad);
    if (trial.largest_rad <= aim_) {
      low = step, low_depth = depth;
      best = std::move(trial);
      if (best.largest_rad > aim_ - kAimBand || step >= most) break;
    } else {
      high = step, high_depth = depth;
      refused_ = step;
    }
    if (high == 0.0) {
      step = std::min(most, step * std::clamp(goal / low_depth, 1.02, 1.8));
      continue;
    }
    if (high - low < 0.3 * kLeastStep * radius_) break;
    // Regula falsi, kept off the ends of the bracket: the engagement may jump.
    const double share = std::clamp((goal - low_depth) / (high_depth - low_depth), 0.15, 0.9);
    step = low + share * (high - low);
  }
  return best;
}

void CyclePlanner::improve(Trial& best) {
  if (!options_.optimise || best.largest_rad < 0.0 || best.worth() <= 0.0) return;
  constexpr double kBetter = 1.002;
  // Of seven, in turn: shapes change little from cycle to cycle. The first ones, which begin with a guess, try them all.
  constexpr int kVariables = 3, kFirst = 8;
  const int count = ++improved_ <= kFirst ? static_cast<int>(shape_.share.size()) : kVariables;
  for (int k = 0; k < count; ++k) {
    const std::size_t v = turn_++ % shape_.share.size();
    bool better = false;
    for (const double sign : {1.0, -1.0}) {
      CycleShape shape = shape_;
      shape.share[v] = std::clamp(shape.share[v] + sign * span_[v], kLeastShare[v], kMostShare[v]);
      if (shape.share[v] == shape_.share[v]) continue;
      const double step = best.from_x - last_.from_x;
      // What it would be worth at the aim is known well enough to see what is not worth a search.
      const Trial probe = tried(step, shape, true);
      const double longer = depth_of_cut(aim_) / depth_of_cut(probe.largest_rad);
      if (longer * probe.worth() <= depth_of_cut(aim_) / depth_of_cut(best.largest_rad) * best.worth()) continue;
      const Trial trial = longest_step(shape, longer * step);
      if (trial.largest_rad < 0.0 || !(trial.worth() > kBetter * best.worth())) continue;
      if (enters_anything(trial)) continue;
      best = trial;
      shape_ = shape;
      better = true;
      break;
    }
    span_[v] = std::clamp(span_[v] * (better ? 1.3 : 0.7), 0.005, 0.15);
  }
}

/// Fronts from flat to steep, where the shape of the last cycle does not get on, or enters a side: the best of those that
/// enter none, if there is one.
void CyclePlanner::reshape(Trial& best) {
  const CycleShape before = shape_;
  bool entering = best.largest_rad >= 0.0 && enters_anything(best);
  for (const double handle : {0.08, 0.16, 0.26}) {
    for (const double bulge : {-0.08, 0.0, 0.08, 0.16, 0.28}) {
      CycleShape shape = before;
      shape.share[0] = shape.share[1] = handle;
      shape.share[2] = bulge;
      Trial trial = longest_step(shape, 0.15 * radius_);
      if (trial.largest_rad < 0.0 || (!entering && trial.worth() <= best.worth())) continue;
      const bool enters = enters_anything(trial);
      if (enters && (!entering || trial.worth() <= best.worth())) continue;
      entering = enters;
      best = std::move(trial);
      shape_ = shape;
    }
  }
}

Half CyclePlanner::accepted(const RuledMotion& motion) {
  Half half;
  half.motion = motion;
  half.engagement = meter_.measure(motion, fine_, kFineRows);
  half.peak = meter_.refine(motion, half.engagement, kFineRings);
  half.way_mm = way_of_middle(motion);
  return half;
}

bool CyclePlanner::accept(Trial trial, LayerCycles& out) {
  Cycle cycle;
  cycle.from_x = trial.from_x;
  cycle.to_x = trial.to_x;
  if (trial.back) {
    cycle.back = accepted(*trial.back);
    stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  }
  cycle.front = accepted(trial.front);
  const double largest = std::max(cycle.front.peak.angle_rad, cycle.back ? cycle.back->peak.angle_rad : 0.0);
  if (largest > options_.largest_rad) {
    if (trial.back) stock_.remove_last();
    aim_ -= std::max(0.002, 1.05 * (largest - options_.largest_rad));
    return false;
  }
  stock_.add(Sweep::of(trial.front, kHalfIntervals));
  for (const RuledMotion* motion : {&trial.front, trial.back ? &*trial.back : &trial.front})
    out.entered_mm = std::max(out.entered_mm, guard_.depth(*motion, 25, 9).deepest());
  out.cycles.push_back(std::move(cycle));
  last_ = std::move(trial);
  return true;
}

GuardDepth CyclePlanner::depth_of(const Trial& trial, int times, int places) const {
  GuardDepth out = guard_.depth(trial.front, times, places);
  if (!trial.back) return out;
  const GuardDepth back = guard_.depth(*trial.back, times, places);
  return {std::max(out.sides, back.sides), std::max(out.others, back.others), std::max(out.tip, back.tip)};
}

GuardDepth CyclePlanner::depth_at_ends(const Trial& trial, int places) const {
  GuardDepth out;
  for (const double t : {0.0, 1.0}) guard_.look(trial.front.pose(t), places, out);
  return out;
}

bool CyclePlanner::enters_anything(const Trial& trial) const {
  // As dense as what is told of accepted halves, or they would be found to enter afterwards: deepest are places just off
  // the ends, where a half leaves a side that runs on past its face.
  constexpr int kTimes = 25, kPlaces = 9;
  const double allowed = kToleranceBudget.cavity.halves * options_.tolerance_mm;
  return depth_of(trial, kTimes, kPlaces).deepest() > std::max(allowed, depth_at_ends(trial, kPlaces).deepest());
}

void CyclePlanner::lift(Trial& best) {
  constexpr int kTimes = 17, kPlaces = 5, kTries = 4;
  const double allowed =
      std::max(kToleranceBudget.cavity.aim * options_.tolerance_mm, kSpare * depth_at_ends(best, kPlaces).tip);
  const double before = lift_, deepest = depth_of(best, kTimes, kPlaces).tip;
  double deep = deepest;
  Trial lifted = best;
  for (int k = 0; k < kTries && deep > allowed; ++k) {
    lift_ += 1.6 * deep + 0.02;
    Trial next = longest_step(shape_, best.from_x - last_.from_x);
    if (next.largest_rad < 0.0) break;
    lifted = std::move(next);
    deep = depth_of(lifted, kTimes, kPlaces).tip;
  }
  if (deep < 0.7 * deepest || deep <= allowed)
    best = std::move(lifted);
  else
    lift_ = before;
}

bool CyclePlanner::accept_some(Trial trial, LayerCycles& out) {
  constexpr int kAims = 4, kTries = 16;
  const double aim = aim_;
  double step = trial.from_x - last_.from_x;
  for (int k = 0; k < kTries && trial.largest_rad >= 0.0; ++k) {
    if (accept(trial, out)) return true;
    if (k < kAims) {
      trial = longest_step(shape_, 0.97 * step);
      step = std::min(step, trial.from_x - last_.from_x);
    } else {
      // What the coarse samples miss does not follow the aim: shorter steps do.
      aim_ = aim;
      step *= 0.75;
      if (step < kLeastStep * radius_) break;
      trial = tried(step, shape_, true);
    }
  }
  return false;
}

void CyclePlanner::place_first(LayerCycles& out) {
  // So far before the start that nothing is cut, then as near as nothing is cut. Where the ends of the sides are skewed the
  // blank reaches far before one of them.
  double far = kFarOut * radius_;
  Trial first;
  for (int k = 0; k <= kMostDoublings; ++k, far *= 2.0) {
    last_.from_x = -far;
    last_.to_x = across_from(sides_.from, last_.from_x, sides_.to, last_.from_x);
    first = tried(0.0, shape_, true);
    if (cuts_nothing(first)) break;
  }
  double low = 0.0, high = far;
  for (int k = 0; k < 14; ++k) {
    const double step = 0.5 * (low + high);
    Trial trial = tried(step, shape_, true);
    if (cuts_nothing(trial)) {
      low = step;
      first = std::move(trial);
    } else {
      high = step;
    }
  }
  if (!accept(std::move(first), out)) out.status = CycleStatus::kStuck;
}

LayerCycles CyclePlanner::run(const Progress& progress) {
  LayerCycles out;
  place_first(out);
  out_ = std::max(2.0 * radius_, -last_.from_x + 2.0 * radius_);
  step_ = 0.2 * radius_;
  const double whole = sides_.from.length() + 4.0 * radius_;
  while (out.status == CycleStatus::kDone && !passed_everything() &&
         static_cast<int>(out.cycles.size()) < options_.most_cycles) {
    progress.step("cycles", std::clamp((last_.from_x + 2.0 * radius_) / whole, 0.0, 1.0));
    if (progress.stop()) {
      out.status = CycleStatus::kCancelled;
      break;
    }
    if (last_.from_x >= options_.most_share * sides_.from.length()) {
      out.status = CycleStatus::kShort;
      break;
    }
    // No more lift than this cycle needs: the floor may fall again.
    lift_ = lift_ > kLeastLiftMm ? 0.5 * lift_ : 0.0;
    Trial best = longest_step(shape_, step_);
    if (best.largest_rad < 0.0 || best.from_x - last_.from_x < kShortStep * radius_ || enters_anything(best))
      reshape(best);
    improve(best);
    if (best.largest_rad < 0.0 || best.from_x - last_.from_x < kLeastStep * radius_) {
      out.status = CycleStatus::kStuck;
      out.stuck_step_mm = refused_;
      break;
    }
    lift(best);
    step_ = best.from_x - last_.from_x;
    if (!accept_some(best, out)) {
      out.status = CycleStatus::kStuck;
      out.stuck_step_mm = step_;
      break;
    }
    // The aim comes back slowly: what made it too high may have been this cycle alone.
    aim_ = std::min(aim_ + 0.001, options_.largest_rad - 0.001);
    const double removed = out.cycles.back().front.engagement.volume_mm3;
    largest_front_ = std::max(largest_front_, removed);
    if (removed <= kNothing * largest_front_ && last_.from_x > sides_.from.length() && last_.to_x > sides_.to.length())
      break;
  }
  return out;
}

}  // namespace

LayerCycles plan_cycles(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options,
                        const Progress& progress) {
  return CyclePlanner(sides, guard, stock, options).run(progress);
}

}  // namespace flank::internal

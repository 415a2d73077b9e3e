#include "flank/trochoid/cycles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/journal.h"
#include "flank/motion/motion_record.h"

namespace flank::internal {

void code(StepCodec& codec, EngagementPeak& peak) {
  for (double* value : {&peak.angle_rad, &peak.t, &peak.s}) codec.number(*value);
}

void code(StepCodec& codec, EngagementRow& row) {
  for (double* value : {&row.t, &row.angle_rad, &row.s, &row.mean_rad, &row.rate_mm3}) codec.number(*value);
}

namespace {

/// Rows of a motion, and rings of the flank for engagement and volume when a cycle is accepted.
constexpr int kFineRows = 102, kFineRings = 61, kVolumeRings = 9;
/// Of these rings every so many are looked at closely in any case.
constexpr int kEvery = 3;
/// Before the start, in radii: there the first front is looked for, and twice as far out for as long as it cuts, up to so
/// many times.
constexpr double kFarOut = 4.0;
constexpr int kMostDoublings = 5;
/// By which it is moved out, in radii, at first, where fine samples see that it cuts too much.
constexpr double kBackOff = 0.1;
/// Of the largest front's volume: a front behind the end that takes less is the last.
constexpr double kNothing = 1e-3;
/// Of what the fine samples saw more than those of the search, this share is expected of the next cycle, if it sees less:
/// what one cycle has, others near it are likely to have, and a search that fails at the fine samples is repeated.
constexpr double kKept = 0.7;
/// An aim that failed is lowered by at least so much, radians.
constexpr double kLeastLess = 0.002;
/// In radii: so near to a wall at the end cycles end in any case, because their chips get ever thinner; so near where none gets on,
/// and so near where taking some back does not help.
constexpr double kAgainstWall = 0.1, kAtWall = 0.2, kBeforeWall = 0.5;
/// Cycles that are taken back where none gets on, at first.
constexpr std::size_t kFirstRewind = 4;
/// Tolerances: a cycle that enters a face deeper than this is none. A little deeper than it may is told with the request that it meets.
constexpr double kDeepest = 4.0;
/// How often they are taken back because a half enters a face: where the sides themselves lead there, that does not help.
constexpr int kRewindsForFaces = 3;

/// Neither the flank of the tool nor its round ends meet material.
bool cuts_nothing(CycleSearch& search, Trial& trial) {
  if (trial.largest_rad > 0.0) return false;
  search.weigh(trial);
  return !(trial.volume_mm3 > 0.0);
}

/// The sweeps of these cycles.
void sweep(const Cycle& cycle, SweptStock& stock) {
  if (cycle.back) stock.add(Sweep::of(cycle.back->motion, kHalfIntervals));
  stock.add(Sweep::of(cycle.front.motion, kHalfIntervals));
}

void code(StepCodec& codec, Half& half) {
  code(codec, half.motion);
  code(codec, half.engagement.peak);
  codec.number(half.engagement.volume_mm3);
  code(codec, half.engagement.rows);
  code(codec, half.peak);
  codec.number(half.way_mm);
  codec.require(half.motion.tip.count() > 0, "expected a motion");
}

/// What the search of one cycle leaves.
struct CycleStep {
  std::optional<Cycle> cycle;  ///< none: none gets on
  CycleState now;
};

void code(StepCodec& codec, CycleStep& step) {
  code(codec, step.cycle);
  code(codec, step.now);
}

class CyclePlanner {
 public:
  CyclePlanner(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options)
      : sides_(sides),
        stock_(stock),
        options_(options),
        search_(sides, guard, stock, options),
        meter_(stock),
        rings_(stock.radial(), kFineRings, kVolumeRings, kEvery) {
    now_ = search_.anew({});
    now_.sweeps = stock.sweeps().size();
  }

  LayerCycles run(const std::optional<FirstFront>& first, const Progress& progress);

 private:
  [[nodiscard]] Half accepted(const RuledMotion& motion);
  /// Whether so much engagement is above the limit, where a search saw less: the next one then aims lower.
  [[nodiscard]] bool is_too_much(double largest_rad, const Trial& searched);
  [[nodiscard]] bool accept(Trial trial, LayerCycles& out);
  /// The trial, or one with a smaller aim where its fine measure is above the limit; none that enters a face, unless the
  /// trial does.
  [[nodiscard]] bool accept_some(Trial trial, bool entering, LayerCycles& out);
  /// The first front, before the blank: as near as it cuts nothing.
  [[nodiscard]] Trial placed_first();
  /// The same, farther out for as long as the fine samples see more than the limit.
  [[nodiscard]] bool accept_first(LayerCycles& out);
  void begin_with(const FirstFront& first, LayerCycles& out);
  /// The next cycle; false where none gets on. `now_` is then in some state between.
  [[nodiscard]] bool add_cycle(LayerCycles& out);
  /// The same, from the journal if an earlier run has found it.
  [[nodiscard]] bool next_cycle(LayerCycles& out, const Progress& progress);
  /// Greedy shapes may lead where nothing gets on: takes back cycles, twice as many each time, and goes on from there with
  /// the shape that it had, which is kept until past the place; from the start, with the first shape. False if that has been tried often enough.
  [[nodiscard]] bool rewind(LayerCycles& out);
  /// The stock as these cycles leave it.
  void put_back(const LayerCycles& cycles);
  [[nodiscard]] bool is_last(const LayerCycles& out) const;
  /// Whether the last front is so near to a wall at the end that cycles may end there; then says how near.
  [[nodiscard]] bool ends_at_wall(double radii, LayerCycles& out) const;

  const LayerSides& sides_;
  SweptStock& stock_;
  const CycleOptions& options_;
  CycleSearch search_;
  CycleState now_;
  EngagementMeter meter_;
  RowRings rings_;
  double out_ = 0.0;                ///< so far behind the sides nothing of the blank is left, mm
  std::vector<CycleState> before_;  ///< as it was before each of the cycles
  std::size_t plain_until_ = 0;     ///< so many cycles are there before shapes are searched again
  int rewinds_ = 0;
};

Half CyclePlanner::accepted(const RuledMotion& motion) {
  Half half;
  half.motion = motion;
  half.engagement = meter_.measure(motion, rings_, kFineRows);
  half.peak = meter_.refine(motion, half.engagement, kFineRings);
  half.way_mm = way_of_middle(motion);
  return half;
}

bool CyclePlanner::is_too_much(double largest_rad, const Trial& searched) {
  if (largest_rad <= options_.largest_rad) return false;
  now_.refuse(searched.from_x - now_.last.from_x, largest_rad, options_.largest_rad);
  now_.excess_rad = std::max(now_.excess_rad + kLeastLess, 1.05 * (largest_rad - searched.largest_rad));
  return true;
}

bool CyclePlanner::accept(Trial trial, LayerCycles& out) {
  Cycle cycle;
  cycle.from_x = trial.from_x;
  cycle.to_x = trial.to_x;
  double largest = 0.0;
  if (trial.back) {
    cycle.back = accepted(*trial.back);
    largest = cycle.back->peak.angle_rad;
    if (is_too_much(largest, trial)) return false;
    stock_.add(Sweep::of(*trial.back, kHalfIntervals));
  }
  cycle.front = accepted(trial.front);
  largest = std::max(largest, cycle.front.peak.angle_rad);
  if (is_too_much(largest, trial)) {
    if (trial.back) stock_.remove_last();
    return false;
  }
  now_.excess_rad = std::max(kKept * now_.excess_rad, largest - trial.largest_rad);
  stock_.add(Sweep::of(trial.front, kHalfIntervals));
  cycle.entered_mm = search_.entered(trial);
  out.cycles.push_back(std::move(cycle));
  now_.last = std::move(trial);
  return true;
}

bool CyclePlanner::accept_some(Trial trial, bool entering, LayerCycles& out) {
  constexpr int kAims = 4, kTries = 16;
  const double excess = now_.excess_rad;
  double step = trial.from_x - now_.last.from_x;
  for (int k = 0; k < kTries && trial.largest_rad >= 0.0; ++k) {
    // A shorter step may enter what the longer one does not.
    if ((k == 0 || entering || !search_.enters_anything(trial)) && accept(trial, out)) return true;
    if (k < kAims) {
      Trial lower = search_.longest_step(now_, now_.shape, 0.97 * step);
      if (lower.largest_rad >= 0.0) {
        trial = std::move(lower);
        step = std::min(step, trial.from_x - now_.last.from_x);
        continue;
      }
      k = kAims;
    }
    // What the coarse samples miss does not follow the aim, which may be so low that no step has it: shorter steps do.
    now_.excess_rad = excess;
    step *= 0.75;
    if (step < search_.least_step()) break;
    trial = search_.lifted(now_, step);
  }
  return false;
}

void CyclePlanner::begin_with(const FirstFront& first, LayerCycles& out) {
  // The entry ends with it: its way and its engagement are counted there.
  Cycle cycle;
  cycle.from_x = first.from_x, cycle.to_x = first.to_x;
  cycle.front.motion = first.motion;
  Trial& last = now_.last;
  last.from_x = first.from_x, last.to_x = first.to_x;
  last.front = first.motion;
  last.way_mm = way_of_middle(first.motion);
  cycle.entered_mm = search_.entered(last);
  stock_.add(Sweep::of(first.motion, kHalfIntervals));
  out.cycles.push_back(std::move(cycle));
}

Trial CyclePlanner::placed_first() {
  // So far before the start that nothing is cut, then as near as nothing is cut. Where the ends of the sides are skewed the
  // blank reaches far before one of them.
  double far = kFarOut * search_.radius();
  Trial first;
  for (int k = 0; k <= kMostDoublings; ++k, far *= 2.0) {
    now_.last.from_x = -far;
    now_.last.to_x = search_.paired_abscissa(now_.last.from_x);
    first = search_.measured(now_, 0.0);
    if (cuts_nothing(search_, first)) break;
  }
  double low = 0.0, high = far;
  for (int k = 0; k < 14; ++k) {
    const double step = 0.5 * (low + high);
    Trial trial = search_.measured(now_, step);
    if (cuts_nothing(search_, trial)) {
      low = step;
      first = std::move(trial);
    } else {
      high = step;
    }
  }
  return first;
}

bool CyclePlanner::accept_first(LayerCycles& out) {
  Trial first = placed_first();
  const double farthest = now_.last.from_x;
  // An edge of the blank may lie between the rings of the search, and on it a slender tool is in deep at once.
  for (double back = kBackOff * search_.radius(); !accept(first, out); back *= 2.0) {
    if (first.from_x <= farthest) return false;
    now_.last.from_x = std::max(farthest, first.from_x - back);
    now_.last.to_x = search_.paired_abscissa(now_.last.from_x);
    now_.excess_rad = 0.0;
    first = search_.measured(now_, 0.0);
  }
  return true;
}

bool CyclePlanner::add_cycle(LayerCycles& out) {
  FoundCycle found = search_.best(std::move(now_), options_.optimise() && out.cycles.size() >= plain_until_);
  now_ = std::move(found.now);
  if (found.trial.largest_rad < 0.0) return false;
  const bool entering = search_.enters_anything(found.trial);
  const bool deep = entering && search_.entered(found.trial) > kDeepest * options_.tolerance_mm;
  if (deep || (entering && options_.optimise() && rewinds_ < kRewindsForFaces)) return false;
  now_.step_mm = found.trial.from_x - now_.last.from_x;
  if (!accept_some(std::move(found.trial), entering, out)) return false;
  now_.largest_front_mm3 = std::max(now_.largest_front_mm3, out.cycles.back().front.engagement.volume_mm3);
  return true;
}

bool CyclePlanner::next_cycle(LayerCycles& out, const Progress& progress) {
  const std::size_t before = out.cycles.size();
  const auto search = [&] {
    CycleStep step;
    if (add_cycle(out)) step.cycle = out.cycles.back();
    step.now = now_;
    return step;
  };
  CycleStep step = journaled(progress, "cycle", search, now_);
  const bool found = step.cycle.has_value();
  if (found && out.cycles.size() == before) {
    sweep(*step.cycle, stock_);
    out.cycles.push_back(std::move(*step.cycle));
  }
  now_ = std::move(step.now);
  return found;
}

bool CyclePlanner::is_last(const LayerCycles& out) const {
  const bool behind = now_.last.from_x > sides_.from.length() && now_.last.to_x > sides_.to.length();
  const bool far_behind = now_.last.from_x > sides_.from.length() + out_ && now_.last.to_x > sides_.to.length() + out_;
  const double removed = out.cycles.empty() ? 0.0 : out.cycles.back().front.engagement.volume_mm3;
  return far_behind || (behind && removed <= kNothing * now_.largest_front_mm3);
}

bool CyclePlanner::ends_at_wall(double radii, LayerCycles& out) const {
  // A corner as round as the tool engages it from wall to wall, however little is taken.
  if (!sides_.from.stops_at_end()) return false;
  const Cycle& last = out.cycles.back();
  const double before = std::max(sides_.from.last() - last.from_x, sides_.to.last() - last.to_x);
  // Past the ends of both sides nothing of them is left.
  const double of_sides = std::max(sides_.from.length() - last.from_x, sides_.to.length() - last.to_x);
  const bool past = of_sides <= 0.0;
  if ((radii > kAgainstWall ? std::min(before, of_sides) : before) > radii * search_.radius()) return false;
  out.before_wall_mm = past ? 0.0 : std::max(before, 1e-9);
  return true;
}

bool CyclePlanner::rewind(LayerCycles& out) {
  if (!options_.optimise() || rewinds_ >= options_.most_rewinds || out.cycles.empty()) return false;
  const std::size_t stuck = out.cycles.size();
  const std::size_t back = std::min<std::size_t>(stuck - 1, kFirstRewind << rewinds_++);
  plain_until_ = stuck + back;
  out.cycles.resize(stuck - back);
  now_ = before_[stuck - back];
  while (stock_.sweeps().size() > now_.sweeps) stock_.remove_last();
  // In the middle a front of quite another shape would be in full material.
  if (stuck - back <= 1) now_ = search_.anew(now_);
  return true;
}

void CyclePlanner::put_back(const LayerCycles& cycles) {
  while (stock_.sweeps().size() > before_.front().sweeps) stock_.remove_last();
  for (const Cycle& cycle : cycles.cycles) sweep(cycle, stock_);
}

LayerCycles CyclePlanner::run(const std::optional<FirstFront>& first, const Progress& progress) {
  LayerCycles out, farthest;
  before_.push_back(now_);
  if (first)
    begin_with(*first, out);
  else if (!accept_first(out))
    out.status = CycleStatus::kStuck, out.stuck = now_.refused, out.ends_stuck = true;
  out_ = std::max(2.0 * search_.radius(), -now_.last.from_x + 2.0 * search_.radius());
  const double whole = sides_.from.length() + 4.0 * search_.radius();
  double farthest_x = -std::numeric_limits<double>::infinity();
  while (out.status == CycleStatus::kDone && !is_last(out)) {
    progress.step("cycles", std::clamp((now_.last.from_x + 2.0 * search_.radius()) / whole, 0.0, 1.0));
    if (progress.stop() && now_.last.from_x <= farthest_x) {
      // Taken back from where it got farthest, and not there again.
      farthest.status = CycleStatus::kCancelled;
      put_back(farthest);
      return farthest;
    }
    if (progress.stop()) out.status = CycleStatus::kCancelled;
    if (now_.last.from_x >= options_.most_share * sides_.from.length()) out.status = CycleStatus::kShort;
    if (out.status == CycleStatus::kShort && ends_at_wall(kBeforeWall, out)) {
      out.status = CycleStatus::kDone;
      break;
    }
    if (out.status != CycleStatus::kDone) break;
    before_.resize(out.cycles.size());
    before_.push_back(now_);
    before_.back().sweeps = stock_.sweeps().size();
    if (!out.cycles.empty() && ends_at_wall(kAgainstWall, out)) break;
    if (next_cycle(out, progress)) continue;
    if (ends_at_wall(kAtWall, out)) break;
    if (now_.last.from_x > farthest_x) {
      farthest_x = now_.last.from_x;
      farthest = out;
      farthest.stuck = now_.refused;
      farthest.ends_stuck = true;
    }
    if (rewind(out)) continue;
    farthest.status = ends_at_wall(kBeforeWall, farthest) ? CycleStatus::kDone : CycleStatus::kStuck;
    put_back(farthest);
    return farthest;
  }
  return out;
}

}  // namespace

void code(StepCodec& codec, Cycle& cycle) {
  bool back = cycle.back.has_value();
  code(codec, back);
  if (codec.reading() && back) cycle.back.emplace();
  if (back) code(codec, *cycle.back);
  code(codec, cycle.front);
  codec.finite(cycle.from_x);
  codec.finite(cycle.to_x);
  codec.number(cycle.entered_mm);
}

void code(StepCodec& codec, LayerCycles& layer) {
  code_choice(codec, layer.status, 4);
  code(codec, layer.cycles);
  code(codec, layer.stuck);
  codec.number(layer.before_wall_mm);
  code(codec, layer.ends_stuck);
}

double LayerCycles::entered_mm() const {
  double deepest = 0.0;
  for (const Cycle& cycle : cycles) deepest = std::max(deepest, cycle.entered_mm);
  return deepest;
}

LayerCycles plan_cycles(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options,
                        const std::optional<FirstFront>& first, const Progress& progress) {
  const std::size_t before = stock.sweeps().size();
  LayerCycles out = journaled(
      progress, "layer", [&] { return CyclePlanner(sides, guard, stock, options).run(first, progress); }, before,
      options.most_rewinds);
  // An earlier run may have found them, in another stock.
  while (stock.sweeps().size() > before) stock.remove_last();
  for (const Cycle& cycle : out.cycles) sweep(cycle, stock);
  return out;
}

}  // namespace flank::internal

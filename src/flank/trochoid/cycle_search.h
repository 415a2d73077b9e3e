/// The search of one cycle: its shape, and the longest step that the engagement allows (docs/algorithms/trochoid.md).
#pragma once

#include <limits>
#include <vector>

#include "flank/trochoid/cycle_guard.h"
#include "flank/trochoid/cycle_state.h"
#include "flank/trochoid/engagement/engagement.h"
#include "flank/trochoid/engagement/kept_measures.h"
#include "flank/trochoid/paths/side_pairing.h"
#include "flank/trochoid/paths/side_path.h"

namespace flank::internal {

/// How a cycle is found.
enum class CycleStrategy {
  kVolume,    ///< the shapes of its halves are optimised for removed volume per way
  kPlain,     ///< the longest step of the first shapes
  kAdjusted,  ///< a longer step, its front then moved back where the engagement asks for it: the published method
};

struct CycleOptions {
  double largest_rad = 1.0471975511965976;  ///< engagement, fronts and backs
  double tolerance_mm = 0.01;
  CycleStrategy strategy = CycleStrategy::kVolume;
  [[nodiscard]] bool optimise() const { return strategy == CycleStrategy::kVolume; }
  /// Ends of fronts on the first side go no farther than this share of its way: above, the layer before got stuck.
  double most_share = std::numeric_limits<double>::infinity();
  /// How often cycles are taken back where none gets on: 4 at first, then twice as many each time.
  int most_rewinds = 6;
};

/// Poses a half path has in a stock: a multiple of its knot spans.
inline constexpr int kHalfIntervals = 48;

/// A cycle, and the state in which the search of it ended.
struct FoundCycle {
  Trial trial;  ///< `largest_rad` < 0: there is none
  CycleState now;
  [[nodiscard]] bool some() const { return trial.largest_rad >= 0.0; }
  [[nodiscard]] double step() const { return trial.from_x - now.last.from_x; }
};

/// A search takes the state that it begins with, and hands back the one that it ends with; the stock is left as it was.
class CycleSearch {
 public:
  CycleSearch(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options);

  [[nodiscard]] double radius() const { return radius_; }
  /// Shorter than this no step is one, mm.
  [[nodiscard]] double least_step() const;
  /// The place of the second side across from one of the first.
  [[nodiscard]] double paired_abscissa(double from_x) const { return pairing_.at(from_x); }
  /// After the same cycle, all that is learnt from cycle to cycle as a layer begins with it.
  [[nodiscard]] CycleState anew(const CycleState& now) const;
  /// The cycle after now.last whose end on the first side is a step farther, not measured.
  [[nodiscard]] Trial plan(const CycleState& now, const CycleShape& shape, double step) const;
  /// The same of the present shape, with its largest engagement.
  [[nodiscard]] Trial measured(const CycleState& now, double step);
  /// The same, with the lift that it needs, which the state then has.
  [[nodiscard]] Trial lifted(CycleState& now, double step);
  /// The volume of a trial: most are only asked how much they engage.
  void weigh(Trial& trial) { measure(0.0, Asked::kVolume, trial); }
  /// The longest step of a shape, weighed; `largest_rad` < 0: there is none. The state counts what is refused.
  [[nodiscard]] Trial longest_step(CycleState& now, const CycleShape& shape, double guess);
  /// The longest step of the present shape, or of another where that does not get on, enters a face or, with `improving`,
  /// removes less a way; its tips lifted off what they enter.
  [[nodiscard]] FoundCycle best(CycleState now, bool improving);
  /// Deepest that a half enters a face, mm.
  [[nodiscard]] double entered(Trial& trial) const { return guard_.depth(trial).deepest(); }
  /// Whether a half enters a face by more than the tolerance and more than its ends; no lift and no shorter step helps
  /// there, another shape may.
  [[nodiscard]] bool enters_anything(Trial& trial) const { return guard_.enters_anything(trial); }

 private:
  enum class Asked { kPeak, kVolume, kBoth };
  /// A shape, one trial of it, and what that says of its longest step, mm, and of what it would be worth.
  struct Prospect {
    CycleShape shape;
    Trial probe;
    double step = 0.0, worth = 0.0;
    bool enters = false;
  };
  /// The engagement that a search may see, so that fine samples see no more than the limit, radians.
  [[nodiscard]] double aim(const CycleState& now) const;
  /// Between places of both sides, across the middle of the axis.
  [[nodiscard]] double gap(double from_x, double to_x) const;
  /// Where the front ends that begins there.
  [[nodiscard]] double partner(double from_x, double ahead) const;
  /// Whether rows of a half are so far apart that the engagement is looked at between them.
  [[nodiscard]] bool has_rows_apart(const RuledMotion& half) const;
  /// Measures what both halves take, one after the other: their largest engagement, up to `enough_rad`, their volume, or both.
  void measure(double enough_rad, Asked asked, Trial& trial);
  /// By one trial with a step; not whether it enters anything.
  [[nodiscard]] Prospect prospect(const CycleState& now, const CycleShape& shape, double step);
  /// The same shape with a back that is within the aim by itself and enters nothing, if the present one is not and another is: greedy
  /// shapes have led there.
  [[nodiscard]] CycleShape replace_back_pass(const CycleState& now, double step);
  /// Of fronts from flat to steep, those that enter no face first, then the worthiest.
  [[nodiscard]] std::vector<Prospect> prospects(const CycleState& now);
  /// The lift with which the tips of a cycle enter nothing, if there is one that helps, mm: the floor alone is asked.
  [[nodiscard]] double needed_lift(const CycleState& now, const CycleShape& shape, double step) const;
  /// Of these the best shape of fronts, where the one that was found does not get on, or enters a side.
  [[nodiscard]] FoundCycle reshaped(FoundCycle found);
  /// Other shares, in turn, that remove more a way.
  [[nodiscard]] FoundCycle improved(FoundCycle found);
  /// A longer step whose front is moved back where the engagement is above the aim, if that succeeds.
  [[nodiscard]] FoundCycle adjusted(FoundCycle found);
  /// The inner points of both halves lifted for as long as their tips enter something, if they then enter nothing.
  [[nodiscard]] FoundCycle raised(FoundCycle found);

  const LayerSides& sides_;
  CycleGuard guard_;
  SweptStock& stock_;
  const CycleOptions& options_;
  EngagementMeter meter_;
  RowRings rings_, volume_rings_, both_rings_;
  KeptMeasures backs_;        ///< of the cycle that is looked for: many trials differ in their fronts alone
  double front_guess_ = 0.5;  ///< when the last front that was measured engaged most
  SidePairing pairing_;
  double radius_ = 0.0;
};

}  // namespace flank::internal

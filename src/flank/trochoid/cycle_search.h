/// The search of one cycle: its shape, and the longest step that the engagement allows (docs/algorithms/trochoid.md).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "flank/trochoid/cycle_guard.h"
#include "flank/trochoid/cycle_state.h"
#include "flank/trochoid/engagement/engagement.h"
#include "flank/trochoid/engagement/kept_measures.h"
#include "flank/trochoid/ways/side_pairing.h"
#include "flank/trochoid/ways/side_path.h"

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

/// Trials leave the stock as it was.
class CycleSearch {
 public:
  CycleSearch(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const CycleOptions& options);

  [[nodiscard]] CycleState& now() { return now_; }
  [[nodiscard]] double radius() const { return radius_; }
  /// Shorter than this no step is one, mm.
  [[nodiscard]] double least_step() const;
  /// The place of the second side across from one of the first.
  [[nodiscard]] double across(double from_x) const { return pairing_.at(from_x); }
  /// Back to the shape that a layer begins with.
  void reset_shape();
  /// The cycle after now().last whose end on the first side is a step farther.
  [[nodiscard]] Trial tried(double step, bool measured) { return tried(step, now_.shape, measured); }
  /// The same, measured, with the lift that it needs.
  [[nodiscard]] Trial lifted(double step);
  /// The volume of a trial: most are only asked how much they engage.
  void weigh(Trial& trial) { take(trial, false, true); }
  /// The longest step of the present shape, weighed; `largest_rad` < 0: there is none.
  [[nodiscard]] Trial longest_step(double guess) { return longest_step(now_.shape, guess); }
  /// The longest step of the present shape, or of another where that does not get on, enters a face or, with `improving`,
  /// removes less a way; its tips lifted off what they enter. `largest_rad` < 0: there is none.
  [[nodiscard]] Trial best(bool improving);
  /// Deepest that a half enters a face, mm.
  [[nodiscard]] double entered(Trial& trial) const { return guard_.depth(trial).deepest(); }
  /// Whether a half enters a face by more than the tolerance and more than its ends; no lift and no shorter step helps
  /// there, another shape may.
  [[nodiscard]] bool enters_anything(Trial& trial) const { return guard_.enters_anything(trial); }
  /// The engagement that a search may see, so that fine samples see no more than the limit, radians.
  [[nodiscard]] double aim() const;
  /// Of the steps beyond the limit since the last cycle was looked for, the one that engages least.
  [[nodiscard]] const RefusedStep& refused() const { return refused_; }
  void set_refused(const RefusedStep& step) { refused_ = step; }
  void refuse(double step_mm, double largest_rad);

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
  /// Whether rows of a half are so far apart that the engagement is looked at between them.
  [[nodiscard]] bool has_rows_apart(const RuledMotion& half) const;
  /// Largest engagement of its halves.
  void measure(Trial& trial) { take(trial, true, false); }
  /// Both, and sooner than one after the other.
  void measure_and_weigh(Trial& trial) { take(trial, true, true); }
  /// Measures what both halves take, one after the other: their largest engagement, their volume, or both.
  void take(Trial& trial, bool peak, bool volume);
  [[nodiscard]] Trial longest_step(const CycleShape& shape, double guess);
  void improve(Trial& best);
  /// A shape and what one trial of it says of its longest step, mm, and what that would be worth.
  struct Prospect {
    CycleShape shape;
    double step = 0.0, worth = 0.0, lift_mm = 0.0;
    bool enters = false;
  };
  /// Of fronts from flat to steep, those that enter no face first, then the worthiest.
  [[nodiscard]] std::vector<Prospect> prospects();
  /// The same fronts with a back that is within the aim by itself and enters nothing, if the present one is not and another is: greedy
  /// shapes have led there.
  [[nodiscard]] CycleShape with_fit_back(const CycleShape& shape, double step);
  /// Fronts from flat to steep, where the shape of the last cycle does not get on, or enters a side: the best of those that
  /// enter none, if there is one.
  void reshape(Trial& best);
  /// The same for a step that is only short: not at every cycle where that gains nothing.
  void reshape_short(Trial& best);
  /// A longer step whose front is moved back where the engagement is above the aim, if that succeeds.
  void adjust(Trial& best);
  /// The lift with which the tips of a cycle enter nothing, if there is one that helps, mm: the floor alone is asked.
  [[nodiscard]] double needed_lift(const CycleShape& shape, double step);
  /// Lifts the inner points of both halves for as long as their tips enter something, if they then enter nothing.
  void lift(Trial& best);
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
  RefusedStep refused_;
  CycleState now_;
};

}  // namespace flank::internal

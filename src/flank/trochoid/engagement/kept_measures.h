/// What motions take from one stock, kept: a search asks the same back half with one front after another.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "flank/trochoid/engagement/engagement.h"

namespace flank::internal {

/// Rings that ask for the largest engagement, for the volume, and for both at once.
struct MeasureRings {
  const RowRings &engagement, &volume, &both;
  /// For one of the two at least.
  [[nodiscard]] const RowRings& of(bool peak, bool for_volume) const {
    return peak && for_volume ? both : peak ? engagement : volume;
  }
};

/// Of motions with the same knots, which their control points tell apart. To be cleared when the stock is another one.
class KeptMeasures {
 public:
  struct Kept {
    std::optional<EngagementPeak> peak;
    std::optional<double> volume_mm3;
  };
  void clear() { entries_.clear(); }
  /// With at least what is asked for; what is not known yet is measured. `between`: the peak is looked for between rows, too.
  const Kept& measure(const RuledMotion& motion, bool peak, bool volume, int rows, const MeasureRings& rings,
                      bool between, EngagementMeter& meter) {
    Kept& kept = entry(motion);
    const bool more_peak = peak && !kept.peak, more_volume = volume && !kept.volume_mm3;
    if (!more_peak && !more_volume) return kept;
    const RowRings& asked = rings.of(more_peak, more_volume);
    const Engagement measured = more_peak && !between ? meter.measure_peak(motion, asked, rows, guess_, 0.0)
                                                      : meter.measure(motion, asked, rows);
    if (more_peak) kept.peak = between ? meter.look_between(motion, measured) : measured.peak, guess_ = kept.peak->t;
    if (more_volume) kept.volume_mm3 = measured.volume_mm3;
    return kept;
  }

 private:
  struct Entry {
    RuledMotion motion;
    Kept kept;
  };
  Kept& entry(const RuledMotion& motion) {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.motion.tip.poles == motion.tip.poles && e.motion.direction.poles == motion.direction.poles;
    });
    return found != entries_.end() ? found->kept : entries_.emplace_back(Entry{motion, {}}).kept;
  }
  std::vector<Entry> entries_;
  double guess_ = 0.5;  ///< when the last of them engaged most
};

}  // namespace flank::internal

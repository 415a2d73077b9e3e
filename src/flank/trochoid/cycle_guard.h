/// How deep the halves of a cycle under trial enter faces, beyond what the side paths enter themselves.
#pragma once

#include <optional>

#include "flank/ruled_motion.h"
#include "flank/trochoid/paths/half_guard.h"

namespace flank::internal {

/// Both halves of a cycle under trial.
struct Trial {
  double from_x = 0.0, to_x = 0.0;
  std::optional<RuledMotion> back;
  RuledMotion front;
  double largest_rad = 0.0, volume_mm3 = 0.0, way_mm = 0.0;  ///< the volume if it was asked for: weigh
  std::optional<GuardDepth> depth;                           ///< what the halves enter, once it was asked
  /// What is maximised: removed volume per way of front and back.
  [[nodiscard]] double worth() const { return way_mm > 0.0 ? volume_mm3 / way_mm : 0.0; }
};

class CycleGuard {
 public:
  /// The guard must outlive it.
  CycleGuard(const HalfGuard& guard, double tolerance_mm)
      : guard_(guard), others_(guard.of_tips()), tolerance_mm_(tolerance_mm) {}

  /// What both halves enter, mm; asked once.
  [[nodiscard]] const GuardDepth& depth(Trial& trial) const;
  /// Whether a half enters a face by more than the tolerance leaves and more than its ends.
  [[nodiscard]] bool enters_anything(Trial& trial) const;
  /// The same of the back alone, if there is one.
  [[nodiscard]] bool enters_with_back(const Trial& trial) const;
  /// Deepest that tips enter a face that is no side, mm, and how deep they may: what the side paths enter there no shape of a cycle
  /// changes.
  [[nodiscard]] double depth_of_tips(const Trial& trial) const;
  [[nodiscard]] double allowed_at_tips(const Trial& trial) const;
  /// The same, so coarsely that it is asked again and again, and what is aimed at then.
  [[nodiscard]] double coarse_depth_of_tips(const Trial& trial) const;
  [[nodiscard]] double aim_at_tips(const Trial& trial) const;

 private:
  [[nodiscard]] double tips(const Trial& trial, int times, int places) const;
  /// What the side paths themselves enter there.
  [[nodiscard]] GuardDepth at_ends(const HalfGuard& guard, const Trial& trial, int places) const;
  const HalfGuard& guard_;
  const HalfGuard others_;  ///< what tips are lifted off: no side is asked for that
  double tolerance_mm_;
};

}  // namespace flank::internal

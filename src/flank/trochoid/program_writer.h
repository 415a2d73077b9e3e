/// Writes the strips of a cavity's program: entries, cycles, finishing sweeps along both sides, and links.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "flank/trochoid/paths/retract.h"
#include "flank/trochoid/program.h"
#include "flank/trochoid/stock/swept_stock.h"

namespace flank::internal {

/// Way before and behind the sides, in the tool's radii: there the tool is out of the blank.
inline constexpr double kRunOut = 1.5;

/// More than run-outs are bent and raised for, so that what they keep to by coarse samples is not cut off; the judge allows more.
[[nodiscard]] double allowed_at_run_outs(const ProgramOptions& options);

/// From where to where the finishing sweeps go on both sides, mm: as far as the cycles got. Out of the blank where an end is
/// open.
struct SideRange {
  double from_start = 0.0, from_end = 0.0, to_start = 0.0, to_end = 0.0;
  /// Whether anything of the sides is in it.
  [[nodiscard]] bool some() const { return from_end > std::max(0.0, from_start) && to_end > std::max(0.0, to_start); }
};

class ProgramWriter {
 public:
  /// `stock`: what the halves leave, which grows with the program. `clear`: over the cavity.
  ProgramWriter(const HalfGuard& guard, const SweptStock& stock, const ClearPlane& clear, const ProgramOptions& options,
                CavityProgram& out)
      : radial_(stock.radial()), guard_(guard), stock_(stock), clear_(clear), options_(options), out_(out) {}

  void layer(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  /// Out of the layer above, over, and in to where this one's first cycle begins.
  void link(const LayerSides& above, const LayerSides& sides, PlannedLayer& planned);

 private:
  void add(const std::string& kind, std::vector<Pose> poses);
  void add(const std::string& kind, const RuledMotion& motion) { add(kind, poses_of(motion, 2)); }
  /// All moves of an entry as one strip.
  void add(const Entry& entry);
  /// Both finishing sweeps of a layer that began before the blank, or inside.
  void finish_open(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  void finish_inside(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  void add_side(std::vector<Pose> poses, PlannedLayer& planned);
  void add_link(std::vector<Pose> poses, PlannedLayer& planned);
  void add_link(const RuledMotion& motion, PlannedLayer& planned);
  [[nodiscard]] bool enters(const std::vector<Pose>& poses) const;
  /// Whether a link engages more than a cycle may.
  [[nodiscard]] bool cuts(const std::vector<Pose>& poses) const;
  /// From the start of one finishing sweep to that of the other: the first way that neither enters a face nor cuts.
  [[nodiscard]] std::vector<Pose> across_start(const LayerSides& sides, const SideRange& range, const Cycle& first);
  /// Back on what the first front has cut.
  [[nodiscard]] std::vector<Pose> way_of_first_front(const LayerSides& sides, const SideRange& range,
                                                     const Cycle& first);
  /// Out of the cavity, over, and in again.
  [[nodiscard]] std::vector<Pose> over(const Pose& last, const WayOut& out, const Pose& next, const WayOut& in) const;
  [[nodiscard]] std::vector<Pose> poses_of(const RuledMotion& motion, int least);
  /// Where the layer begins: over the material, or before the place of the first cycle, out of the blank.
  [[nodiscard]] Pose beginning(const LayerSides& sides, const PlannedLayer& planned) const;

  const RadialFunction& radial_;
  const HalfGuard& guard_;
  const SweptStock& stock_;
  const ClearPlane& clear_;
  const ProgramOptions& options_;
  CavityProgram& out_;
};

}  // namespace flank::internal

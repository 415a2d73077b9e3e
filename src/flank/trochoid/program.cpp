#include "flank/trochoid/program.h"

#include <algorithm>
#include <numbers>

namespace flank::internal {

double PlannedLayer::entered_mm() const { return std::max(cycles.entered_mm(), entry ? entry->entered_mm : 0.0); }

bool PlannedLayer::stuck_along_axis() const {
  constexpr double kHalfAcross = std::numbers::pi / 6.0;
  return cycles.status == CycleStatus::kStuck && !cycles.cycles.empty() && off_axis_rad < kHalfAcross;
}

bool PlannedLayer::stuck_before_sides() const {
  return cycles.status == CycleStatus::kStuck && !cycles.cycles.empty() && share <= 0.0;
}

bool CavityProgram::stuck_before_sides() const {
  return !layers.empty() && std::all_of(layers.begin(), layers.end(),
                                        [](const PlannedLayer& layer) { return layer.stuck_before_sides(); });
}

bool CavityProgram::stuck_along_axis() const {
  return std::any_of(layers.begin(), layers.end(), [](const PlannedLayer& layer) { return layer.stuck_along_axis(); });
}

bool CavityProgram::done() const {
  return !layers.empty() && std::all_of(layers.begin(), layers.end(), [](const PlannedLayer& layer) {
    return layer.cycles.status == CycleStatus::kDone;
  });
}

double CavityProgram::entered_mm() const {
  double deepest = 0.0;
  for (const PlannedLayer& layer : layers) deepest = std::max(deepest, layer.entered_mm());
  return deepest;
}

}  // namespace flank::internal

#include "flank/pipeline/folder/machine_tilt.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/machine/kinematics.h"
#include "flank/machine/model/machine_file.h"

namespace flank::internal {

double machine_tilt_deg(const std::string& name) {
  constexpr int kSteps = 360;  // of each range: a degree or two
  const Machine machine = read_machine(name);
  const Kinematics kinematics(machine, machine.tool_length);
  const auto angle_of = [&](std::size_t joint, int step) {
    const Joint& of = machine.joints[kinematics.rotary_joints()[joint]];
    constexpr double kTurn = 2.0 * std::numbers::pi;  // more than one is no other direction
    return std::lerp(std::max(of.low, -kTurn), std::min(of.high, kTurn), static_cast<double>(step) / kSteps);
  };
  const Vec3 up = kinematics.direction({0.0, 0.0});
  double least = 1.0;
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k)
      least = std::min(least, up.dot(kinematics.direction({angle_of(0, i), angle_of(1, k)})));
  return std::acos(std::clamp(least, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace flank::internal

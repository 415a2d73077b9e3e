#include "flank/machine/control_time.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/machine/feeds/s_curve.h"

namespace flank::internal {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Of a whole way, by its share (1 is the whole): all axes of the program within their limits.
WayLimits limits_of(const Machine& machine, const NcMove& from, const NcMove& to) {
  WayLimits limits;
  const auto add = [&](double way, const Joint& joint, double unit) {
    if (!(way > 0.0)) return;
    limits.speed = std::min(limits.speed, unit * joint.speed / way);
    limits.acceleration = std::min(limits.acceleration, unit * joint.acceleration / way);
    limits.jerk = std::min(limits.jerk, unit * joint.jerk / way);
  };
  for (std::size_t k = 0; k < 3; ++k)
    add(std::abs(to.position(static_cast<int>(k)) - from.position(static_cast<int>(k))),
        machine.joints[machine.linear[k]], 1.0);
  for (std::size_t k = 0; k < 2; ++k)
    add(std::abs(to.orientation(static_cast<int>(k)) - from.orientation(static_cast<int>(k))), machine.rotary_joint(k),
        kDegrees);
  return limits;
}

/// What its feed says, s.
double stated_seconds(const NcProgram& program, const NcMove& from, const NcMove& to) {
  if (program.feed_mode == NcFeedMode::kInverseTime) return 60.0 / to.feed;
  const double way = (to.position - from.position).norm();
  return 60.0 * (way > 0.0 ? way : (to.orientation - from.orientation).norm()) / to.feed;
}

}  // namespace

bool rests_between_blocks(const Machine& machine, const NcProgram& program) {
  return machine.dialect.language == NcLanguage::kLinuxCnc && program.positions != NcPositions::kTipVector;
}

std::vector<double> resting_seconds(const Machine& machine, const NcProgram& program) {
  std::vector<double> seconds(program.moves.size(), 0.0);
  for (std::size_t i = 1; i < program.moves.size(); ++i) {
    const NcMove &from = program.moves[i - 1], &to = program.moves[i];
    if (to.kind == NcKind::kRapid || !(to.feed > 0.0)) continue;
    WayLimits limits = limits_of(machine, from, to);
    limits.speed = std::min(limits.speed, 1.0 / stated_seconds(program, from, to));
    if (std::isfinite(limits.acceleration)) seconds[i] = seconds_from_rest_to_rest(1.0, limits);
  }
  return seconds;
}

}  // namespace flank::internal

#include "flank/machine/control_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Over a whole way: the least time of it by the speeds, and the largest acceleration, both of its share (1 is the whole).
struct WayLimits {
  double least_seconds = 0.0, acceleration = 1e300;
};

WayLimits limits_of(const Machine& machine, const NcMove& from, const NcMove& to) {
  WayLimits limits;
  const auto add = [&](double way, double speed, double acceleration) {
    if (!(way > 0.0)) return;
    limits.least_seconds = std::max(limits.least_seconds, way / speed);
    limits.acceleration = std::min(limits.acceleration, acceleration / way);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Joint& joint = machine.joints[machine.linear[k]];
    add(std::abs(to.position(static_cast<int>(k)) - from.position(static_cast<int>(k))), joint.speed,
        joint.acceleration);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Joint& joint = machine.rotary_joint(k);
    add(std::abs(to.orientation(static_cast<int>(k)) - from.orientation(static_cast<int>(k))), kDegrees * joint.speed,
        kDegrees * joint.acceleration);
  }
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
    const WayLimits limits = limits_of(machine, from, to);
    const double cruise = std::max(stated_seconds(program, from, to), limits.least_seconds);
    // The whole way at the cruising speed 1 / cruise needs 1 / (cruise a) more for its two ramps; where these would be longer than the
    // way, half of it speeds up and half slows down.
    const double ramps = 1.0 / (cruise * limits.acceleration);
    seconds[i] = ramps <= cruise ? cruise + ramps : 2.0 / std::sqrt(limits.acceleration);
  }
  return seconds;
}

}  // namespace flank::internal

/// How far a machine tilts a part that is clamped upright.
#pragma once

#include <string>

namespace flank::internal {

/// Degrees between the tool and what points to the spindle while all rotary joints are at zero: the most that their ranges allow. Throws as read_machine
/// does.
[[nodiscard]] double machine_tilt_deg(const std::string& machine);

}  // namespace flank::internal

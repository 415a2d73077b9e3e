/// Shanks of a wheel's tools.
#pragma once

#include <string>
#include <vector>

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Whether a tool is given with a shank or a holder.
[[nodiscard]] bool brings_body(const std::string& spec);

/// Gives each tool that brings neither shank nor holder a shank, for all the paths of its operations together, and the holder that was given: planned was
/// a way for a shank as thick as its flank ends. The tools' files and the operations' results get both. `notes`: what was chosen.
void give_shanks(WheelWork& work, std::vector<WheelOperation>& operations, std::vector<std::string>& notes);

}  // namespace flank::internal

/// Shanks of a wheel's tools.
#pragma once

#include <string>
#include <vector>

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Gives each tool that brings neither shank nor holder a shank, for all the paths of its operations together: planned was a way for one as
/// thick as its flank ends. The tools' files and the operations' results get it. `notes`: what was chosen.
void give_shanks(WheelWork& work, std::vector<WheelOperation>& operations, std::vector<std::string>& notes);

}  // namespace flank::internal

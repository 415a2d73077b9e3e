/// Children of this program that end with it, however it ends.
#pragma once

namespace flank::internal {

/// Variable of the environment: the process whose end is that of the child, by its number.
inline constexpr const char* kEndsWithVariable = "FLANK_ENDS_WITH";

/// To be called first of all by a program that may be such a child: if the environment names its parent, the system kills
/// this process when the thread that started it ends, and at once if that has happened already. Its own children do not
/// inherit the variable.
void end_with_parent_if_asked();

}  // namespace flank::internal

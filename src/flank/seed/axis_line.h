/// Lines as users give them: six numbers, the tip and the holder end of an axis.
#pragma once

#include <string>
#include <string_view>

#include "flank/vec.h"

namespace flank::internal {

/// One axis position as a user gives it: two points, whose distance may be the axis length or may not.
struct AxisLine {
  Vec3 tip = Vec3::Zero(), holder = Vec3::UnitZ();  ///< mm
  [[nodiscard]] double length() const { return (holder - tip).norm(); }
  /// Needs length() > 0.
  [[nodiscard]] Pose pose() const { return {tip, (holder - tip).normalized()}; }
};

/// Reads "x y z x y z", numbers separated by commas or blanks. Returns false and says why not in `why`: another count
/// of numbers, something that is not a finite number, two ends at the same place.
[[nodiscard]] bool parse_axis_line(std::string_view text, AxisLine& line, std::string& why);

/// A first axis as a user gives it. Throws UsageError that says what would be accepted.
[[nodiscard]] AxisLine parse_start_line(std::string_view text);

}  // namespace flank::internal

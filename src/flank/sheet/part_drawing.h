/// The part as it is clamped, drawn in lines: the borders of its faces seen from one side of the machine.
#pragma once

#include <string>

#include "flank/machine/work_setup.h"
#include "flank/part.h"

namespace flank::internal {

/// From where the part is looked at, in the frame of the machine with its rotary joints at zero.
enum class DrawnFrom { kFront, kAbove };  ///< X to the right and Z up; X to the right and Y up

/// Lines of a part, in the frame of the work, mm: found once, drawn from any side.
class PartDrawing {
 public:
  /// `targets`: faces that are machined, by index, drawn bold.
  PartDrawing(const Part& part, const std::vector<int>& targets, const WorkSetup& place);

  /// One SVG document, to scale, with the zero point of the program, its two axes and, from the front, what the part is clamped on.
  [[nodiscard]] std::string svg(DrawnFrom side) const;
  /// Of the part where it is clamped.
  [[nodiscard]] const Box3& box() const { return box_; }

 private:
  struct Line {
    Vec3 from, to;
    bool target = false;
  };
  std::vector<Line> lines_;
  Box3 box_;
  Vec3 zero_;
};

}  // namespace flank::internal

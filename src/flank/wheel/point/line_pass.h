/// A pass of the tip sphere along one line of a face.
#pragma once

#include <cstddef>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/point/axis_field.h"
#include "flank/wheel/point/face_lines.h"
#include "flank/wheel/point/flank_joints.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// What all passes along a face know.
struct LineWork {
  const FaceLines& lines;
  const TipRoom& room;
  const AxisField& field;
  double rows_apart, columns_apart;  ///< places and lines between the field's nodes
  const FlankJoints& joints;
  double most_turn_rad;  ///< of the axis from one pose to the next one
  [[nodiscard]] bool goes_on(const Pose& a, const Pose& b) const;
};

/// Poses that follow each other, and at which place of the line each has its tip.
struct LineStretch {
  std::vector<Pose> poses;
  std::vector<double> places;
};

/// Of the places that are wanted those with room. A stretch ends where its room does, and where its axis would have to jump.
[[nodiscard]] std::vector<LineStretch> line_stretches(const LineWork& work, std::size_t line,
                                                      const std::vector<char>& wanted);

/// Whether a pose, with its tip where the line has it at a place, has room.
[[nodiscard]] bool has_room(const LineWork& work, std::size_t line, double place, const Pose& pose);

/// With poses at the stops of its line, too: the tip goes where the joint asks for, and the axis turns evenly between those that the stretch
/// has. In pieces where a stop has no room.
[[nodiscard]] std::vector<std::vector<Pose>> with_stops(const LineWork& work, std::size_t line,
                                                        const LineStretch& stretch);

}  // namespace flank::internal

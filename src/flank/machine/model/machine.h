/// A machine: its chain of joints from the work to the tool, their limits, and how its control wants programs.
///
/// All joints at zero define the machine's frame: axes and points of joints are given there. A joint's positive direction
/// is that of the tool relative to the work (ISO 841) unless it is `reversed`, whichever of the two it carries. Then the
/// chain is the product of exponentials from the work to the tool, and it does not matter where the bed stands in it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "flank/machine/nc/dialect.h"
#include "flank/machine/nc/program.h"
#include "flank/vec.h"

namespace flank::internal {

enum class JointKind : std::uint8_t { kLinear, kRotary };

/// One joint. Millimetres, radians, seconds.
struct Joint {
  std::string name;  ///< its letter in programs: "X"
  JointKind kind = JointKind::kLinear;
  bool table = false;  ///< it moves the work; else the tool
  /// Positive values move the link itself along `direction`: of a joint of the table the opposite of ISO 841.
  bool reversed = false;
  Vec3 direction = Vec3::UnitX();  ///< unit, in the machine's frame
  Vec3 point = Vec3::Zero();       ///< of a rotary joint: a point on its axis, mm
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double speed = std::numeric_limits<double>::infinity();         ///< mm/s, rad/s
  double acceleration = std::numeric_limits<double>::infinity();  ///< mm/s^2, rad/s^2
  double jerk = std::numeric_limits<double>::infinity();          ///< mm/s^3, rad/s^3
};

inline constexpr std::size_t kJointCount = 5;
/// Values of the joints in the order of Machine::joints: mm and radians.
using JointValues = std::array<double, kJointCount>;

/// A value of a joint in mm or degrees.
[[nodiscard]] double in_units(const Joint& joint, double value);

/// A part of the machine's outline, where all joints are zero, in the machine's frame. Millimetres.
struct MachineBody {
  enum class Shape : std::uint8_t { kBox, kCylinder };
  std::string name;
  std::size_t link = 0;  ///< joints between the work and it: 0 moves with the work, kJointCount with the tool
  Shape shape = Shape::kBox;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< lower and upper corner; ends of the axis
  double radius = 0.0;                          ///< of a cylinder
};

/// Where programs measure the tool: the centre of the tip's sphere (s = 0), or the tool's lowest point, r(0) beyond it.
enum class ControlledPoint : std::uint8_t { kCentre, kLowest };

struct Machine {
  std::string name, description;
  std::array<Joint, kJointCount> joints;  ///< from the work to the tool: three linear, two rotary
  std::array<std::size_t, 3> linear{};    ///< indices of the linear joints in the order of programs: X, Y, Z
  std::array<std::size_t, 2> rotary{};    ///< of the rotary joints in the order of programs: "AC"
  Vec3 gauge = Vec3::Zero();              ///< the spindle's gauge point where all joints are zero, mm
  Vec3 tool_axis = Vec3::UnitZ();         ///< towards the holder, likewise
  double tool_length = 100.0;             ///< from the gauge point to the controlled point, if nothing else is said
  ControlledPoint controlled = ControlledPoint::kLowest;
  std::vector<MachineBody> bodies;
  double rapid = 100.0;  ///< of the controlled point on links, mm/s
  NcDialect dialect;
  NcPositions positions = NcPositions::kTipRotary;
  NcJoin join = NcJoin::kAxes;
  NcFeedMode feed_mode = NcFeedMode::kPerMinute;
  int work_offset = 1;      ///< 1: G54
  double block_time = 0.0;  ///< the control needs as long for a block, s

  [[nodiscard]] const Joint& rotary_joint(std::size_t k) const { return joints[rotary[k]]; }
  [[nodiscard]] const Joint& linear_joint(std::size_t k) const { return joints[linear[k]]; }
  /// How many joints move the work: the link behind them is the bed.
  [[nodiscard]] std::size_t table_joints() const;
  /// "table-table", "head-table", "head-head".
  [[nodiscard]] std::string nesting() const;
};

}  // namespace flank::internal

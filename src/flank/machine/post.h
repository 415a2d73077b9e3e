/// From a path to a program: joints, blocks, feeds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/machine/joint_choice.h"
#include "flank/machine/linearise.h"
#include "flank/machine/model/machine.h"
#include "flank/machine/work_setup.h"
#include "flank/path.h"

namespace flank::internal {

/// What a post needs to know of the tool, mm.
struct PostTool {
  std::string name;
  double axis_length = 0.0;
  double tip_radius = 0.0;  ///< r(0)
  double largest_radius = 0.0;
};

struct PostOptions {
  WorkSetup setup;
  double deviation = 1e-4;       ///< mm: LineariseOptions
  double link_deviation = 0.01;  ///< mm, of links
  double feed = 1000.0 / 60.0;   ///< of the contact along strips, mm/s, where nothing else is known
  /// Of each pose of each strip the least time for a mm, s: the inverse of its feed; empty lists, or none at all, where it is not known.
  std::vector<std::vector<double>> slowness;
  bool time_optimal = false;  ///< as fast as the joints can instead
};

/// The range that a joint uses, and how fast; mm, degrees, seconds.
struct JointUse {
  std::string name;
  double low = 0.0, high = 0.0, speed = 0.0, acceleration = 0.0;
};

/// Where the joints are, and how fast the contact is.
struct TracePoint {
  double time_s = 0.0;
  JointValues joints{};      ///< mm, radians
  double feed_mm_s = 0.0;    ///< of the contact, on the way here
  bool cutting = false;      ///< on the way here; else a link
  double off_path_mm = 0.0;  ///< how far the control's motion has the flank from the planned one; 0 on links
};

struct Post {
  NcProgram program;
  std::optional<Unreachable> unreachable;               ///< then there is no program
  int unreachable_strip = 0;                            ///< id
  std::size_t planned = 0, inserted = 0, left_out = 0;  ///< poses
  double deviation_mm = 0.0;  ///< proven bound between the control's motion and the planned one, along strips
  double rounding_mm = 0.0;   ///< bound of what the program's digits add
  double least_sine = 1.0;    ///< of the angle between the tool and the first rotary axis
  int flips = 0;
  double time_s = 0.0, cutting_s = 0.0;  ///< as planned, and as the feeds say
  /// Of a control that comes to rest at the end of every block (control_time.h): what its run takes; none: as planned.
  std::optional<double> resting_s = {};
  double resting_cutting_s = 0.0;
  std::vector<JointUse> use;
  std::vector<TracePoint> trace;  ///< at the nodes of the feed's plan: joints run straight between them
};

/// From the controlled point to s = 0, mm.
[[nodiscard]] double tip_offset(const Machine& machine, const PostTool& tool);

/// `path` in the part's frame, links included. What cannot be run is a status, not an exception. Throws InternalError for
/// a path without poses.
[[nodiscard]] Post post(const Machine& machine, const Path& path, const PostTool& tool, const PostOptions& options);

}  // namespace flank::internal

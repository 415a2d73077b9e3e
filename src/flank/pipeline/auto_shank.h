/// A shank that nobody has given: chosen for the path that was found, and in the way of a second plan where it has no room.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/run.h"
#include "flank/setup/clearance_scene.h"

namespace flank::internal {

inline constexpr double kAnySlenderness = 1e300;  ///< of a tool whose stiffness nobody has bound

/// "auto" where nothing says what stands above the flank: no shank or holder is given, and the tool (`own_body`) brings none.
[[nodiscard]] std::string default_shank(const ObstacleRequest& request, bool own_body);

/// A shank for a path that was planned without one, into the request: as thick as the flank ends, or the standard diameter just below it, and
/// out of the part along all of the path. Where that comes too near something, the thickest that does not, if flank and shank stay as stiff as
/// `slenderest` asks (1e300: a given tool, whose stiffness nobody has bound) and the request leaves its thickness open. `flank`: the tool without it.
void choose_clear_shank(const ClearanceScene& scene, const Path& path, const Box3& part, double slenderest,
                        const Tool& flank, ObstacleRequest& obstacles);

/// Puts a holder on the end of the tool's shank, and makes the shank longer, by whole millimetres and to the least of them that halving finds, until
/// both are clear along the path. `outline`: (z, radius), z from the holder's face. `obstacles`: as they chose the shank.
void lengthen_for_holder(const ClearanceScene& scene, const Path& path, const Box3& part,
                         const std::vector<Vec2>& outline, ObstacleRequest& obstacles, Tool& tool);

/// Gives the result's tool the shank that its path lets in.
void take_clear_shank(const ClearanceScene& scene, const Box3& part, double slenderest, ObstacleRequest& obstacles,
                      Result& result);

/// What a plan knows of a shank that nobody has given.
enum class KnownShank {
  kNothing,
  kLength,    ///< at least the job's: what is found must be stiff enough with it, and a shank is chosen for that
  kInTheWay,  ///< all of it: the job's, in the way from the beginning
};

/// A plan of a job.
template <class Job>
using ShankPlan = std::function<Result(const Job& job, KnownShank known, const Progress& progress)>;

/// Plans; `plan` may choose a shank for what it found. Where the shank comes too near, plans again with it in the way from the beginning, which
/// `plan` does with a given one already if `always`. Where the tool is too slender with it (more than `slenderest`), plans again with its length
/// known. The better of the two. A note says the figures of a chosen one. The journal has the steps of both.
template <class Job>
[[nodiscard]] Result with_room_for_shank(const Job& job, bool always, double slenderest, const ShankPlan<Job>& plan,
                                         const Progress& progress);

}  // namespace flank::internal

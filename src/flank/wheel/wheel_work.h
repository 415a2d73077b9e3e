/// What the operations of a wheel hand on.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "flank/base/own_code.h"
#include "flank/feature/wheel_face.h"
#include "flank/tool.h"
#include "flank/wheel/blank.h"
#include "flank/wheel/face_targets.h"
#include "flank/wheel/point/channel.h"
#include "flank/wheel/sector.h"
#include "flank/wheel/wheel_job.h"
#include "flank/wheel_request.h"

namespace flank::internal {

/// Triangles that a path is held against.
struct GuardTriangles {
  std::set<std::pair<int, int>> faces;  ///< of the part, and the pitches that they are turned by
  double off_mm = 0.0;
  TriangleBvh tree;
};

struct WheelWork {
  const WheelRequest& job;
  const WheelRoles& roles;
  const WheelSector& sector;
  const Part& part;
  const WheelBlank& blank;
  FaceTargets targets;
  std::vector<WheelFace> faces;                         ///< as triangles: what directions are chosen by
  std::map<std::string, WheelOperation> finished = {};  ///< of an earlier run, by id
  std::function<void(const std::string&)> begins = {};  ///< told the id of an operation before it is done anew
  std::string program = own_code_id();                  ///< what another build has found is found again
  /// How far the blades are from turned copies of the first one, mm. From `kEqualShare` of the tolerance on every sector has paths of its
  /// own, and `finish` holds them all.
  double difference_mm = 0.0;
  double most_tilt_deg = 100.0;         ///< that is asked for, or that the machine allows
  std::optional<Tool> tool = {};        ///< T1: finishes
  std::optional<Tool> rough_tool = {};  ///< T2: roughs, where it is another one
  Path finish = {};                     ///< strips that finish something, in their order
  std::vector<std::string> notes = {};
  std::optional<TriangleBvh> coarse = {},
                             all_round = {};  ///< of all faces that a tool may meet, once they are asked for
  std::unique_ptr<DistanceGrid> grid = {}, grid_all_round = {};  ///< of `coarse` and `all_round`
  std::optional<GuardTriangles> fine = {};                       ///< of those that the last path may meet

  /// Triangles by which directions are looked for, and those by which a path is held against the part: they are beside the faces by
  /// `off_mm` at most, and so many that faces that the path comes nowhere near to are left out.
  [[nodiscard]] const TriangleBvh& coarse_triangles();
  [[nodiscard]] const TriangleBvh& guard_triangles(const Path& path, const RadialFunction& radial, double off_mm);
  /// To coarse_triangles() and to wheel_triangles().
  [[nodiscard]] const DistanceGrid& distances();
  [[nodiscard]] const DistanceGrid& wheel_distances();
  /// The whole wheel, with all blades that the part lacks, as the first of these: what stands in the way of an axis far above the flank.
  [[nodiscard]] const TriangleBvh& wheel_triangles();
  /// Gives back the memory of all these: what reads the part once more, as the judge does, needs its own.
  void forget();
  [[nodiscard]] double reach_mm() const;       ///< no two places of the wheel are farther from each other
  static constexpr double kGuardShare = 0.02;  ///< of the tolerance: `off_mm` of finishing paths
  static constexpr double kEqualShare = 0.1;
  [[nodiscard]] bool equal() const { return difference_mm <= kEqualShare * job.tolerance_mm; }
  [[nodiscard]] double sectors_of_hub() const { return flank::internal::sectors_of_hub(roles, faces); }
  /// The hub, and where the part has a piece of it, what goes on before and behind.
  [[nodiscard]] std::vector<const Target*> floor();
  /// All that the tool keeps out of besides the floor, the blades beside the sector that the part lacks among it.
  [[nodiscard]] std::vector<const Target*> walls();
  /// What floor() and walls() have more than the part.
  [[nodiscard]] std::vector<const Target*> missing();
  /// Unit vector along the wheel's axis: the end that a floor looks to which leans, else that from which most of the sides' poses come. With it to
  /// the spindle the wheel is clamped.
  [[nodiscard]] Vec3 up() const;
  /// What passes of any operation are planned with: tolerance, and turns within the length in which the judge looks for them (and a little
  /// more), and the directions that a machine holds.
  /// Of passes on some faces: the largest of them says how sharply they may turn.
  [[nodiscard]] PointOptions point_options(const std::vector<std::string>& names);
  /// How often `finish` is turned.
  [[nodiscard]] int copies() const { return equal() ? sector.copies : 1; }
};

/// All faces but the hub, what lies in it and what is no part of the wheel.
[[nodiscard]] std::vector<std::string> wall_faces(const WheelRoles& roles);

}  // namespace flank::internal

/// What the judge says about collisions: how near shank and holder come to the part and to fixtures, and the flank to
/// fixtures, along the whole motion (docs/algorithms/clearance.md).
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/path.h"
#include "flank/tool.h"
#include "flank/triangle_mesh.h"
#include "flank/vec.h"

namespace flank {

/// What a triangle belongs to. The flank may touch the target and is judged on all of the part elsewhere (judge.h).
enum class ObstacleRole { kTarget, kPart, kFixture };

/// Triangles to keep clear of. They may be open, overlap and be oriented in any way: only their distance counts. A tool that
/// is wholly inside a closed obstacle, and touches none of its triangles, is not seen here (VerifyReport::buried).
struct Obstacle {
  std::string name;  ///< "F1", or a fixture's file
  ObstacleRole role = ObstacleRole::kPart;
  TriangleMesh mesh;
  double deviation_mm = 0.0;  ///< the true surface is no farther than this from the triangles
  std::string caveat = {};    ///< a sentence on what is inexact about them; empty: nothing is
};

/// An obstacle whose triangles are made when a tool comes near its box: of most faces of a part none does.
struct DistantObstacle {
  std::string name;
  ObstacleRole role = ObstacleRole::kPart;
  Box3 box;                        ///< all of it lies in it
  std::function<Obstacle()> make;  ///< with the same name and role; called at most once, from any thread
};

/// What a tool must keep clear of, with what a search of it needs, which is made when it is asked for and kept. Copies share it. Throws what
/// `make` throws, where it is asked.
class ObstacleSet {
 public:
  ObstacleSet() : ObstacleSet(std::vector<DistantObstacle>{}) {}
  explicit ObstacleSet(std::vector<DistantObstacle> obstacles);
  ObstacleSet(std::vector<Obstacle> obstacles);  // NOLINT(google-explicit-constructor): triangles are a set of them
  ObstacleSet(std::initializer_list<Obstacle> obstacles) : ObstacleSet(std::vector<Obstacle>(obstacles)) {}

  [[nodiscard]] const std::vector<DistantObstacle>& obstacles() const;
  /// The triangles of one of them, by its index; made now if they were not.
  [[nodiscard]] const Obstacle& made(std::size_t index) const;
  /// The same triangles, all as fixtures.
  [[nodiscard]] ObstacleSet as_fixtures() const;

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }  ///< for the judge

 private:
  std::shared_ptr<const Data> data_;
};

/// Flank, shank and holder are measured apart: they may touch different things. kAxis: a rod in the tool's axis above its flank.
enum class ToolBody { kFlank, kShank, kHolder, kAxis };

/// mm: accuracy of the clearance at single poses, which is for charts only and costs less like that.
inline constexpr double kPoseClearanceMm = 0.01;
/// So many poses of a path are looked at for them, about; the others get the lesser one of those to either side.
inline constexpr std::size_t kMostShownPoses = 8000;

struct ClearanceOptions {
  /// > 0: of the minimum over the motion. It counts against the tool, so lower it if a clearance is kept by little;
  /// time grows slowly, as only intervals near the minimum are halved.
  double accuracy_mm = 1e-3;
  double tolerance_mm = 0.01;  ///< > 0: what the shank may enter the target by, and everything without a requirement
  /// Least clearance of every pair but shank and target; negative: as `tolerance_mm` for the shank and flank, 0 for the
  /// holder.
  double required_mm = -1.0;
  /// >= 0: left on the faces of the part. What is required of shank and holder beside them is more by this; not beside fixtures.
  double allowance_mm = 0.0;
};

/// One body of the tool against all obstacles of one role.
struct ClearanceFigure {
  ToolBody body = ToolBody::kShank;
  ObstacleRole role = ObstacleRole::kPart;
  /// Least distance over the motion; negative: the depth of the deepest point of the obstacles, in one of the convex
  /// bodies that the tool's body is a union of. Infinite: there are no such obstacles.
  double clearance_mm = 0.0;
  double bound_mm = 0.0;  ///< the true least distance is below clearance_mm by no more than this
  double required_mm = 0.0;
  bool kept = true;                 ///< clearance_mm - bound_mm >= required_mm
  std::string obstacle;             ///< where it is least: name of the obstacle
  Vec3 point = Vec3::Zero();        ///< on the obstacle
  int strip = -1;                   ///< 0-based
  double t = 0.0;                   ///< pose index + fraction
  double z_mm = 0.0, rho_mm = 0.0;  ///< nearest point of the body: along the axis from s = 0, and from the axis
};

/// Empty: nothing was requested, or the tool has neither shank nor holder and there are no fixtures.
struct ClearanceReport {
  std::vector<ClearanceFigure> figures;  ///< in the order of body, then role
  /// Least distance of any of these pairs but shank and target (which may touch) at every pose, by strip: for charts.
  /// Infinite where there are no such pairs; above the truth by no more than kPoseClearanceMm or 2 percent of a depth, in paths of no more than
  /// kMostShownPoses poses.
  std::vector<std::vector<double>> pose_clearance_mm;
  std::vector<std::string> notes;  ///< caveats of the obstacles that the figures are about
  [[nodiscard]] bool kept() const;
  /// The figure with the least clearance minus its bound and its requirement; nullptr if there is none.
  [[nodiscard]] const ClearanceFigure* worst() const;
};

[[nodiscard]] std::string_view body_name(ToolBody body);      ///< "flank", "shank", "holder", "axis"
[[nodiscard]] std::string_view role_name(ObstacleRole role);  ///< "target", "part", "fixture"

/// Judges tool and path against the obstacles, continuous between the poses. Parallel; the same bits for any number of
/// threads. Throws UsageError for an accuracy or tolerance that is not > 0, InputError for poses that are none.
[[nodiscard]] ClearanceReport judge_clearance(const Tool& tool, const Path& path, const ObstacleSet& obstacles,
                                              const ClearanceOptions& options);

/// Whether every clearance is kept, as judge_clearance(...).kept() says, in less time: it ends at the first place where one is not. It may say no
/// where that says yes by less than twice the accuracy. A shank keeps `shank_least_mm`, too, where that is more than what is required. Parallel;
/// the same answer for any number of threads. Throws as judge_clearance.
[[nodiscard]] bool keeps_clear(const Tool& tool, const Path& path, const ObstacleSet& obstacles,
                               const ClearanceOptions& options, double shank_least_mm = -1e300);

/// Whether anything could hold the tool where it works, whatever shank and holder it has or lacks.
struct HoldReport {
  /// Of a rod in the tool's axis, from the flank's upper end to beyond all obstacles and kRodShare as thick as that end: where it
  /// enters something (`kept` is false), nothing could hold the tool. What keeps clear by more than that end's radius reads as infinite.
  ClearanceFigure axis;
  /// Of a shank as thick as the flank's upper end and one diameter long, for a tool that has none of its own: what it enters most.
  std::optional<ClearanceFigure> as_thick;
};

/// Judges that against the part's faces, continuous between the poses; fixtures are for shank and holder to keep clear of. None if
/// there are no faces or no poses. Parallel; the same bits for any number of threads. Throws as judge_clearance.
[[nodiscard]] std::optional<HoldReport> judge_hold(const Tool& tool, const Path& path, const ObstacleSet& obstacles,
                                                   const ClearanceOptions& options);

}  // namespace flank

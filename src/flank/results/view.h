/// What a picture of a result needs: faces as triangles with the judge's signed distance, poses, the tool's profile.
/// For looking at; the figures that count are those of verify.json.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/envelope/strip_surface.h"
#include "flank/path/engaged_arcs.h"
#include "flank/path/half_space.h"
#include "flank/results/view_mesh.h"
#include "flank/run.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// What happens about one place of a strip.
struct ViewPlace {
  double t = 0.0;          ///< pose index from 0, plus the fraction of the step
  double lowest_f_mm = 0;  ///< over the target's vertices that this place sweeps past; infinite where there are none
  double highest_f_mm = 0;
  double largest_c = 0.0;  ///< regularity where the flank touches a target: plunges at 1
  double clearance_mm =
      0;  ///< least of the judge's at the poses of this place; infinite: nothing is near, or asked for
};

struct ViewStrip {
  int id = 1;
  std::string face;
  std::size_t pose_count = 0;      ///< of the path
  std::vector<std::size_t> index;  ///< of the poses shown, from 0; the first and the last are among them
  std::vector<Pose> poses;
  std::vector<ViewPlace> places;
};

/// The flank's meridian at one s.
struct ProfilePoint {
  double s = 0.0, z = 0.0, rho = 0.0;
  double curvature_per_mm = 0.0;  ///< positive where the meridian is convex, as of a barrel
};

struct View {
  std::string part;     ///< file name without folder
  std::string command;  ///< that asked for this, with file names without folders
  std::string faces;
  double allowance_mm = 0.0;  ///< left on purpose: distances are from the faces moved out by this
  double tolerance_mm = 0.0, least_coverage = 0.0;
  std::vector<ViewFace> bodies;    ///< every face of the part, in the part's order
  std::vector<ViewFace> fixtures;  ///< every face of the fixtures; `face` is the obstacle's name, "vice.stl F6"
  std::vector<ViewStrip> strips;
  std::vector<SheetSide> sides;  ///< of open sheets that are targets: from `place` the tool is `towards`
  Tool tool;
  std::vector<ProfilePoint> profile;
};

/// A check surface counts as entered from this share of the tolerance on: one that only touches the target is not.
inline constexpr double kEnteredShare = 0.5;
inline constexpr std::size_t kMostPosesShown = 1500;
inline constexpr std::size_t kMostPlaces = 240;

/// The signed error at places with these normals, mm, of a tool that bends.
using BentError = std::function<std::vector<double>(const std::vector<Vec3>& at, const std::vector<Vec3>& normals)>;

/// Triangulates the part, asks the judge at the vertices, and thins the path out. `bent`: asked at those of the targets, if it is there.
[[nodiscard]] View make_view(const PlanJob& job, const Setup& setup, const Tool& tool, const Path& path,
                             const VerifyReport& verdict, const BentError& bent = nullptr);

}  // namespace flank::internal

/// What of a result is only drawn.
struct flank::Result::Drawings {
  std::vector<internal::StripSurface> strips;  ///< one per strip of the path
  internal::View view;
  std::vector<internal::HalfSpace> blank;       ///< of a program that is replayed
  TriangleMesh left;                            ///< of the stock, after it
  std::vector<std::vector<double>> engagement;  ///< of every pose of every strip, then: radians
  internal::PathArcs arcs;                      ///< of the same
};

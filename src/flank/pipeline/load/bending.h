/// What a tool leaves when it bends: how far it gives way at the instant at which an edge makes the surface.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/pipeline/load/path_loads.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// A place of a surface: where the axis is that makes it, and the surface's normal there, towards the tool.
struct MadeBy {
  double pose = 0.0;  ///< index and fraction, of its strip
  double s = 0.0;     ///< on the axis, mm
  Vec3 normal = Vec3::UnitZ();
};

/// How far the axis gives way along the normal while an edge passes the place, mm: > 0 leaves material, < 0 cuts too deep. `arcs` of the nearest
/// pose, `feed` in mm/s. 0 where the ring of the place is not engaged.
[[nodiscard]] double bent_along(const Tool& tool, const CuttingRequest& request, const std::vector<double>& heights,
                                const std::vector<EngagedArc>& arcs, const std::vector<Pose>& poses,
                                const MadeBy& place, double feed);

/// Throws UsageError for what is missing.
void require_bending(const BendingRequest& request);

/// Of the targets that a path finishes.
struct Bending {
  double overcut_mm = 0.0,
         undercut_mm = 0.0;  ///< of the surface that a stiff tool leaves, where it passes; as the judge has them
  double bent_overcut_mm = 0.0, bent_undercut_mm = 0.0;  ///< of the one that this tool leaves
  double least_mm = 0.0, most_mm = 0.0;                  ///< what bending adds to f
  Vec3 most_point = Vec3::Zero();
  std::size_t samples = 0;  ///< with a load
};
/// `volume`: of the path, as the judge has its tool.
[[nodiscard]] Bending bending_of(const std::vector<FaceSamples>& faces, const SweptVolume& volume, const Tool& tool,
                                 const Path& path, const PathArcs& arcs, const PathLoads& loads,
                                 const CuttingRequest& request);

/// The same as sentences, at the feeds that a program takes with this material. `known`: of the replay of a stock.
[[nodiscard]] std::vector<std::string> bending_notes(const BendingRequest& asked, const PathArcs& known,
                                                     const Setup& setup, const Tool& tool, const SweptVolume& volume,
                                                     const Path& path, double spacing_mm);

/// Places that are looked at, of all targets together, about.
inline constexpr double kMostBent = 4000.0;

[[nodiscard]] std::string bending_text(const Bending& bending);

}  // namespace flank::internal

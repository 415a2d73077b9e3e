/// What a tool leaves when it bends: how far it gives way at the instant at which an edge makes the surface.
#pragma once

#include <functional>
#include <optional>
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

/// Places that a report looks at, of all targets together, about.
inline constexpr double kMostBent = 4000.0;

/// A tool that bends on a path, at the feeds that a program takes with this material.
class BendingTool {
 public:
  /// `known`: arcs of the replay of a stock. `judged`: the tool as the judge has it. Tool and path must outlive this.
  BendingTool(const BendingRequest& asked, const PathArcs& known, const Setup& setup, const Tool& tool,
              const Tool& judged, const Path& path);

  [[nodiscard]] bool knows_load() const { return !arcs_.heights.empty(); }
  /// The signed error, mm, at places with their normals, towards the tool; none where no load is known. Does not outlive this.
  [[nodiscard]] std::function<std::vector<double>(const std::vector<Vec3>& points, const std::vector<Vec3>& normals)>
  errors() const;
  /// Of samples of the targets; none where no load is known.
  [[nodiscard]] std::optional<BendingReport> report(const Setup& setup, double spacing_mm) const;
  /// Of the loads, and of what the report says.
  void add_notes(const std::optional<BendingReport>& report, std::vector<std::string>& notes) const;

 private:
  /// Of a target.
  struct BentPlace {
    double f = 0.0;       ///< of a stiff tool, mm; infinite where nothing comes near
    double added = 0.0;   ///< by bending, mm
    bool loaded = false;  ///< a load is known there
  };

  [[nodiscard]] std::vector<BentPlace> at(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) const;
  [[nodiscard]] BentPlace bent(const SweptDistance& at, const Vec3& normal) const;

  const Tool& tool_;
  const Path& path_;
  SweptVolume volume_;
  PathArcs arcs_;
  CuttingRequest cutting_;
  PathLoads loads_;
};

}  // namespace flank::internal

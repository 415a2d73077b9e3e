#include "flank/pipeline/folder/judge_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/setup/targets.h"
#include "flank/verify/reach.h"

namespace flank::internal {
namespace {

/// Of the triangles that the ball is held against, mm: a place of the border of the reachable part is as wrong as they
/// are.
constexpr double kFinestMm = 0.001, kCoarsestMm = 0.01, kToleranceShare = 0.25;
constexpr double kLongestCellMm = 1.0;  ///< borders are off by a part of a cell
constexpr double kFarShare = 0.1;       ///< of the ball's radius: of the triangles that only close a solid

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

int solid_of(const Part& part, int face) {
  return part.is_mesh() ? -1 : part.faces[static_cast<std::size_t>(face)].solid;
}

/// A face's triangles, counter-clockwise seen from outside of its solid. `fine` and `coarse` are deviations; coarse where
/// the face keeps away from `near`.
TriangleMesh triangles_of(const Part& part, int face, const Box3& near, double fine, double coarse) {
  if (part.is_mesh()) return extract_mesh(part, {face});
  const Face& value = part.faces[static_cast<std::size_t>(face)];
  Box3 box;
  for (const Vec3& p : value.surface.poles) box.add(p);
  const bool meets = (box.low.array() <= near.high.array()).all() && (box.high.array() >= near.low.array()).all();
  return tessellate(value, {.chord_mm = meets ? fine : coarse, .edge_mm = meets ? kLongestCellMm : 1e300}).mesh;
}

/// Samples that a spacing may give on all faces together (about 100 bytes each), and that it has to give on a target.
constexpr double kMostSamples = 3e6, kFewestSamples = 300.0;

/// Refuses a spacing that is out of all proportion to the faces, from the numbers at the usual spacing.
void require_sensible(const Setup& setup, double spacing) {
  if (!(spacing > 0.0)) throw UsageError(fmt::format("sample spacing {} mm: must be > 0", spacing));
  const double usual = default_spacing(setup.part.box.diagonal());
  const double more = usual / spacing * (usual / spacing);
  double all = 0.0;
  for (const FaceSamples& face : judge_samples(setup, usual, 2.0 * usual)) {
    const double here = more * static_cast<double>(face.points.size());
    all += here;
    if (face.target && here < kFewestSamples)
      throw UsageError(fmt::format(
          "a sample spacing of {} mm gives about {:.0f} samples on {}; {:.0f} are needed, which {:.3g} mm give",
          spacing, here, face.face, kFewestSamples, spacing * std::sqrt(here / kFewestSamples)));
  }
  if (all > kMostSamples)
    throw UsageError(
        fmt::format("a sample spacing of {} mm gives about {:.3g} samples; {:.3g} are accepted, which {:.3g} mm give",
                    spacing, all, kMostSamples, spacing * std::sqrt(all / kMostSamples)));
}

/// The first `count` of the judged faces, in the order of the samples, for the proof.
struct JudgedShapes {
  std::vector<TriangleMesh> meshes;
  std::vector<FaceShape> list;
  JudgedShapes(const Setup& setup, std::size_t count);
};

JudgedShapes::JudgedShapes(const Setup& setup, std::size_t count) {
  std::vector<int> judged = setup.targets;
  judged.insert(judged.end(), setup.checks.begin(), setup.checks.end());
  std::sort(judged.begin(), judged.end());
  judged.resize(std::min(judged.size(), count));
  const Part& part = setup.part;
  meshes.reserve(judged.size());
  for (int face : judged) {
    if (!part.is_mesh()) {
      list.emplace_back(&part.faces[static_cast<std::size_t>(face)]);
      continue;
    }
    meshes.push_back(extract_mesh(part, {face}));
    list.emplace_back(&meshes.back());
  }
}

/// No ball that touches the samples, nor anything that it could enter, is outside of this.
Box3 balls_of(const std::vector<FaceSamples>& samples, double radius) {
  Box3 box;
  for (const FaceSamples& face : samples) {
    if (!face.target) continue;
    for (const Vec3& p : face.points) box.add(p);
    box.low.array() -= face.spacing_mm;
    box.high.array() += face.spacing_mm;
  }
  const Vec3 reach = Vec3::Constant(2.0 * radius);
  box.low -= reach;
  box.high += reach;
  return box;
}

/// The faces of the part that bound a solid of which one is judged, or are judged themselves.
std::vector<int> faces_around(const Part& part, const std::vector<int>& judged) {
  std::vector<int> solids, around;
  for (int face : judged) solids.push_back(solid_of(part, face));
  for (int face = 0; face < part.face_count(); ++face) {
    const int solid = solid_of(part, face);
    if (part.is_left_out(face)) continue;
    if (holds(judged, face) || (solid >= 0 && holds(solids, solid))) around.push_back(face);
  }
  return around;
}

}  // namespace

double default_spacing(double diagonal_mm) {
  // Half a millimetre is fine enough for blades of a hand's size; a metre of fan blade would be a million samples.
  return std::clamp(diagonal_mm / 300.0, 0.05, std::max(0.5, diagonal_mm / 1000.0));
}

void measure_reach(const Setup& setup, const Tool& tool, const Path& path, double radius_mm,
                   std::vector<FaceSamples>& samples) {
  const Part& part = setup.part;
  const double tolerance_mm = setup.tolerance_mm;
  std::vector<int> judged = setup.targets;
  judged.insert(judged.end(), setup.checks.begin(), setup.checks.end());
  if (judged.size() < 2) return;
  std::sort(judged.begin(), judged.end());
  const std::vector<int> around = faces_around(part, judged);
  const Box3 near = balls_of(samples, radius_mm);
  const double fine = std::clamp(kToleranceShare * tolerance_mm, kFinestMm, kCoarsestMm);
  std::vector<TriangleMesh> meshes(around.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    const bool checked = holds(judged, around[k]);
    const double coarse = std::max(fine, kFarShare * radius_mm);
    meshes[k] = triangles_of(part, around[k], near, checked ? fine : coarse, coarse);
  });
  for (std::size_t j = 0; j < samples.size(); ++j) {
    FaceSamples& target = samples[j];
    if (!target.target) continue;
    // The samples are in the order of `judged`.
    const int own = judged[j];
    std::vector<ReachFace> others;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const int solid = solid_of(part, around[k]);
      if (around[k] == own) continue;
      others.push_back({meshes[k], solid == solid_of(part, own) ? -1 : solid, holds(judged, around[k])});
    }
    if (!target.of_solid && side_of_tool(tool, path, target) < 0)
      for (Vec3& n : target.normals) n = -n;
    target.reachable = reachable_shares(target, others, {radius_mm, tolerance_mm});
  }
}

VerifyReport judge_job(const Setup& setup, const JudgeRequest& request, const Tool& tool, const Path& path) {
  if (request.sample_mm) require_sensible(setup, *request.sample_mm);
  const double spacing = request.sample_mm.value_or(default_spacing(setup.part.box.diagonal()));
  std::vector<FaceSamples> samples = judge_samples(setup, spacing, 2.0 * spacing);
  const double radius = request.reach_radius_mm.value_or(smallest_radius(tool));
  // A tool that is none (a fit that failed) has nothing to reach with.
  if (radius > 0.0) measure_reach(setup, tool, path, radius, samples);
  JudgeOptions options;
  options.tolerance_mm = setup.tolerance_mm;
  const JudgedShapes shapes(setup, request.sample_mm ? 0 : samples.size());
  VerifyReport report = judge(tool, path, samples, shapes.list, options);
  report.reach_radius_mm = radius;
  return report;
}

ProgramStock judge_stock(const Setup& setup, const TrochoidJob& job, const Tool& tool, const Path& path,
                         const std::vector<HalfSpace>& blank, double most_triangles) {
  const double spacing = default_spacing(setup.part.box.diagonal());
  ProgramStockOptions options;
  options.cell_mm = job.cycles.stock_cell_mm;
  options.most_engagement_deg = job.cycles.most_engagement_deg;
  options.tolerance_mm = setup.tolerance_mm;
  options.most_triangles = most_triangles;
  return replay_program(tool, path, blank, judge_samples(setup, spacing, 2.0 * spacing), options);
}

}  // namespace flank::internal

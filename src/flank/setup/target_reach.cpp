#include "flank/setup/target_reach.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/geom/face_box.h"
#include "flank/geom/tessellate.h"
#include "flank/setup/ball_places.h"
#include "flank/verify/reach_border.h"

namespace flank::internal {
namespace {

/// Of the triangles that the ball is held against, mm: a place of the border of the reachable part is as wrong as they
/// are. What is fine enough grows with the ball: a ship's hull in hundredths of a millimetre takes a gigabyte.
constexpr double kFinestMm = 0.001, kCoarsestMm = 0.01, kToleranceShare = 0.25;
/// Of the ball's radius, where that is less and where that is more: a part of a millimetre is looked at like one of a metre.
constexpr double kFinestShare = 0.001, kCoarsestShare = 0.001;
/// Borders are off by a part of a cell: mm, or a share of the ball's radius, as with the triangles.
constexpr double kLongestCellMm = 1.0, kShortestCellShare = 1.0, kLongestCellShare = 0.1;
/// Of a face's size, where lengths are less than usual: a hub beside a tiny target would take millions of triangles.
constexpr double kFineShare = 1e-5, kCellShare = 1.0 / 300.0;
constexpr double kFarShare = 0.1;  ///< of the ball's radius: of the triangles that only close a solid

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

int solid_of(const Part& part, int face) {
  return part.is_mesh() ? -1 : part.faces[static_cast<std::size_t>(face)].solid;
}

/// A face's triangles, counter-clockwise seen from outside of its solid: fine where the ball may come near, and coarse ones of all of it.
ReachFace triangles_of(const Part& part, int face, bool checked, const BallPlaces& places, const ReachFineness& of) {
  ReachFace out{.mesh = {}, .solid = solid_of(part, face), .checked = checked};
  const auto cut = [&](double chord_mm, double edge_mm) {
    return tessellate(part.faces[static_cast<std::size_t>(face)], {.chord_mm = chord_mm, .edge_mm = edge_mm}).mesh;
  };
  const TriangleMesh whole = part.is_mesh() ? extract_mesh(part, {face}) : cut(of.coarse_mm, 1e300);
  if (!checked) {
    out.mesh = whole;
    return out;
  }
  if (part.is_mesh()) {
    out.mesh = near_part(whole, places);
    if (out.mesh.triangles.size() < whole.triangles.size()) out.closing = whole;
    return out;
  }
  out.closing = whole;
  const double size = box_of(part.faces[static_cast<std::size_t>(face)]).diagonal();
  if (places.meet(whole.box())) out.mesh = near_part(cut(of.fine_on(size), of.cell_on(size)), places);
  return out;
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

/// Triangles of the faces around.
std::vector<ReachFace> reach_faces(const Setup& setup, const std::vector<int>& around, const std::vector<int>& judged,
                                   const std::vector<FaceSamples>& samples, double radius_mm) {
  const ReachFineness of = reach_fineness(setup.tolerance_mm, radius_mm);
  const BallPlaces places(samples, radius_mm);
  std::vector<ReachFace> faces(around.size());
  parallel_for(faces.size(), [&](std::size_t k) {
    stop_here();
    faces[k] = triangles_of(setup.part, around[k], holds(judged, around[k]), places, of);
  });
  return faces;
}

template <class Value>
void take(std::vector<Value>& out, const std::vector<Value>& from, const std::vector<std::size_t>& which) {
  for (const std::size_t i : which)
    if (i < from.size()) out.push_back(from[i]);
}

void append(FaceSamples& out, const FaceSamples& from, const std::vector<std::size_t>& which) {
  take(out.points, from.points, which);
  take(out.areas, from.areas, which);
  take(out.reaches_mm, from.reaches_mm, which);
  take(out.curvatures_per_mm, from.curvatures_per_mm, which);
  take(out.normals, from.normals, which);
  take(out.reachable, from.reachable, which);
  take(out.smooth, from.smooth, which);
  take(out.cells, from.cells, which);
  out.spacing_mm = std::max(out.spacing_mm, from.spacing_mm);
}

}  // namespace

double ReachFineness::fine_on(double face_mm) const {
  return std::max(fine_mm, std::min(kFinestMm, kFineShare * face_mm));
}

double ReachFineness::cell_on(double face_mm) const {
  return std::max(cell_mm, std::min(kLongestCellMm, kCellShare * face_mm));
}

ReachFineness reach_fineness(double tolerance_mm, double radius_mm) {
  ReachFineness of;
  of.fine_mm = std::clamp(kToleranceShare * tolerance_mm, std::min(kFinestMm, kFinestShare * radius_mm),
                          std::max(kCoarsestMm, kCoarsestShare * radius_mm));
  of.coarse_mm = std::max(of.fine_mm, kFarShare * radius_mm);
  of.cell_mm = std::max(std::min(kLongestCellMm, kShortestCellShare * radius_mm), kLongestCellShare * radius_mm);
  return of;
}

std::vector<FaceSamples> target_samples(const Setup& setup, double spacing_mm) {
  const Part& part = setup.part;
  std::vector<FaceSamples> samples(setup.targets.size());
  parallel_for(samples.size(), [&](std::size_t k) {
    const int face = setup.targets[k];
    samples[k] = part.is_mesh() ? sample_mesh(part.face_id(face), extract_mesh(part, {face}), spacing_mm, true)
                                : sample_face(part.faces[static_cast<std::size_t>(face)], spacing_mm, true);
  });
  return samples;
}

TargetReach::TargetReach(const Setup& setup, const ReachBall& ball, const std::vector<FaceSamples>& samples) {
  const Part& part = setup.part;
  const double radius = radius_mm_ = ball.radius_mm;
  std::vector<int> judged = setup.targets;
  judged.insert(judged.end(), setup.checks.begin(), setup.checks.end());
  if (judged.size() < 2 && !ball.corners && setup.standing.empty()) return;
  const std::vector<int> around = faces_around(part, judged);
  std::vector<ReachFace> all = reach_faces(setup, around, judged, samples, radius);
  for (std::size_t k = 0; k < setup.standing.size(); ++k)
    all.push_back({setup.standing[k], part.solids + static_cast<int>(k), true});
  const ReachFaces faces(all);
  for (const int own : setup.targets) {
    const auto at = static_cast<std::size_t>(std::find(around.begin(), around.end(), own) - around.begin());
    targets_.emplace(own, ReachScene(faces, at, ball.corners, {radius, setup.tolerance_mm}));
  }
}

void TargetReach::fill(int face, FaceSamples& samples) const {
  const auto found = targets_.find(face);
  if (found == targets_.end()) return;
  samples.reachable = found->second.shares(samples);
}

std::vector<double> TargetReach::largest_balls(int face, const FaceSamples& samples) const {
  const auto found = targets_.find(face);
  if (found == targets_.end()) return std::vector<double>(samples.points.size(), radius_mm_);
  return found->second.largest_balls(samples);
}

FinerReach finer_reach(const Setup& setup, const TargetReach& reach, const std::vector<FaceSamples>& samples,
                       double share) {
  constexpr std::size_t kMostSamples = 4000;
  std::vector<std::pair<double, double>> balls;  // radius, area
  for (std::size_t j = 0; j < samples.size(); ++j) {
    FaceSamples few;
    const std::size_t step = 1 + samples[j].points.size() / kMostSamples;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < samples[j].points.size(); i += step) which.push_back(i);
    append(few, samples[j], which);
    const std::vector<double> radii = reach.largest_balls(setup.targets[j], few);
    const double times = static_cast<double>(step) * setup.copies_of(setup.targets[j]);
    for (std::size_t i = 0; i < radii.size(); ++i) balls.emplace_back(radii[i], few.areas[i] * times);
  }
  std::sort(balls.begin(), balls.end(), std::greater());
  double all = 0.0, reached = 0.0;
  for (const auto& [radius, area] : balls) all += area;
  FinerReach out;
  for (const auto& [radius, area] : balls) {
    reached += area;
    out = {radius, reached / all};
    if (reached >= share * all) break;
  }
  return out;
}

FaceSamples with_fine_border(const verify::Sampler& sampler, const TargetReach& reach, int face,
                             const FaceSamples& samples) {
  const std::vector<std::size_t> part = verify::reach_border(samples);
  if (part.empty()) return samples;
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    if (!std::binary_search(part.begin(), part.end(), i)) whole.push_back(i);
  FaceSamples fine = sampler.cut(samples, part);
  reach.fill(face, fine);
  FaceSamples out;
  out.face = samples.face;
  out.target = samples.target;
  out.of_solid = samples.of_solid;
  append(out, samples, whole);
  std::vector<std::size_t> all(fine.points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  append(out, fine, all);
  return out;
}

}  // namespace flank::internal

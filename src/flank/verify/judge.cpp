#include "flank/judge.h"

#include <algorithm>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/verify/judge_faces.h"

namespace flank {
using namespace internal;
using namespace internal::verify;
namespace {

/// Samples per task, measured from the first to the last. Fixed, so that the number of threads changes nothing: each
/// search starts from the place of the sample before, and of two equally near places that may decide which one is
/// named.
constexpr std::size_t kBlock = 256;
/// So few samples are measured one by one: a query of their ball would cost as much as it may spare.
constexpr std::size_t kLeastBlock = 16;
constexpr double kRounding = 1e-9;  ///< relative: widens the ball around samples by more than round-off can shrink it
constexpr double kFarHorizonMm = 1e6;  ///< beyond any part: nothing is farther
/// Horizon of covered_samples, in tolerances: just above 1, so that |f| = tolerance is still measured exactly.
constexpr double kCoveredHorizon = 1.01;

double size_of(const FaceSamples& face) {
  Box3 box;
  for (const Vec3& p : face.points) box.add(p);
  return box.diagonal();
}

/// distances() of neighbouring points, in halves: f has slope 1, so that one place may tell that all of them are
/// farther than the horizon.
void measure_near(const SweptVolume& volume, std::span<const Vec3> points, double horizon,
                  std::span<SweptDistance> out) {
  if (points.size() <= kLeastBlock) {
    volume.distances(points, horizon, out);
    return;
  }
  Box3 box;
  for (const Vec3& p : points) box.add(p);
  const double radius = 0.5 * box.diagonal() * (1.0 + kRounding);
  if (volume.distance(box.center(), horizon + radius).f >= horizon + radius) {
    for (SweptDistance& d : out) d = {horizon, -1, 0.0, 0.0};
    return;
  }
  const std::size_t half = points.size() / 2;
  measure_near(volume, points.first(half), horizon, out.first(half));
  measure_near(volume, points.subspan(half), horizon, out.subspan(half));
}

}  // namespace

double smallest_radius(const Tool& tool) { return tool.radial.smallest(); }

std::vector<SweptDistance> swept_distances(const SweptVolume& volume, const FaceSamples& face, double horizon_mm) {
  std::vector<SweptDistance> out(face.points.size());
  parallel_blocks(out.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    stop_here();
    const std::span points = std::span(face.points).subspan(begin, end - begin);
    const std::span results = std::span(out).subspan(begin, end - begin);
    if (horizon_mm < kFarHorizonMm)
      measure_near(volume, points, horizon_mm, results);
    else
      volume.distances(points, horizon_mm, results);
  });
  return out;
}

std::vector<std::size_t> covered_samples(const SweptVolume& volume, const FaceSamples& face, double tolerance_mm) {
  FLANK_ASSERT(tolerance_mm > 0.0);
  const double horizon = kCoveredHorizon * tolerance_mm;
  const std::vector<SweptDistance> distances = swept_distances(volume, face, horizon);
  std::vector<std::size_t> covered;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (std::abs(distances[i].f) <= tolerance_mm) covered.push_back(i);
  return covered;
}

VerifyReport judge(const Tool& tool, const Path& path, const std::vector<FaceSamples>& faces,
                   const JudgeOptions& options) {
  return judge(tool, path, faces, {}, options);
}

VerifyReport judge(const Tool& tool, const Path& path, const std::vector<FaceSamples>& faces,
                   const std::vector<FaceShape>& shapes, const JudgeOptions& options) {
  FLANK_ASSERT(shapes.empty() || shapes.size() == faces.size());
  std::vector<JudgedFace> judged;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceSamples& face = faces[k];
    judged.push_back({.face = face.face,
                      .target = face.target,
                      .size_mm = size_of(face),
                      .samples = [&face](std::size_t, bool, const auto& use) { use(face); },
                      .shape = shapes.empty() ? nullptr : &shapes[k]});
  }
  return judge_faces(tool, path, judged, options);
}

}  // namespace flank

// What each figure means is written in docs/algorithms/judge.md.
#include "flank/judge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/verify/prove.h"

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
constexpr double kEndShare = 1e-9;     ///< of a step or of the axis: nearer to an end than this counts as at the end
/// Of the face's size: how far worst places keep from one another. Else all of them would lie in one scratch.
constexpr double kWorstSeparation = 0.05;
/// Tolerances: the histogram runs from minus to plus this; its outer bins take what is beyond.
constexpr double kHistogramReach = 2.0;
/// Horizon of covered_samples, in tolerances: just above 1, so that |f| = tolerance is still measured exactly.
constexpr double kCoveredHorizon = 1.01;

/// Whether the strip sweeps past the sample: its nearest sphere belongs to the inside of a strip's path and of the
/// axis.
bool swept_past(const SweptDistance& d, const Tool& tool, const Path& path) {
  if (d.strip < 0) return false;
  const double last = static_cast<double>(path.strips[static_cast<std::size_t>(d.strip)].poses.size()) - 1.0;
  const double length = tool.radial.axis_length();
  return d.t > kEndShare && d.t < last - kEndShare && d.s > kEndShare * length && d.s < (1.0 - kEndShare) * length;
}

/// Sums over the samples of a face, in their order, so that the same bits come out every time. Areas in mm^2.
struct Sums {
  double area = 0.0, covered = 0.0, reachable = 0.0, covered_reachable = 0.0, touched = 0.0, squares = 0.0;
};

Sums add_up(const Tool& tool, const Path& path, const FaceSamples& face, const std::vector<SweptDistance>& distances,
            double tolerance, FaceVerdict& verdict) {
  Sums sums;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const SweptDistance& d = distances[i];
    const double area = face.areas[i];
    sums.area += area;
    verdict.overcut_mm = std::max(verdict.overcut_mm, -d.f);
    if (!face.target) continue;
    verdict.undercut_mm = std::max(verdict.undercut_mm, d.f);
    const double reachable = face.reachable.empty() ? area : area * face.reachable[i];
    sums.reachable += reachable;
    if (std::abs(d.f) <= tolerance) {
      sums.covered += area;
      sums.covered_reachable += reachable;
    }
    if (!swept_past(d, tool, path)) continue;
    verdict.undercut_covered_mm = std::max(verdict.undercut_covered_mm, d.f);
    sums.touched += area;
    sums.squares += area * d.f * d.f;
  }
  return sums;
}

/// The deepest places of one face, each at least a share of the face's size away from deeper ones.
std::vector<WorstPlace> worst_of(const FaceSamples& face, const std::vector<SweptDistance>& distances, int count) {
  std::vector<std::size_t> order;
  Box3 box;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    box.add(face.points[i]);
    if (distances[i].f < 0.0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distances[a].f < distances[b].f || (distances[a].f == distances[b].f && a < b);
  });
  const double separation = kWorstSeparation * box.diagonal();
  std::vector<WorstPlace> out;
  for (std::size_t i : order) {
    if (static_cast<int>(out.size()) >= count) break;
    const bool close = std::any_of(out.begin(), out.end(),
                                   [&](const WorstPlace& w) { return (w.point - face.points[i]).norm() < separation; });
    if (close) continue;
    const SweptDistance& d = distances[i];
    out.push_back({face.face, face.points[i], d.f, d.strip, d.t, d.s});
  }
  return out;
}

double size_of(const FaceSamples& face) {
  Box3 box;
  for (const Vec3& p : face.points) box.add(p);
  return box.diagonal();
}

/// Puts a place first that is at least as deep as all others, and takes out those near it.
void add_place(const WorstPlace& deepest, double separation, int count, std::vector<WorstPlace>& worst) {
  std::erase_if(worst, [&](const WorstPlace& w) { return (w.point - deepest.point).norm() < separation; });
  worst.insert(worst.begin(), deepest);
  if (static_cast<int>(worst.size()) > count) worst.resize(static_cast<std::size_t>(std::max(0, count)));
}

void add_histogram(VerifyReport& report, const FaceSamples& face, const std::vector<SweptDistance>& distances) {
  const auto& edges = report.histogram_edges_mm;
  const int bins = static_cast<int>(report.histogram_area_mm2.size());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), distances[i].f) - edges.begin();
    const int bin = std::clamp(static_cast<int>(above) - 1, 0, bins - 1);
    report.histogram_area_mm2[static_cast<std::size_t>(bin)] += face.areas[i];
  }
}

void prepare_histogram(VerifyReport& report, const JudgeOptions& options) {
  const int bins = options.histogram_bins;
  for (int i = 0; i <= bins; ++i)
    report.histogram_edges_mm.push_back(options.tolerance_mm * (2.0 * kHistogramReach * i / bins - kHistogramReach));
  report.histogram_area_mm2.assign(static_cast<std::size_t>(bins), 0.0);
}

// The swept solid is a union of balls of radius at least r. At the deepest inner point y of a face, cut by f(y) = -o,
// the ball (c, b) that cuts there touches the face's normal: y - c = (b - o) n. A sample x at most e away along the
// face leaves the tangent plane by at most k e^2 / 2, k the largest normal curvature, so |x - c| <= (b - o) + (1/(b -
// o) + k) e^2 / 2 and f(x) <= f(y) + (1/(r - o) + k) e^2 / 2. f has slope at most 1 besides, so e itself always bounds
// it. y lies in the cell of one of the samples: the deepest that any cell allows, less the deepest sample.
double between_samples(const FaceSamples& face, const std::vector<SweptDistance>& distances, double least_radius,
                       double overcut) {
  // The radius r - o of the derivation, less the way from y to its sample: the ball must still be one there.
  const double inner = least_radius - overcut - face.spacing_mm;
  double deepest = overcut;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double e = face.reaches_mm.empty() ? face.spacing_mm : face.reaches_mm[i];
    double more = e;
    if (inner > 0.0 && !face.curvatures_per_mm.empty())
      more = std::min(e, 0.5 * (1.0 / inner + face.curvatures_per_mm[i]) * e * e);
    deepest = std::max(deepest, more - distances[i].f);
  }
  return deepest - overcut;
}

void require_usable(const JudgeOptions& options) {
  if (!(options.tolerance_mm > 0.0))
    throw UsageError("tolerance " + std::to_string(options.tolerance_mm) + " mm: must be > 0");
  if (options.histogram_bins < 1) throw UsageError("a histogram needs at least one bin");
}

double share_of(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// What one face adds to the report.
struct FaceResult {
  FaceVerdict verdict;
  Sums sums;
  std::vector<WorstPlace> worst;
};

/// f at the samples of a face. On a check surface only overcut matters, at the samples and between them; where the depth
/// is proved anyway, not even that.
std::vector<SweptDistance> measure(const SweptVolume& volume, const FaceSamples& face, const JudgeOptions& options,
                                   bool proved) {
  if (face.target) return swept_distances(volume, face, options.horizon_mm);
  if (proved) return std::vector<SweptDistance>(face.points.size());
  return swept_distances(volume, face, std::min(options.horizon_mm, std::max(options.tolerance_mm, face.spacing_mm)));
}

FaceResult judge_face(const SweptVolume& volume, const Tool& tool, const Path& path, const FaceSamples& face,
                      const FaceShape* shape, const JudgeOptions& options, VerifyReport& report) {
  const std::vector<SweptDistance> distances = measure(volume, face, options, shape != nullptr);
  FaceResult result;
  FaceVerdict& verdict = result.verdict;
  verdict.face = face.face;
  verdict.target = face.target;
  verdict.samples = face.points.size();
  verdict.spacing_mm = face.spacing_mm;
  const Sums sums = result.sums = add_up(tool, path, face, distances, options.tolerance_mm, verdict);
  verdict.area_mm2 = sums.area;
  verdict.coverage = share_of(sums.covered, sums.area);
  verdict.reachable_share = share_of(sums.reachable, sums.area);
  verdict.coverage_reachable = share_of(sums.covered_reachable, sums.reachable);
  verdict.rms_mm = sums.touched > 0.0 ? std::sqrt(sums.squares / sums.touched) : 0.0;
  // Without distances there is nothing between samples to speak of.
  if (face.target || shape == nullptr)
    verdict.sampling_bound_mm = between_samples(face, distances, smallest_radius(tool), verdict.overcut_mm);
  verdict.overcut_bound_mm = verdict.overcut_mm + verdict.sampling_bound_mm;
  result.worst = worst_of(face, distances, options.worst_places);
  if (!result.worst.empty()) verdict.deepest = result.worst.front();
  if (shape != nullptr) {
    const double separation = kWorstSeparation * size_of(face);
    prove_depth(volume, smallest_radius(tool), *shape, options.tolerance_mm, options.proof, verdict);
    if (verdict.deepest) add_place(*verdict.deepest, separation, options.worst_places, result.worst);
  }
  if (face.target) add_histogram(report, face, distances);
  return result;
}

void add_target(VerifyReport& report, Sums& totals, const FaceResult& face) {
  totals.area += face.sums.area;
  totals.covered += face.sums.covered;
  totals.reachable += face.sums.reachable;
  totals.covered_reachable += face.sums.covered_reachable;
  totals.touched += face.sums.touched;
  totals.squares += face.sums.squares;
  report.overcut_mm = std::max(report.overcut_mm, face.verdict.overcut_mm);
  report.undercut_mm = std::max(report.undercut_mm, face.verdict.undercut_mm);
  report.undercut_covered_mm = std::max(report.undercut_covered_mm, face.verdict.undercut_covered_mm);
  report.sampling_bound_mm = std::max(report.sampling_bound_mm, face.verdict.sampling_bound_mm);
  report.overcut_bound_mm = std::max(report.overcut_bound_mm, face.verdict.overcut_bound_mm);
}

void keep_worst(std::vector<WorstPlace>& worst, int count) {
  std::stable_sort(worst.begin(), worst.end(), [](const WorstPlace& a, const WorstPlace& b) { return a.f < b.f; });
  if (static_cast<int>(worst.size()) > count) worst.resize(static_cast<std::size_t>(std::max(0, count)));
}

/// A gouge is named first: it spoils a face that nobody meant to touch.
Verdict verdict_of(const VerifyReport& report) {
  if (report.gouge_mm > report.tolerance_mm) return Verdict::kGouge;
  if (report.overcut_mm > report.tolerance_mm) return Verdict::kOvercut;
  const bool proved = std::max(report.overcut_bound_mm, report.gouge_bound_mm) <= report.tolerance_mm;
  return proved || report.depth == DepthProof::kSampled ? Verdict::kPass : Verdict::kUnproved;
}

}  // namespace

double smallest_radius(const Tool& tool) { return tool.radial.smallest(); }

namespace {

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

std::vector<SweptDistance> swept_distances(const SweptVolume& volume, const FaceSamples& face, double horizon_mm) {
  std::vector<SweptDistance> out(face.points.size());
  parallel_blocks(out.size(), kBlock, [&](std::size_t begin, std::size_t end) {
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
  require_usable(options);
  FLANK_ASSERT(shapes.empty() || shapes.size() == faces.size());
  VerifyReport report;
  report.depth = shapes.empty() ? DepthProof::kSampled : DepthProof::kProved;
  report.tolerance_mm = options.tolerance_mm;
  prepare_histogram(report, options);
  const SweptVolume volume(tool, path);
  Sums totals;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceSamples& face = faces[k];
    FaceResult result = judge_face(volume, tool, path, face, shapes.empty() ? nullptr : &shapes[k], options, report);
    if (face.target) {
      add_target(report, totals, result);
    } else {
      report.gouge_mm = std::max(report.gouge_mm, result.verdict.overcut_mm);
      report.gouge_bound_mm = std::max(report.gouge_bound_mm, result.verdict.overcut_bound_mm);
    }
    report.worst.insert(report.worst.end(), result.worst.begin(), result.worst.end());
    report.faces.push_back(std::move(result.verdict));
  }
  keep_worst(report.worst, options.worst_places);
  report.coverage = share_of(totals.covered, totals.area);
  report.reachable_share = share_of(totals.reachable, totals.area);
  report.coverage_reachable = share_of(totals.covered_reachable, totals.reachable);
  report.rms_mm = totals.touched > 0.0 ? std::sqrt(totals.squares / totals.touched) : 0.0;
  report.verdict = verdict_of(report);
  return report;
}

}  // namespace flank

#include "flank/verify/judge_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/verify/face_tally.h"
#include "flank/verify/proof/cover_search.h"
#include "flank/verify/proof/face_shape.h"
#include "flank/verify/proof/mesh_shape.h"
#include "flank/verify/prove.h"
#include "flank/verify/reach_border.h"

namespace flank::internal::verify {
namespace {

/// Tolerances: the histogram runs from minus to plus this; its outer bins take what is beyond.
constexpr double kHistogramReach = 2.0;

void require_usable(const JudgeOptions& options) {
  if (!(options.tolerance_mm > 0.0))
    throw UsageError("tolerance " + std::to_string(options.tolerance_mm) + " mm: must be > 0");
  if (options.histogram_bins < 1) throw UsageError("a histogram needs at least one bin");
}

void prepare_histogram(VerifyReport& report, const JudgeOptions& options) {
  const int bins = options.histogram_bins;
  for (int i = 0; i <= bins; ++i)
    report.histogram_edges_mm.push_back(options.tolerance_mm * (2.0 * kHistogramReach * i / bins - kHistogramReach));
  report.histogram_area_mm2.assign(static_cast<std::size_t>(bins), 0.0);
}

/// What one face adds to the report.
struct FaceResult {
  FaceVerdict verdict;
  Sums sums;
  std::vector<WorstPlace> worst;
};

/// What a finer look at the coverage of a face need not do again.
struct FaceCache {
  std::optional<FaceVerdict> depth;  ///< with the figures of the proof of depth
  std::optional<FaceSamples> samples;
  std::vector<SweptDistance> distances;
};

/// Looks at the coverage, in shares of ProofOptions::cover_evaluations. Where a share of the face is asked for, the first is coarse:
/// if it is clear at once that this is covered, or by how much it is not, the last digits of the bound are not worth their price. The
/// last ones cut the cells along the border of what is covered twice and three times more.
constexpr std::array<double, 4> kCoverageEffort{1.0 / 12.0, 1.0, 16.0, 64.0};

/// A proof of coverage that says less than this share of what is measured is one of nothing.
constexpr double kTellingProof = 0.9;

/// One judgement.
class Judge {
 public:
  Judge(const Tool& tool, const Path& path, const JudgeOptions& options)
      : tool_(tool), path_(path), options_(options), volume_(tool, path) {}

  VerifyReport run(const std::vector<JudgedFace>& faces, const LeastCoverage& least) {
    const bool shapes = std::all_of(faces.begin(), faces.end(), [](const JudgedFace& f) { return f.shape != nullptr; });
    prove_depth_ = shapes && !faces.empty() && options_.depth == DepthProof::kProved;
    keep_ = least.reachable > 0.0 || least.whole > 0.0;
    std::vector<FaceCache> known(faces.size());
    std::vector<FaceResult> results(faces.size());
    bool again = false;
    for (std::size_t look = keep_ ? 0 : 1; look < kCoverageEffort.size();) {
      balls_a_sample_ = kCoverageEffort[look] * static_cast<double>(options_.proof.cover_evaluations);
      begin();
      for (std::size_t k = 0; k < faces.size(); ++k)
        if (!again || faces[k].target) results[k] = judge_face(faces[k], known[k]);
      finish(results, shapes && !faces.empty());
      again = true;
      if (border_decides(least.reachable, faces, known)) {
        fine_ = true;
        for (FaceCache& face : known) face.samples.reset();
        continue;
      }
      if (!undecided(least, look)) break;
      ++look;
    }
    return std::move(report_);
  }

 private:
  void begin() {
    report_ = {};
    report_.depth = prove_depth_ ? DepthProof::kProved : DepthProof::kSampled;
    report_.tolerance_mm = options_.tolerance_mm;
    prepare_histogram(report_, options_);
  }

  /// Measured to cover what is needed, but not proved to. What is measured to cover less is looked at once more, where the proof of
  /// it says next to nothing.
  [[nodiscard]] bool undecided(const LeastCoverage& least, std::size_t look) const {
    if (report_.overcut_bound_mm > report_.tolerance_mm || !report_.coverage_bound) return false;
    const bool measured = report_.coverage_reachable >= least.reachable && report_.coverage >= least.whole;
    if (!measured) return look == 0 && *report_.coverage_bound < kTellingProof * report_.coverage;
    return *report_.coverage_reachable_bound < least.reachable || *report_.coverage_bound < least.whole;
  }

  /// May the cells in which what is reachable ends tell whether what is needed is covered? They count whole where they are open, and
  /// as their middle is where they are measured.
  [[nodiscard]] bool border_decides(double least, const std::vector<JudgedFace>& faces,
                                    const std::vector<FaceCache>& known) const {
    const double sure = report_.coverage_reachable_bound.value_or(report_.coverage_reachable);
    if (!keep_ || fine_ || report_.overcut_bound_mm > report_.tolerance_mm || sure >= least) return false;
    double border = 0.0;
    for (std::size_t k = 0; k < known.size(); ++k)
      if (const auto& samples = known[k].samples)
        for (const std::size_t i : reach_border(*samples)) border += faces[k].copies * samples->areas[i];
    return report_.coverage_reachable + share_of(border, reachable_mm2_) >= least;
  }

  /// f at the samples of a face. On a check surface only overcut matters, at the samples and between them; where the
  /// depth is proved anyway, not even that.
  [[nodiscard]] std::vector<SweptDistance> measure(const FaceSamples& face) const {
    if (face.target) return swept_distances(volume_, face, options_.horizon_mm);
    if (prove_depth_) return std::vector<SweptDistance>(face.points.size());
    const double between = std::max(options_.tolerance_mm, face.spacing_mm);
    return swept_distances(volume_, face, std::min(options_.horizon_mm, between));
  }

  /// The area of each cell that is not proved to be finished; empty: all of it.
  [[nodiscard]] ProvedCover cover_of(const FaceSamples& samples, const std::vector<SweptDistance>& distances,
                                     const Shape* shape) const {
    if (shape == nullptr || !samples.target || samples.cells.empty()) return {};
    // A face that is cut too deep somewhere is proved to be finished nowhere.
    const auto too_deep = [&](const SweptDistance& d) { return d.f < -options_.tolerance_mm; };
    if (std::any_of(distances.begin(), distances.end(), too_deep)) return {};
    CoverLimits limits;
    limits.tolerance_mm = options_.tolerance_mm;
    for (double area : samples.areas) limits.gap_mm2 += options_.proof.cover_gap_share * area;
    limits.evaluations = static_cast<std::size_t>(balls_a_sample_ * static_cast<double>(samples.points.size()));
    limits.cells = options_.proof.cells;
    return search_cover(volume_, *shape, samples, distances, limits);
  }

  /// The samples of a tile, and f at each of them: as they are known, else measured.
  template <class Use>
  void with_tile(const JudgedFace& face, std::size_t tile, FaceCache& known, const Use& use) const {
    if (known.samples) {
      use(*known.samples, known.distances);
      return;
    }
    face.samples(tile, fine_, [&](const FaceSamples& samples) {
      std::vector<SweptDistance> distances = measure(samples);
      use(samples, distances);
      // Faces in many tiles are measured again: all of them together would take too much memory.
      if (!keep_ || !face.target || face.tiles > 1) return;
      known.samples = samples;
      known.distances = std::move(distances);
    });
  }

  FaceResult judge_face(const JudgedFace& face, FaceCache& known) {
    std::unique_ptr<Shape> shape;
    if (face.shape != nullptr && face.target)
      shape = std::visit([](const auto* value) { return make_shape(*value); }, *face.shape);
    FaceTally tally(tool_, path_, face.face, face.target, face.size_mm, options_);
    std::size_t looked = 0;
    for (std::size_t k = 0; k < face.tiles; ++k) {
      stop_here();
      with_tile(face, k, known, [&](const FaceSamples& samples, const std::vector<SweptDistance>& distances) {
        const ProvedCover cover = cover_of(samples, distances, shape.get());
        looked += cover.evaluations;
        tally.add(samples, distances, cover.open_mm2);
        if (face.target) tally.add_histogram(report_, samples, distances);
      });
    }
    FaceResult result{tally.verdict(), tally.sums(), tally.worst()};
    result.verdict.cover_cells = looked, result.verdict.copies = face.copies;
    complete(result, face, tally.separation(), known);
    return result;
  }

  /// The proof of depth, and what does not hold without it.
  void complete(FaceResult& result, const JudgedFace& face, double separation, FaceCache& known) const {
    FaceVerdict& verdict = result.verdict;
    if (prove_depth_) {
      // Check surfaces were not asked at their samples: nothing is known between them.
      if (!face.target) verdict.sampling_bound_mm = 0.0;
      verdict.overcut_bound_mm = verdict.overcut_mm;
      if (known.depth)
        take_depth(*known.depth, verdict);
      else
        prove_depth(volume_, smallest_radius(tool_), *face.shape, options_.tolerance_mm, options_.proof, verdict);
      known.depth = verdict;
      if (verdict.deepest) add_place(*verdict.deepest, separation, options_.worst_places, result.worst);
    }
    // A cell is finished if nothing is left on it, and it is not cut too deep: that is known of the face as a whole.
    if (verdict.overcut_bound_mm <= options_.tolerance_mm) return;
    verdict.coverage_bound = verdict.coverage_reachable_bound = 0.0;
    result.sums.proved = result.sums.proved_reachable = 0.0;
  }

  /// What prove_depth fills.
  static void take_depth(const FaceVerdict& from, FaceVerdict& verdict) {
    verdict.overcut_mm = from.overcut_mm;
    verdict.overcut_bound_mm = from.overcut_bound_mm;
    verdict.bound_point = from.bound_point;
    verdict.proof_cells = from.proof_cells;
    verdict.deepest = from.deepest;
  }

  void add(const FaceResult& result, Sums& totals) {
    const FaceVerdict& verdict = result.verdict;
    if (verdict.target) {
      totals.add(result.sums, verdict.copies);
      report_.overcut_mm = std::max(report_.overcut_mm, verdict.overcut_mm);
      report_.undercut_mm = std::max(report_.undercut_mm, verdict.undercut_mm);
      report_.undercut_covered_mm = std::max(report_.undercut_covered_mm, verdict.undercut_covered_mm);
      report_.sampling_bound_mm = std::max(report_.sampling_bound_mm, verdict.sampling_bound_mm);
      report_.overcut_bound_mm = std::max(report_.overcut_bound_mm, verdict.overcut_bound_mm);
    } else {
      report_.gouge_mm = std::max(report_.gouge_mm, verdict.overcut_mm);
      report_.gouge_bound_mm = std::max(report_.gouge_bound_mm, verdict.overcut_bound_mm);
    }
    report_.worst.insert(report_.worst.end(), result.worst.begin(), result.worst.end());
    report_.faces.push_back(verdict);
  }

  void finish(const std::vector<FaceResult>& results, bool cover_proved) {
    Sums totals;
    for (const FaceResult& result : results) add(result, totals);
    std::stable_sort(report_.worst.begin(), report_.worst.end(),
                     [](const WorstPlace& a, const WorstPlace& b) { return a.f < b.f; });
    const auto most = static_cast<std::size_t>(std::max(0, options_.worst_places));
    if (report_.worst.size() > most) report_.worst.resize(most);
    report_.coverage = share_of(totals.covered, totals.area);
    report_.reachable_share = share_of(totals.reachable, totals.area);
    report_.coverage_reachable = share_of(totals.covered_reachable, totals.reachable);
    reachable_mm2_ = totals.reachable;
    if (cover_proved) {
      report_.coverage_bound = share_of(totals.proved, totals.area);
      report_.coverage_reachable_bound = share_of(totals.proved_reachable, totals.reachable);
    }
    report_.rms_mm = totals.touched > 0.0 ? std::sqrt(totals.squares / totals.touched) : 0.0;
    report_.verdict = verdict();
  }

  /// A gouge is named first: it spoils a face that nobody meant to touch.
  [[nodiscard]] Verdict verdict() const {
    if (report_.gouge_mm > report_.tolerance_mm) return Verdict::kGouge;
    if (report_.overcut_mm > report_.tolerance_mm) return Verdict::kOvercut;
    const bool proved = std::max(report_.overcut_bound_mm, report_.gouge_bound_mm) <= report_.tolerance_mm;
    return proved ? Verdict::kPass : Verdict::kUnproved;
  }

  const Tool& tool_;
  const Path& path_;
  const JudgeOptions& options_;
  SweptVolume volume_;
  double balls_a_sample_ = 0.0;  ///< that a look at coverage may take
  double reachable_mm2_ = 0.0;
  bool prove_depth_ = false, keep_ = false, fine_ = false;
  VerifyReport report_;
};

}  // namespace

VerifyReport judge_faces(const Tool& tool, const Path& path, const std::vector<JudgedFace>& faces,
                         const JudgeOptions& options, const LeastCoverage& least) {
  require_usable(options);
  return Judge(tool, path, options).run(faces, least);
}

}  // namespace flank::internal::verify

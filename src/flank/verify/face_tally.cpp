// What each figure means is written in docs/algorithms/judge.md.
#include "flank/verify/face_tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The distance to what is nowhere, without a horizon: where nothing moves, nothing comes near.
constexpr double kNowhere = 1e300;

constexpr double kEndShare = 1e-9;  ///< of a step or of the axis: nearer to an end than this counts as at the end

// The swept solid is a union of balls of radius at least r. At the deepest inner point y of a face, cut by f(y) = -o,
// the ball (c, b) that cuts there touches the face's normal: y - c = (b - o) n. A sample x at most e away along the
// face leaves the tangent plane by at most k e^2 / 2, k the largest normal curvature, so o <= -f(x) + (1/(b - o) + k)
// e^2 / 2. f has slope at most 1 besides, so e itself always bounds it, and b - o >= r + f(x) - e. Where a border or a
// kink is in the cell, y need not lie below the ball.
double depth_in_cell(const FaceSamples& face, std::size_t i, double f, double least_radius) {
  const double e = face.reaches_mm.empty() ? face.spacing_mm : face.reaches_mm[i];
  const double inner = least_radius + f - e;
  const bool smooth = !face.curvatures_per_mm.empty() && !face.smooth.empty() && face.smooth[i] != 0;
  if (!smooth || !(inner > 0.0)) return e - f;
  return std::min(e, 0.5 * (1.0 / inner + face.curvatures_per_mm[i]) * e * e) - f;
}

}  // namespace

void Sums::add(const Sums& face, int copies) {
  const double n = copies;
  area += n * face.area;
  covered += n * face.covered;
  reachable += n * face.reachable;
  covered_reachable += n * face.covered_reachable;
  touched += n * face.touched;
  squares += n * face.squares;
  proved += n * face.proved;
  proved_reachable += n * face.proved_reachable;
}

double share_of(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

void add_place(const WorstPlace& deepest, double separation, int count, std::vector<WorstPlace>& worst) {
  std::erase_if(worst, [&](const WorstPlace& w) { return (w.point - deepest.point).norm() < separation; });
  worst.insert(worst.begin(), deepest);
  if (static_cast<int>(worst.size()) > count) worst.resize(static_cast<std::size_t>(std::max(0, count)));
}

FaceTally::FaceTally(const Tool& tool, const Path& path, const std::string& face, bool target, double size_mm,
                     const JudgeOptions& options)
    : tool_(tool),
      path_(path),
      separation_(kWorstSeparation * size_mm),
      tolerance_(options.tolerance_mm),
      least_radius_(smallest_radius(tool)),
      places_(options.worst_places) {
  verdict_.face = face;
  verdict_.target = target;
}

// Whether the strip sweeps past the sample: its nearest sphere belongs to the inside of a strip's path and of the axis.
bool FaceTally::swept_past(const SweptDistance& d) const {
  if (d.strip < 0) return false;
  const double last = static_cast<double>(path_.strips[static_cast<std::size_t>(d.strip)].poses.size()) - 1.0;
  const double length = tool_.radial.axis_length();
  return d.t > kEndShare && d.t < last - kEndShare && d.s > kEndShare * length && d.s < (1.0 - kEndShare) * length;
}

void FaceTally::add_sample(const FaceSamples& samples, std::size_t i, const SweptDistance& d, double open) {
  const double area = samples.areas[i];
  sums_.area += area;
  verdict_.overcut_mm = std::max(verdict_.overcut_mm, -d.f);
  if (!samples.target) return;
  const double left = d.f < kNowhere ? d.f : kInfinity;
  if (left > verdict_.undercut_mm) verdict_.undercut_point = samples.points[i];
  verdict_.undercut_mm = std::max(verdict_.undercut_mm, left);
  const double reachable = samples.reachable.empty() ? area : area * samples.reachable[i];
  sums_.reachable += reachable;
  sums_.proved += area - open;
  sums_.proved_reachable += std::max(0.0, reachable - open);
  if (std::abs(d.f) <= tolerance_) {
    sums_.covered += area;
    sums_.covered_reachable += reachable;
    if (open > largest_open_) {
      largest_open_ = open;
      verdict_.uncovered_point = samples.points[i];
    }
  }
  if (!swept_past(d)) return;
  verdict_.undercut_covered_mm = std::max(verdict_.undercut_covered_mm, d.f);
  sums_.touched += area;
  sums_.squares += area * d.f * d.f;
}

void FaceTally::add(const FaceSamples& samples, std::span<const SweptDistance> distances,
                    std::span<const double> open_mm2) {
  verdict_.samples += samples.points.size();
  verdict_.spacing_mm = std::max(verdict_.spacing_mm, samples.spacing_mm);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    add_sample(samples, i, distances[i], open_mm2.empty() ? samples.areas[i] : open_mm2[i]);
    const double depth = depth_in_cell(samples, i, distances[i].f, least_radius_);
    if (depth <= deepest_between_) continue;
    deepest_between_ = depth;
    between_point_ = samples.points[i];
  }
  add_worst(samples, distances);
}

// The deepest places, each at least a share of the face's size away from deeper ones.
void FaceTally::add_worst(const FaceSamples& samples, std::span<const SweptDistance> distances) {
  std::vector<WorstPlace> all = std::move(worst_);
  const auto shallower = [](double a, double b) { return a > b; };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i].f < 0.0) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shallower(distances[b].f, distances[a].f); });
  worst_.clear();
  std::size_t next = 0;
  const auto take = [&](const WorstPlace& w) {
    const bool close = std::any_of(worst_.begin(), worst_.end(), [&](const WorstPlace& other) {
      return (w.point - other.point).norm() < separation_;
    });
    if (!close) worst_.push_back(w);
  };
  for (std::size_t i : order) {
    if (static_cast<int>(worst_.size()) >= places_) break;
    const SweptDistance& d = distances[i];
    // Places of the tiles before come first where they are as deep.
    while (next < all.size() && all[next].f <= d.f) take(all[next++]);
    if (static_cast<int>(worst_.size()) < places_) take({samples.face, samples.points[i], d.f, d.strip, d.t, d.s});
  }
  while (next < all.size() && static_cast<int>(worst_.size()) < places_) take(all[next++]);
}

void FaceTally::add_histogram(VerifyReport& report, const FaceSamples& samples,
                              std::span<const SweptDistance> distances) const {
  const auto& edges = report.histogram_edges_mm;
  const int bins = static_cast<int>(report.histogram_area_mm2.size());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), distances[i].f) - edges.begin();
    const int bin = std::clamp(static_cast<int>(above) - 1, 0, bins - 1);
    report.histogram_area_mm2[static_cast<std::size_t>(bin)] += samples.areas[i];
  }
}

FaceVerdict FaceTally::verdict() const {
  FaceVerdict out = verdict_;
  out.area_mm2 = sums_.area;
  out.coverage = share_of(sums_.covered, sums_.area);
  out.reachable_share = share_of(sums_.reachable, sums_.area);
  out.coverage_reachable = share_of(sums_.covered_reachable, sums_.reachable);
  out.coverage_bound = share_of(sums_.proved, sums_.area);
  out.coverage_reachable_bound = share_of(sums_.proved_reachable, sums_.reachable);
  out.rms_mm = sums_.touched > 0.0 ? std::sqrt(sums_.squares / sums_.touched) : 0.0;
  out.sampling_bound_mm = std::max(0.0, deepest_between_ - out.overcut_mm);
  out.overcut_bound_mm = out.overcut_mm + out.sampling_bound_mm;
  out.bound_point = between_point_;
  if (!worst_.empty()) out.deepest = worst_.front();
  return out;
}

}  // namespace flank::internal::verify

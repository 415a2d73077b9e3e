#include "flank/correct/measure/error_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "flank/surface/mesh/scattered_spline.h"

namespace flank::internal {
namespace {

constexpr double kOutlier = 5.0;  ///< standard deviations
constexpr int kRounds = 10, kDegree = 3;
/// In the first rounds fields are too stiff to follow points that belong to another pass.
constexpr int kStiffRounds = 5, kStiffCount = 5, kAnyCount = 20;
constexpr std::array<int, 6> kCounts = {4, 5, 7, 10, 14, 20};
constexpr std::size_t kPointsPerUnknown = 3;
constexpr std::size_t kFewest = kPointsPerUnknown * kCounts.front() * kCounts.front();

/// The error of one pass at a place.
struct Sample {
  Vec2 place;
  double error_mm = 0.0;
};

struct Fitted {
  BSplineSurface surface;
  double squares = 0.0, score = 0.0;
  std::size_t unknowns = 0;
};

/// Control points that some sample has a say in: a face may fill a part of its domain, and a pass a part of the face.
std::size_t asked_for(const std::vector<Sample>& samples, int count) {
  const int spans = count - kDegree;
  std::vector<char> asked(static_cast<std::size_t>(count * count), 0);
  const auto span = [&](double x) { return std::clamp(static_cast<int>(x * spans), 0, spans - 1); };
  for (const Sample& sample : samples)
    for (int i = 0; i <= kDegree; ++i)
      for (int j = 0; j <= kDegree; ++j)
        asked[static_cast<std::size_t>((span(sample.place.x()) + i) * count + span(sample.place.y()) + j)] = 1;
  return static_cast<std::size_t>(std::count(asked.begin(), asked.end(), 1));
}

Fitted fitted(const std::vector<Sample>& samples, int count) {
  std::vector<Vec3> values;
  std::vector<Vec2> places;
  for (const Sample& sample : samples) {
    values.emplace_back(sample.error_mm, 0.0, 0.0);
    places.push_back(sample.place);
  }
  Fitted out;
  out.surface =
      fit_scattered(values, places, {.degree = kDegree, .count_u = count, .count_v = count, .smoothing = 1e-4});
  for (const Sample& sample : samples)
    out.squares += std::pow(sample.error_mm - out.surface.value(sample.place.x(), sample.place.y()).x(), 2);
  out.unknowns = asked_for(samples, count);
  const auto n = static_cast<double>(samples.size());
  out.score = out.squares / n / std::pow(1.0 - static_cast<double>(out.unknowns) / n, 2);
  return out;
}

Fitted best_of(const std::vector<Sample>& samples, int largest_count) {
  Fitted best = fitted(samples, kCounts.front());
  for (const int count : kCounts) {
    if (count > largest_count || kPointsPerUnknown * asked_for(samples, count) > samples.size()) break;
    Fitted next = fitted(samples, count);
    if (next.score < 0.98 * best.score) best = std::move(next);
  }
  return best;
}

std::size_t passes_of(const std::vector<MeasuredPoint>& points) {
  return points.empty() ? 1 : std::max<std::size_t>(1, points.front().higher_mm.size());
}

using Samples = std::vector<std::vector<Sample>>;

bool too_few(const Samples& samples) {
  return std::any_of(samples.begin(), samples.end(), [](const auto& of) { return of.size() < kFewest; });
}

/// By how much the second lowest pass lies above the lowest.
double margin(const MeasuredPoint& point) {
  std::vector<double> higher = point.higher_mm;
  if (higher.size() < 2) return std::numeric_limits<double>::infinity();
  std::nth_element(higher.begin(), higher.begin() + 1, higher.end());
  return higher[1];
}

/// What the points say about each pass, if they lie on it. Points where two passes are nearer to each other are left out.
Samples by_pass(const std::vector<MeasuredPoint>& points, const ErrorField& known, double least_margin_mm) {
  Samples samples(passes_of(points));
  for (const MeasuredPoint& point : points) {
    if (margin(point) < least_margin_mm) continue;
    const std::size_t pass = known.lowest(point.u, point.v, point.higher_mm);
    const double higher = point.higher_mm.empty() ? 0.0 : point.higher_mm[pass];
    samples[pass].push_back({Vec2(point.u, point.v), point.error_mm - higher});
  }
  return samples;
}

/// Before anything is known, only points count that the error moves to no other pass.
Samples first_samples(const std::vector<MeasuredPoint>& points) {
  std::vector<double> errors;
  for (const MeasuredPoint& point : points) errors.push_back(point.error_mm);
  Samples samples = by_pass(points, {}, typical(errors));
  return too_few(samples) ? by_pass(points, {}, 0.0) : samples;
}

ErrorField field_of(const std::vector<MeasuredPoint>& points, const ErrorField& known, int largest_count) {
  const std::size_t passes = passes_of(points);
  Samples samples = known.passes.empty() ? first_samples(points) : by_pass(points, known, 0.0);
  if (passes > 1 && too_few(samples)) {
    samples.assign(1, {});
    for (const MeasuredPoint& point : points) samples.front().push_back({Vec2(point.u, point.v), point.error_mm});
  }
  ErrorField field;
  double squares = 0.0, unknowns = 0.0, count = 0.0;
  for (const std::vector<Sample>& of : samples) {
    Fitted best = best_of(of, largest_count);
    count += static_cast<double>(of.size());
    squares += best.squares;
    unknowns += static_cast<double>(best.unknowns);
    field.passes.push_back(std::move(best.surface));
  }
  field.passes.resize(passes, field.passes.front());
  field.noise_mm = std::sqrt(squares / (count - unknowns));
  return field;
}

}  // namespace

double typical(std::vector<double> values) {
  if (values.empty()) return 0.0;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 1.4826 * *middle;
}

double ErrorField::of_pass(std::size_t pass, double u, double v) const {
  return passes[pass].value(std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)).x();
}

std::size_t ErrorField::lowest(double u, double v, const std::vector<double>& higher_mm) const {
  std::size_t lowest = 0;
  double least = 0.0;
  for (std::size_t k = 0; k < higher_mm.size(); ++k) {
    const double left = higher_mm[k] + (passes.empty() ? 0.0 : of_pass(k, u, v));
    if (k == 0 || left < least) least = left, lowest = k;
  }
  return lowest;
}

double ErrorField::at(double u, double v, const std::vector<double>& higher_mm) const {
  const std::size_t pass = lowest(u, v, higher_mm);
  return (higher_mm.empty() ? 0.0 : higher_mm[pass]) + of_pass(pass, u, v);
}

// Each round asks all points again: the first field is bent by those that do not belong.
SmoothedError smoothed_error(const std::vector<MeasuredPoint>& points) {
  SmoothedError out;
  out.points = points;
  for (int round = 0; round < kRounds; ++round) {
    const bool stiff = passes_of(points) > 1 && round < kStiffRounds;
    out.field = field_of(out.points, out.field, stiff ? kStiffCount : kAnyCount);
    if (stiff) continue;
    std::vector<double> rest;
    for (const MeasuredPoint& point : points)
      rest.push_back(point.error_mm - out.field.at(point.u, point.v, point.higher_mm));
    const double most = kOutlier * std::max(typical(rest), 1e-7);
    std::vector<MeasuredPoint> kept;
    std::vector<int> outliers;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (std::abs(rest[k]) <= most)
        kept.push_back(points[k]);
      else
        outliers.push_back(points[k].index);
    }
    const bool settled = round > 0 && outliers == out.outliers && passes_of(points) == 1;
    out.outliers = std::move(outliers);
    if (settled) break;
    out.points = std::move(kept);
  }
  return out;
}

}  // namespace flank::internal

#include "flank/seed/orbit_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

constexpr int kInside = 96;  ///< steps across the target, of its own chart
constexpr int kPast = 8;     ///< more on each side, as far as a chart reaches past the target
constexpr int kSpans = 24;   ///< parts of the width whose ends are told apart
constexpr double kTiny = 1e-300;

/// A point of the target's own chart, whose orbits go along a or along b.
ChartPoint along_and_across(const Chart& chart, bool swapped, double along, double across) {
  return swapped ? chart.at(across, along) : chart.at(along, across);
}

/// The chart's direction that goes with the motion: b?
bool goes_along_b(const Chart& chart, const SelfMotion& motion) {
  constexpr int kPlaces = 9;
  constexpr double kStep = 0.02;
  double along_a = 0.0, along_b = 0.0;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const double a = (i % kPlaces + 0.5) / kPlaces, b = (i / kPlaces + 0.5) / kPlaces;
    const Vec3 v = motion.velocity(chart.at(a, b).point).normalized();
    along_a += std::abs(v.dot((chart.at(a + kStep, b).point - chart.at(a - kStep, b).point).normalized()));
    along_b += std::abs(v.dot((chart.at(a, b + kStep).point - chart.at(a, b - kStep).point).normalized()));
  }
  return along_b > along_a;
}

}  // namespace

OrbitSection::OrbitSection(const Target& target, const Chart& chart, const SelfMotion& motion) : motion_(motion) {
  const bool swapped = goes_along_b(chart, motion);
  std::vector<ChartPoint> line;
  for (int k = -kPast; k <= kInside + kPast; ++k)
    line.push_back(along_and_across(chart, swapped, 0.5, static_cast<double>(k) / kInside));
  lay_out(line);
  spans_ = {times_of_ends(chart, swapped)};
  measure(target);
}

void OrbitSection::lay_out(const std::vector<ChartPoint>& line) {
  // Moved by tau(b), a line x(b) has the tangent x' + tau' v, in the moved frame: across v if tau' = -<x', v> / v^2.
  std::vector<double> times(line.size(), 0.0);
  const auto shift = [&](std::size_t from, std::size_t to) {
    const Vec3 v = motion_.velocity(0.5 * (line[from].point + line[to].point));
    times[to] = times[from] - (line[to].point - line[from].point).dot(v) / v.squaredNorm();
  };
  const std::size_t middle = line.size() / 2;
  for (std::size_t k = middle; k + 1 < line.size(); ++k) shift(k, k + 1);
  for (std::size_t k = middle; k > 0; --k) shift(k, k - 1);
  for (std::size_t k = 0; k < line.size(); ++k)
    points_.push_back({motion_.moved(line[k].point, times[k]), motion_.turned(line[k].normal, times[k])});
  lengths_.assign(line.size(), 0.0);
  const auto step = [&](std::size_t k) { return (points_[k].point - points_[k - 1].point).norm(); };
  for (std::size_t k = kPast + 1; k < line.size(); ++k) lengths_[k] = lengths_[k - 1] + step(k);
  for (std::size_t k = kPast; k > 0; --k) lengths_[k - 1] = lengths_[k] - step(k);
  width_ = lengths_[kPast + kInside];
}

ChartPoint OrbitSection::at(double length) const {
  const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, length);
  const auto k = static_cast<std::size_t>(next - lengths_.begin());
  const double f = (length - lengths_[k - 1]) / std::max(kTiny, lengths_[k] - lengths_[k - 1]);
  const double g = std::clamp(f, 0.0, 1.0);
  return {(1.0 - f) * points_[k - 1].point + f * points_[k].point,
          ((1.0 - g) * points_[k - 1].normal + g * points_[k].normal).normalized()};
}

OrbitSection::Crossing OrbitSection::crossing_of(const Vec3& p, double time) const {
  constexpr int kSteps = 6;  // each takes away what the section's bend within one step leaves
  std::size_t nearest = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 q = motion_.moved(p, -time);
    const auto found = std::min_element(points_.begin(), points_.end(), [&](const ChartPoint& a, const ChartPoint& b) {
      return (a.point - q).squaredNorm() < (b.point - q).squaredNorm();
    });
    nearest = static_cast<std::size_t>(found - points_.begin());
    const Vec3 v = motion_.velocity(found->point);
    time += (q - found->point).dot(v) / v.squaredNorm();
  }
  return {time, lengths_[nearest]};
}

OrbitSection::Crossing OrbitSection::crossing_of(const Vec3& p) const {
  constexpr int kTimes = 32;
  constexpr std::size_t kStride = 4;  // of the section's points, to find the time roughly
  const Span all = span();
  double time = 0.0, least = std::numeric_limits<double>::infinity();
  for (int m = 0; m <= kTimes; ++m) {
    const double at = all.first + (all.last - all.first) * m / kTimes;
    const Vec3 q = motion_.moved(p, -at);
    for (std::size_t k = 0; k < points_.size(); k += kStride) {
      const double square = (points_[k].point - q).squaredNorm();
      if (square < least) least = square, time = at;
    }
  }
  return crossing_of(p, time);
}

OrbitSection::Span OrbitSection::times_of_ends(const Chart& chart, bool swapped) const {
  constexpr int kHalf = 12, kAcross = 2 * kSpans;
  Span span;
  for (int j = 0; j <= kAcross; ++j)
    for (double way : {-0.5, 0.5}) {
      double time = 0.0;
      for (int i = 0; i <= kHalf; ++i) {
        const ChartPoint at = along_and_across(chart, swapped, 0.5 + way * i / kHalf, static_cast<double>(j) / kAcross);
        time = crossing_of(at.point, time).time;
        span = {std::min(span.first, time), std::max(span.last, time)};
      }
    }
  return span;
}

void OrbitSection::measure(const Target& target) {
  constexpr double kSpacing = 1.0 / 40.0;  // of the square root of the area
  const double spacing = kSpacing * std::sqrt(target.area());
  std::vector<Crossing> crossings;
  for (const SurfaceSample& sample : target.samples(spacing)) crossings.push_back(crossing_of(sample.point));
  for (const Vec3& point : target.border_points(spacing)) crossings.push_back(crossing_of(point));
  // A chart is rough at its borders: where the section ends, the target's own points tell.
  double low = width_, high = 0.0;
  for (const Crossing& crossing : crossings) {
    low = std::min(low, crossing.length);
    high = std::max(high, crossing.length);
  }
  for (double& length : lengths_) length -= low;
  width_ = high - low;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  spans_.assign(kSpans, {kNone, -kNone});
  for (const Crossing& crossing : crossings) {
    const int part = std::clamp(static_cast<int>(kSpans * (crossing.length - low) / width_), 0, kSpans - 1);
    Span& span = spans_[static_cast<std::size_t>(part)];
    span = {std::min(span.first, crossing.time), std::max(span.last, crossing.time)};
  }
  // A part that no point of the target passes has its neighbours' ends.
  for (std::size_t k = 1; k < spans_.size(); ++k)
    if (spans_[k].last < spans_[k].first) spans_[k] = spans_[k - 1];
  for (std::size_t k = spans_.size() - 1; k > 0; --k)
    if (spans_[k - 1].last < spans_[k - 1].first) spans_[k - 1] = spans_[k];
}

OrbitSection::Span OrbitSection::span_at(double length) const {
  const int part = std::clamp(static_cast<int>(kSpans * length / width_), 0, kSpans - 1);
  return spans_[static_cast<std::size_t>(part)];
}

OrbitSection::Span OrbitSection::span() const {
  Span all = spans_.front();
  for (const Span& span : spans_) all = {std::min(all.first, span.first), std::max(all.last, span.last)};
  return all;
}

Chart orbit_chart(const OrbitSection& section) {
  const OrbitSection::Span span = section.span();
  return Chart([&](double a, double b) -> ChartPoint {
    const ChartPoint at = section.at(b * section.width());
    const double time = span.first + a * (span.last - span.first);
    return {section.motion().moved(at.point, time), section.motion().turned(at.normal, time)};
  });
}

}  // namespace flank::internal

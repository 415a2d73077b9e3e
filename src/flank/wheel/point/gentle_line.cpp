#include "flank/wheel/point/gentle_line.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kStepMm = 0.25;  ///< between places of the line
constexpr double kFirstMm = 0.5;  ///< deviation of the first weights
constexpr double kWiderBy = 1.41421356237309505;
constexpr double kWidestMm = 64.0;  ///< of the deviations that are tried
constexpr double kReach = 3.0;      ///< deviations: what is farther has no weight
constexpr double kEndMm = 4.0;      ///< of a line's end, that says how the channel goes on

/// A line that goes on beyond its ends beside another one, or, where that has ended, too, as both of them together ran there.
class LongLine {
 public:
  LongLine(const SideLine& own, const SideLine& other) : own_(own), other_(other) {}
  [[nodiscard]] double angle(double way) const {
    if (way >= own_.from() && way <= own_.to()) return own_.angle(way);
    const bool before = way < own_.from();
    const double end = before ? own_.from() : own_.to(), reach = before ? std::max(way, std::min(end, other_.from()))
                                                                        : std::min(way, std::max(end, other_.to()));
    const double beside = own_.angle(end) + other_.angle(reach) - other_.angle(end);
    return beside + (way - reach) * slope(before);
  }

 private:
  [[nodiscard]] double slope(bool before) const {
    const auto of = [&](const SideLine& line) {
      const double mm = std::min(kEndMm, 0.5 * (line.to() - line.from()));
      return before ? (line.angle(line.from() + mm) - line.angle(line.from())) / mm
                    : (line.angle(line.to()) - line.angle(line.to() - mm)) / mm;
    };
    return 0.5 * (of(own_) + of(other_));
  }
  const SideLine &own_, &other_;
};

/// Means of the places around each, with the weights of a normal distribution; beyond the ends the line goes on straight.
std::vector<double> evened(const std::vector<double>& values, double deviation_mm) {
  const auto n = static_cast<int>(values.size()), reach = static_cast<int>(std::ceil(kReach * deviation_mm / kStepMm));
  std::vector<double> weights;
  for (int k = 0; k <= reach; ++k) weights.push_back(std::exp(-0.5 * std::pow(k * kStepMm / deviation_mm, 2)));
  const auto at = [&](int i) {
    const auto last = static_cast<std::size_t>(n) - 1;
    if (i < 0) return values[0] + i * (values[1] - values[0]);
    if (i >= n) return values[last] + (i - n + 1) * (values[last] - values[last - 1]);
    return values[static_cast<std::size_t>(i)];
  };
  std::vector<double> out;
  for (int i = 0; i < n; ++i) {
    double sum = weights[0] * at(i), whole = weights[0];
    for (int k = 1; k <= reach; ++k) {
      const double w = weights[static_cast<std::size_t>(k)];
      sum += w * (at(i - k) + at(i + k)), whole += 2.0 * w;
    }
    out.push_back(sum / whole);
  }
  return out;
}

/// 1/mm, the most of all places.
double bend_of(const std::vector<double>& angles, const FloorMap& map) {
  double most = 0.0;
  for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
    const double second = angles[i - 1] - 2.0 * angles[i] + angles[i + 1];
    most = std::max(most, std::abs(second) * map.radius(static_cast<double>(i) * kStepMm) / (kStepMm * kStepMm));
  }
  return most;
}

double value(const std::vector<double>& values, double way) {
  const double x = std::clamp(way / kStepMm, 0.0, static_cast<double>(values.size()) - 1.0);
  const auto k = std::min(static_cast<std::size_t>(x), values.size() - 2);
  return std::lerp(values[k], values[k + 1], x - static_cast<double>(k));
}

}  // namespace

GentleLine::GentleLine(const SideLine& own, const SideLine& other, const FloorMap& map, double radius_mm) {
  const LongLine line(own, other);
  const int count = std::max(3, static_cast<int>(std::ceil(map.length() / kStepMm)) + 1);
  for (int k = 0; k < count; ++k) exact_.push_back(line.angle(k * kStepMm));
  angles_ = exact_;
  for (double mm = kFirstMm; mm <= kWidestMm && bend_of(angles_, map) * radius_mm > 1.0; mm *= kWiderBy)
    angles_ = evened(exact_, mm);
}

double GentleLine::angle(double way) const { return value(angles_, way); }

double GentleLine::off(double way) const { return std::abs(value(exact_, way) - value(angles_, way)); }

}  // namespace flank::internal

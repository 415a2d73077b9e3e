#include "flank/correct/motion/path_motions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr int kPosesPerControl = 8;
constexpr std::array<int, 4> kCounts = {24, 36, 60, 96};

/// Both ends of the axis as one point: what a rail goes through.
using Ends = Eigen::Matrix<double, 6, 1>;

Ends ends_of(const Pose& pose, double length) {
  Ends ends;
  ends << pose.tip, pose.at(length);
  return ends;
}

/// A strip by its way: cubic from pose to pose.
class Way {
 public:
  Way(const Strip& strip, double length) : length_(length) {
    for (const Pose& pose : strip.poses) {
      const Ends ends = ends_of(pose, length);
      const double step = ends_.empty() ? 0.0 : (ends - ends_.back()).norm();
      if (!ends_.empty() && step == 0.0) continue;
      way_.push_back(ends_.empty() ? 0.0 : way_.back() + step);
      ends_.push_back(ends);
    }
    if (ends_.size() < 2)
      throw InputError("strip " + std::to_string(strip.id) + " of the path has less than two poses");
    for (std::size_t k = 0; k < ends_.size(); ++k) slopes_.push_back(slope(k));
  }

  /// share 0: the first pose, 1: the last.
  [[nodiscard]] Pose at(double share) const {
    const double w = share * way_.back();
    const auto after = std::upper_bound(way_.begin() + 1, way_.end() - 1, w);
    const auto k = static_cast<std::size_t>(after - way_.begin()) - 1;
    const double h = way_[k + 1] - way_[k], x = (w - way_[k]) / h, y = 1.0 - x;
    const Ends ends = y * y * (1.0 + 2.0 * x) * ends_[k] + x * x * (1.0 + 2.0 * y) * ends_[k + 1] +
                      h * x * y * (y * slopes_[k] - x * slopes_[k + 1]);
    const Vec3 tip = ends.head<3>(), top = ends.tail<3>();
    return {tip, (top - tip).normalized()};
  }
  [[nodiscard]] double length() const { return length_; }

 private:
  [[nodiscard]] Ends chord(std::size_t k) const { return (ends_[k + 1] - ends_[k]) / (way_[k + 1] - way_[k]); }
  /// Of the parabola through three poses.
  [[nodiscard]] Ends slope(std::size_t k) const {
    const std::size_t last = ends_.size() - 1;
    if (last == 1) return chord(0);
    if (k == 0) return 2.0 * chord(0) - slope(1);
    if (k == last) return 2.0 * chord(last - 1) - slope(last - 1);
    const double before = way_[k] - way_[k - 1], after = way_[k + 1] - way_[k];
    return (after * chord(k - 1) + before * chord(k)) / (before + after);
  }

  double length_;
  std::vector<double> way_;
  std::vector<Ends> ends_, slopes_;
};

RuledMotion through(const Way& way, int count) {
  std::vector<Pose> poses;
  std::vector<double> times;
  const int last = kPosesPerControl * count;
  for (int k = 0; k <= last; ++k) {
    times.push_back(static_cast<double>(k) / last);
    poses.push_back(way.at(times.back()));
  }
  return fit_motion(poses, times, way.length(), count);
}

/// Largest distance of the strip from the motion, by its way.
double off(const Way& way, const RuledMotion& motion) {
  constexpr int kPlaces = 1000;
  double largest = 0.0;
  for (int k = 0; k <= kPlaces; ++k) {
    const double share = static_cast<double>(k) / kPlaces;
    const Pose wanted = way.at(share), is = motion.pose(share);
    largest = std::max({largest, (wanted.tip - is.tip).norm(), (wanted.at(way.length()) - is.at(way.length())).norm()});
  }
  return largest;
}

}  // namespace

std::vector<RuledMotion> motions_through(const Path& path, double axis_length, double near_mm) {
  std::vector<Way> ways;
  for (const Strip& strip : path.strips) ways.emplace_back(strip, axis_length);
  std::vector<RuledMotion> motions;
  for (const int count : kCounts) {
    motions.clear();
    double largest = 0.0;
    for (const Way& way : ways) {
      motions.push_back(through(way, count));
      largest = std::max(largest, off(way, motions.back()));
    }
    if (largest <= near_mm) break;
  }
  return motions;
}

}  // namespace flank::internal

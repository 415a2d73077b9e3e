#include "flank/verify/reach_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace flank::internal::verify {
namespace {

using Key = std::array<long long, 3>;

/// Samples by cubes in which no neighbour of a sample is farther than the next cube.
class Neighbours {
 public:
  explicit Neighbours(const FaceSamples& samples) : samples_(samples) {
    for (std::size_t i = 0; i < samples.points.size(); ++i) cubes_[key(samples.points[i])].push_back(i);
  }

  /// Is any sample beside this one what this one is not: reachable, or out of reach?
  [[nodiscard]] bool differ(std::size_t i) const {
    const Key middle = key(samples_.points[i]);
    for (long long a = -1; a <= 1; ++a)
      for (long long b = -1; b <= 1; ++b)
        for (long long c = -1; c <= 1; ++c)
          if (const auto found = cubes_.find({middle[0] + a, middle[1] + b, middle[2] + c});
              found != cubes_.end() && std::any_of(found->second.begin(), found->second.end(), [&](std::size_t j) {
                return is_beside(i, j) && reached(i) != reached(j);
              }))
            return true;
    return false;
  }

 private:
  [[nodiscard]] Key key(const Vec3& p) const {
    const double side = 2.0 * samples_.spacing_mm;
    return {std::llround(p.x() / side), std::llround(p.y() / side), std::llround(p.z() / side)};
  }
  [[nodiscard]] double size(std::size_t i) const {
    return samples_.reaches_mm.empty() ? samples_.spacing_mm : samples_.reaches_mm[i];
  }
  [[nodiscard]] bool is_beside(std::size_t i, std::size_t j) const {
    return (samples_.points[i] - samples_.points[j]).norm() <= size(i) + size(j);
  }
  [[nodiscard]] bool reached(std::size_t i) const { return samples_.reachable[i] > 0.0; }

  const FaceSamples& samples_;
  std::map<Key, std::vector<std::size_t>> cubes_;
};

}  // namespace

std::vector<std::size_t> reach_border(const FaceSamples& samples) {
  const std::vector<double>& shares = samples.reachable;
  const auto whole = [](double share) { return share == 0.0 || share == 1.0; };
  if (std::all_of(shares.begin(), shares.end(), [&](double share) { return share == shares.front() && whole(share); }))
    return {};
  const Neighbours neighbours(samples);
  std::vector<std::size_t> border;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (!whole(shares[i]) || neighbours.differ(i)) border.push_back(i);
  return border;
}

}  // namespace flank::internal::verify

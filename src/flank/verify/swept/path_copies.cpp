#include "flank/verify/swept/path_copies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace flank::internal::verify {
namespace {

/// Of the size of a path: poses that are nearer are equal. Turned in double precision they are a hundredth of that apart.
constexpr double kRounding = 1e-13;
constexpr double kLeastRounding = 1e-12;  ///< mm
constexpr std::size_t kMostFitted = 64;   ///< poses by which a motion is found; all of them are held against it

const std::vector<Pose>& poses_of(const Path& path, std::size_t strip) { return path.strips[strip].poses; }

/// Whether the strips are as long as those `period` before them.
bool repeats_lengths(const Path& path, std::size_t period) {
  for (std::size_t k = period; k < path.strips.size(); ++k)
    if (poses_of(path, k).size() != poses_of(path, k - period).size()) return false;
  return true;
}

/// The motion that takes tips and upper ends of the first `period` strips to those from `first` on, by the least squares of some of them.
std::optional<Turn> fitted(const Path& path, std::size_t period, std::size_t first, double length) {
  std::vector<std::pair<const Pose*, const Pose*>> pairs;
  for (std::size_t k = 0; k < period; ++k)
    for (std::size_t i = 0; i < poses_of(path, k).size(); ++i)
      pairs.emplace_back(&poses_of(path, k)[i], &poses_of(path, first + k)[i]);
  const std::size_t step = pairs.size() / kMostFitted + 1, count = (pairs.size() + step - 1) / step;
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(2 * count)), to = from;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [a, b] = pairs[k * step];
    const auto at = static_cast<Eigen::Index>(2 * k);
    from.col(at) = a->tip, from.col(at + 1) = a->at(length);
    to.col(at) = b->tip, to.col(at + 1) = b->at(length);
  }
  if (!from.allFinite() || !to.allFinite()) return {};
  Turn turn;
  turn.forth.matrix() = Eigen::umeyama(from, to, false);
  turn.back = turn.forth.inverse(Eigen::Isometry);
  return turn;
}

bool moves_all(const Turn& turn, const Path& path, std::size_t period, std::size_t first, double length) {
  for (std::size_t k = 0; k < period; ++k)
    for (std::size_t i = 0; i < poses_of(path, k).size(); ++i) {
      const Pose &a = poses_of(path, k)[i], &b = poses_of(path, first + k)[i];
      const Vec3 low = turn.forth * a.tip - b.tip, high = turn.forth * a.at(length) - b.at(length);
      const double size = b.tip.cwiseAbs().maxCoeff() + length, most = std::max(kLeastRounding, kRounding * size);
      if (!(std::max(low.norm(), high.norm()) <= most)) return false;
    }
  return true;
}

std::optional<PathCopies> copies_of(const Path& path, std::size_t period, double length) {
  if (!repeats_lengths(path, period)) return {};
  PathCopies out{period, {Turn{}}};
  for (std::size_t first = period; first < path.strips.size(); first += period) {
    const std::optional<Turn> turn = fitted(path, period, first, length);
    if (!turn || !moves_all(*turn, path, period, first, length)) return {};
    out.turns.push_back(*turn);
  }
  return out;
}

}  // namespace

PathCopies find_copies(const Path& path, double axis_length_mm) {
  const std::size_t count = path.strips.size();
  // Of a single strip a copy is not worth the turns.
  for (std::size_t period = 2; 2 * period <= count; ++period)
    if (count % period == 0)
      if (std::optional<PathCopies> copies = copies_of(path, period, axis_length_mm)) return *std::move(copies);
  return {count, {Turn{}}};
}

}  // namespace flank::internal::verify

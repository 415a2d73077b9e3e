#include "flank/seed/line_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// A movability, squared sine of an angle, that is round-off of the normals.
constexpr double kExact = 1e-15;
/// Of the axis length, for central differences: their error is 2e-11 of the third derivative, and round-off, 1e-16 /
/// kDifference, about as much.
constexpr double kDifference = 1e-5;
/// Damping in mean diagonals: the first makes a step that is nearly Gauss-Newton's, the most one that is nothing. Up by
/// ten after a refusal, down by a hundred after a success, since the problem has four unknowns and every trial is cheap
/// against the eight of a derivative.
constexpr double kFirstDamping = 1e-3, kMostDamping = 1e6, kMore = 10.0, kLess = 1e-2;
/// A line may not become better by losing footpoints; this is round-off of their weight.
constexpr double kSameWeight = 1e-9;

using Vec4 = Eigen::Vector4d;

/// The line of four shifts: of the tip along e1, e2 and of the holder end along e1, e2. Rigid, about the middle.
struct Shifts {
  Pose start;
  double length;
  Vec3 e1, e2;

  [[nodiscard]] Pose pose(const Vec4& x) const {
    const Vec3 a = start.tip + x[0] * e1 + x[1] * e2, b = start.at(length) + x[2] * e1 + x[3] * e2;
    const Vec3 u = (b - a).normalized();
    return {0.5 * (a + b) - 0.5 * length * u, u};
  }
};

class Objective {
 public:
  Objective(const Target& target, const Shifts& shifts, int samples)
      : target_(target), shifts_(shifts), feet_(static_cast<std::size_t>(samples)) {
    track_axis(target_, shifts_.start, shifts_.length, feet_);
  }

  /// Residuals <n_j, v(s_j)> at the best velocity, weighted so that their squares sum to the movability.
  Movability at(const Vec4& x, Eigen::VectorXd& residuals) {
    ++evaluations_;
    const Pose pose = shifts_.pose(x);
    track_axis(target_, pose, shifts_.length, feet_);
    MovabilityOptions form;
    form.previous = heading_;
    const Movability m = movability(feet_, pose, shifts_.length, form);
    const auto n = static_cast<Eigen::Index>(feet_.size());
    residuals.resize(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Footpoint& foot = feet_[static_cast<std::size_t>(j)];
      const double s = shifts_.length * static_cast<double>(j) / static_cast<double>(n - 1);
      const double share = footpoint_weight(foot.location) / (m.weight * static_cast<double>(n));
      residuals[j] = m.valid() ? std::sqrt(share) * foot.normal.dot(m.velocity.at(s, shifts_.length)) : 0.0;
    }
    return m;
  }
  /// Keeps the sign of the velocity, which the form leaves open: else residuals of two evaluations could differ in it.
  void keep_heading(const Vec3& heading) { heading_ = heading; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  const Target& target_;
  const Shifts& shifts_;
  std::vector<Footpoint> feet_;
  Vec3 heading_ = Vec3::Zero();
  int evaluations_ = 0;
};

bool better(const Movability& a, const Movability& b) { return a.value < b.value && a.weight > b.weight - kSameWeight; }

}  // namespace

LineSearch search_line(const Target& target, const Pose& start, double axis_length, const LineSearchOptions& options) {
  FLANK_ASSERT(options.samples >= 2 && axis_length > 0.0);
  const Vec3 e1 = start.axis.unitOrthogonal();
  const Shifts shifts{start, axis_length, e1, start.axis.cross(e1)};
  Objective objective(target, shifts, options.samples);
  const double radius = options.radius_share * target.diagonal(), h = kDifference * axis_length;
  Vec4 x = Vec4::Zero();
  Eigen::VectorXd e, e_trial;
  Movability best = objective.at(x, e);
  LineSearch result{start, best, best, 0.0, 0};
  objective.keep_heading(best.velocity.middle);
  Eigen::MatrixXd jacobian(options.samples, 4);
  double damping = kFirstDamping;
  for (int iteration = 0; iteration < options.iterations && best.valid() && best.value > kExact; ++iteration) {
    for (int k = 0; k < 4; ++k) {
      Eigen::VectorXd low, high;
      (void)objective.at(x + h * Vec4::Unit(k), high);
      (void)objective.at(x - h * Vec4::Unit(k), low);
      jacobian.col(k) = (high - low) / (2.0 * h);
    }
    const Eigen::Matrix4d normal = jacobian.transpose() * jacobian;
    bool accepted = false;
    for (; damping < kMostDamping && !accepted; damping *= kMore) {
      const Eigen::Matrix4d damped = normal + damping * normal.trace() / 4.0 * Eigen::Matrix4d::Identity();
      Vec4 trial = x - damped.ldlt().solve(jacobian.transpose() * e);
      if (!trial.allFinite()) break;
      // The ball of admissible shifts is convex: a step that leaves it is pulled back to it.
      const double far = std::max(trial.head<2>().norm(), trial.tail<2>().norm());
      if (far > radius) trial *= radius / far;
      const Movability m = objective.at(trial, e_trial);
      accepted = m.valid() && better(m, best);
      if (!accepted) continue;
      x = trial;
      e = e_trial;
      best = m;
      damping *= kLess;
    }
    if (!accepted) break;
  }
  result.pose = shifts.pose(x);
  result.after = best;
  result.shift_mm = std::max(x.head<2>().norm(), x.tail<2>().norm());
  result.evaluations = objective.evaluations();
  return result;
}

}  // namespace flank::internal

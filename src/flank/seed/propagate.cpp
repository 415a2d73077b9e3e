#include "flank/seed/propagate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/seed/movability.h"

namespace flank::internal {
namespace {

/// Share of the trace that holds a coordinate of a correction which the distances hardly see: shift out of the surface,
/// slide, turn out of the surface, turn in it.
const Eigen::Vector4d kCorrectionDamping(1e-6, 1e-5, 1e-6, 1e-5);
/// Gauss-Newton passes of a correction: the first leaves the square of a small drift, the second nothing.
constexpr int kCorrections = 2;
/// A correction below this share of the step lets the next one be longer, by kGrow; refused steps are halved, so that
/// what was too long is not tried again at once.
constexpr double kGrowShare = 0.05, kGrow = 1.5;
/// In traces, on slide and turns: so stiff that only the mean distance is corrected.
constexpr double kHeld = 1e12;

class Walker {
 public:
  Walker(const Target& target, const Pose& start, double axis_length, const PropagationOptions& options)
      : target_(target), length_(axis_length), feet_(static_cast<std::size_t>(options.samples)), trial_(feet_.size()) {
    track_axis(target_, start, length_, feet_);
    for (const Footpoint& foot : feet_) profile_.push_back(foot.distance);
  }

  /// Velocity at a pose near the current one; its footpoints are left in trial().
  Movability velocity(const Pose& pose, const AxisVelocity& previous) {
    std::copy(feet_.begin(), feet_.end(), trial_.begin());
    track_axis(target_, pose, length_, trial_);
    return next_velocity(trial_, pose, length_, previous);
  }

  /// One classical Runge-Kutta step of length h; false if the velocity is not defined on the way.
  bool step(const Pose& pose, const AxisVelocity& k1, double h, Pose& next) {
    const Movability k2 = velocity(moved(pose, k1, length_, 0.5 * h), k1);
    if (!k2.valid()) return false;
    const Movability k3 = velocity(moved(pose, k2.velocity, length_, 0.5 * h), k1);
    if (!k3.valid()) return false;
    const Movability k4 = velocity(moved(pose, k3.velocity, length_, h), k1);
    if (!k4.valid()) return false;
    const auto mean = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      return Vec3((a + 2.0 * b + 2.0 * c + d) / 6.0);
    };
    next = moved(pose,
                 {mean(k1.middle, k2.velocity.middle, k3.velocity.middle, k4.velocity.middle),
                  mean(k1.omega, k2.velocity.omega, k3.velocity.omega, k4.velocity.omega)},
                 length_, h);
    return true;
  }

  /// Least-squares change of a pose that brings its distances back to the start's, the travel held; not `whole`: only
  /// their mean, by a shift. Returns the displacement of the end that moved farther, mm.
  double correct(Pose& pose, const Vec3& heading, bool whole);

  /// The trial footpoints become those of the current pose.
  void accept() { std::swap(feet_, trial_); }
  [[nodiscard]] double trial_inside_share() const {
    const auto inside = [](const Footpoint& f) { return f.location == Location::kInside; };
    return static_cast<double>(std::count_if(trial_.begin(), trial_.end(), inside)) /
           static_cast<double>(trial_.size());
  }
  [[nodiscard]] double trial_drift() const;

 private:
  const Target& target_;
  double length_;
  std::vector<Footpoint> feet_, trial_;
  std::vector<double> profile_;
};

double Walker::correct(Pose& pose, const Vec3& heading, bool whole) {
  using Vec4 = Eigen::Vector4d;
  const double last = static_cast<double>(feet_.size()) - 1.0;
  const Pose before = pose;
  std::copy(feet_.begin(), feet_.end(), trial_.begin());
  track_axis(target_, pose, length_, trial_);
  for (int pass = 0; pass < kCorrections; ++pass) {
    const Vec3 along = (heading - heading.dot(pose.axis) * pose.axis).normalized(), up = pose.axis.cross(along);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Vec4 rhs = Vec4::Zero();
    for (std::size_t j = 0; j < trial_.size(); ++j) {
      const double w = footpoint_weight(trial_[j].location);
      // Distance's derivative by: shift out of the surface, slide, turn out of the surface, turn in it. rho in [-1, 1]
      // makes turns lengths at the ends of the axis. Shift along the heading is the travel, which is held.
      const double rho = 2.0 * static_cast<double>(j) / last - 1.0;
      const Vec3& n = trial_[j].normal;
      const Vec4 row(n.dot(up), n.dot(pose.axis), rho * n.dot(up), rho * n.dot(along));
      normal += w * row * row.transpose();
      rhs += w * (profile_[j] - trial_[j].distance) * row;
    }
    const double trace = normal.trace();
    if (!(trace > 0.0)) break;
    normal.diagonal() += trace * kCorrectionDamping;
    if (!whole) normal.diagonal().tail<3>().setConstant(kHeld * trace);
    const Vec4 x = normal.ldlt().solve(rhs);
    const AxisVelocity change{x[0] * up + x[1] * pose.axis, (2.0 / length_) * (x[2] * up + x[3] * along)};
    pose = moved(pose, change, length_, 1.0);
    track_axis(target_, pose, length_, trial_);
  }
  return farther_end(before, pose, length_);
}

double Walker::trial_drift() const {
  // Past the border the distances are those of an extrapolation: no drift of anything.
  double sum = 0.0;
  int count = 0;
  for (std::size_t j = 0; j < trial_.size(); ++j) {
    if (trial_[j].location != Location::kInside) continue;
    sum += std::pow(trial_[j].distance - profile_[j], 2);
    ++count;
  }
  return count == 0 ? 0.0 : std::sqrt(sum / count);
}

/// Past the border the surface is only extrapolated: the last motion goes on as it is.
void add_overrun(const AxisVelocity& velocity, double axis_length, double length, Propagation& out) {
  constexpr int kSteps = 4;  // poses, so that a spline through them goes straight on
  for (int k = 0; k < kSteps; ++k) {
    out.poses.push_back(moved(out.poses.back(), velocity, axis_length, length / kSteps));
    out.travel_mm.push_back(out.travel_mm.back() + length / kSteps);
  }
}

/// One accepted step from `pose`: its length is `h`, which is shortened as needed and made longer for the next step.
bool advance(Walker& walker, const Pose& pose, const AxisVelocity& velocity, double size,
             const PropagationOptions& options, double& h, double& next_h, Pose& next) {
  for (; h >= options.shortest_step_share * size; h *= 0.5) {
    if (!walker.step(pose, velocity, h, next)) continue;
    const double allowed = options.correction_share * h;
    const double done = walker.correct(next, velocity.middle, true);
    const bool is_short = h <= options.first_step_share * size;
    // Where the line leaves the target it does so by a short step.
    if (walker.trial_inside_share() == 0.0 && !is_short) continue;
    next_h = std::min((done < kGrowShare * h ? kGrow : 1.0) * h, options.longest_step_share * size);
    if (done <= allowed) return true;
    if (!is_short) continue;
    // The distances cannot all be kept without turning away: their mean can.
    return walker.step(pose, velocity, h, next) && (walker.correct(next, velocity.middle, false), true);
  }
  return false;
}

}  // namespace

Propagation propagate(const Target& target, const Pose& start, double axis_length, const Vec3& heading,
                      const PropagationOptions& options) {
  FLANK_ASSERT(options.samples >= 2 && axis_length > 0.0);
  FLANK_ASSERT(options.shortest_step_share <= options.longest_step_share);
  const double size = target.diagonal();
  Propagation out;
  out.poses.push_back(start);
  out.travel_mm.push_back(0.0);
  Walker walker(target, start, axis_length, options);
  Movability at = walker.velocity(start, {heading - heading.dot(start.axis) * start.axis, Vec3::Zero()});
  double h = options.first_step_share * size, next_h = h;
  while (at.valid() && at.value <= options.movability_limit) {
    Pose next;
    out.end = PropagationEnd::kStep;
    if (!advance(walker, out.poses.back(), at.velocity, size, options, h, next_h, next)) return out;
    walker.accept();
    // What the corrections have found of slide and turn is kept.
    const AxisVelocity last = mean_velocity(out.poses.back(), next, axis_length, h);
    out.poses.push_back(next);
    out.travel_mm.push_back(out.travel_mm.back() + h);
    ++out.steps;
    h = next_h;
    at = walker.velocity(next, last);
    if (walker.trial_inside_share() == 0.0) {
      add_overrun(at.valid() ? at.velocity : last, axis_length, options.overrun_share * size, out);
      out.end = PropagationEnd::kBorder;
      return out;
    }
    out.worst_movability = std::max(out.worst_movability, at.value);
    out.worst_drift_mm = std::max(out.worst_drift_mm, walker.trial_drift());
    out.end = PropagationEnd::kTravel;
    if (out.travel_mm.back() > options.longest_travel_share * size) return out;
  }
  out.end = PropagationEnd::kMovability;
  return out;
}

}  // namespace flank::internal

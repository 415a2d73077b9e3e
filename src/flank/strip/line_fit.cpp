#include "flank/strip/line_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/seed/movability.h"

namespace flank::internal {
namespace {

/// Rounds of Lawson's weights in a step. They converge linearly, and the best round is kept; each is a 5 x 5 solve,
/// which costs little beside the footpoints. The next step of Gauss-Newton goes on where this one stopped.
constexpr int kLawsonSteps = 14;
/// Errors beyond this share of the tolerance are evened out by Lawson's weights; below it least squares is as good.
constexpr double kLawsonFrom = 0.4;
/// Added to the factor of each of Lawson's weights: a sample whose error is zero in one round would otherwise have
/// weight zero for ever, whatever its error becomes.
constexpr double kLawsonFloor = 1e-3;
/// Weight of a coordinate that must not change. All others are at most about 1, since the samples' weights sum to one
/// and no entry of a row exceeds 1: so the coordinate moves by 1e-9 of what it would.
constexpr double kHeld = 1e9;
/// A step moves no end by more than this share of the axis: the distances are not linear over more.
constexpr double kLongestStep = 0.15;
constexpr double kSettled = 1e-3;  ///< a step below this share of the tolerance ends the iteration
/// So does a step that lowers the error by less than this share: what it still may gain is not worth its footpoints.
constexpr double kLeastGain = 0.01;
/// A step that makes the error larger than this many times the last plus a tolerance has lost the line.
constexpr double kLost = 2.0;
/// Damping tried one after the other until a step is short enough: from what changes no digit of a well-posed problem
/// (whose matrix has a trace of about 1) to what leaves a step of 1e-4 of the error. Thirtyfold steps: nine trials at
/// most.
constexpr double kFirstDamping = 1e-8, kMostDamping = 1e4, kDampingFactor = 30.0;
/// Length of travel across the axis below which it gives no direction (travel is of the order of 1).
constexpr double kNoTravel = 1e-9;

}  // namespace

LineFrame line_frame(const Pose& pose, const Vec3& travel) {
  Vec3 e1 = travel - travel.dot(pose.axis) * pose.axis;
  if (e1.norm() < kNoTravel) e1 = pose.axis.unitOrthogonal();
  e1.normalize();
  return {e1, pose.axis.cross(e1), pose.axis};
}

Pose moved_line(const Pose& pose, double axis_length, const LineFrame& frame, const Vec5& x) {
  const Vec3 middle = pose.at(0.5 * axis_length) + x[0] * frame.e1 + x[1] * frame.e2 + x[2] * frame.u;
  const Vec3 axis = (pose.axis + (2.0 / axis_length) * (x[3] * frame.e1 + x[4] * frame.e2)).normalized();
  return {middle - 0.5 * axis_length * axis, axis};
}

Vec5 distance_row(const LineFrame& frame, const Vec3& normal, double rho) {
  const double a = normal.dot(frame.e1), b = normal.dot(frame.e2);
  Vec5 row;
  row << a, b, normal.dot(frame.u), rho * a, rho * b;
  return row;
}

LineFitter::LineFitter(const Target& target, const RadialFunction& radial, const LineFitOptions& options)
    : target_(target), length_(radial.axis_length()), options_(options) {
  FLANK_ASSERT(options.samples >= 2 && options.tolerance_mm > 0.0);
  const auto n = static_cast<std::size_t>(options.samples);
  for (std::size_t j = 0; j < n; ++j) {
    s_.push_back(length_ * static_cast<double>(j) / (static_cast<double>(n) - 1.0));
    radius_.push_back(radial.at(s_.back()).r);
  }
  feet_.resize(n);
  rows_.resize(n);
  errors_.resize(n);
  weights_.resize(n);
  base_weights_.resize(n);
}

void LineFitter::forget() { std::fill(feet_.begin(), feet_.end(), Footpoint{}); }

void LineFitter::set_feet(std::span<const Footpoint> feet) {
  FLANK_ASSERT(feet.size() == feet_.size());
  std::copy(feet.begin(), feet.end(), feet_.begin());
}

LineFit LineFitter::measure(const Pose& pose) {
  track_axis(target_, pose, length_, feet_);
  LineFit fit;
  fit.pose = pose;
  double largest = 0.0;
  std::size_t inside = 0;
  for (std::size_t j = 0; j < feet_.size(); ++j) {
    errors_[j] = feet_[j].distance - radius_[j];
    if (feet_[j].location != Location::kInside) continue;
    ++inside;
    largest = std::max(largest, std::abs(errors_[j]));
  }
  if (inside > 0) fit.largest_mm = largest;
  fit.inside_share = static_cast<double>(inside) / static_cast<double>(feet_.size());
  return fit;
}

Footpoint LineFitter::trimmed_foot(const Pose& pose, std::size_t j, double depth_mm) const {
  if (feet_[j].location == Location::kInside) return feet_[j];
  // Past the border only what is near can be deep: a horizon spares most of the search.
  const double horizon = radius_[j] - depth_mm;
  return horizon > 0.0 ? target_.closest_within(pose.at(s_[j]), horizon) : Footpoint{};
}

// Beside the border the sign of the distance says only on which side of the tangent plane the point lies: a sphere that
// reaches round the border cuts it from either side.
double LineFitter::depth(const Footpoint& foot, std::size_t j) const {
  return radius_[j] - (foot.location == Location::kInside ? foot.distance : std::abs(foot.distance));
}

double LineFitter::overcut(const Pose& pose, double least_mm) const {
  // What was found deep already is the horizon of the next search, so most samples cost nothing.
  double worst = least_mm;
  for (std::size_t j = 0; j < feet_.size(); ++j) {
    const Footpoint foot = trimmed_foot(pose, j, worst);
    if (foot.patch >= 0) worst = std::max(worst, depth(foot, j));
  }
  return worst;
}

double LineFitter::inside_overcut() const {
  double worst = -1e300;
  for (std::size_t j = 0; j < feet_.size(); ++j)
    if (feet_[j].location == Location::kInside) worst = std::max(worst, -errors_[j]);
  return worst;
}

void LineFitter::deep_points(const Pose& pose, double depth_mm, std::vector<Vec3>& points) const {
  for (std::size_t j = 0; j < feet_.size(); ++j) {
    const Footpoint foot = trimmed_foot(pose, j, depth_mm);
    if (foot.patch >= 0 && depth(foot, j) > depth_mm) points.push_back(foot.point);
  }
}

void LineFitter::linearise(const LineFrame& frame) {
  for (std::size_t j = 0; j < feet_.size(); ++j)
    rows_[j] = distance_row(frame, feet_[j].normal, 2.0 * s_[j] / length_ - 1.0);
}

void LineFitter::load_weights() {
  double sum = 0.0;
  for (std::size_t j = 0; j < feet_.size(); ++j) sum += base_weights_[j] = footpoint_weight(feet_[j].location);
  if (sum > 0.0)
    for (double& w : base_weights_) w /= sum;
  weights_ = base_weights_;
}

// min over x of sum w_j (e_j + row_j x)^2 + sum stay_i (x_i + offset_i)^2 + damping |x|^2. `offset` is how far the line
// has come from its start, so `stay` holds it to the start and not to the last step.
Vec5 LineFitter::solve(const Vec5& stay, const Vec5& offset, double damping) const {
  Eigen::Matrix<double, 5, 5> normal = (stay + Vec5::Constant(damping)).asDiagonal();
  Vec5 rhs = -stay.cwiseProduct(offset);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    normal.noalias() += weights_[j] * rows_[j] * rows_[j].transpose();
    rhs -= weights_[j] * errors_[j] * rows_[j];
  }
  return normal.ldlt().solve(rhs);
}

// Lawson (1961): weighted least squares whose weights are multiplied by the errors that it leaves tends to the minimax
// solution. Rounds are not monotonous, so the best of them is kept.
Vec5 LineFitter::best_step(const Vec5& stay, const Vec5& offset, double damping) {
  load_weights();
  const auto largest = [&](const Vec5& x) {
    double worst = 0.0;
    for (std::size_t j = 0; j < rows_.size(); ++j)
      if (feet_[j].location == Location::kInside) worst = std::max(worst, std::abs(errors_[j] + rows_[j].dot(x)));
    return worst;
  };
  Vec5 best = solve(stay, offset, damping);
  double least = largest(best);
  if (least < kLawsonFrom * options_.tolerance_mm) return best;
  Vec5 x = best;
  for (int k = 0; k < kLawsonSteps; ++k) {
    double worst = 1e-300, sum = 0.0;  // worst > 0: it divides
    for (std::size_t j = 0; j < rows_.size(); ++j) worst = std::max(worst, std::abs(errors_[j] + rows_[j].dot(x)));
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const bool inside = feet_[j].location == Location::kInside;
      if (inside) weights_[j] *= std::abs(errors_[j] + rows_[j].dot(x)) / worst + kLawsonFloor;
      sum += weights_[j];
    }
    if (!(sum > 0.0)) break;
    for (double& w : weights_) w /= sum;
    x = solve(stay, offset, damping);
    const double now = largest(x);
    if (now < least) {
      least = now;
      best = x;
    }
  }
  return best;
}

Vec5 LineFitter::limited_step(const Vec5& stay, const Vec5& offset) {
  const double longest = kLongestStep * length_;
  Vec5 x = best_step(stay, offset, 0.0);
  // What the distances hardly see runs away first: damped, not scaled, the rest of the step stays what it is.
  for (double damping = kFirstDamping; x.cwiseAbs().maxCoeff() > longest && damping < kMostDamping;
       damping *= kDampingFactor)
    x = best_step(stay, offset, damping);
  return x;
}

LineFitter::Lift LineFitter::lift(const Pose& pose, double depth_mm) const {
  Lift lift;
  for (std::size_t j = 0; j < feet_.size(); ++j) {
    const Footpoint foot = trimmed_foot(pose, j, depth_mm);
    const double excess = foot.patch >= 0 ? depth(foot, j) - depth_mm : 0.0;
    if (excess <= 0.0) continue;
    // A turn about the other end moves the sphere by s / L of what it moves this end: at least half, so none divides by
    // zero.
    const bool upper = 2.0 * s_[j] > length_;
    const Vec3 away = foot.location == Location::kInside ? foot.normal : (pose.at(s_[j]) - foot.point).normalized();
    const Vec3 shift = excess * length_ / (upper ? s_[j] : length_ - s_[j]) * away;
    Vec3& end = upper ? lift.holder : lift.tip;
    if (shift.squaredNorm() > end.squaredNorm()) end = shift;
  }
  return lift;
}

LineFit LineFitter::refine(const Pose& start, const LineHold& hold) {
  // So that moving an end by L/4 adds (share * tolerance)^2 to the mean squared error.
  const auto stay_of = [&](double share) { return std::pow(4.0 * share * options_.tolerance_mm / length_, 2); };
  Vec5 stay = Vec5::Constant(stay_of(hold.stay_share > 0.0 ? hold.stay_share : options_.stay_share));
  if (hold.slide_share > 0.0) stay[2] = stay_of(hold.slide_share);
  if (hold.travel.norm() > 0.0) stay[0] = kHeld;
  LineFit best = measure(start);
  if (!best.touches()) return best;
  const LineFrame frame = line_frame(start, hold.travel);
  Vec5 offset = Vec5::Zero();
  for (int k = 0; k < options_.steps; ++k) {
    best_feet_ = feet_;
    linearise(frame);
    const Vec5 x = limited_step(stay, offset);
    const double size = x.cwiseAbs().maxCoeff();
    const LineFit trial = measure(moved_line(best.pose, length_, frame, x));
    const bool better = trial.touches() && trial.largest_mm < best.largest_mm;
    const bool lost = !trial.touches() || trial.largest_mm > kLost * best.largest_mm + options_.tolerance_mm;
    if (!better && (lost || k > 0)) {
      feet_ = best_feet_;
      return best;
    }
    const double gained = best.largest_mm - trial.largest_mm;
    best = trial;
    offset += x;
    if (size < kSettled * options_.tolerance_mm || (k > 0 && gained < kLeastGain * best.largest_mm)) break;
  }
  return best;
}

}  // namespace flank::internal

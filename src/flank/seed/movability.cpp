#include "flank/seed/movability.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// As FitStage::extension_weight: an extrapolated normal says little, but without it a line that has half left the
/// target would be free to turn.
constexpr double kExtensionWeight = 0.05;

using Vec5 = Eigen::Matrix<double, 5, 1>;
using Mat5 = Eigen::Matrix<double, 5, 5>;

/// Two unit vectors across the axis; unknowns are (across e1, across e2, along u, omega e1 L/2, omega e2 L/2).
struct Frame {
  Vec3 u, e1, e2;
  explicit Frame(const Pose& pose) : u(pose.axis), e1(u.unitOrthogonal()), e2(u.cross(e1)) {}
};

/// E as a quadratic form in the unknowns; turns are scaled by L/2, so that all five are of the size of a velocity.
struct Form {
  Mat5 matrix = Mat5::Zero();
  double weight = 0.0;         ///< sum of the footpoints' weights
  Vec3 normal = Vec3::Zero();  ///< weighted sum of normals: which way the machining side is
};

Form assemble(std::span<const Footpoint> feet, const Frame& frame) {
  Form form;
  const double last = static_cast<double>(feet.size()) - 1.0;
  for (std::size_t j = 0; j < feet.size(); ++j) {
    const double w = footpoint_weight(feet[j].location);
    if (w == 0.0) continue;
    const Vec3& n = feet[j].normal;
    const double rho = 2.0 * static_cast<double>(j) / last - 1.0, n1 = n.dot(frame.e1), n2 = n.dot(frame.e2);
    Vec5 row;
    row << n1, n2, n.dot(frame.u), rho * n1, rho * n2;
    form.matrix += w * row * row.transpose();
    form.weight += w;
    form.normal += w * n;
  }
  if (form.weight > 0.0) form.matrix /= form.weight;
  return form;
}

/// Of two rows in closed form.
Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen_of(const Eigen::Matrix2d& form) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(form);
  return eigen;
}

/// Unit vector of the smallest form, among nearly equal ones the one nearest to `previous` (both in the plane across
/// the axis).
Vec2 best_direction(const Eigen::Matrix2d& form, const Vec2& previous, double steering) {
  Eigen::Matrix2d steered = form;
  if (previous.norm() > 0.0) steered -= steering * previous.normalized() * previous.normalized().transpose();
  return eigen_of(steered).eigenvectors().col(0);
}

}  // namespace

double footpoint_weight(Location location) {
  if (location == Location::kInside) return 1.0;
  return location == Location::kExtension ? kExtensionWeight : 0.0;
}

Movability movability(std::span<const Footpoint> feet, const Pose& pose, double axis_length,
                      const MovabilityOptions& options) {
  FLANK_ASSERT(feet.size() >= 2 && axis_length > 0.0);
  FLANK_ASSERT(std::abs(pose.axis.squaredNorm() - 1.0) < 1e-6);
  Movability result;
  const Frame frame(pose);
  const Form form = assemble(feet, frame);
  result.weight = form.weight / static_cast<double>(feet.size());
  if (form.weight == 0.0) return result;

  // Minimise over slide and turns for a given velocity across the axis: the penalties make this block regular.
  Eigen::Matrix3d inner = form.matrix.bottomRightCorner<3, 3>();
  const Vec3 penalty(options.axial_penalty, options.turn_penalty, options.turn_penalty);
  inner.diagonal() += penalty;
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(inner);
  const Eigen::Matrix<double, 3, 2> coupling = form.matrix.bottomLeftCorner<3, 2>();
  const Eigen::Matrix<double, 3, 2> eliminated = ldlt.solve(coupling);
  const Eigen::Matrix2d schur = form.matrix.topLeftCorner<2, 2>() - coupling.transpose() * eliminated;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen = eigen_of(schur);
  result.low = eigen.eigenvalues()[0];
  result.high = eigen.eigenvalues()[1];

  const Vec2 previous(options.previous.dot(frame.e1), options.previous.dot(frame.e2));
  Vec5 x;
  x.head<2>() = best_direction(schur, previous, options.steering);
  const Vec3 across = x[0] * frame.e1 + x[1] * frame.e2;
  // The form has no sign. Without a direction to keep: to the right of the axis, seen from the machining side.
  const bool backward =
      previous.norm() > 0.0 ? x.head<2>().dot(previous) < 0.0 : across.dot(frame.u.cross(form.normal)) < 0.0;
  if (backward) x.head<2>() *= -1.0;
  const Vec3 centre(options.centre.middle.dot(frame.u), 0.5 * axis_length * options.centre.omega.dot(frame.e1),
                    0.5 * axis_length * options.centre.omega.dot(frame.e2));
  x.tail<3>() = ldlt.solve(penalty.cwiseProduct(centre)) - eliminated * x.head<2>();
  result.value = std::max(0.0, x.dot(form.matrix * x));
  result.velocity.middle = x[0] * frame.e1 + x[1] * frame.e2 + x[2] * frame.u;
  result.velocity.omega = (2.0 / axis_length) * (x[3] * frame.e1 + x[4] * frame.e2);
  return result;
}

void track_axis(const Target& target, const Pose& pose, double axis_length, std::span<Footpoint> feet) {
  FLANK_ASSERT(feet.size() >= 2);
  const std::size_t n = feet.size(), middle = n / 2;
  const double step = axis_length / (static_cast<double>(n) - 1.0);
  const auto find = [&](std::size_t j, std::size_t neighbour) {
    const Vec3 p = pose.at(step * static_cast<double>(j));
    feet[j] = target.track(p, feet[j].patch >= 0 ? feet[j] : feet[neighbour]);
  };
  find(middle, middle);
  for (std::size_t j = middle + 1; j < n; ++j) find(j, j - 1);
  for (std::size_t j = middle; j-- > 0;) find(j, j + 1);
}

Movability movability(const Target& target, const Pose& pose, double axis_length, int samples,
                      const MovabilityOptions& options) {
  std::vector<Footpoint> feet(static_cast<std::size_t>(samples));
  track_axis(target, pose, axis_length, feet);
  return movability(feet, pose, axis_length, options);
}

Pose moved(const Pose& pose, const AxisVelocity& velocity, double axis_length, double step) {
  const Vec3 axis = (pose.axis + step * velocity.omega).normalized();
  const Vec3 middle = pose.at(0.5 * axis_length) + step * velocity.middle;
  return {middle - 0.5 * axis_length * axis, axis};
}

AxisVelocity mean_velocity(const Pose& from, const Pose& to, double axis_length, double h) {
  return {(to.at(0.5 * axis_length) - from.at(0.5 * axis_length)) / h, (to.axis - from.axis) / h};
}

Movability next_velocity(std::span<const Footpoint> feet, const Pose& pose, double axis_length,
                         const AxisVelocity& last) {
  // On changes of slide and turn, against squared sines: so small that they decide only what the normals leave open.
  constexpr double kAxialPenalty = 1e-3, kTurnPenalty = 1e-4;
  MovabilityOptions form;
  form.axial_penalty = kAxialPenalty;
  form.turn_penalty = kTurnPenalty;
  form.previous = last.middle;
  form.centre = last;
  return movability(feet, pose, axis_length, form);
}

double farther_end(const Pose& from, const Pose& to, double axis_length) {
  return std::max((to.tip - from.tip).norm(), (to.at(axis_length) - from.at(axis_length)).norm());
}

}  // namespace flank::internal

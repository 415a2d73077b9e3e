#include "flank/seed/self_motion.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace flank::internal {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Sine of the angle between velocity and target, root mean square. What leaves the target by more is no better than the
/// lines of a chart.
constexpr double kMostSine = 0.03;
/// Below this share of the speed that it makes at the target's size a turn is none: its axis is too far away to be known.
constexpr double kLeastTurn = 1e-3;

/// The matrix of p x ., so that turn x p = -crossing(p) turn.
Eigen::Matrix3d crossing(const Vec3& p) {
  Eigen::Matrix3d m;
  m << 0.0, -p.z(), p.y(), p.z(), 0.0, -p.x(), -p.y(), p.x(), 0.0;
  return m;
}

/// The samples' two quadratic forms in (slide, turn), with lengths in units of the target's size about its middle.
struct Forms {
  Vec3 middle = Vec3::Zero();
  double size = 0.0, area = 0.0;
  Mat6 normal_speed = Mat6::Zero(), speed = Mat6::Zero();
};

Forms forms_of(std::span<const SurfaceSample> samples) {
  Forms forms;
  for (const SurfaceSample& s : samples) {
    forms.middle += s.area * s.point;
    forms.area += s.area;
  }
  if (!(forms.area > 0.0)) return forms;
  forms.middle /= forms.area;
  for (const SurfaceSample& s : samples) forms.size += s.area * (s.point - forms.middle).squaredNorm();
  forms.size = std::sqrt(forms.size / forms.area);
  if (!(forms.size > 0.0)) return forms;
  for (const SurfaceSample& s : samples) {
    Eigen::Matrix<double, 3, 6> velocity;
    velocity << Eigen::Matrix3d::Identity(), -crossing((s.point - forms.middle) / forms.size);
    const Vec6 normal = velocity.transpose() * s.normal;
    forms.normal_speed += s.area / forms.area * normal * normal.transpose();
    forms.speed += s.area / forms.area * velocity.transpose() * velocity;
  }
  return forms;
}

}  // namespace

bool SelfMotion::is_screw_at(const Vec3& p) const {
  constexpr double kLeastShare = 0.05;  // of the speed: a path of three degrees to the axis, or across it
  const double speed = velocity(p).norm();
  return slide.norm() > kLeastShare * speed && turn.cross(p - centre).norm() > kLeastShare * speed;
}

Vec3 SelfMotion::turned(const Vec3& direction, double time) const {
  const double angle = turn.norm() * time;
  return angle == 0.0 ? direction : Vec3(Eigen::AngleAxisd(angle, turn.normalized()) * direction);
}

Vec3 SelfMotion::moved(const Vec3& p, double time) const { return centre + turned(p - centre, time) + time * slide; }

std::optional<SelfMotion> self_motion(std::span<const SurfaceSample> samples) {
  const Forms forms = forms_of(samples);
  if (!(forms.size > 0.0)) return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat6> eigen(forms.normal_speed, forms.speed);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  const double least = std::max(0.0, eigen.eigenvalues()[0]), next = eigen.eigenvalues()[1];
  if (least > kMostSine * kMostSine || next <= kMostSine * kMostSine) return std::nullopt;
  const Vec6 twist = eigen.eigenvectors().col(0);  // of unit mean square speed, by the solver's scaling
  SelfMotion motion;
  motion.centre = forms.middle;
  motion.slide = twist.head<3>();
  motion.sine = std::sqrt(least);
  const Vec3 turn = twist.tail<3>() / forms.size;
  if (twist.tail<3>().norm() < kLeastTurn) return motion;
  motion.turn = turn;
  motion.centre += turn.cross(motion.slide) / turn.squaredNorm();
  motion.slide = turn * (turn.dot(motion.slide) / turn.squaredNorm());
  return motion;
}

}  // namespace flank::internal

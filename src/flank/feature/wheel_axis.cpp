#include "flank/feature/wheel_axis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Root mean square of the sine by which normals may leave the plane through the axis; triangles' normals err more.
constexpr double kTurned = 0.01, kTurnedMesh = 0.06;
/// The same of a face's own axis, in its own size.
constexpr double kOwn = 3e-3, kOwnMesh = 0.03;
constexpr double kPitch = 0.01;    ///< advance per radian, as a share of the size: more is a screw
constexpr double kOnAxis = 0.005;  ///< nearer to the axis, in sizes, normals say nothing
constexpr double kSameDeg = 0.3, kSameShare = 2e-3;

bool is_mesh(const WheelFace& face) { return face.type == "mesh"; }

/// The complex of the face's normals in six numbers a normal: moment and direction.
Eigen::Matrix<double, 6, 6> complex_of(const WheelFace& face, const Vec3& centre, double size) {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (const FaceSample& s : face.samples) {
    Eigen::Matrix<double, 6, 1> a;
    a << (s.point - centre).cross(s.normal) / size, s.normal;
    sum += s.area * a * a.transpose();
  }
  return sum / std::max(face.area, 1e-300);
}

/// The axis of a face alone. A cylinder also slides along it: of its two null vectors the one that turns most is taken.
std::optional<WheelAxis> own_axis(const WheelFace& face, const Vec3& middle) {
  const double size = std::max(face.box.diagonal(), 1e-9);
  const Vec3 centre = face.box.center();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(complex_of(face, centre, size));
  const double limit = is_mesh(face) ? kOwnMesh : kOwn;
  int null = 0;
  while (null < 6 && solver.eigenvalues()[null] < limit * limit) ++null;
  if (null < 1 || null > 2) return {};
  Eigen::Matrix<double, 6, 1> x = solver.eigenvectors().col(0);
  if (null == 2) {
    const auto both = solver.eigenvectors().leftCols<2>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> most(both.topRows<3>().transpose() * both.topRows<3>());
    x = both * most.eigenvectors().col(1);
  }
  const Vec3 d = x.head<3>();
  Vec3 m = size * x.tail<3>();
  const double length = d.norm();
  if (length < 0.05) return {};
  if (null == 1 && std::abs(d.dot(m)) > kPitch * size * length * length) return {};
  m -= d * d.dot(m) / (length * length);
  WheelAxis axis;
  axis.direction = d / length;
  axis.point = centre - m.cross(d) / (length * length);
  axis.point += axis.direction * axis.direction.dot(middle - axis.point);
  return axis;
}

/// Most of the direction points to the positive side, so that the same part has the same axis however its faces are ordered.
void orient(WheelAxis& axis) {
  Eigen::Index most = 0;
  axis.direction.cwiseAbs().maxCoeff(&most);
  if (axis.direction[most] < 0.0) axis.direction = -axis.direction;
}

bool same(const WheelAxis& a, const WheelAxis& b, double size) {
  return std::abs(a.direction.dot(b.direction)) > std::cos(kSameDeg * 0.017453292519943295) &&
         (a.point - b.point).norm() < kSameShare * size;
}

}  // namespace

double WheelAxis::angle(const Vec3& p) const {
  // The coordinate direction that lies most across the axis, and the one across both.
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  const Vec3 e = (Vec3::Unit(least) - direction[least] * direction).normalized(), f = direction.cross(e);
  return std::atan2(f.dot(p - point), e.dot(p - point));
}

Eigen::Isometry3d WheelAxis::turn(double radians) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = Eigen::AngleAxisd(radians, direction).toRotationMatrix();
  out.translation() = point - out.linear() * point;
  return out;
}

bool is_turned(const WheelFace& face, const WheelAxis& axis, double size_mm) {
  double sum = 0.0;
  for (const FaceSample& s : face.samples) {
    const double radius = axis.radius(s.point), share = std::min(1.0, radius / (kOnAxis * size_mm));
    const double off = share * s.normal.dot(axis.around(s.point));
    sum += s.area * off * off;
  }
  const double limit = is_mesh(face) ? kTurnedMesh : kTurned;
  return sum < limit * limit * face.area;
}

std::optional<WheelAxis> find_axis(const std::vector<WheelFace>& faces, const Box3& box) {
  const double size = box.diagonal();
  std::vector<WheelAxis> known;
  for (const WheelFace& face : faces) {
    std::optional<WheelAxis> axis = own_axis(face, box.center());
    if (!axis) continue;
    orient(*axis);
    if (std::any_of(known.begin(), known.end(), [&](const WheelAxis& other) { return same(*axis, other, size); }))
      continue;
    for (const WheelFace& other : faces)
      if (is_turned(other, *axis, size)) axis->turned_mm2 += other.area;
    known.push_back(*axis);
  }
  if (known.empty()) return {};
  return *std::max_element(known.begin(), known.end(),
                           [](const auto& a, const auto& b) { return a.turned_mm2 < b.turned_mm2; });
}

}  // namespace flank::internal

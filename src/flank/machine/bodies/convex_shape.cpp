#include "flank/machine/bodies/convex_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// Rounds of the search; it ends long before, but for shapes that touch along a whole face.
constexpr int kMostRounds = 60;
/// Nearer than this to the origin, mm, the difference of the shapes holds it.
constexpr double kNothing = 1e-9;

/// Sine to a frustum's axis below which all points of its disc are as far as its centre.
constexpr double kAlong = 1e-9;

/// Up to four points of the difference of two shapes.
struct Simplex {
  std::array<Vec3, 4> point;
  int count = 0;
};

/// The point nearest to the origin of the hull of those points of a simplex whose bits are set; false if it lies on the
/// border of that hull, where fewer points do, or the points are no simplex.
bool nearest_of(const Simplex& s, unsigned chosen, Vec3& nearest) {
  std::array<int, 4> index{};
  int count = 0;
  for (int k = 0; k < s.count; ++k)
    if ((chosen >> k & 1U) != 0U) index[static_cast<std::size_t>(count++)] = k;
  const auto at = [&](int k) -> const Vec3& {
    return s.point[static_cast<std::size_t>(index[static_cast<std::size_t>(k)])];
  };
  if (count == 1) {
    nearest = at(0);
    return true;
  }
  if (count == 2) {
    const Vec3 d = at(1) - at(0);
    const double square = d.squaredNorm(), t = -at(0).dot(d);
    if (!(t > 0.0 && t < square)) return false;
    nearest = at(0) + t / square * d;
    return true;
  }
  const Vec3 e = at(1) - at(0), f = at(2) - at(0);
  const Vec3 normal = e.cross(f);
  if (count == 3) {
    const double square = normal.squaredNorm();
    if (!(square > 0.0)) return false;
    // The origin's barycentric coordinates in the plane.
    const double v = -at(0).cross(f).dot(normal) / square, w = -e.cross(at(0)).dot(normal) / square;
    if (!(v > 0.0 && w > 0.0 && v + w < 1.0)) return false;
    nearest = at(0).dot(normal) / square * normal;
    return true;
  }
  const Vec3 g = at(3) - at(0);
  const double volume = normal.dot(g);
  if (!(std::abs(volume) > 0.0)) return false;
  const double u = -at(0).dot(f.cross(g)) / volume, v = -at(0).dot(g.cross(e)) / volume,
               w = -at(0).dot(normal) / volume;
  nearest = Vec3::Zero();
  return u >= 0.0 && v >= 0.0 && w >= 0.0 && u + v + w <= 1.0;
}

/// Reduces the simplex to the points that carry the point of its hull nearest to the origin, which is returned.
Vec3 reduce(Simplex& s) {
  double least = std::numeric_limits<double>::infinity();
  unsigned best = 1U;
  Vec3 nearest = s.point[0], here;
  for (unsigned chosen = 1U; chosen < 1U << s.count; ++chosen) {
    if (!nearest_of(s, chosen, here) || here.squaredNorm() >= least) continue;
    least = here.squaredNorm();
    best = chosen;
    nearest = here;
  }
  int count = 0;
  for (int k = 0; k < s.count; ++k)
    if ((best >> k & 1U) != 0U) s.point[static_cast<std::size_t>(count++)] = s.point[static_cast<std::size_t>(k)];
  s.count = count;
  return nearest;
}

}  // namespace

ConvexShape::ConvexShape(Kind kind, const Vec3& a, const Vec3& b, const Vec3& c, const std::array<double, 2>& radii)
    : kind_(kind), a_(a), b_(b), c_(c), radii_(radii) {
  const Box3 box = bounds();
  middle_ = box.center();
  reach_ = 0.5 * box.diagonal();
}

ConvexShape ConvexShape::box(const Vec3& low, const Vec3& high) { return {Kind::kBox, low, high, Vec3::Zero(), {}}; }

ConvexShape ConvexShape::frustum(const Vec3& from, double from_radius, const Vec3& to, double to_radius) {
  return {Kind::kFrustum, from, to, (to - from).normalized(), {from_radius, to_radius}};
}

ConvexShape ConvexShape::triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {Kind::kTriangle, a, b, c, {}};
}

Vec3 ConvexShape::support(const Vec3& d) const {
  if (kind_ == Kind::kBox)
    return {d.x() > 0 ? b_.x() : a_.x(), d.y() > 0 ? b_.y() : a_.y(), d.z() > 0 ? b_.z() : a_.z()};
  if (kind_ == Kind::kTriangle) {
    const double da = d.dot(a_), db = d.dot(b_), dc = d.dot(c_);
    if (da >= db && da >= dc) return a_;
    return db >= dc ? b_ : c_;
  }
  Vec3 across = d - d.dot(c_) * c_;
  const double length = across.norm();
  // Along the axis what is left is rounding, which may point along the axis itself; there the disc's centre does as well.
  across = length > kAlong * d.norm() ? Vec3(across / length) : Vec3(Vec3::Zero());
  const Vec3 from = a_ + radii_[0] * across, to = b_ + radii_[1] * across;
  return d.dot(from) >= d.dot(to) ? from : to;
}

Box3 ConvexShape::bounds() const {
  Box3 box;
  for (int k = 0; k < 3; ++k) {
    box.add(support(Vec3::Unit(k)));
    box.add(support(-Vec3::Unit(k)));
  }
  return box;
}

// Gilbert, Johnson and Keerthi 1988: the point of the difference of both shapes that is nearest to the origin, by the
// hull of up to four points of its surface. Whatever the present point v is, no point of the difference is below the
// plane through its support across v, so what is returned is a bound even if the search ends early.
double gap(const ConvexShape& first, const ConvexShape& second, const Eigen::Isometry3d& to_first, double enough) {
  const Eigen::Matrix3d turn = to_first.linear();
  const auto support = [&](const Vec3& d) -> Vec3 {
    return first.support(d) - to_first * second.support(-(turn.transpose() * d));
  };
  Vec3 v = first.middle() - to_first * second.middle();
  const double apart = v.norm() - first.reach() - second.reach();
  if (apart >= enough) return apart;
  if (!(v.norm() > kNothing)) return 0.0;
  Simplex simplex;
  double bound = 0.0;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vec3 w = support(-v);
    const double length = v.norm();
    bound = std::max(bound, v.dot(w) / length);
    if (bound >= enough || (round > 0 && length - bound <= kGapErrorMm)) return bound;
    for (int k = 0; k < simplex.count; ++k)
      if (simplex.point[static_cast<std::size_t>(k)] == w) return bound;
    simplex.point[static_cast<std::size_t>(simplex.count++)] = w;
    v = reduce(simplex);
    if (simplex.count == 4 || v.norm() <= kNothing) return 0.0;
  }
  return bound;
}

}  // namespace flank::internal

#include "flank/design/equal_faces.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

/// Points along each edge of a border.
constexpr int kBorderPoints = 48;

/// Kernels cut the same surface to each face's own rectangle: it must be this share of both that they have in common.
constexpr double kCommonShare = 0.5;
/// Places per direction of the first look.
constexpr int kFirstLook = 6;

/// A parameter of the one surface from that of the other.
struct Line {
  double offset = 0.0, slope = 1.0;
  [[nodiscard]] double at(double p) const { return offset + slope * p; }
};

/// The line that takes the interval [b0, b1] to [a0, a1], or to [a1, a0].
Line line_through(double b0, double b1, double a0, double a1, bool turn) {
  if (turn) std::swap(a0, a1);
  const double slope = (a1 - a0) / (b1 - b0);
  return {a0 - slope * b0, slope};
}

std::vector<double> inner_breaks(const std::vector<double>& knots) {
  std::vector<double> inner;
  for (const double k : knots)
    if (k > knots.front() && k < knots.back() && (inner.empty() || k > inner.back())) inner.push_back(k);
  return inner;
}

/// In which ways the parameters `to` may become the parameters `from`, if the surfaces are the same: ends to ends; the
/// same numbers, where the surfaces were cut from one; inner knots to inner knots.
std::vector<Line> parameter_lines(const std::vector<double>& from, const std::vector<double>& to, bool turn) {
  std::vector<Line> lines{line_through(to.front(), to.back(), from.front(), from.back(), turn)};
  const auto add = [&](const Line& line) {
    for (const Line& old : lines)
      if (std::abs(old.at(to.front()) - line.at(to.front())) + std::abs(old.at(to.back()) - line.at(to.back())) <
          1e-9 * (from.back() - from.front()))
        return;
    lines.push_back(line);
  };
  if (!turn) add({0.0, 1.0});
  const std::vector<double> a = inner_breaks(from), b = inner_breaks(to);
  if (a.empty() || b.empty()) return lines;
  if (a.size() > 1 && b.size() > 1) add(line_through(b.front(), b.back(), a.front(), a.back(), turn));
  add({a.front() + (turn ? 1.0 : -1.0) * (turn ? b.back() : b.front()), turn ? -1.0 : 1.0});
  return lines;
}

/// The part of the interval of `to` that `from` has, too, by `line`; nothing if it is too small a share of either.
std::optional<std::pair<double, double>> common(const std::vector<double>& from, const std::vector<double>& to,
                                                const Line& line) {
  const double x = (from.front() - line.offset) / line.slope, y = (from.back() - line.offset) / line.slope;
  const double low = std::max(to.front(), std::min(x, y)), high = std::min(to.back(), std::max(x, y));
  if (high - low < kCommonShare * std::max(to.back() - to.front(), std::abs(y - x))) return {};
  return std::pair{low, high};
}

/// Places in [low, high] that see whatever two splines with these knots differ in: some in every span.
std::vector<double> places(double low, double high, std::vector<double> breaks, int each) {
  breaks.push_back(low);
  breaks.push_back(high);
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> all;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double a = std::max(breaks[k], low), b = std::min(breaks[k + 1], high);
    if (b - a <= 1e-9 * (high - low)) continue;
    for (int i = 0; i < each; ++i) all.push_back(std::lerp(a, b, static_cast<double>(i) / each));
  }
  all.push_back(high);
  return all;
}

/// The rotation and translation that brings points nearest to others (Kabsch 1976).
Eigen::Isometry3d nearest_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) a += from[k], b += to[k];
  a /= static_cast<double>(from.size());
  b /= static_cast<double>(from.size());
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) product += (to[k] - b) * (from[k] - a).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  motion.translation() = b - motion.linear() * a;
  return motion;
}

struct Deviation {
  Eigen::Isometry3d motion;
  double mean = 0.0, largest = 0.0;  ///< root mean square; mm
};

/// Two surfaces whose parameters are thought to belong together.
class Matching {
 public:
  Matching(const BSplineSurface& from, const BSplineSurface& to, bool exchange, const Line& u, const Line& v)
      : from_(from), to_(to), exchange_(exchange), u_(u), v_(v) {}

  /// The motion that takes what both have in common from one to the other, within the tolerance at every place.
  [[nodiscard]] std::optional<Deviation> within(double tolerance_mm) const {
    const std::vector<double>&au = exchange_ ? from_.knots_v : from_.knots_u,
          &av = exchange_ ? from_.knots_u : from_.knots_v;
    const auto u = common(au, to_.knots_u, u_), v = common(av, to_.knots_v, v_);
    if (!u || !v || !same_distances(*u, *v, tolerance_mm)) return {};
    const auto first = pairs(places(u->first, u->second, {}, kFirstLook), places(v->first, v->second, {}, kFirstLook));
    // No motion brings all of them nearer, on the average, than this one does.
    if (deviation(first).mean > tolerance_mm) return {};
    const auto all = pairs(places(u->first, u->second, breaks(au, to_.knots_u, u_), degree_u() + 2),
                           places(v->first, v->second, breaks(av, to_.knots_v, v_), degree_v() + 2));
    const Deviation found = deviation(all);
    if (found.largest > tolerance_mm) return {};
    return found;
  }

 private:
  using Points = std::pair<std::vector<Vec3>, std::vector<Vec3>>;  ///< of the one and of the other
  [[nodiscard]] int degree_u() const { return std::max(to_.degree_u, exchange_ ? from_.degree_v : from_.degree_u); }
  [[nodiscard]] int degree_v() const { return std::max(to_.degree_v, exchange_ ? from_.degree_u : from_.degree_v); }

  [[nodiscard]] Vec3 of_from(double u, double v) const {
    const double a = u_.at(u), b = v_.at(v);
    return exchange_ ? from_.value(b, a) : from_.value(a, b);
  }

  /// Diagonals of the common rectangle: a motion keeps them.
  [[nodiscard]] bool same_distances(const std::pair<double, double>& u, const std::pair<double, double>& v,
                                    double tolerance_mm) const {
    const auto differ = [&](double u0, double v0, double u1, double v1) {
      return std::abs((of_from(u0, v0) - of_from(u1, v1)).norm() - (to_.value(u0, v0) - to_.value(u1, v1)).norm());
    };
    return differ(u.first, v.first, u.second, v.second) <= 2.0 * tolerance_mm &&
           differ(u.first, v.second, u.second, v.first) <= 2.0 * tolerance_mm;
  }

  /// The knots of both, as parameters of `to`.
  static std::vector<double> breaks(const std::vector<double>& from, const std::vector<double>& to, const Line& line) {
    std::vector<double> all = inner_breaks(to);
    for (const double k : inner_breaks(from)) all.push_back((k - line.offset) / line.slope);
    return all;
  }

  [[nodiscard]] Points pairs(const std::vector<double>& us, const std::vector<double>& vs) const {
    Points points;
    for (const double u : us)
      for (const double v : vs) {
        points.first.push_back(of_from(u, v));
        points.second.push_back(to_.value(u, v));
      }
    return points;
  }

  static Deviation deviation(const Points& points) {
    Deviation found{nearest_motion(points.first, points.second)};
    double sum = 0.0;
    for (std::size_t k = 0; k < points.first.size(); ++k) {
      const double square = (found.motion * points.first[k] - points.second[k]).squaredNorm();
      sum += square;
      found.largest = std::max(found.largest, square);
    }
    found.mean = std::sqrt(sum / static_cast<double>(points.first.size()));
    found.largest = std::sqrt(found.largest);
    return found;
  }

  const BSplineSurface &from_, &to_;
  bool exchange_;
  Line u_, v_;
};

/// Points along the border, mm.
std::vector<Vec3> border(const Face& face) {
  std::vector<Vec3> points;
  const BSplineSurface& s = face.surface;
  for (const TrimLoop& loop : face.loops)
    for (const BSplineCurve2& edge : loop.edges)
      for (int k = 0; k < kBorderPoints; ++k) {
        const Vec2 p = edge.value(std::lerp(edge.first(), edge.last(), static_cast<double>(k) / kBorderPoints));
        points.push_back(s.value(p.x(), p.y()));
      }
  if (!points.empty()) return points;
  for (int k = 0; k < kBorderPoints; ++k) {
    const double x = static_cast<double>(k) / kBorderPoints;
    const double u = std::lerp(s.u_first(), s.u_last(), x), v = std::lerp(s.v_first(), s.v_last(), x);
    for (const Vec3& p :
         {s.value(u, s.v_first()), s.value(s.u_last(), v), s.value(u, s.v_last()), s.value(s.u_first(), v)})
      points.push_back(p);
  }
  return points;
}

double farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double largest = 0.0;
  for (const Vec3& p : from) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& q : to) least = std::min(least, (p - q).squaredNorm());
    largest = std::max(largest, least);
  }
  return std::sqrt(largest);
}

/// Do the borders run along one another? Points stand for them: their own spacing is allowed, too.
bool same_border(const Face& from, const Face& to, const Eigen::Isometry3d& motion) {
  std::vector<Vec3> a = border(from);
  const std::vector<Vec3> b = border(to);
  Box3 box;
  for (Vec3& p : a) box.add(p = motion * p);
  return std::max(farthest(a, b), farthest(b, a)) <= kBorderShare * box.diagonal();
}

}  // namespace

std::optional<Eigen::Isometry3d> motion_between(const Face& from, const Face& to, double tolerance_mm) {
  if (from.of_solid != to.of_solid) return {};
  // A face moved a little along itself is almost the same: the first way within the tolerance need not be the right one.
  std::optional<Deviation> best;
  for (int way = 0; way < 8; ++way) {
    const bool exchange = way & 1, turn_u = way & 2, turn_v = way & 4;
    // Each of the three turns the normal of the parameters round.
    const bool turned = exchange != (turn_u != turn_v);
    if (from.of_solid && (from.reversed != turned) != to.reversed) continue;
    const BSplineSurface &a = from.surface, &b = to.surface;
    for (const Line& u : parameter_lines(exchange ? a.knots_v : a.knots_u, b.knots_u, turn_u))
      for (const Line& v : parameter_lines(exchange ? a.knots_u : a.knots_v, b.knots_v, turn_v))
        if (const auto found = Matching(a, b, exchange, u, v).within(best ? best->largest : tolerance_mm);
            found && (!best || found->largest < best->largest) && same_border(from, to, found->motion))
          best = found;
  }
  if (!best) return {};
  return best->motion;
}

std::vector<EqualFace> equal_faces(const Part& part, const std::vector<int>& faces, double tolerance_mm) {
  std::vector<EqualFace> all;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    EqualFace next{faces[k], k, Eigen::Isometry3d::Identity()};
    for (std::size_t first = 0; first < k && !part.is_mesh(); ++first) {
      if (all[first].first != first) continue;
      const auto motion = motion_between(part.faces[static_cast<std::size_t>(faces[first])],
                                         part.faces[static_cast<std::size_t>(faces[k])], tolerance_mm);
      if (!motion) continue;
      next.first = first;
      next.from_first = *motion;
      break;
    }
    all.push_back(next);
  }
  return all;
}

Path carried(const Path& path, const std::string& from, const std::string& to, const Eigen::Isometry3d& motion) {
  Path moved;
  for (const Strip& strip : path.strips) {
    const std::vector<std::string> named = face_list_items(strip.face);
    if (std::find(named.begin(), named.end(), from) == named.end()) continue;
    Strip& next = moved.strips.emplace_back(strip);
    next.face = to;
    for (Pose& pose : next.poses) {
      pose.tip = motion * pose.tip;
      pose.axis = (motion.linear() * pose.axis).normalized();
    }
  }
  for (std::size_t k = 0; k < moved.strips.size(); ++k) moved.strips[k].id = static_cast<int>(k) + 1;
  return moved;
}

}  // namespace flank::internal

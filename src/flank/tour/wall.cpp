#include "flank/tour/wall.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flank::internal {
namespace {

constexpr double kFlatMm = 1e-5;      ///< how far poles of a plane may be off it
constexpr double kStraightMm = 1e-4;  ///< how far a line of a ruled wall may be off its chord
constexpr double kOnePlace =
    1e-4;  ///< of the range of a parameter: an edge along which it changes by less is a line of the wall
constexpr int kPerEdge = 33;  ///< points of a border

std::vector<Vec3> border_of(const Face& face) {
  std::vector<Vec3> points;
  for (const TrimLoop& loop : face.loops)
    for (const BSplineCurve2& edge : loop.edges)
      for (const Vec3& p : points_along(face, edge, kPerEdge)) points.push_back(p);
  return points;
}

/// Range of a parameter of the face over its borders.
std::pair<double, double> range_of(const Face& face, int coordinate) {
  double low = 1e300, high = -1e300;
  for (const TrimLoop& loop : face.loops)
    for (const BSplineCurve2& edge : loop.edges)
      for (int k = 0; k < kPerEdge; ++k) {
        const Vec2 q = edge.value(edge.first() + (edge.last() - edge.first()) * k / (kPerEdge - 1));
        low = std::min(low, q[coordinate]);
        high = std::max(high, q[coordinate]);
      }
  return {low, high};
}

/// The value of a parameter along a trim, if it has one there.
std::optional<double> place_of(const BSplineCurve2& trim, int coordinate, double range) {
  const double a = trim.value(trim.first())[coordinate], b = trim.value(trim.last())[coordinate];
  const double middle = trim.value(0.5 * (trim.first() + trim.last()))[coordinate];
  if (std::max(std::abs(a - b), std::abs(a - middle)) > kOnePlace * range) return {};
  return 0.5 * (a + b);
}

}  // namespace

Vec3 Wall::normal_at(double u, double v) const {
  const SurfaceJet jet = face_->surface.jet(u, v);
  const Vec3 cross = jet.du.cross(jet.dv);
  const double size = cross.norm();
  // At the apex of a cone there is none: the one beside it.
  if (!(size > 1e-12 * (jet.du.squaredNorm() + jet.dv.squaredNorm()))) {
    const double um = 0.5 * (face_->surface.u_first() + face_->surface.u_last());
    const double vm = 0.5 * (face_->surface.v_first() + face_->surface.v_last());
    return along_u_ ? normal_at(um, v) : normal_at(u, vm);
  }
  return (face_->reversed ? -1.0 : 1.0) / size * cross;
}

std::optional<Wall> Wall::of(const Face& face, const LateralEdge* begin, const LateralEdge* end) {
  if (begin == nullptr && end == nullptr) return {};
  Wall wall;
  wall.face_ = &face;
  wall.flat_ = wall.lay_flat(begin, end);
  if (!wall.flat_ && !wall.lay_ruled(begin, end)) return {};
  wall.target_ = make_target({face});
  return wall;
}

bool Wall::lay_flat(const LateralEdge* begin, const LateralEdge* end) {
  const BSplineSurface& s = face_->surface;
  normal_ = normal_at(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
  origin_ = s.poles.front();
  for (const Vec3& pole : s.poles)
    if (std::abs((pole - origin_).dot(normal_)) > kFlatMm) return false;
  Vec3 up = Vec3::Zero();
  for (const LateralEdge* edge : {begin, end})
    if (edge != nullptr) up += edge->direction();
  y_ = (up - up.dot(normal_) * normal_).normalized();
  x_ = y_.cross(normal_);
  const std::vector<Vec3> border = border_of(*face_);
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : border) middle += p / static_cast<double>(border.size());
  const auto place = [&](const LateralEdge* edge) {
    return edge == nullptr ? middle : 0.5 * (edge->foot + edge->head);
  };
  if ((place(end) - place(begin)).dot(x_) < 0.0) x_ = -x_;
  low_ = foot_x_[0] = 1e300;
  high_ = foot_x_[1] = -1e300;
  for (const Vec3& p : border) {
    const double x = (p - origin_).dot(x_), y = (p - origin_).dot(y_);
    low_ = std::min(low_, y);
    high_ = std::max(high_, y);
    foot_x_[0] = std::min(foot_x_[0], x);
    foot_x_[1] = std::max(foot_x_[1], x);
  }
  return end_at(begin, 0) && end_at(end, 1) && foot_x_[1] + head_x_[1] > foot_x_[0] + head_x_[0];
}

bool Wall::end_at(const LateralEdge* edge, int k) {
  constexpr double kLeastRise = 0.1;  // an edge that lies across the lines is none of them
  head_x_[k] = foot_x_[k];
  if (edge == nullptr) return true;
  const double rise = edge->direction().dot(y_);
  if (!(rise > kLeastRise)) return false;
  const double lean = edge->direction().dot(x_) / rise;
  const double x = (edge->foot - origin_).dot(x_), y = (edge->foot - origin_).dot(y_);
  foot_x_[k] = x + (low_ - y) * lean;
  head_x_[k] = x + (high_ - y) * lean;
  return true;
}

bool Wall::lay_ruled(const LateralEdge* begin, const LateralEdge* end) {
  for (const bool along_u : {false, true}) {
    along_u_ = along_u;
    if (find_places(begin, end) && is_straight(begin != nullptr ? *begin : *end, begin != nullptr ? 0 : 1)) return true;
  }
  return false;
}

bool Wall::find_places(const LateralEdge* begin, const LateralEdge* end) {
  const int across = along_u_ ? 1 : 0;
  const auto [low, high] = range_of(*face_, across);
  for (const int k : {0, 1}) {
    const LateralEdge* edge = k == 0 ? begin : end;
    if (edge == nullptr) continue;
    const std::optional<double> place = place_of(k == 0 ? *edge->after : *edge->before, across, high - low);
    if (!place) return false;
    place_[k] = *place;
  }
  // What has no edge ends at the other end of the face.
  const auto other = [low = low, high = high](double place) {
    return std::abs(place - low) > std::abs(place - high) ? low : high;
  };
  if (begin == nullptr) place_[0] = other(place_[1]);
  if (end == nullptr) place_[1] = other(place_[0]);
  return std::abs(place_[1] - place_[0]) > kOnePlace * (high - low);
}

bool Wall::is_straight(const LateralEdge& edge, int k) {
  constexpr int kLines = 9;
  const auto [foot, head] = range_of(*face_, along_u_ ? 0 : 1);
  foot_ = foot;
  head_ = head;
  const WallLine at_edge = ruled_line(place_[k]);
  if ((at_edge.head - at_edge.foot).dot(edge.direction()) < 0.0) std::swap(foot_, head_);
  for (int i = 0; i < kLines; ++i) {
    const double place = place_[0] + (place_[1] - place_[0]) * i / (kLines - 1.0);
    const WallLine line = ruled_line(place);
    for (const double share : {0.25, 0.5, 0.75}) {
      const double along = foot_ + share * (head_ - foot_);
      const Vec3 p = along_u_ ? face_->surface.value(along, place) : face_->surface.value(place, along);
      if ((p - line.foot).cross(line.direction()).norm() > kStraightMm) return false;
    }
  }
  return true;
}

WallLine Wall::ruled_line(double place) const {
  const auto uv = [&](double along) { return along_u_ ? Vec2(along, place) : Vec2(place, along); };
  const Vec2 f = uv(foot_), h = uv(head_);
  return {face_->surface.value(f[0], f[1]), face_->surface.value(h[0], h[1]), normal_at(f[0], f[1]),
          normal_at(h[0], h[1]), place};
}

WallLine Wall::flat_line(double foot_x, double head_x) const {
  return {origin_ + foot_x * x_ + low_ * y_, origin_ + head_x * x_ + high_ * y_, normal_, normal_};
}

WallLine Wall::end_line(bool last, const WallEnd& back) const {
  const int k = last ? 1 : 0;
  const double inwards = last ? -1.0 : 1.0;
  if (flat_) {
    // Distances are at right angles to the edge, and measured along x.
    const double lean = (head_x_[k] - foot_x_[k]) / (high_ - low_), along_x = std::sqrt(1.0 + lean * lean);
    return flat_line(foot_x_[k] + inwards * back.foot_back * along_x, head_x_[k] + inwards * back.head_back * along_x);
  }
  const double share = std::max(back.foot_back, back.head_back) / way();
  return ruled_line(place_[k] - (last ? 1.0 : -1.0) * std::min(share, 1.0) * (place_[1] - place_[0]));
}

double Wall::way() const {
  if (flat_) return 0.5 * (std::abs(foot_x_[1] - foot_x_[0]) + std::abs(head_x_[1] - head_x_[0]));
  constexpr int kSteps = 16;
  double foot = 0.0, head = 0.0;
  WallLine before = ruled_line(place_[0]);
  for (int k = 1; k <= kSteps; ++k) {
    const WallLine line = ruled_line(place_[0] + (place_[1] - place_[0]) * k / kSteps);
    foot += (line.foot - before.foot).norm();
    head += (line.head - before.head).norm();
    before = line;
  }
  return std::max(foot, head);
}

std::vector<WallLine> Wall::keys(const WallEnd& begin, const WallEnd& end) const {
  const WallLine a = first(begin), b = last(end);
  if (!flat_) return {a, b};
  const auto x_of = [&](const Vec3& p) { return (p - origin_).dot(x_); };
  // Near an edge that leans, lines turn over three times the way by which they lean.
  constexpr double kTurns = 2.0;
  const double lean_a = std::abs(x_of(a.head) - x_of(a.foot)), lean_b = std::abs(x_of(b.head) - x_of(b.foot));
  const double from = std::max(x_of(a.foot), x_of(a.head)) + kTurns * lean_a;
  const double to = std::min(x_of(b.foot), x_of(b.head)) - kTurns * lean_b;
  constexpr double kUpright = 1e-9;
  if (from >= to) return {a, b};
  std::vector<WallLine> keys{a};
  if (lean_a > kUpright) keys.push_back(flat_line(from, from));
  if (lean_b > kUpright) keys.push_back(flat_line(to, to));
  keys.push_back(b);
  return keys;
}

WallLine Wall::between(const WallLine& a, const WallLine& b, double share) const {
  if (!flat_) return ruled_line(a.place + share * (b.place - a.place));
  return {a.foot + share * (b.foot - a.foot), a.head + share * (b.head - a.head), a.foot_normal, a.head_normal};
}

double Wall::bend(const Vec3& place) const { return flat_ ? 0.0 : target_->closest(place).k2; }

double Wall::twist() const {
  if (flat_) return 0.0;
  double most = 0.0;
  constexpr int kLines = 9;
  for (int k = 0; k < kLines; ++k) {
    const WallLine line = ruled_line(place_[0] + (place_[1] - place_[0]) * k / (kLines - 1.0));
    most = std::max(
        most, std::atan2(line.foot_normal.cross(line.head_normal).norm(), line.foot_normal.dot(line.head_normal)));
  }
  return most;
}

}  // namespace flank::internal

#include "flank/trochoid/front_adjustment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace flank::internal {
namespace {

/// Samples in time and along the tool, and most rounds: those of the paper.
constexpr int kRows = 102, kRings = 21, kMostRounds = 10;
/// The inner control points of a rail, and coordinates of those of both rails.
constexpr int kInner = 2, kFirstInner = 2, kUnknowns = 2 * 3 * kInner;
/// Weight of fairness, the squared second differences of what the control points are moved by, against a mean squared
/// distance of the envelope: it decides only what the envelope leaves open.
constexpr double kFairness = 1e-4;
/// What is moved back is moved to this share of the limit, and by this much more than it takes: a fit evens out what it is
/// asked for, and what is aimed at the limit itself comes near it and never gets there.
constexpr double kAim = 0.97, kMore = 1.3;

using Row = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// A point of the new envelope: how it follows the control points, and how far it is to move back.
struct EnvelopePoint {
  RingCircle circle;     ///< x: the envelope's normal across the axis, away from the material that is left
  double inwards = 1.0;  ///< sign of the angle from there along the engaged arc
  bool on_envelope = false;
};

/// Where a ring touches the envelope on the side towards which fronts advance.
EnvelopePoint envelope_point(const AxisJet& axis, const ToolRing& ring, const Vec3& forward) {
  EnvelopePoint out;
  const Vec3 v = axis.velocity(ring.s);
  const double along = v.dot(axis.u);
  const Vec3 across = v - along * axis.u;
  const double speed = across.norm();
  if (!(speed > 0.0)) return out;
  const double c = -ring.sine * along / (ring.cosine * speed);
  if (!(std::abs(c) < 1.0)) return out;
  const Vec3 x = across / speed, y = axis.u.cross(x);
  const RingCircle circle{axis.at(ring.z), x, y, ring.radius};
  const double half = std::acos(c);
  const double side = circle.direction(half).dot(forward) > circle.direction(-half).dot(forward) ? 1.0 : -1.0;
  const Vec3 normal = circle.direction(side * half);
  out = {{circle.centre, normal, axis.u.cross(normal), ring.radius}, -side, true};
  return out;
}

/// In the blank, and in none of the last sweeps at their poses: those of the front before and of the back between, whose
/// envelopes a point moves back to.
bool is_left(const SweptStock& stock, const Vec3& x) {
  constexpr std::size_t kRecent = 3;
  for (const HalfSpace& h : stock.blank())
    if (h.normal.dot(x) > h.offset) return false;
  const std::vector<Sweep>& sweeps = stock.sweeps();
  for (std::size_t k = sweeps.size() - std::min(kRecent, sweeps.size()); k < sweeps.size(); ++k)
    for (const Pose& pose : sweeps[k].axes) {
      const Vec3 d = x - pose.tip;
      const double z = d.dot(pose.axis);
      ToolProfile::Place place;
      if (stock.profile().at(z, place) && (d - z * pose.axis).squaredNorm() < place.radius * place.radius) return false;
    }
  return true;
}

/// How far x must go against `normal` to leave the material, mm; 0 where it is in none.
double way_out(const SweptStock& stock, const Vec3& x, const Vec3& normal) {
  constexpr int kSteps = 16, kBisections = 12;
  const double most = 0.5 * stock.profile().largest();
  if (!is_left(stock, x)) return 0.0;
  double low = 0.0, high = most;
  for (int k = 1; k <= kSteps; ++k) {
    high = most * k / kSteps;
    if (!is_left(stock, x - high * normal)) break;
    low = high;
  }
  for (int k = 0; k < kBisections && high > low; ++k) {
    const double middle = 0.5 * (low + high);
    (is_left(stock, x - middle * normal) ? low : high) = middle;
  }
  return high;
}

/// What the inner control points of both rails move a point of the axis' height z by, along `normal`.
Row row_of(const RuledMotion& motion, double t, double z, const Vec3& normal) {
  Row row = Row::Zero();
  const std::vector<double>& knots = motion.tip.knots;
  const int degree = motion.tip.degree, span = find_span(degree, knots, t);
  std::array<double, 4> basis{};
  basis_derivatives(degree, knots, span, t, 0, basis.data());
  for (int j = 0; j < kInner; ++j) {
    const int k = kFirstInner + j - (span - degree);
    if (k < 0 || k > degree) continue;
    const double b = basis[static_cast<std::size_t>(k)];
    row.segment<3>(3 * j) = b * normal;
    row.segment<3>(3 * (kInner + j)) = b * z * normal;
  }
  return row;
}

/// The normal equations of one round: sum of (row * x + back)^2.
struct Equations {
  Normal matrix = Normal::Zero();
  Row right = Row::Zero();
  double rows = 0.0;
  void add(const Row& row, double back) {
    matrix += row * row.transpose();
    right -= back * row;
    rows += 1.0;
  }
  /// Both inner points of a rail are moved alike, and the directions little, where nothing else decides.
  [[nodiscard]] Row solved(double axis_length) const {
    Normal a = matrix / rows;
    for (int k = 0; k < 3; ++k)
      for (const int rail : {0, 3 * kInner}) {
        const double weight = kFairness * (rail == 0 ? 1.0 : axis_length * axis_length);
        // Second differences over the points 1 to 4, of which 1 and 4 stay.
        a(rail + k, rail + k) += 5.0 * weight;
        a(rail + 3 + k, rail + 3 + k) += 5.0 * weight;
        a(rail + k, rail + 3 + k) -= 4.0 * weight;
        a(rail + 3 + k, rail + k) -= 4.0 * weight;
      }
    return a.ldlt().solve(right / rows);
  }
};

/// Engagement of every ring at every row, in the order of measure.
std::vector<double> angles_of(const RuledMotion& front, EngagementMeter& meter, const std::vector<ToolRing>& rings) {
  std::vector<double> angles(static_cast<std::size_t>(kRows) * rings.size());
  meter.measure_rings(front, rings, kRows, angles);
  return angles;
}

}  // namespace

std::optional<RuledMotion> adjusted_front(RuledMotion front, EngagementMeter& meter, const SweptStock& stock,
                                          double largest_rad) {
  const std::vector<ToolRing> rings = tool_rings(stock.radial(), kRings, 0);
  const double middle = 0.5 * front.axis_length;
  const Vec3 forward = front.jet(0.0).velocity(middle).normalized() - front.jet(1.0).velocity(middle).normalized();
  for (int round = 0;; ++round) {
    const std::vector<double> angles = angles_of(front, meter, rings);
    if (*std::max_element(angles.begin(), angles.end()) <= largest_rad) return front;
    if (round == kMostRounds) return std::nullopt;
    Equations equations;
    for (int i = 0; i < kRows; ++i) {
      const double t = EngagementMeter::time_of(static_cast<std::size_t>(i), kRows);
      const AxisJet axis = front.jet(t);
      for (std::size_t r = 0; r < rings.size(); ++r) {
        const EnvelopePoint point = envelope_point(axis, rings[r], forward);
        if (!point.on_envelope) continue;
        double back = 0.0;
        if (angles[static_cast<std::size_t>(i) * rings.size() + r] > largest_rad)
          back = kMore * way_out(stock, point.circle.at(point.inwards * kAim * largest_rad), point.circle.x);
        equations.add(row_of(front, t, rings[r].z, point.circle.x), back);
      }
    }
    if (!(equations.rows > 0.0)) return std::nullopt;
    const Row moved = equations.solved(front.axis_length);
    for (int j = 0; j < kInner; ++j) {
      front.tip.poles.col(kFirstInner + j) += moved.segment<3>(3 * j);
      front.direction.poles.col(kFirstInner + j) += moved.segment<3>(3 * (kInner + j));
    }
  }
}

}  // namespace flank::internal

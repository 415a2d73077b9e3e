#include "flank/obstacle/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Newton steps: outside the body the second derivative is exact, and a handful closes the bound. Inside it has kinks,
/// and what has not closed by then is divided.
constexpr int kMostSteps = 24;
constexpr int kMostHalvings = 12;  ///< of a step that does not lower the value: 2e-4 of it is no step any more
/// Of a divided triangle: a limit of time. The value found stands, its proof does not.
constexpr int kMostParts = 6000;
constexpr double kEnoughFall = 1e-3;  ///< of what a step's slope promises: Armijo's rule, which keeps steps from idling
/// Determinant against the product of the diagonal at which a two-dimensional quadratic is one-dimensional.
constexpr double kFlat = 1e-12;

using Corners = std::array<Vec3, 3>;

/// The least value that the tangent plane at x takes on the triangle.
double tangent_bound(const BodyJet& jet, const Vec3& x, const Corners& v) {
  double least = 0.0;
  for (const Vec3& corner : v) least = std::min(least, jet.gradient.dot(corner - x));
  return jet.value + least;
}

/// Quadratic model in the two sides from corner 0, and where it is least in the triangle.
struct Model {
  double g1 = 0.0, g2 = 0.0, h11 = 0.0, h12 = 0.0, h22 = 0.0;

  [[nodiscard]] double at(double a, double b) const {
    return g1 * a + g2 * b + 0.5 * (h11 * a * a + 2.0 * h12 * a * b + h22 * b * b);
  }

  /// Steps (a, b) from (p, q); p + a >= 0, q + b >= 0, p + a + q + b <= 1.
  [[nodiscard]] Vec2 least(double p, double q) const {
    const double det = h11 * h22 - h12 * h12;
    if (det > kFlat * (h11 * h22)) {
      const double a = (h12 * g2 - h22 * g1) / det, b = (h12 * g1 - h11 * g2) / det;
      if (p + a >= 0.0 && q + b >= 0.0 && p + a + q + b <= 1.0) return {a, b};
    }
    // Else the least is on the triangle's border: the least of three quadratics of one variable.
    Vec2 best(0.0, 0.0);
    const auto side = [&](double a, double b, double da, double db) {
      // Along (a, b) + t (da, db), 0 <= t <= 1.
      const double slope = (g1 + h11 * a + h12 * b) * da + (g2 + h12 * a + h22 * b) * db;
      const double bend = h11 * da * da + 2.0 * h12 * da * db + h22 * db * db;
      const double t = bend > 0.0 ? std::clamp(-slope / bend, 0.0, 1.0) : slope < 0.0 ? 1.0 : 0.0;
      if (at(a + t * da, b + t * db) < at(best.x(), best.y())) best = {a + t * da, b + t * db};
    };
    side(-p, -q, 1.0, 0.0);
    side(-p, -q, 0.0, 1.0);
    side(1.0 - p, -q, -1.0, 1.0);
    return best;
  }
};

class Descent {
 public:
  Descent(const ConvexProfile& body, const Pose& pose, const Corners& v, double cutoff, bool any)
      : body_(body), pose_(pose), v_(v), cutoff_(cutoff), any_(any), side1_(v[1] - v[0]), side2_(v[2] - v[0]) {}

  TriangleDistance run() {
    // From the middle: its tangent plane alone shows of most triangles that they are too far.
    double p = 1.0 / 3.0, q = 1.0 / 3.0;
    move_to(p, q);
    for (int k = 0; k < kMostSteps; ++k) {
      if (any_ && best_.value < cutoff_) return finished();
      lower_ = std::max(lower_, tangent_bound(best_.jet, best_.point, v_));
      if (lower_ >= cutoff_ || best_.value - lower_ <= kTriangleDistanceError) return finished();
      if (!step(p, q)) break;
    }
    divide();
    return finished();
  }

 private:
  struct Part {
    Corners corners;
    double bound = 0.0;
  };

  [[nodiscard]] Vec3 place(double p, double q) const { return v_[0] + p * side1_ + q * side2_; }

  void move_to(double p, double q) {
    best_.point = place(p, q);
    best_.jet = body_jet(body_, pose_, best_.point);
    best_.value = best_.jet.value;
  }

  bool step(double& p, double& q) {
    const BodyJet& jet = best_.jet;
    Model model{jet.gradient.dot(side1_), jet.gradient.dot(side2_), jet.second(pose_.axis, side1_, side1_),
                jet.second(pose_.axis, side1_, side2_), jet.second(pose_.axis, side2_, side2_)};
    const Vec2 move = model.least(p, q);
    const double slope = model.g1 * move.x() + model.g2 * move.y();
    if (!(slope < 0.0)) return false;
    double share = 1.0;
    for (int k = 0; k < kMostHalvings; ++k, share *= 0.5) {
      const double a = p + share * move.x(), b = q + share * move.y();
      const Vec3 x = place(a, b);
      const BodyJet there = body_jet(body_, pose_, x);
      if (!(there.value <= best_.value + kEnoughFall * share * slope)) continue;
      p = a;
      q = b;
      best_.point = x;
      best_.jet = there;
      best_.value = there.value;
      return true;
    }
    return false;
  }

  /// Quarters, depth first, without those whose tangent bound shows that they hold nothing lower.
  void divide() {
    constexpr std::size_t kStack = 128;  // three entries stay behind per level: 42 halvings, which no double needs
    std::array<Part, kStack> stack;
    std::size_t top = 0;
    stack[top++] = {v_, lower_};
    for (int parts = 0; top > 0 && parts < kMostParts; ++parts) {
      const Part part = stack[--top];
      const double slack = kTriangleDistanceError + std::max(0.0, -kDepthShareError * best_.value);
      if (part.bound >= std::min(best_.value - slack, cutoff_) || top + 4 > stack.size()) continue;
      const Corners& t = part.corners;
      const Vec3 a = 0.5 * (t[1] + t[2]), b = 0.5 * (t[2] + t[0]), c = 0.5 * (t[0] + t[1]);
      for (const Corners& quarter : {Corners{t[0], c, b}, Corners{c, t[1], a}, Corners{b, a, t[2]}, Corners{a, b, c}})
        stack[top++] = {quarter, std::max(part.bound, look_at(quarter))};
      // The one that may hold the least on top.
      std::sort(stack.begin() + static_cast<std::ptrdiff_t>(top) - 4, stack.begin() + static_cast<std::ptrdiff_t>(top),
                [](const Part& x, const Part& y) { return x.bound > y.bound; });
    }
  }

  /// Measures the middle of a part; returns its tangent bound.
  double look_at(const Corners& t) {
    const Vec3 x = (t[0] + t[1] + t[2]) / 3.0;
    const BodyJet jet = body_jet(body_, pose_, x);
    if (jet.value < best_.value) {
      best_.value = jet.value;
      best_.point = x;
      best_.jet = jet;
    }
    return tangent_bound(jet, x, t);
  }

  TriangleDistance finished() {
    best_.below = best_.value < cutoff_;
    // Not below: what is promised is a bound of all values, and the place is of no interest.
    if (!best_.below) best_.value = std::max(lower_, cutoff_);
    return best_;
  }

  const ConvexProfile& body_;
  const Pose& pose_;
  const Corners& v_;
  double cutoff_;
  bool any_;
  Vec3 side1_, side2_;
  double lower_ = -1e300;
  TriangleDistance best_;
};

}  // namespace

TriangleDistance triangle_distance(const ConvexProfile& body, const Pose& pose, const Corners& corners, double cutoff,
                                   bool any) {
  return Descent(body, pose, corners, cutoff, any).run();
}

}  // namespace flank::internal

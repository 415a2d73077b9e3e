// Ends of what a sweep takes of a circle, against a dense search over time.
#include "flank/trochoid/engagement/arc_end.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "flank/base/random.h"
#include "flank/trochoid/paths/half_path.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kLength = 17.0, kRadius = 3.3;
constexpr int kIntervals = 48;

AxisPlace place(const Vec3& tip, const Vec3& u, const Vec3& tip_dx, const Vec3& u_dx) {
  return {tip, u.normalized(), tip_dx, u_dx - u_dx.dot(u.normalized()) * u.normalized()};
}

/// A front half of a twisted cavity: it turns sharply, so that a place may be taken at two times.
RuledMotion twisted_half() {
  const AxisPlace from = place({0.0, 0.0, 0.0}, {0.05, 0.12, 1.0}, {1.0, 0.05, 0.0}, {0.001, 0.004, 0.0});
  const AxisPlace to = place({1.0, 9.0, 1.0}, {-0.06, -0.1, 1.0}, {1.0, -0.04, 0.01}, {0.0, -0.003, 0.0});
  return half_path(kLength, from, to.reversed(), {1.5, 1.2, 1.0, 0.0});
}

struct Guess {
  double angle = 0.0;
  Taken taken = Taken::kAbove;
};

class ArcEnd : public ::testing::Test {
 protected:
  [[nodiscard]] double gap(double t, const Vec3& x) const { return gap_at(profile_, sweep_.at(t), x).gap; }
  /// At one of many times around a place, within so many intervals of it.
  [[nodiscard]] bool is_taken(const Vec3& x, double around, double within) const {
    constexpr int kTimes = 400;
    const double low = std::max(0.0, around - within), high = std::min(sweep_.last(), around + within);
    for (int k = 0; k <= kTimes; ++k)
      if (gap(std::lerp(low, high, static_cast<double>(k) / kTimes), x) <= 0.0) return true;
    return false;
  }
  /// A circle across about the axis of a pose, near its tip, where its round end and its flank meet.
  RingCircle circle_near(double t) {
    const SweepPose pose = sweep_.at(t);
    const Vec3 u = pose.direction.normalized(),
               tilted = (u + 0.08 * Vec3(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), 0.0)).normalized();
    RingCircle out;
    out.radius = kRadius * (1.0 + 0.2 * random_.uniform(-1.0, 1.0));
    out.x = tilted.cross(Vec3::UnitY()).normalized();
    out.y = tilted.cross(out.x);
    const double off = kRadius * (1.0 + 0.9 * random_.uniform(-1.0, 1.0)), angle = kPi * random_.uniform(-1.0, 1.0);
    out.centre = pose.tip + (0.2 + 0.9 * random_.uniform(-1.0, 1.0)) * kRadius * u + off * out.direction(angle);
    return out;
  }

  /// Where the pose alone takes the circle, to begin with.
  [[nodiscard]] std::vector<Guess> guesses(const RingCircle& circle, double t) const {
    constexpr int kAngles = 360, kHalvings = 30;
    std::vector<Guess> out;
    const auto in = [&](double angle) { return gap(t, circle.at(angle)) <= 0.0; };
    for (int k = 1; k <= kAngles; ++k) {
      double low = kPi * (2.0 * (k - 1) / kAngles - 1.0), high = kPi * (2.0 * k / kAngles - 1.0);
      const bool before = in(low), after = in(high);
      if (before == after) continue;
      for (int i = 0; i < kHalvings; ++i) (in(0.5 * (low + high)) == before ? low : high) = 0.5 * (low + high);
      out.push_back({after ? high : low, after ? Taken::kAbove : Taken::kBelow});
    }
    return out;
  }

  RadialFunction radial_{ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)};
  ToolProfile profile_{radial_};
  Sweep sweep_ = Sweep::of(twisted_half(), kIntervals);
  Random random_{5};
};

TEST_F(ArcEnd, IsWhereTheSweepEndsAndNotAnotherRoot) {
  constexpr int kCircles = 400;
  /// Of the intervals beside a pose so much is its own: its neighbours have guesses of theirs.
  constexpr double kBeside = 2e-3, kOwn = 0.25;
  int ends = 0;
  for (int n = 0; n < kCircles; ++n) {
    const double t = std::floor(random_.uniform(1.0, sweep_.last() - 1.0));
    const RingCircle circle = circle_near(t);
    for (const Guess& guess : guesses(circle, t)) {
      const double end = arc_end(profile_, circle, {&sweep_, sweep_.last(), t}, guess.angle, guess.taken);
      if (end == guess.angle) continue;  // none near: the sweep goes on taking
      ++ends;
      const double inwards = guess.taken == Taken::kAbove ? kBeside : -kBeside;
      EXPECT_TRUE(is_taken(circle.at(end + inwards), t, sweep_.last()))
          << n << ' ' << t << ' ' << guess.angle << ' ' << end;
      EXPECT_FALSE(is_taken(circle.at(end - inwards), t, kOwn)) << n << ' ' << t << ' ' << guess.angle << ' ' << end;
    }
  }
  EXPECT_GT(ends, kCircles * 3 / 4);
}

}  // namespace
}  // namespace flank::internal

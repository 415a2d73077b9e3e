// The surfaces of a strip are those of its motion, from its first pose to its last.
#include "flank/envelope/strip_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/envelope.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_tools.h"
#include "flank/judge.h"

namespace flank::internal {
namespace {

constexpr int kCount = 37;  ///< places a direction, prime to the grids

constexpr double kTolerance = 0.01;

double share(int i) { return (i + 0.37) / kCount; }

class StripSurfaces : public ::testing::TestWithParam<int> {
 protected:
  const RadialFunction radial = example_tool("barrel").radial;
  const StripMotion strip{7, example_motion(std::abs(GetParam()), radial.axis_length()), 0.125, 0.8,
                          GetParam() > 0 ? +1 : -1};
  const StripSurface made = strip_surface(strip, radial, kTolerance);

  [[nodiscard]] double t(double u) const { return strip.from_t + (strip.to_t - strip.from_t) * u; }
};

TEST_P(StripSurfaces, KeepTheirPromiseBetweenTheirPoints) {
  EXPECT_EQ(made.name, "strip 7");
  EXPECT_EQ(made.stretch.area(), 1.0);
  EXPECT_EQ(made.title(radial.axis_length()), "strip 7");
  EXPECT_LE(made.envelope_deviation_mm, kStripSurfaceMm);
  EXPECT_LE(made.axis_deviation_mm, kStripSurfaceMm);
  double envelope = 0.0, axis = 0.0, radius = 0.0;
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      const double s = radial.axis_length() * share(j);
      const ContactPoint contact = contact_point(strip.motion, radial, s, t(share(i)), strip.side);
      const Vec3 center = strip.motion.pose(t(share(i))).at(s);
      envelope = std::max(envelope, (made.envelope.value(share(i), share(j)) - contact.point).norm());
      axis = std::max(axis, (made.axis.value(share(i), share(j)) - center).norm());
      radius = std::max(radius, std::abs((made.envelope.value(share(i), share(j)) - center).norm() - radial.at(s).r));
    }
  }
  EXPECT_LE(envelope, kStripSurfaceMm);
  EXPECT_LE(axis, kStripSurfaceMm);
  EXPECT_LE(radius, kStripSurfaceMm);
}

/// What a fit gives: rails and radial function with knots, across which the envelope has a jump of curvature.
TEST(StripSurface, NeedsFewPointsAtKnots) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 60; ++k) {
    t.push_back(k / 60.0);
    const double a = 4.0 * t.back();
    poses.push_back({Vec3(20.0 * a, 6.0 * std::sin(1.7 * a), 2.0 * std::cos(2.3 * a)),
                     Vec3(0.3 * std::sin(a), 0.2 * std::cos(2.1 * a), 1.0).normalized()});
  }
  Eigen::VectorXd c(9);
  c << 3.0, 3.2, 3.1, 2.8, 2.9, 3.4, 3.9, 4.0, 3.7;
  const RadialFunction radial = RadialFunction::spline(25.0, c);
  const RuledMotion motion = fit_motion(poses, t, 25.0, 11);
  ASSERT_LT(regularity(motion, radial, 100, 40).largest_c, 0.9);
  const StripSurface made = strip_surface({1, motion, 0.03, 0.97, -1}, radial, kTolerance);
  EXPECT_LE(made.envelope_deviation_mm, 0.5 * kStripSurfaceMm);
  EXPECT_LE(made.axis_deviation_mm, 0.5 * kStripSurfaceMm);
  EXPECT_LT(made.envelope.count_u, 150);
  EXPECT_LT(made.envelope.count_v, 80);
}

TEST_P(StripSurfaces, NormalsLookToTheTool) {
  const SurfaceJet jet = made.envelope.jet(0.4, 0.6);
  const Vec3 center = strip.motion.pose(t(0.4)).at(0.6 * radial.axis_length());
  EXPECT_EQ(jet.du.cross(jet.dv).dot(center - jet.p) > 0.0, made.towards_tool);
}

INSTANTIATE_TEST_SUITE_P(Motions, StripSurfaces, ::testing::Values(1, -1, 2, -2, 3));

/// A motion through tips at equal steps, the axis along z.
RuledMotion upright(const std::vector<Vec3>& tips, double length) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (const Vec3& tip : tips) {
    t.push_back(static_cast<double>(t.size()) / static_cast<double>(tips.size() - 1));
    poses.push_back({tip, Vec3::UnitZ()});
  }
  return fit_motion(poses, t, length, 24);
}

/// Of the poses of a motion.
SweptVolume swept(const RuledMotion& motion, const RadialFunction& radial) {
  Path path;
  path.strips.emplace_back();
  path.strips.back().poses = sample_motion(motion, {.chord_tolerance_mm = 1e-5}).poses;
  return {Tool{radial, "", {}, {}}, path};
}

/// What is not true of a surface: the largest distance, mm, of its places from the border of what the motion sweeps, and the number of
/// places at which its normal does not look to the tool.
struct Untrue {
  double off_mm = 0.0;
  int turned = 0;
};

Untrue untrue(const StripSurface& made, const RuledMotion& motion, const RadialFunction& radial) {
  const SweptVolume volume = swept(motion, radial);
  Untrue out;
  for (int i = 0; i < kCount; ++i)
    for (int j = 0; j < kCount; ++j) {
      const SurfaceJet jet = made.envelope.jet(share(i), share(j));
      out.off_mm = std::max(out.off_mm, std::abs(volume.distance(jet.p, 1e300).f));
      const double t = made.stretch.u(share(i)), s = radial.axis_length() * made.stretch.v(share(j));
      const Vec3 to_axis = motion.pose(t).at(s) - jet.p;
      out.turned += (jet.du.cross(jet.dv).dot(to_axis) > 0.0) != made.towards_tool ? 1 : 0;
    }
  return out;
}

std::string said(const StripSurface& made, double length) {
  std::vector<std::string> notes;
  note_strip_surfaces({made}, length, notes);
  return notes.empty() ? "" : notes.front();
}

TEST(StripSurface, IsLeftOutWhereTheToolPlungesAllTheWay) {
  // Along its own axis: no sphere of a tool that grows has a contact.
  const RadialFunction cone(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.1));
  std::vector<Vec3> tips;
  for (int k = 0; k < 60; ++k) tips.emplace_back(0.0, 0.0, 0.5 * k);
  const StripSurface made = strip_surface({1, upright(tips, 20.0), 0.0, 1.0, +1}, cone, kTolerance);
  EXPECT_FALSE(made.has_envelope());
  EXPECT_NE(said(made, 20.0).find("strip 1 is left out"), std::string::npos);
}

/// Ways of a strip to lose its surface on a part of it.
struct Spoiled {
  const char* what;
  std::vector<Vec3> (*tips)();
  int side;
};

/// A plunge that becomes a straight cut.
std::vector<Vec3> plunge_then_cut() {
  std::vector<Vec3> tips;
  for (int k = 0; k < 60; ++k) {
    const double x = std::max(0.0, k - 20.0);
    tips.emplace_back(0.02 * x * x, 0.0, std::min(0.0, 0.4 * (k - 20.0)));
  }
  return tips;
}

/// A straight cut into a corner that is narrower than the tool and out of it: the inner side folds there.
std::vector<Vec3> tight_corner() {
  constexpr double kBend = 1.0;  // mm, radius of the axis' way; the tool has 3 and more
  std::vector<Vec3> tips;
  for (int k = 40; k > 0; --k) tips.emplace_back(-0.75 * k, 0.0, 0.0);
  for (int k = 0; k <= 12; ++k) {
    const double a = 0.5 * 3.14159265358979 * k / 12;
    tips.emplace_back(kBend * std::sin(a), kBend * (1.0 - std::cos(a)), 0.0);
  }
  for (int k = 1; k <= 20; ++k) tips.emplace_back(kBend, kBend + 0.75 * k, 0.0);
  return tips;
}

/// Forward, back over its own way, and forward.
std::vector<Vec3> back_and_forth() {
  std::vector<Vec3> tips;
  for (int k = 0; k < 60; ++k) tips.emplace_back(0.5 * k + 9.0 * std::sin(0.21 * k), 2.0 * std::cos(0.05 * k), 0.0);
  return tips;
}

TEST(StripSurface, HoldsWhatTheStripLeavesAndNoMore) {
  const Spoiled kinds[] = {{"plunges first", plunge_then_cut, +1},  {"plunges first, other side", plunge_then_cut, -1},
                           {"turns in a corner", tight_corner, +1}, {"turns in a corner, outside", tight_corner, -1},
                           {"goes back", back_and_forth, +1},       {"goes back, other side", back_and_forth, -1}};
  const RadialFunction cone(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.1));
  int trimmed = 0;
  for (const Spoiled& kind : kinds) {
    const RuledMotion motion = upright(kind.tips(), 20.0);
    const StripSurface made = strip_surface({4, motion, 0.0, 1.0, kind.side}, cone, kTolerance);
    if (!made.has_envelope()) {
      EXPECT_NE(said(made, 20.0).find("is left out"), std::string::npos) << kind.what;
      ++trimmed;
      continue;
    }
    const Untrue wrong = untrue(made, motion, cone);
    EXPECT_LE(wrong.off_mm, 2.0 * strip_surface_limit(kTolerance)) << kind.what;
    EXPECT_EQ(wrong.turned, 0) << kind.what;
    if (made.stretch.area() == 1.0) continue;
    ++trimmed;
    EXPECT_NE(said(made, 20.0).find("strip 4 contains only"), std::string::npos) << kind.what;
    EXPECT_NE(made.title(20.0).find("% of its length"), std::string::npos) << kind.what;
  }
  EXPECT_GE(trimmed, 4) << "else the kinds are not spoiled";
}

}  // namespace
}  // namespace flank::internal

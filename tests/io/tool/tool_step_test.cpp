// tool.step: the solids are closed, are those of the tool, and lie on the body that its spheres envelope.
#include "flank/io/tool/tool_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/part_files.h"

namespace flank::internal {
namespace {

using testing_io::Scratch;

constexpr double kPi = std::numbers::pi;
constexpr double kPromiseMm = 1e-3;  ///< of the file

Tool tool_of(ToolFamily family, double length, const std::vector<double>& parameters) {
  Tool tool;
  tool.radial = RadialFunction(
      family, length,
      Eigen::Map<const Eigen::VectorXd>(parameters.data(), static_cast<Eigen::Index>(parameters.size())));
  return tool;
}

Tool wavy_spline() {
  Tool tool;
  Eigen::VectorXd c(9);
  c << 3.0, 3.2, 3.1, 2.8, 2.9, 3.4, 3.9, 4.0, 3.7;
  tool.radial = RadialFunction::spline(25.0, c);
  return tool;
}

/// Radius of the flank's solid at z, from the definition alone: the largest circle of the spheres there.
double body_radius(const RadialFunction& radial, double z) {
  double largest = 0.0;
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = radial.axis_length() * i / kSteps, r = radial.at(s).r;
    largest = std::max(largest, r * r - (z - s) * (z - s));
  }
  return std::sqrt(largest);
}

/// Of the body below the meridian point of s = L, by the trapezoidal rule in z.
double body_volume(const RadialFunction& radial) {
  const double low = -radial.at(0.0).r, high = meridian_point(radial, radial.axis_length()).x();
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    // The middle of each slice: the tip's sphere stands steeply on the axis.
    const double rho = body_radius(radial, low + (high - low) * (i + 0.5) / kSteps);
    sum += kPi * rho * rho * (high - low) / kSteps;
  }
  return sum;
}

struct Solids {
  Part part;
  double volume = 0.0;
  std::vector<Vec2> points;  ///< (z, rho) of a grid on the faces, flat ends left out
};

/// Adds what a face, whole and not trimmed, has of the volume by the divergence of (x, y, 0) / 2, to which flat ends add
/// nothing.
void add_face(const Face& face, Solids& out) {
  ASSERT_TRUE(face.loops.empty()) << face.id;
  const BSplineSurface& f = face.surface;
  constexpr int kAround = 160, kAlong = 160;
  const double du = (f.u_last() - f.u_first()) / kAround, dv = (f.v_last() - f.v_first()) / kAlong;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const SurfaceJet p = f.jet(f.u_first() + (i + 0.5) * du, f.v_first() + (j + 0.5) * dv);
      const Vec3 area = p.du.cross(p.dv) * (face.reversed ? -du * dv : du * dv);
      out.volume += 0.5 * (p.p.x() * area.x() + p.p.y() * area.y());
      out.points.emplace_back(p.p.z(), std::hypot(p.p.x(), p.p.y()));
    }
  }
}

Solids written(const Tool& tool) {
  const Scratch scratch;
  Solids out;
  out.part = read_part(scratch.write("tool.step", tool_to_step(tool)));
  for (std::size_t k = 0; k < out.part.faces.size(); ++k)
    if (out.part.surface_types[k] != "plane") add_face(out.part.faces[k], out);
  return out;
}

void expect_body(const Tool& tool) {
  const Solids solids = written(tool);
  EXPECT_EQ(solids.part.solids, 1);
  EXPECT_TRUE(solids.part.repairs.empty());
  for (const Face& face : solids.part.faces) EXPECT_TRUE(face.of_solid);
  const double low = -tool.radial.at(0.0).r;
  const double high = meridian_point(tool.radial, tool.radial.axis_length()).x();
  double worst = 0.0;
  for (std::size_t k = 0; k < solids.points.size(); k += 97) {
    const Vec2& p = solids.points[k];
    worst = std::max(worst, std::abs(p.y() - body_radius(tool.radial, p.x())));
  }
  EXPECT_LT(worst, kPromiseMm);
  EXPECT_NEAR(solids.part.box.low.z(), low, kPromiseMm);
  EXPECT_NEAR(solids.part.box.high.z(), high, kPromiseMm);
  const double volume = body_volume(tool.radial);
  EXPECT_NEAR(solids.volume, volume, 1e-3 * volume);
}

TEST(ToolStep, Cylinder) { expect_body(tool_of(ToolFamily::kCylinder, 20.0, {4.0})); }
TEST(ToolStep, Cone) { expect_body(tool_of(ToolFamily::kCone, 30.0, {2.0, 0.2})); }
TEST(ToolStep, ConeThatGrowsThinner) { expect_body(tool_of(ToolFamily::kCone, 10.0, {4.0, -0.2})); }
TEST(ToolStep, Barrel) { expect_body(tool_of(ToolFamily::kBarrel, 24.0, {85.0, 5.0, 10.0})); }
TEST(ToolStep, ConcaveBarrel) { expect_body(tool_of(ToolFamily::kBarrel, 24.0, {-60.0, 5.0, 10.0})); }
TEST(ToolStep, FreeSpline) { expect_body(wavy_spline()); }

TEST(ToolStep, ShankAndHolderAreObjectsOfTheirOwn) {
  Tool tool = tool_of(ToolFamily::kCylinder, 20.0, {4.0});
  const double flank = written(tool).volume;
  tool.shank = {{20.0, 4.0}, {50.0, 4.0}};
  tool.holder = {{50.0, 10.0}, {60.0, 12.0}, {60.0, 20.0}, {80.0, 20.0}};
  const Solids solids = written(tool);
  EXPECT_EQ(solids.part.solids, 3);
  const double shank = kPi * 16.0 * 30.0, holder = kPi * (10.0 / 3.0 * (100.0 + 120.0 + 144.0) + 400.0 * 20.0);
  EXPECT_NEAR(solids.volume - flank, shank + holder, 1e-3 * (shank + holder));
  const std::string text = tool_to_step(tool);
  for (const char* name : {"'flank'", "'shank'", "'holder'"}) EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(ToolStep, AProfileThatTouchesTheAxisIsTwoSolids) {
  Tool tool = tool_of(ToolFamily::kCylinder, 20.0, {4.0});
  tool.holder = {{30.0, 5.0}, {40.0, 0.0}, {50.0, 5.0}, {50.0, 5.0}};
  EXPECT_EQ(written(tool).part.solids, 3);
}

TEST(ToolStep, SameBytesEveryTime) {
  Tool tool = wavy_spline();
  tool.shank = {{24.0, 4.0}, {50.0, 4.0}};
  EXPECT_EQ(tool_to_step(tool), tool_to_step(tool));
}

TEST(ToolStep, RefusesWhatIsNoTool) {
  EXPECT_THROW((void)tool_to_step(tool_of(ToolFamily::kBarrel, 24.0, {3.0, 5.0, 10.0})), InputError);
}

}  // namespace
}  // namespace flank::internal

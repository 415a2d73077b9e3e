#include "flank/inspect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/inspect/inspect_mesh.h"
#include "flank/inspect/inspect_text.h"
#include "io/part_files.h"
#include "rotor37_file.h"

namespace flank::internal {
namespace {

using testing_io::own_part;

constexpr double kPi = std::numbers::pi;
/// Of a whole face, and of a trimmed one, whose border cells are halved five times.
constexpr double kWholeAreaShare = 1e-6, kTrimmedAreaShare = 2e-3;

const InspectReport& solids() {
  static const InspectReport report = inspect(read_part(own_part("solids.brep")));
  return report;
}

const InspectRow& row(const std::string& id) {
  for (const InspectRow& r : solids().rows)
    if (r.id == id) return r;
  throw InternalError("no " + id);
}

void expect_area(const std::string& id, double area, double share) {
  EXPECT_NEAR(row(id).area_mm2, area, share * area) << id;
}

TEST(Inspect, AreasOfKnownSurfaces) {
  expect_area("F1", 4.0 * kPi * 25.0, kWholeAreaShare);                  // sphere of radius 5
  expect_area("F2", kPi * 4.0 * std::hypot(4.0, 6.0), kWholeAreaShare);  // cone
  expect_area("F4", 4.0 * kPi * kPi * 12.0, kWholeAreaShare);            // torus of radii 6 and 2
  expect_area("F29", 4.0 * kPi * kPi * 12.0, kWholeAreaShare);           // the same as a periodic spline
  expect_area("F6", kPi * 25.0, kTrimmedAreaShare);                      // disk
  expect_area("F20", kPi * 15.0, kTrimmedAreaShare);                     // ellipse of radii 5 and 3
  expect_area("F28", kPi * (24.0 - 2.25), kTrimmedAreaShare);            // ellipse with a round hole
}

TEST(Inspect, Bends) {
  EXPECT_EQ(row("F1").bend, "convex") << "a ball from outside";
  EXPECT_TRUE(std::isinf(row("F1").smallest_concave_radius_mm));
  EXPECT_EQ(row("F3").bend, "flat");
  EXPECT_EQ(row("F8").bend, "concave") << "the hole through the cylinder";
  EXPECT_NEAR(row("F8").smallest_concave_radius_mm, 2.0, 1e-9);
  EXPECT_EQ(row("F4").bend, "mixed") << "a torus is a saddle inside and convex outside";
  EXPECT_NEAR(row("F4").smallest_concave_radius_mm, 4.0, 1e-6);
  EXPECT_NEAR(row("F4").bend_share[static_cast<std::size_t>(Bend::kSaddle)], 0.5, 0.05);
}

TEST(Inspect, TrimsHolesSolidsAndForm) {
  EXPECT_EQ(row("F1").trims, 0);
  EXPECT_EQ(row("F28").trims, 2);
  EXPECT_EQ(row("F28").holes, 1);
  EXPECT_EQ(row("F28").solid, -1);
  EXPECT_EQ(row("F1").solid, 0);
  EXPECT_TRUE(row("F1").rational);
  EXPECT_EQ(row("F1").degree_u, 2);
  EXPECT_NEAR(row("F1").length_u_mm, 10.0 * kPi, 0.01);
  EXPECT_LT((row("F1").box.high - row("F1").box.low - Vec3::Constant(10.0)).norm(), 0.1);
}

TEST(Inspect, TableHasOneLineAFace) {
  const std::string table = to_table(solids());
  for (const InspectRow& r : solids().rows) EXPECT_NE(table.find("\n" + r.id + " "), std::string::npos) << r.id;
  EXPECT_NE(table.find("solids.brep: BREP, unit mm"), std::string::npos);
}

TEST(Inspect, ASmallPartIsNotZeroAcross) {
  InspectReport report = solids();
  report.box = {Vec3::Zero(), Vec3(0.0393, 0.0121, 12.0)};
  report.rows[0].area_mm2 = 0.000421;
  report.rows[0].length_u_mm = 0.0344, report.rows[0].length_v_mm = 0.0;
  const std::string table = to_table(report);
  EXPECT_NE(table.find("0.039 x 0.012 x 12.0 mm"), std::string::npos);
  EXPECT_NE(table.find("0.034 x 0.00"), std::string::npos);
  EXPECT_NE(table.find(" 0.00042 "), std::string::npos);
}

TEST(Inspect, Json) {
  const nlohmann::json json = nlohmann::json::parse(inspect_to_json(solids()));
  EXPECT_EQ(json.at("schema"), "openflank/inspect/1");
  EXPECT_EQ(json.at("units"), "mm");
  EXPECT_EQ(json.at("faces").size(), solids().rows.size());
  EXPECT_EQ(json.at("faces")[0].at("id"), "F1");
  EXPECT_TRUE(json.at("faces")[0].at("smallest_concave_radius").is_null());
  EXPECT_EQ(json.at("faces")[7].at("bend"), "concave");
  EXPECT_EQ(json.at("faces")[0].at("solid"), 1);
  EXPECT_TRUE(json.at("faces")[27].at("solid").is_null());
  EXPECT_EQ(nlohmann::json::parse(json.dump()), json);
}

TEST(Inspect, Kj66Blades) {
  FLANK_REAL_PART(file, "kj66_impeller.step");
  const InspectReport report = inspect(read_part(file));
  for (const std::size_t face : {0u, 2u, 9u, 11u}) {
    EXPECT_NEAR(report.rows[face].area_mm2, 1895.0, 6.0);
    EXPECT_EQ(report.rows[face].bend, "saddle") << "ruled: negative Gaussian curvature";
    EXPECT_GT(report.rows[face].smallest_concave_radius_mm, 25.0);
  }
}

TEST(Inspect, Rotor37Blade) {
  const InspectReport report = inspect(read_part(test::rotor37_file("rotor37")));
  EXPECT_NEAR(report.rows[0].area_mm2, 3700.0, 60.0);
  EXPECT_NEAR(report.rows[2].area_mm2, 3700.0, 60.0);
  EXPECT_GT(report.rows[2].smallest_concave_radius_mm, 27.0);
}

// A quarter of a tube of radius 10 seen from inside: 0 and 1/10.
TEST(Inspect, MeshCurvaturesOfATube) {
  TriangleMesh mesh;
  const int n = 30;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double a = 0.5 * kPi * i / n;
      mesh.vertices.emplace_back(10.0 * std::cos(a), 10.0 * std::sin(a), 0.5 * j);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b + 1, b});
      mesh.triangles.push_back({a, a + 1, b + 1});
    }
  const auto curvatures = mesh_curvatures(mesh, 200);
  EXPECT_GT(curvatures.size(), 150u);
  for (const auto& [low, high] : curvatures) {
    EXPECT_NEAR(low, 0.0, 0.01);
    EXPECT_NEAR(high, 0.1, 0.01);
  }
}

TEST(Inspect, Mesh) {
  FLANK_REAL_PART(file, "nasty_r37_blade_cm_noisy.stl");
  const Part part = read_part(file, "cm");
  const InspectReport report = inspect(part);
  ASSERT_EQ(report.rows.size(), part.mesh_faces.size());
  EXPECT_EQ(report.rows[0].triangles, static_cast<int>(part.mesh_faces[0].size()));
  // The noise of 0.02 mm does not drown the blade's own curvature (28 mm on the CAD face).
  EXPECT_GT(report.rows[1].smallest_concave_radius_mm, 3.0);
  EXPECT_GT(report.rows[1].area_mm2, 10.0 * report.rows[2].area_mm2);
  EXPECT_NE(to_table(report).find("notes"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal

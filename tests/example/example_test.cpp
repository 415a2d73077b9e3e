#include "flank/example.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flank/envelope.h"
#include "flank/error.h"
#include "flank/example/example_blades.h"

namespace flank::internal {
namespace {

constexpr double kRadToDegrees = 180.0 / 3.14159265358979323846;

/// Coarse, so that the tests that only look at the form are quick.
const ExampleOptions kQuick{.relative_accuracy = 1e-6, .mesh_vertices = 2000};

Vec3 normal(const BSplineSurface& surface, double u, double v) {
  const SurfaceJet jet = surface.jet(u, v);
  return jet.du.cross(jet.dv).normalized();
}

double angle_degrees(const Vec3& a, const Vec3& b) { return kRadToDegrees * std::atan2(a.cross(b).norm(), a.dot(b)); }

TEST(Example, EveryNameMakesAPart) {
  const std::vector<std::string> names = example_names();
  EXPECT_EQ(names.size(), 27u);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names) {
    const Example example = make_example(name, kQuick);
    EXPECT_EQ(example.name, name);
    EXPECT_FALSE(example.description.empty());
    EXPECT_NE(example.faces.empty(), !example.mesh.has_value()) << name;
    EXPECT_GT(example.diagonal_mm, 50.0) << name;
    EXPECT_LT(example.diagonal_mm, name == "rotor37-blisk" ? 300.0 : 150.0) << name;
    EXPECT_EQ(example.step.empty(), !name.starts_with("rotor37") && name != "impeller") << name;
    for (std::size_t k = 0; k < example.faces.size(); ++k) EXPECT_EQ(example.faces[k].id, "F" + std::to_string(k + 1));
    const bool known = name.starts_with("envelope") || name.starts_with("cavity-") || name.starts_with("deformed");
    EXPECT_EQ(example.truth.has_value(), known) << name;
    if (known && example.faces.size() > 0) {
      EXPECT_EQ(example.truth->motions.size(), example.faces.size()) << name;
    }
  }
}

TEST(Example, RefusesWhatItDoesNotKnow) {
  try {
    (void)make_example("no-such-part");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("twisted-blade"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("no-such-part"), std::string::npos);
  }
  EXPECT_THROW((void)make_example("envelope-mesh", {.mesh_vertices = -1}), UsageError);
  EXPECT_THROW((void)make_example("envelope-noisy", {.noise = std::nan("")}), UsageError);
  EXPECT_THROW((void)make_example("envelope-cone-1", {.relative_accuracy = 0.0}), UsageError);
}

TEST(Example, IsTheSameEveryTime) {
  for (const char* name : {"envelope-spline-2", "envelope-noisy", "twisted-blade"}) {
    const Example a = make_example(name, kQuick), b = make_example(name, kQuick);
    if (a.mesh) {
      EXPECT_EQ(a.mesh->vertices, b.mesh->vertices);
      EXPECT_EQ(a.mesh->triangles, b.mesh->triangles);
    } else {
      EXPECT_EQ(a.faces[0].surface.poles, b.faces[0].surface.poles);
    }
  }
}

TEST(Example, TruthPathFollowsItsMotions) {
  const Example example = make_example("cavity-barrel", kQuick);
  const ExampleTruth& truth = *example.truth;
  ASSERT_EQ(truth.path.strips.size(), 2u);
  EXPECT_LE(truth.path_bound_mm, 1e-5);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<Pose>& poses = truth.path.strips[k].poses;
    EXPECT_EQ(poses.front().tip, truth.motions[k].pose(0.0).tip);
    EXPECT_EQ(poses.back().axis, truth.motions[k].pose(1.0).axis);
    EXPECT_EQ(truth.path.strips[k].face, example.faces[k].id);
  }
}

TEST(Example, CavitySidesFaceEachOtherAndLeaveRoom) {
  for (const char* name : {"cavity-barrel", "cavity-hyperbolic", "cavity-cone", "cavity-spline"}) {
    const Example example = make_example(name, kQuick);
    ASSERT_EQ(example.faces.size(), 2u);
    const Vec3 a = normal(example.faces[0].surface, 0.5, 0.5), b = normal(example.faces[1].surface, 0.5, 0.5);
    EXPECT_GT(angle_degrees(a, b), 150.0) << name;
    // The tool on one side stays clear of the other.
    const RadialFunction& radial = example.truth->tool.radial;
    for (std::size_t k = 0; k < 2; ++k) {
      const BSplineSurface& other = example.faces[1 - k].surface;
      double room = 1e300;
      for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 10; ++j) {
          const double s = radial.axis_length() * j / 10.0;
          const Vec3 centre = example.truth->motions[k].pose(i / 20.0).at(s);
          for (int p = 0; p <= 20; ++p)
            for (int q = 0; q <= 10; ++q)
              room = std::min(room, (other.value(p / 20.0, q / 10.0) - centre).norm() - radial.at(s).r);
        }
      }
      EXPECT_GT(room, 2.0) << name;
    }
  }
}

TEST(RuledBlade, TurnsBy50DegreesAlongStraightRulings) {
  const BSplineSurface surface = ruled_blade().surface;
  EXPECT_EQ(surface.degree_v, 1);
  for (const double u : {0.0, 0.2, 0.5, 0.77, 1.0}) {
    EXPECT_NEAR((surface.value(u, 1.0) - surface.value(u, 0.0)).norm(), 50.0, 0.1);
    EXPECT_NEAR(angle_degrees(normal(surface, u, 0.0), normal(surface, u, 1.0)), 50.0, 1.5);
  }
  for (const double v : {0.0, 1.0}) {
    double length = 0.0;
    for (int i = 0; i < 200; ++i) length += (surface.value((i + 1) / 200.0, v) - surface.value(i / 200.0, v)).norm();
    EXPECT_GT(length, 65.0);
    EXPECT_LT(length, 85.0);
  }
}

TEST(TwistedBlade, TwistsAndIsNotRuled) {
  const BSplineSurface surface = twisted_blade().surface;
  const Vec3 root = surface.value(1.0, 0.0) - surface.value(0.0, 0.0),
             tip = surface.value(1.0, 1.0) - surface.value(0.0, 1.0);
  EXPECT_NEAR(angle_degrees(root, tip), 30.0, 1e-6);
  double bulge = 0.0;  // of the lines up the span over their chords
  for (const double u : {0.0, 0.5, 1.0}) {
    const Vec3 a = surface.value(u, 0.0), b = surface.value(u, 1.0), m = surface.value(u, 0.5);
    bulge = std::max(bulge, (m - a).cross(b - a).norm() / (b - a).norm());
  }
  EXPECT_GT(bulge, 0.5);
  // Across the chord it is convex towards the machining side everywhere.
  for (const double u : {0.05, 0.3, 0.5, 0.7, 0.95})
    for (const double v : {0.0, 0.4, 1.0}) EXPECT_LT(surface.jet(u, v).duu.dot(normal(surface, u, v)), 0.0);
}

TEST(EllipticSide, CurvesAwayFromTheToolBothWays) {
  const BSplineSurface surface = elliptic_side().surface;
  for (const double u : {0.02, 0.5, 0.98}) {
    for (const double v : {0.02, 0.5, 0.98}) {
      const SurfaceJet jet = surface.jet(u, v);
      const Vec3 n = normal(surface, u, v);
      const double l = jet.duu.dot(n), m = jet.duv.dot(n), k = jet.dvv.dot(n);
      EXPECT_LT(l, 0.0);
      EXPECT_GT(l * k - m * m, 0.0);
      EXPECT_GT(n.dot(Vec3(jet.p.x(), jet.p.y(), 0.0)), 0.0);
    }
  }
}

TEST(ExampleMesh, HasItsVerticesOnTheEnvelopeAndLooksToTheAxis) {
  const Example example = make_example("envelope-mesh");
  const TriangleMesh& mesh = *example.mesh;
  EXPECT_NEAR(static_cast<double>(mesh.vertices.size()), 13000.0, 500.0);
  const RuledMotion& motion = example.truth->motions[0];
  const RadialFunction& radial = example.truth->tool.radial;
  const int count_s = static_cast<int>(std::lround(std::sqrt(0.5 * static_cast<double>(mesh.vertices.size())))),
            count_t = 2 * count_s;
  for (std::size_t k = 0; k < mesh.vertices.size(); k += 7) {
    const double t = static_cast<double>(static_cast<int>(k) / count_s) / (count_t - 1);
    const double s = radial.axis_length() * static_cast<double>(static_cast<int>(k) % count_s) / (count_s - 1);
    EXPECT_LT((contact_point(motion, radial, s, t, 1).point - mesh.vertices[k]).norm(), 1e-12);
  }
  for (const auto& triangle : mesh.triangles) {
    const Vec3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    ASSERT_LT((b - a).cross(c - a).y(), 0.0);  // contact side +1 looks to +y, the axis lies the other way
  }
}

TEST(ExampleMesh, NoiseHasItsLength) {
  const Example plain = make_example("envelope-mesh", kQuick), noisy = make_example("envelope-noisy", kQuick);
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < plain.mesh->vertices.size(); ++k) {
    const Vec3 shift = noisy.mesh->vertices[k] - plain.mesh->vertices[k];
    EXPECT_NEAR(shift.norm(), 1e-4 * plain.diagonal_mm, 1e-12);
    mean += shift / static_cast<double>(plain.mesh->vertices.size());
  }
  EXPECT_LT(mean.norm(), 0.1 * 1e-4 * plain.diagonal_mm);
}

TEST(ExampleMesh, HolesAreTwoAndInside) {
  const Example plain = make_example("envelope-mesh", kQuick), holed = make_example("envelope-holes", kQuick);
  const double lost =
      1.0 - static_cast<double>(holed.mesh->triangles.size()) / static_cast<double>(plain.mesh->triangles.size());
  EXPECT_NEAR(lost, 3.14159 * 1.5 * (0.08 * 0.08 + 0.06 * 0.06), 0.01);
  // Closed borders: the outer one and two holes. Euler: V - E + F = 1 - holes.
  std::set<std::pair<int, int>> edges;
  for (const auto& triangle : holed.mesh->triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax({triangle[k], triangle[(k + 1) % 3]}));
  const int euler = static_cast<int>(holed.mesh->vertices.size()) - static_cast<int>(edges.size()) +
                    static_cast<int>(holed.mesh->triangles.size());
  EXPECT_EQ(euler, 1 - 2);
}

}  // namespace
}  // namespace flank::internal

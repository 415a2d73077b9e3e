// Parameters of disk-like patches: exact on rectangles, one to one on others, and what is no disk.
#include "flank/surface/mesh/mesh_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

std::optional<MeshParameters> parameters(TriangleMesh& mesh) {
  const MeshTopology topology = link_triangles(mesh, 0.9);
  return parametrize(mesh, topology);
}

/// Every triangle keeps its orientation and some of its area in the parameter plane.
void expect_one_to_one(const TriangleMesh& mesh, const std::vector<Vec2>& uv) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 x = uv[static_cast<std::size_t>(a)], e = uv[static_cast<std::size_t>(b)] - x,
               f = uv[static_cast<std::size_t>(c)] - x;
    EXPECT_GT(e[0] * f[1] - e[1] * f[0], 0.0);
  }
}

double sum_of_areas(const TriangleMesh& mesh, const std::vector<Vec2>& uv) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 x = uv[static_cast<std::size_t>(a)], e = uv[static_cast<std::size_t>(b)] - x,
               f = uv[static_cast<std::size_t>(c)] - x;
    sum += 0.5 * (e[0] * f[1] - e[1] * f[0]);
  }
  return sum;
}

/// The square [-10, 10]^2 with a round hole of radius 4 in its middle, by rings that turn from circle to square.
TriangleMesh with_round_hole() {
  return shapes::grid(
      96, 14,
      [](double u, double v) -> Vec3 {
        const double angle = 2.0 * std::numbers::pi * u;
        const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
        const double to_square = 10.0 / direction.cwiseAbs().maxCoeff();
        return (to_square + v * (4.0 - to_square)) * direction;
      },
      true);
}

/// A dish with a round, smooth rim of radius 9 and a rise of 0.02 r^2.
TriangleMesh dish() {
  return shapes::grid(40, 40, [](double u, double v) {
    const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
    const double a = 9.0 * x * std::sqrt(1.0 - 0.5 * y * y), b = 9.0 * y * std::sqrt(1.0 - 0.5 * x * x);
    return Vec3(a, b, 0.02 * (a * a + b * b));
  });
}

TEST(MeshParameters, OfARectangleAreItsCoordinates) {
  TriangleMesh mesh = shapes::sheet(30, 10, 24, 10);
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->four_sided);
  EXPECT_TRUE(p->holes.empty());
  EXPECT_NEAR(std::max(p->size_u, p->size_v), 30.0, 1e-12);
  EXPECT_NEAR(std::min(p->size_u, p->size_v), 10.0, 1e-12);
  // Any corner may be the origin: the map is affine with the rectangle's sides.
  const Vec2 origin = p->uv[0], along = p->uv[24 * 11] - origin, across = p->uv[10] - origin;
  EXPECT_NEAR(std::abs(along[0] * across[1] - along[1] * across[0]), 1.0, 1e-12);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& x = mesh.vertices[v];
    EXPECT_LT((p->uv[v] - (origin + along * x[0] / 30.0 + across * x[1] / 10.0)).norm(), 1e-10);
  }
}

TEST(MeshParameters, MarksTheSidesOfTheSquare) {
  TriangleMesh mesh = shapes::sheet(20, 15, 16, 12);
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  int corners = 0, marked = 0;
  for (std::size_t v = 0; v < p->uv.size(); ++v) {
    const char side = p->side[v];
    if ((side & 1) != 0) {
      EXPECT_NEAR(p->uv[v][0], 0.0, 1e-14);
    }
    if ((side & 2) != 0) {
      EXPECT_NEAR(p->uv[v][0], 1.0, 1e-14);
    }
    if ((side & 4) != 0) {
      EXPECT_NEAR(p->uv[v][1], 0.0, 1e-14);
    }
    if ((side & 8) != 0) {
      EXPECT_NEAR(p->uv[v][1], 1.0, 1e-14);
    }
    marked += side != 0;
    corners += side == 5 || side == 6 || side == 9 || side == 10;
    const Vec3& x = mesh.vertices[v];
    EXPECT_EQ(side != 0, x[0] == 0.0 || x[0] == 20.0 || x[1] == 0.0 || x[1] == 15.0);
  }
  EXPECT_EQ(corners, 4);
  EXPECT_EQ(marked, 2 * 16 + 2 * 12);
}

TEST(MeshParameters, SpreadABentPatchOneToOneOverTheWholeSquare) {
  TriangleMesh mesh = shapes::twisted(30);
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->four_sided);
  expect_one_to_one(mesh, p->uv);
  EXPECT_NEAR(sum_of_areas(mesh, p->uv), 1.0, 1e-12);
  EXPECT_GT(p->size_u * p->size_v, 40.0 * 60.0);
}

TEST(MeshParameters, AreTheSameForAMovedAndScaledMesh) {
  TriangleMesh mesh = shapes::twisted(16), moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& x : moved.vertices) x = 25.0 * (turn * x) + Vec3(100, 200, 300);
  const auto a = parameters(mesh), b = parameters(moved);
  ASSERT_TRUE(a && b);
  for (std::size_t v = 0; v < a->uv.size(); ++v) EXPECT_LT((a->uv[v] - b->uv[v]).norm(), 1e-9);
  EXPECT_NEAR(b->size_u, 25.0 * a->size_u, 1e-6);
}

TEST(MeshParameters, GoOnEvenlyAcrossAHole) {
  TriangleMesh mesh = with_round_hole();
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->four_sided);
  ASSERT_EQ(p->holes.size(), 1u);
  expect_one_to_one(mesh, p->uv);
  for (const int v : p->holes[0]) EXPECT_NEAR(mesh.vertices[static_cast<std::size_t>(v)].norm(), 4.0, 1e-9);
  const double cut_share = 1.0 - sum_of_areas(mesh, p->uv);
  EXPECT_NEAR(cut_share, std::numbers::pi * 16.0 / 400.0, 0.02) << "the hole keeps its share of the square";
}

/// Stairs instead of a circle: still one to one.
TEST(MeshParameters, AreOneToOneAroundAJaggedHole) {
  TriangleMesh mesh = shapes::sheet(20, 20, 30, 30);
  shapes::cut(mesh, [](const Vec3& x) { return (x - Vec3(8, 11, 0)).norm() < 4.0; });
  mesh = repair_mesh(mesh).mesh;
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->four_sided);
  ASSERT_EQ(p->holes.size(), 1u);
  expect_one_to_one(mesh, p->uv);
}

TEST(MeshParameters, ProjectARoundPatchOntoItsPlane) {
  TriangleMesh mesh = dish();
  const auto p = parameters(mesh);
  ASSERT_TRUE(p);
  EXPECT_FALSE(p->four_sided);
  ASSERT_EQ(p->holes.size(), 1u) << "its rim has to be cut out of the square";
  expect_one_to_one(mesh, p->uv);
  for (const Vec2& q : p->uv) {
    EXPECT_GT(q.minCoeff(), 0.01);
    EXPECT_LT(q.maxCoeff(), 0.99);
  }
  EXPECT_NEAR(p->size_u, 18.0, 0.1);
  for (const char side : p->side) EXPECT_EQ(side, 0);
}

TEST(MeshParameters, RefuseWhatIsNoDisk) {
  TriangleMesh ball = shapes::sphere(10, 6);
  EXPECT_FALSE(parameters(ball)) << "no rim";
  TriangleMesh tube = shapes::grid(
      40, 10,
      [](double u, double v) {
        return Vec3(5 * std::cos(2 * std::numbers::pi * u), 5 * std::sin(2 * std::numbers::pi * u), 8 * v);
      },
      true);
  EXPECT_FALSE(parameters(tube)) << "two rims";
  TriangleMesh two = shapes::sheet(10, 10, 5, 5);
  const TriangleMesh other = shapes::sheet(10, 10, 5, 5);
  const auto offset = static_cast<int>(two.vertices.size());
  for (const Vec3& x : other.vertices) two.vertices.push_back(x + Vec3(50, 0, 0));
  for (const auto& [a, b, c] : other.triangles) two.triangles.push_back({a + offset, b + offset, c + offset});
  EXPECT_FALSE(parameters(two)) << "two components";
  TriangleMesh cap = shapes::sphere(10, 20);
  shapes::cut(cap, [](const Vec3& x) { return x[2] > 8.0; });
  cap = repair_mesh(cap).mesh;
  EXPECT_FALSE(parameters(cap)) << "a round rim, and no graph over any plane";
}

}  // namespace
}  // namespace flank::internal

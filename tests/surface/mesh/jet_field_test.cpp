// Rings of neighbours, and jets at all vertices.
#include "flank/surface/mesh/jet_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flank/geom/mesh_repair.h"
#include "flank/threads.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

struct Field {
  TriangleMesh mesh;
  MeshTopology topology;
  std::vector<Vec3> normals;

  explicit Field(TriangleMesh m, double crease = 0.9) : mesh(repair_mesh(std::move(m)).mesh) {
    topology = link_triangles(mesh, crease);
    normals = vertex_normals(mesh);
  }
};

TriangleMesh flat(int n) {
  return shapes::grid(n, n, [n](double u, double v) { return Vec3(n * u, n * v, 0.0); });
}

/// Number of rings between two vertices of flat(n): diagonals run one way only.
int rings_between(int n, int a, int b) {
  const int di = b / (n + 1) - a / (n + 1), dj = b % (n + 1) - a % (n + 1);
  return di * dj > 0 ? std::max(std::abs(di), std::abs(dj)) : std::abs(di) + std::abs(dj);
}

TEST(RingCollector, TakesWholeRingsUntilThereAreEnough) {
  constexpr int n = 20;
  const Field f(flat(n));
  RingCollector rings(f.mesh, f.topology, f.normals);
  const int middle = 10 * (n + 1) + 10;
  for (const auto& [least, ring] : {std::pair(1, 0), std::pair(2, 1), std::pair(7, 1), std::pair(8, 2),
                                    std::pair(19, 2), std::pair(20, 3), std::pair(37, 3)}) {
    const std::vector<int> found = rings.collect(middle, least);
    EXPECT_EQ(found.front(), middle);
    EXPECT_EQ(std::set<int>(found.begin(), found.end()).size(), found.size()) << "none twice";
    for (int v = 0; v < (n + 1) * (n + 1); ++v)
      EXPECT_EQ(std::find(found.begin(), found.end(), v) != found.end(), rings_between(n, middle, v) <= ring)
          << "at least " << least << ", vertex " << v;
    ASSERT_EQ(rings.points().size(), found.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_EQ(rings.points()[k], f.mesh.vertices[static_cast<std::size_t>(found[k])]);
  }
}

TEST(RingCollector, NearVerticesComeBeforeFarOnes) {
  constexpr int n = 12;
  const Field f(flat(n));
  RingCollector rings(f.mesh, f.topology, f.normals);
  const int corner = 0;
  const std::vector<int> found = rings.collect(corner, 30);
  for (std::size_t k = 1; k < found.size(); ++k)
    EXPECT_LE(rings_between(n, corner, found[k - 1]), rings_between(n, corner, found[k]));
}

TEST(RingCollector, EndsWithTheComponent) {
  TriangleMesh two = flat(3);
  const auto offset = static_cast<int>(two.vertices.size());
  const TriangleMesh other = flat(3);
  for (const Vec3& x : other.vertices) two.vertices.push_back(x + Vec3(0, 0, 0.01));
  for (const auto& [a, b, c] : other.triangles) two.triangles.push_back({a + offset, b + offset, c + offset});
  const Field f(two);
  RingCollector rings(f.mesh, f.topology, f.normals);
  EXPECT_EQ(rings.collect(5, 1000).size(), 16u) << "all of its own sheet, nothing of the one close by";
  for (const int v : rings.collect_within(5, 100.0)) EXPECT_LT(v, offset);
}

TEST(RingCollector, DoesNotGoRoundASharpBend) {
  // Two planes at 90 degrees joined without a crease: the normal turns by more than 60 degrees.
  constexpr int n = 8;
  const Field f(shapes::grid(2 * n, 4,
                             [](double u, double v) {
                               const double x = 2 * n * u - n;
                               return x <= 0.0 ? Vec3(x, 4 * v, 0.0) : Vec3(0.0, 4 * v, -x);
                             }),
                2.0);
  RingCollector rings(f.mesh, f.topology, f.normals);
  for (const int v : rings.collect(0, 1000)) EXPECT_GE(f.mesh.vertices[static_cast<std::size_t>(v)][2], 0.0);
}

TEST(RingCollector, TakesThoseWithinARadius) {
  constexpr int n = 20;
  const Field f(flat(n));
  RingCollector rings(f.mesh, f.topology, f.normals);
  const int middle = 10 * (n + 1) + 10;
  for (const double radius : {0.5, 1.0, 2.5, 4.0}) {
    const std::vector<int> found = rings.collect_within(middle, radius);
    const std::set<int> set(found.begin(), found.end());
    for (std::size_t v = 0; v < f.mesh.vertices.size(); ++v)
      EXPECT_EQ(set.contains(static_cast<int>(v)),
                (f.mesh.vertices[v] - f.mesh.vertices[static_cast<std::size_t>(middle)]).norm() <= radius)
          << radius;
  }
}

TEST(FitJets, OnASphereBendByItsRadius) {
  const Field f(shapes::sphere(10, 16));
  const std::vector<JetFit> fits = fit_jets(f.mesh, f.topology, f.normals);
  ASSERT_EQ(fits.size(), f.mesh.vertices.size());
  for (std::size_t v = 0; v < fits.size(); ++v) {
    const Jet& jet = fits[v].jet;
    EXPECT_EQ(jet.origin, f.mesh.vertices[v]);
    EXPECT_EQ(Vec3(jet.frame.col(2)), f.normals[v]);
    const Jet::Heights h = jet.heights(0.0, 0.0);
    EXPECT_NEAR(h.z, 0.0, 1e-5);
    EXPECT_NEAR(0.5 * (h.xx + h.yy), -0.1, 1e-3) << "away from the normal";
    EXPECT_NEAR(h.xx * h.yy - h.xy * h.xy, 0.01, 2e-4);
  }
}

TEST(FitJets, OnAPlaneAreThePlane) {
  const Field f(flat(9));
  for (const JetFit& fit : fit_jets(f.mesh, f.topology, f.normals)) {
    EXPECT_EQ(fit.degree, 4);
    for (const double c : fit.jet.c) EXPECT_NEAR(c, 0.0, 1e-13);
  }
}

TEST(FitJets, DoNotDependOnTheNumberOfThreads) {
  const Field f(shapes::twisted(50));
  set_thread_count(1);
  const std::vector<JetFit> one = fit_jets(f.mesh, f.topology, f.normals);
  set_thread_count(3);
  const std::vector<JetFit> three = fit_jets(f.mesh, f.topology, f.normals);
  set_thread_count(0);
  for (std::size_t v = 0; v < one.size(); ++v) EXPECT_EQ(one[v].jet.c, three[v].jet.c);
}

/// A crumpled place: whatever the polynomial would do, the jet stays near the mesh next to its vertex.
TEST(FitJets, StayTameWhereTheMeshIsCrumpled) {
  TriangleMesh mesh = flat(16);
  Random random(5);
  for (Vec3& x : mesh.vertices) x[2] = random.uniform(-0.4, 0.4);
  const Field f(mesh, 3.0);
  const std::vector<JetFit> fits = fit_jets(f.mesh, f.topology, f.normals);
  int lowered = 0;
  for (std::size_t v = 0; v < fits.size(); ++v) {
    lowered += fits[v].degree < 4;
    const Jet& jet = fits[v].jet;
    const Jet::Heights h = jet.heights(0.0, 0.0);
    EXPECT_LE(std::hypot(h.x, h.y), 1.5 + 1e-12);
    EXPECT_LE(std::abs(h.z), 0.2 * 2.5) << "a fifth of the way to its neighbours, which are at most 2.5 away";
  }
  EXPECT_GT(lowered, 20);
}

/// At the tip of a needle every neighbour's normal is more than 60 degrees away: the vertex is alone.
TEST(FitJets, AtTheTipOfANeedleIsAPlane) {
  constexpr int n = 24;
  TriangleMesh needle;
  needle.vertices.emplace_back(0.0, 0.0, 10.0);
  for (int ring = 1; ring <= 3; ++ring)
    for (int k = 0; k < n; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / n;
      needle.vertices.emplace_back(0.5 * ring * std::cos(angle), 0.5 * ring * std::sin(angle), 10.0 - 4.0 * ring);
    }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    needle.triangles.push_back({0, 1 + k, 1 + next});
    for (int ring = 0; ring < 2; ++ring) {
      const int above = 1 + ring * n, below = above + n;
      needle.triangles.push_back({above + k, below + k, below + next});
      needle.triangles.push_back({above + k, below + next, above + next});
    }
  }
  const Field f(needle);
  ASSERT_EQ(f.mesh.vertices.size(), needle.vertices.size()) << "its sides differ by fifteen degrees: no creases";
  RingCollector rings(f.mesh, f.topology, f.normals);
  ASSERT_EQ(rings.collect(0, 30).size(), 1u);
  const Jet tip = fit_jets(f.mesh, f.topology, f.normals)[0].jet;
  for (const double c : tip.c) EXPECT_EQ(c, 0.0);
  EXPECT_LT((tip.normal(Vec3(0, 0, 10)) - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(FitJets, AllowanceLetsRoughMeshesKeepTheirDegree) {
  TriangleMesh mesh = flat(16);
  Random random(6);
  for (Vec3& x : mesh.vertices) x[2] = 0.3 * random.normal();
  const Field f(mesh, 3.0);
  const auto mean_degree = [&](double allowance) {
    JetOptions options;
    options.allowance = allowance;
    double sum = 0.0;
    for (const JetFit& fit : fit_jets(f.mesh, f.topology, f.normals, options)) sum += fit.degree;
    return sum / static_cast<double>(f.mesh.vertices.size());
  };
  EXPECT_GT(mean_degree(2.0), mean_degree(0.0) + 0.2);
}

}  // namespace
}  // namespace flank::internal

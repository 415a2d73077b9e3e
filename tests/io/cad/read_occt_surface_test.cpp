// Surfaces through a STEP file and back: control points, weights and knots as they were.
#include <gtest/gtest.h>

#include <algorithm>

#include "flank/base/random.h"
#include "io/cad_shapes.h"

namespace flank::internal {
namespace {

using testing_io::through_step;

/// Of a number of about 1: what the writer of the CAD kernel leaves of it.
constexpr double kDigits = 1e-12;

void expect_same(const BSplineSurface& a, const BSplineSurface& b, double size) {
  ASSERT_EQ(a.degree_u, b.degree_u);
  ASSERT_EQ(a.degree_v, b.degree_v);
  ASSERT_EQ(a.count_u, b.count_u);
  ASSERT_EQ(a.count_v, b.count_v);
  ASSERT_EQ(a.knots_u.size(), b.knots_u.size());
  ASSERT_EQ(a.knots_v.size(), b.knots_v.size());
  for (std::size_t i = 0; i < a.knots_u.size(); ++i) EXPECT_NEAR(a.knots_u[i], b.knots_u[i], kDigits);
  for (std::size_t i = 0; i < a.knots_v.size(); ++i) EXPECT_NEAR(a.knots_v[i], b.knots_v[i], kDigits);
  for (std::size_t i = 0; i < a.poles.size(); ++i) EXPECT_LT((a.poles[i] - b.poles[i]).norm(), kDigits * size) << i;
  ASSERT_EQ(a.weights.size(), b.weights.size());
  for (std::size_t i = 0; i < a.weights.size(); ++i) EXPECT_NEAR(a.weights[i], b.weights[i], kDigits);
}

/// Knots of any multiplicity, poles over a bent sheet of 20 mm.
Face random_face(std::uint64_t seed, int degree_u, int degree_v, bool rational) {
  Random random(seed);
  const auto knots = [&](int degree) {
    std::vector<double> k(static_cast<std::size_t>(degree) + 1, -1.0);
    for (int i = 0; i < 3; ++i)
      k.insert(k.end(), static_cast<std::size_t>(i == 1 ? degree - 1 : 1), 0.3 * i + random.uniform(0.0, 0.2));
    k.insert(k.end(), static_cast<std::size_t>(degree) + 1, 2.5);
    return k;
  };
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = degree_u, s.degree_v = degree_v;
  s.knots_u = knots(degree_u), s.knots_v = knots(degree_v);
  s.count_u = static_cast<int>(s.knots_u.size()) - degree_u - 1;
  s.count_v = static_cast<int>(s.knots_v.size()) - degree_v - 1;
  for (int i = 0; i < s.count_u; ++i) {
    for (int j = 0; j < s.count_v; ++j) {
      s.poles.emplace_back(20.0 * i / s.count_u, 20.0 * j / s.count_v, random.uniform(-1.0, 1.0));
      if (rational) s.weights.push_back(random.uniform(0.7, 1.4));
    }
  }
  return face;
}

TEST(ReadSurface, PolynomialSurfacesComeBackAsTheyWere) {
  for (const auto& [u, v] : {std::pair(2, 3), std::pair(3, 3), std::pair(5, 2)}) {
    const Face face = random_face(static_cast<std::uint64_t>(10 * u + v), u, v, false);
    const Part part = through_step({face});
    ASSERT_EQ(part.faces.size(), 1u);
    expect_same(face.surface, part.faces[0].surface, 30.0);
    EXPECT_TRUE(part.faces[0].loops.empty()) << "the whole rectangle needs no trim";
    EXPECT_EQ(part.surface_types[0], "B-spline");
  }
}

TEST(ReadSurface, RationalSurfacesKeepTheirWeights) {
  const Face face = random_face(7, 3, 2, true);
  const Part part = through_step({face});
  ASSERT_EQ(part.faces.size(), 1u);
  expect_same(face.surface, part.faces[0].surface, 30.0);
}

TEST(ReadSurface, EqualWeightsAreNone) {
  Face face = random_face(8, 3, 3, false);
  face.surface.weights.assign(face.surface.poles.size(), 2.0);
  const Part part = through_step({face});
  EXPECT_TRUE(part.faces[0].surface.weights.empty());
  EXPECT_LT((part.faces[0].surface.value(0.4, 0.7) - face.surface.value(0.4, 0.7)).norm(), 1e-11);
}

TEST(ReadSurface, ArcsAreExactArcs) {
  const Part part = through_step({testing_io::octant(7.0), testing_io::torus_patch(12.0, 3.0)});
  ASSERT_EQ(part.faces.size(), 2u);
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const Vec3 sphere = part.faces[0].surface.value(i / 20.0, j / 20.0);
      ASSERT_NEAR(sphere.norm(), 7.0, 1e-11);
      const Vec3 torus = part.faces[1].surface.value(i / 20.0, j / 20.0);
      ASSERT_NEAR(std::hypot(std::hypot(torus.x(), torus.y()) - 12.0, torus.z()), 3.0, 1e-11);
    }
  }
}

/// A cylinder of one inch radius and two inches height that another program wrote, with true cylinders and planes.
TEST(ReadSurface, AnalyticSurfacesOfAFileBecomeTheSameSurface) {
  const Part part = read_part(testing_io::own_part("inch_cylinder.step"));
  const std::vector<std::string>& types = part.surface_types;
  const auto side = std::find(types.begin(), types.end(), "cylinder") - types.begin();
  ASSERT_LT(side, 3);
  const Face& face = part.faces[static_cast<std::size_t>(side)];
  const BSplineSurface& s = face.surface;
  EXPECT_EQ(s.degree_u * s.degree_v, 2) << "arcs by straight lines";
  const Vec3 middle = part.box.center();
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const Vec3 p =
          s.value(s.u_first() + (s.u_last() - s.u_first()) * i / 40, s.v_first() + (s.v_last() - s.v_first()) * j / 4);
      // The axis is one of the frame's: the height is whatever is left.
      const Vec3 d = p - middle;
      double least = 1e300;
      for (int axis = 0; axis < 3; ++axis)
        least = std::min(least, std::abs(std::hypot(d[(axis + 1) % 3], d[(axis + 2) % 3]) - 25.4));
      ASSERT_LT(least, 1e-6);
    }
  }
  EXPECT_NEAR(testing_io::area_of(face), 2.0 * std::numbers::pi * 25.4 * 50.8, 1.0);
}

}  // namespace
}  // namespace flank::internal

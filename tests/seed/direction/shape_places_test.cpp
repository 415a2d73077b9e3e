// Places that follow the shape: one on each plane, samples of the target, and the same wherever the target lies.
#include "flank/seed/direction/shape_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cover/cover_targets.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::sheet;

/// A rectangle with corner p, sides a and b, normal a x b.
Face flat_at(const Vec3& p, const Vec3& a, const Vec3& b) {
  return sheet([=](double u, double v) { return Vec3(p + u * a + v * b); }, 4, 4);
}

/// Five sides of a box of 30 x 30 x 20 mm.
std::vector<Face> box_faces() {
  const Vec3 x(30, 0, 0), y(0, 30, 0), z(0, 0, 20);
  return {flat_at(z, x, y), flat_at(Vec3::Zero(), x, z), flat_at(x, y, z), flat_at(x + y, -x, z), flat_at(y, -y, z)};
}

/// A sheet without symmetries that bends everywhere.
Vec3 wavy(double u, double v) {
  return {50.0 * u, 36.0 * v, 5.0 * std::sin(3.1 * u + 0.3) * std::cos(2.3 * v - 0.2) + 3.0 * u * u * v};
}

TEST(ShapePlacesOfABox, EachPlaneHasOne) {
  const std::vector<SurfaceSample> places = shape_places(*make_target(box_faces()), 5);
  ASSERT_EQ(places.size(), 5u);
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_LT(places[a].normal.dot(places[b].normal), 0.5) << a << " " << b;
}

TEST(ShapePlacesOfABox, EachLiesInTheMiddleOfItsPlane) {
  for (const SurfaceSample& place : shape_places(*make_target(box_faces()), 5)) {
    // Normals of a plane are equal; the nearest to its centre stands for it.
    const Vec3 n = place.normal;
    const Vec3 middle(15.0 + 15.0 * n.x(), 15.0 + 15.0 * n.y(), n.z() > 0.5 ? 20.0 : 10.0);
    EXPECT_LT((place.point - middle).norm(), 6.0) << n.transpose();
  }
}

TEST(ShapePlaces, AreSamplesOfTheTargetAndDifferent) {
  const auto target = make_target({sheet(wavy)});
  for (const int count : {1, 2, 7, 30}) {
    const std::vector<SurfaceSample> places = shape_places(*target, count);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
    for (std::size_t a = 0; a < places.size(); ++a) {
      const Footpoint foot = target->closest(places[a].point);
      EXPECT_NEAR(foot.distance, 0.0, 1e-9);
      EXPECT_NEAR((foot.normal - places[a].normal).norm(), 0.0, 1e-6);
      for (std::size_t b = 0; b < a; ++b) EXPECT_GT((places[a].point - places[b].point).norm(), 1e-3);
    }
  }
}

TEST(ShapePlaces, MoveWithTheTarget) {
  // A lattice in space finds the neighbours: wherever its walls are, they are the same ones.
  const Face face = sheet(wavy);
  const std::vector<SurfaceSample> here = shape_places(*make_target({face}), 12);
  for (const Vec3& shift : {Vec3(0.37, -0.81, 0.13), Vec3(-1000.4, 77.7, -3.3), Vec3(-25.0, -18.0, 0.0)}) {
    const Face moved = testing::moved(face, Eigen::AngleAxisd(0.0, Vec3::UnitX()), shift);
    const std::vector<SurfaceSample> there = shape_places(*make_target({moved}), 12);
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_NEAR((here[k].point + shift - there[k].point).norm(), 0.0, 1e-6) << k;
  }
}

TEST(ShapePlaces, TurnWithTheTarget) {
  const Eigen::AngleAxisd turn(0.8, Vec3(0.5, -0.2, 0.7).normalized());
  const Face face = sheet(wavy);
  const std::vector<SurfaceSample> here = shape_places(*make_target({face}), 9);
  const std::vector<SurfaceSample> there = shape_places(*make_target({testing::moved(face, turn, Vec3::Zero())}), 9);
  for (std::size_t k = 0; k < here.size(); ++k)
    EXPECT_NEAR((turn * here[k].point - there[k].point).norm(), 0.0, 1e-6) << k;
}

TEST(ShapePlaces, BothSidesOfAThinBladeGetTheirOwn) {
  // Two parallel faces half a millimetre apart, machined from outside.
  const Vec3 x(40, 0, 0), z(0, 0, 30);
  const auto blade = make_target({flat_at(Vec3::Zero(), x, z), flat_at(Vec3(40.0, 0.5, 0.0), -x, z)});
  const std::vector<SurfaceSample> places = shape_places(*blade, 6);
  const auto front =
      std::count_if(places.begin(), places.end(), [](const SurfaceSample& p) { return p.normal.y() < 0; });
  EXPECT_GE(front, 2);
  EXPECT_LE(front, 4);
}

}  // namespace
}  // namespace flank::internal

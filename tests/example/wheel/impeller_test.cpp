// The impeller is one valid solid, and its faces are where its header says.
#include "flank/example/wheel/impeller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flank::internal {
namespace {

/// The middle of a face by its parameters, and the normal there that looks out of the material.
struct Middle {
  Vec3 point, outward;
};
Middle middle(const Face& face) {
  const BSplineSurface& s = face.surface;
  const SurfaceJet jet = s.jet(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
  return {jet.p, (face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv).normalized()};
}

Box3 pole_box(const Face& face) {
  Box3 box;
  for (const Vec3& pole : face.surface.poles) box.add(pole);
  return box;
}

/// Towards growing angles about X.
Vec3 forward(const Vec3& p) { return Vec3::UnitX().cross(p).normalized(); }

TEST(Impeller, FacesOfABladeLookOutwards) {
  for (const double from : {0.0, 0.4}) {
    const std::vector<Face> blade = impeller_blade(from, 0.7);
    ASSERT_EQ(blade.size(), 6u);
    // Away from the face on the other side.
    for (const auto& [one, other] : {std::pair{0u, 2u}, {1u, 3u}, {4u, 5u}}) {
      const Middle a = middle(blade[one]), b = middle(blade[other]);
      EXPECT_GT(a.outward.dot(a.point - b.point), 0.0) << from << " " << blade[one].id;
      EXPECT_LT(b.outward.dot(a.point - b.point), 0.0) << from << " " << blade[other].id;
    }
    EXPECT_GT(middle(blade[0]).outward.dot(forward(middle(blade[0]).point)), 0.5);
    EXPECT_LT(middle(blade[2]).outward.dot(forward(middle(blade[2]).point)), -0.5);
    EXPECT_GT(middle(blade[1]).outward.x(), 0.5);
    EXPECT_LT(middle(blade[3]).outward.x(), -0.5);
  }
}

/// The lid must not come out of the hub, whose skin would then have holes of another kind.
TEST(Impeller, TheRootOfABladeLiesInsideTheHub) {
  for (const double from : {0.0, 0.4}) {
    const std::vector<Face> blade = impeller_blade(from, 0.0);
    const BSplineSurface& lid = blade[4].surface;
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 40; ++j) {
        const Vec3 p = lid.value(std::lerp(lid.u_first(), lid.u_last(), 0.1 * i),
                                 std::lerp(lid.v_first(), lid.v_last(), 0.025 * j));
        const double share = p.x() / 30.0;
        EXPECT_LT(std::hypot(p.y(), p.z()), 16.0 + 16.0 * share * share - 0.5) << from << " " << i << " " << j;
      }
  }
}

TEST(Impeller, IsOneSolidWithItsFacesInOrder) {
  const SolidModel model = impeller();
  ASSERT_EQ(model.faces.size(), 26u);
  for (const Face& face : model.faces) EXPECT_TRUE(face.of_solid) << face.id;
  for (std::size_t k = 0; k < 2 * kImpellerPairs; ++k) {
    const Middle back = middle(model.faces[6 + 4 * k]), front = middle(model.faces[8 + 4 * k]);
    EXPECT_LT(back.outward.dot(forward(back.point)), -0.5) << k;
    EXPECT_GT(front.outward.dot(forward(front.point)), 0.5) << k;
    EXPECT_LT(model.faces[5 + 4 * k].surface.count_u, 3) << "an edge, ruled across";
    // A pitch from main blade to main blade and from splitter to splitter.
    if (k >= 2) {
      const Vec3 before = middle(model.faces[8 + 4 * (k - 2)]).point;
      EXPECT_LT((Eigen::AngleAxisd(kImpellerPitchRad, Vec3::UnitX()) * before - front.point).norm(), 1e-6) << k;
    }
    EXPECT_EQ(model.faces[8 + 4 * k].surface.degree_u, 3);
    EXPECT_EQ(model.faces[8 + 4 * k].surface.degree_v, 3);
  }
  // A splitter begins behind the main blade and is shorter.
  const Box3 main = pole_box(model.faces[8]), splitter = pole_box(model.faces[12]);
  EXPECT_GT(splitter.low.x(), main.low.x() + 5.0);
  EXPECT_TRUE(model.step.starts_with("ISO-10303-21;"));
  EXPECT_EQ(model.step, impeller().step);
}

}  // namespace
}  // namespace flank::internal

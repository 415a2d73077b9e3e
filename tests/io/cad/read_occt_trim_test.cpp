// Trims through a STEP file and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "flank/error.h"
#include "flank/io/cad/read_occt_trim.h"
#include "io/cad_shapes.h"

namespace flank::internal {
namespace {

using testing_io::enclosed;
using testing_io::through_step;

constexpr double kPi = std::numbers::pi;

/// Loops of the face, the largest first.
std::vector<TrimLoop> by_size(const Face& face) {
  std::vector<TrimLoop> loops = face.loops;
  std::sort(loops.begin(), loops.end(),
            [](const TrimLoop& a, const TrimLoop& b) { return std::abs(enclosed(a)) > std::abs(enclosed(b)); });
  return loops;
}

void expect_closed(const TrimLoop& loop) {
  for (std::size_t i = 0; i < loop.edges.size(); ++i) {
    const BSplineCurve2 &a = loop.edges[i], &b = loop.edges[(i + 1) % loop.edges.size()];
    EXPECT_LT((a.value(a.last()) - b.value(b.first())).norm(), 1e-12);
  }
}

TEST(ReadTrim, APolygonKeepsItsCornersInTheirOrder) {
  const std::vector<Vec2> corners{{0.1, 0.2}, {0.9, 0.1}, {0.8, 0.7}, {0.45, 0.9}};
  Face face = test::plane_face("F1", 10.0, 4.0);
  face.loops = {test::polygon(corners)};
  const Part part = through_step({face});
  ASSERT_EQ(part.faces.size(), 1u);
  ASSERT_EQ(part.faces[0].loops.size(), 1u);
  const TrimLoop& loop = part.faces[0].loops[0];
  ASSERT_EQ(loop.edges.size(), 4u);
  expect_closed(loop);
  // The file may begin at any corner.
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if ((loop.edges[i].value(loop.edges[i].first()) - corners[0]).norm() < 1e-9) begin = i;
  for (std::size_t i = 0; i < 4; ++i) {
    const BSplineCurve2& edge = loop.edges[(begin + i) % 4];
    EXPECT_LT((edge.value(edge.first()) - corners[i]).norm(), 1e-12) << i;
    EXPECT_LT((edge.value(0.5 * (edge.first() + edge.last())) - 0.5 * (corners[i] + corners[(i + 1) % 4])).norm(),
              1e-12);
  }
}

TEST(ReadTrim, HolesComeBackAsHolesAndCirclesAsCircles) {
  Face face = test::plane_face("F1", 10.0, 10.0);
  face.loops = {test::polygon({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}), test::circle({0.4, 0.5}, 0.2),
                test::circle({0.75, 0.75}, 0.05)};
  const Part part = through_step({face});
  ASSERT_EQ(part.faces[0].loops.size(), 3u);
  const std::vector<TrimLoop> loops = by_size(part.faces[0]);
  EXPECT_NEAR(enclosed(loops[0]), 0.64, 1e-9) << "the outer loop runs counter-clockwise";
  EXPECT_NEAR(enclosed(loops[1]), -kPi * 0.04, 1e-6) << "and the holes clockwise";
  EXPECT_NEAR(enclosed(loops[2]), -kPi * 0.0025, 1e-6);
  for (const BSplineCurve2& edge : loops[1].edges)
    for (int i = 0; i <= 20; ++i)
      ASSERT_NEAR((edge.value(edge.first() + (edge.last() - edge.first()) * i / 20) - Vec2(0.4, 0.5)).norm(), 0.2,
                  1e-12);
  for (const TrimLoop& loop : loops) expect_closed(loop);
  EXPECT_NEAR(testing_io::area_of(part.faces[0]), 64.0 - kPi * 4.25, 0.02);
}

TEST(ReadTrim, TheOrderAndTheDirectionOfTheLoopsDoNotMatter) {
  const TrimLoop outer = test::polygon({{0.1, 0.1}, {0.1, 0.9}, {0.9, 0.9}, {0.9, 0.1}});  // clockwise
  Face face = test::plane_face("F1", 10.0, 10.0);
  face.loops = {test::circle({0.4, 0.5}, 0.2), outer};
  const Part part = through_step({face});
  ASSERT_EQ(part.faces[0].loops.size(), 2u);
  EXPECT_NEAR(testing_io::area_of(part.faces[0]), 64.0 - kPi * 4.0, 0.02);
}

TEST(ReadTrim, ATrimOnABentFaceCutsTheAreaItShould) {
  // The parameter of a quarter circle as a rational arc is not its angle: half of it by the symmetry only.
  Face half = test::quarter_cylinder("F1", 5.0, 12.0);
  half.loops = {test::polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}})};
  Face piece = test::quarter_cylinder("F2", 5.0, 12.0);
  piece.loops = {test::polygon({{0.5, 0.25}, {1, 0.25}, {1, 0.75}, {0.5, 0.75}})};
  const Part part = through_step({half, piece});
  ASSERT_EQ(part.faces.size(), 2u);
  EXPECT_NEAR(testing_io::area_of(part.faces[0]), 0.25 * kPi * 5.0 * 12.0, 0.02);
  EXPECT_NEAR(testing_io::area_of(part.faces[1]), 0.25 * kPi * 5.0 * 6.0, 0.02);
}

TEST(ReadTrim, ALoopRoundTheWholeRectangleIsNone) {
  Face face = test::quarter_cylinder("F1", 5.0, 12.0);
  face.loops = {test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}})};
  EXPECT_TRUE(through_step({face}).faces[0].loops.empty());
  face.loops = {test::polygon({{0, 0}, {1, 0}, {1, 0.999}, {0, 0.999}})};
  const Face shorter = through_step({face}).faces[0];
  EXPECT_TRUE(shorter.loops.empty()) << "a rectangle of the parameters is a smaller surface";
  EXPECT_NEAR(shorter.surface.v_last(), 0.999, 1e-12);
  EXPECT_NEAR(shorter.surface.value(0.5, shorter.surface.v_last()).z(), 11.988, 1e-11);
}

TEST(ReadTrim, TrimsOfAnalyticSurfacesFollowTheirNewParameters) {
  // The caps of the cylinder are planes within circles.
  const Part part = read_part(testing_io::own_part("inch_cylinder.step"));
  int caps = 0;
  for (std::size_t k = 0; k < part.faces.size(); ++k) {
    if (part.surface_types[k] != "plane") continue;
    ++caps;
    EXPECT_NEAR(testing_io::area_of(part.faces[k]), kPi * 25.4 * 25.4, 0.5);
    ASSERT_EQ(part.faces[k].loops.size(), 1u);
    const Face& face = part.faces[k];
    for (const BSplineCurve2& edge : face.loops[0].edges) {
      for (int i = 0; i <= 20; ++i) {
        const Vec2 q = edge.value(edge.first() + (edge.last() - edge.first()) * i / 20);
        const Vec3 d = face.surface.value(q.x(), q.y()) - part.box.center();
        ASSERT_NEAR(d.norm(), std::hypot(25.4, 25.4), 1e-5) << "on the rim";
      }
    }
  }
  EXPECT_EQ(caps, 2);
}

BSplineSurface plane() {
  BSplineSurface s;
  s.degree_u = s.degree_v = 1;
  s.knots_u = {0, 0, 2, 2};
  s.knots_v = {0, 0, 1, 1};
  s.count_u = s.count_v = 2;
  s.poles = {Vec3(0, 0, 0), Vec3(0, 5, 0), Vec3(10, 0, 0), Vec3(10, 5, 0)};
  return s;
}

TrimLoop loop_through(const Vec2& corner) {
  TrimLoop loop;
  const Vec2 corners[] = {{0.2, 0.2}, corner, {0.4, 0.8}};
  for (int k = 0; k < 3; ++k) {
    BSplineCurve2& edge = loop.edges.emplace_back();
    edge.degree = 1;
    edge.knots = {0, 0, 1, 1};
    edge.poles.resize(2, 2);
    edge.poles << corners[k], corners[(k + 1) % 3];
  }
  return loop;
}

std::string refusal(const std::function<void()>& what) {
  try {
    what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReadTrim, ATrimKeepsNearItsSurface) {
  const auto refused = [](const Vec2& corner, const std::function<void(BSplineCurve2&)>& damage = {}) {
    TrimLoop loop = loop_through(corner);
    if (damage) damage(loop.edges[0]);
    return refusal([&] { require_usable_trim(loop, plane(), "F1"); });
  };
  EXPECT_EQ(refused({1.9, 0.5}), "accepted");
  EXPECT_EQ(refused({3.9, -0.9}), "accepted") << "borders need not end at the surface's own";
  EXPECT_NE(refused({4.1, 0.5}).find("F1: one of its trims reaches the parameters (4.1, 0.5)"), std::string::npos);
  EXPECT_NE(refused({1.0, -1e300}).find("far outside"), std::string::npos);
  EXPECT_NE(refused({NAN, 0.5}).find("not finite"), std::string::npos);
  EXPECT_NE(refused({1.9, 0.5},
                    [](auto& e) {
                      e.weights = {1, 0};
                    })
                .find("a weight of one of its trims is not > 0"),
            std::string::npos);
  EXPECT_NE(refused({1.9, 0.5}, [](auto& e) { e.knots = {1, 1, 1, 1}; }).find("do not rise"), std::string::npos);
  const auto bend = [](auto& e) {
    const Vec2 from = e.poles.col(0), to = e.poles.col(1);
    e.degree = 2, e.knots = {0, 0, 0, 1, 1, 1};
    e.poles.resize(2, 3);
    e.poles << from, Vec2(1.0, 2.5), to;
  };
  EXPECT_EQ(refused({1.9, 0.5}, bend), "accepted") << "a control point far out, and the curve is not";
}

}  // namespace
}  // namespace flank::internal

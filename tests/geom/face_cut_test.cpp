#include "flank/geom/face_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/geom/trim.h"
#include "geom/skins.h"

namespace flank::internal {
namespace {

constexpr double kSamePoint = 1e-10;

void expect_same_points(const BSplineSurface& whole, const BSplineSurface& part, double shift_u, double shift_v) {
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const double u = part.u_first() + (part.u_last() - part.u_first()) * i / 20;
      const double v = part.v_first() + (part.v_last() - part.v_first()) * j / 20;
      const double at_u = u > whole.u_last() ? u - shift_u : u, at_v = v > whole.v_last() ? v - shift_v : v;
      EXPECT_LT((part.value(u, v) - whole.value(at_u, at_v)).norm(), kSamePoint) << u << " " << v;
    }
  }
}

TEST(FaceCut, APieceIsTheSameSurface) {
  for (const bool rational : {false, true}) {
    BSplineSurface s = testing::elliptic_skin(40.0, 4.0, 30.0).surface;
    if (rational)
      for (std::size_t k = 0; k < s.poles.size(); ++k)
        s.weights.push_back(1.0 + 0.3 * std::sin(0.7 * static_cast<double>(k)));
    expect_same_points(s, cut_surface(s, true, 0.21, 0.83), 0.0, 0.0);
    expect_same_points(s, cut_surface(s, false, 0.0, 0.37), 0.0, 0.0);
  }
}

TEST(FaceCut, AClosedSurfaceIsCutAcrossItsSeam) {
  const BSplineSurface s = testing::elliptic_skin(40.0, 4.0, 30.0).surface;
  ASSERT_TRUE(is_closed(s, true));
  EXPECT_FALSE(is_closed(s, false));
  const BSplineSurface part = cut_surface(s, true, 0.8, 1.3);
  EXPECT_NEAR(part.u_first(), 0.8, 1e-12);
  EXPECT_NEAR(part.u_last(), 1.3, 1e-12);
  expect_same_points(s, part, 1.0, 0.0);
}

/// Of `loops` and of the same cut at u: inside and outside agree on the side that is kept, and nothing is left beyond.
void expect_cut(const std::vector<TrimLoop>& loops, double at) {
  const ParameterRectangle all{0.0, 10.0, 0.0, 10.0};
  const TrimRegion before(loops, all), above(cut_loops(loops, true, at, true), all),
      below(cut_loops(loops, true, at, false), all);
  Random random(7);
  for (int k = 0; k < 2000; ++k) {
    const double u = random.uniform(0.0, 10.0), v = random.uniform(0.0, 10.0);
    if (std::abs(u - at) < 1e-4) continue;
    EXPECT_EQ(above.inside(u, v), u > at && before.inside(u, v)) << u << " " << v;
    EXPECT_EQ(below.inside(u, v), u < at && before.inside(u, v)) << u << " " << v;
  }
}

TEST(FaceCut, LoopsKeepWhatTheyEnclose) {
  const TrimLoop disk = testing::circle_loop(5.0, 5.0, 4.0), hole = testing::circle_loop(5.5, 5.0, 1.5);
  const TrimLoop other = testing::circle_loop(5.0, 1.8, 0.5);
  for (const double at : {1.5, 3.0, 4.2, 5.0, 6.9, 8.0}) {
    expect_cut({disk}, at);
    expect_cut({disk, hole}, at);
    expect_cut({hole, disk, other}, at);
  }
}

TEST(FaceCut, CutLoopsEndWhereTheNextBegins) {
  const std::vector<TrimLoop> loops =
      cut_loops({testing::circle_loop(5.0, 5.0, 4.0), testing::circle_loop(5.5, 5.0, 1.5)}, false, 5.2, true);
  ASSERT_EQ(loops.size(), 1u) << "the hole is open to the line";
  for (std::size_t i = 0; i < loops[0].edges.size(); ++i) {
    const BSplineCurve2 &a = loops[0].edges[i], &b = loops[0].edges[(i + 1) % loops[0].edges.size()];
    EXPECT_LT((a.value(a.last()) - b.value(b.first())).norm(), 1e-12);
    EXPECT_GE(a.value(0.5 * (a.first() + a.last())).y(), 5.2 - 1e-9);
  }
}

TEST(FaceCut, NothingLeftIsRefused) {
  Face face = testing::elliptic_skin(40.0, 4.0, 30.0);
  face.loops = {testing::circle_loop(0.5, 0.5, 0.1)};
  EXPECT_THROW((void)cut_face(face, true, 0.7, 0.9), InputError);
  EXPECT_EQ(cut_face(face, true, 0.45, 0.9).loops.size(), 1u);
}

// A corner that lies a rounding beyond the line: the piece beyond it has no length.
TEST(FaceCut, ACornerThatTouchesTheLineIsNoPiece) {
  for (const double beyond : {0.0, 1e-15, 1e-12, 1e-10, 1e-8}) {
    TrimLoop loop;
    const Vec2 corners[] = {{0.5 - beyond, 0.2}, {0.8, 0.1}, {0.5 - beyond, 0.9}, {0.9, 0.5}};
    for (int k = 0; k < 4; ++k) {
      BSplineCurve2& edge = loop.edges.emplace_back();
      edge.degree = 1;
      edge.knots = {0.0, 0.0, 1.0, 1.0};
      edge.poles.resize(2, 2);
      edge.poles << corners[k], corners[(k + 1) % 4];
    }
    for (const bool above : {true, false}) {
      for (const TrimLoop& kept : cut_loops({loop}, true, 0.5, above)) {
        for (const BSplineCurve2& edge : kept.edges) {
          ASSERT_GE(edge.poles.cols(), 2) << beyond;
          ASSERT_EQ(edge.knots.size(), static_cast<std::size_t>(edge.poles.cols() + edge.degree + 1));
          EXPECT_GE(above ? edge.poles.row(0).minCoeff() - 0.5 : 0.5 - edge.poles.row(0).maxCoeff(), -1e-8) << beyond;
        }
      }
    }
    EXPECT_FALSE(cut_loops({loop}, true, 0.5, true).empty());
  }
}

// Ends without order would send a sort out of its bounds.
TEST(FaceCut, TrimsWithoutFiniteParametersAreRefused) {
  TrimLoop loop;
  for (int k = 0; k < 40; ++k) {
    BSplineCurve2& edge = loop.edges.emplace_back();
    edge.degree = 1;
    edge.knots = {0.0, 0.0, 1.0, 1.0};
    edge.poles.resize(2, 2);
    const double v = k % 3 == 0 ? std::nan("") : 0.01 * k;
    edge.poles << (k % 2 == 0 ? 0.2 : 0.8), (k % 2 == 0 ? 0.8 : 0.2), v, v;
  }
  EXPECT_THROW((void)cut_loops({loop}, true, 0.5, true), InputError);
}

}  // namespace
}  // namespace flank::internal

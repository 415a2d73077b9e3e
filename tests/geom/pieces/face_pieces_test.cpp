#include "flank/geom/pieces/face_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "flank/geom/trim.h"
#include "geom/skins.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;

/// By a fine grid of the surface.
double area_of(const BSplineSurface& s) {
  constexpr int kCells = 200;
  double area = 0.0;
  const double du = (s.u_last() - s.u_first()) / kCells, dv = (s.v_last() - s.v_first()) / kCells;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const SurfaceJet jet = s.jet(s.u_first() + (i + 0.5) * du, s.v_first() + (j + 0.5) * dv);
      area += jet.du.cross(jet.dv).norm() * du * dv;
    }
  }
  return area;
}

/// Largest angle between two normals.
double turn_of(const BSplineSurface& s) {
  std::vector<Vec3> normals;
  for (int i = 0; i <= 40; ++i) {
    const SurfaceJet jet = s.jet(s.u_first() + (s.u_last() - s.u_first()) * i / 40, 0.5 * (s.v_first() + s.v_last()));
    normals.push_back(jet.du.cross(jet.dv).normalized());
  }
  double least = 1.0;
  for (const Vec3& a : normals)
    for (const Vec3& b : normals) least = std::min(least, a.dot(b));
  return std::acos(std::clamp(least, -1.0, 1.0));
}

Face elliptic_skin_of(double scale, double thickness) {
  return testing::elliptic_skin(40.0 * scale, thickness * scale, 30.0 * scale, 0.3);
}

std::string kinds_of(const std::vector<FacePiece>& pieces) {
  std::string kinds;
  for (const FacePiece& piece : pieces) kinds += piece.edge ? 'e' : 's';
  return kinds;
}

TEST(FacePieces, AClosedSkinHasTwoSidesAndTwoEdges) {
  for (const double scale : {0.01, 1.0, 100.0}) {
    for (const double thickness : {1.0, 4.0}) {
      const Face skin = elliptic_skin_of(scale, thickness);
      const std::vector<FacePiece> pieces = face_pieces(skin);
      ASSERT_EQ(kinds_of(pieces), "ssee") << scale << " " << thickness;
      double sum = 0.0;
      for (const FacePiece& piece : pieces) sum += area_of(piece.face.surface);
      EXPECT_NEAR(sum, area_of(skin.surface), 1e-3 * sum);
      for (const FacePiece& piece : pieces) {
        EXPECT_EQ(piece.face.reversed, skin.reversed);
        if (piece.edge) continue;
        EXPECT_LT(turn_of(piece.face.surface), kPi / 2);
        EXPECT_GT(area_of(piece.face.surface), 0.4 * sum) << "a side goes across the seam";
      }
    }
  }
}

TEST(FacePieces, DoNotDependOnWhichParameterGoesRound) {
  const Face skin = testing::elliptic_skin(40.0, 4.0, 30.0, 0.3);
  Face turned = skin;
  BSplineSurface& s = turned.surface;
  std::swap(s.degree_u, s.degree_v);
  std::swap(s.knots_u, s.knots_v);
  std::swap(s.count_u, s.count_v);
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) s.pole(i, j) = skin.surface.pole(j, i);
  const std::vector<FacePiece> pieces = face_pieces(skin), others = face_pieces(turned);
  ASSERT_EQ(kinds_of(pieces), "ssee");
  ASSERT_EQ(kinds_of(others), "ssee");
  for (std::size_t k = 0; k < pieces.size(); ++k)
    EXPECT_NEAR(area_of(pieces[k].face.surface), area_of(others[k].face.surface), 1e-9 * area_of(skin.surface));
}

/// Two flat sides and the half circle between them: a skin that is wrapped round one edge only.
Face wrapped(double length, double radius, double share_of_second) {
  const double arc = kPi * radius, total = length + arc + share_of_second * length;
  return testing::drawn_skin(
      [=](double f) {
        const double s = f * total;
        if (s < length) return Vec3(s - length, radius, 0.0);
        if (s > length + arc) return Vec3(-(s - length - arc), -radius, 0.0);
        const double angle = (s - length) / radius;
        return Vec3(radius * std::sin(angle), radius * std::cos(angle), 0.0);
      },
      25.0, 0.2, 400);
}

TEST(FacePieces, ASkinWrappedRoundOneEdge) {
  EXPECT_EQ(kinds_of(face_pieces(wrapped(40.0, 0.5, 1.0))), "sse");
  EXPECT_EQ(kinds_of(face_pieces(wrapped(40.0, 0.5, 0.4))), "sse");
  EXPECT_EQ(kinds_of(face_pieces(wrapped(40.0, 0.5, 0.02))), "se") << "what is left of the other side is none";
}

/// One side with the half of a nose, which turns by `root_deg` at one end of the span and by `tip_deg` at the other, and half of a tail.
Face half_skin(double root_deg, double tip_deg) {
  constexpr double kSide = 40.0, kNose = 1.0, kTail = 0.7, kTailTurn = 100.0 * kPi / 180.0, kNoseShare = 0.03,
                   kTailShare = 0.03;
  const std::vector<double> v = {0.0, 0.25, 0.5, 0.75, 1.0};
  std::vector<double> u;
  std::vector<Vec3> points;
  const auto arc = [](double x, double radius, double angle) {
    return Vec2(x - radius * std::sin(angle), radius * (std::cos(angle) - 1.0));
  };
  for (int i = 0; i <= 400; ++i) {
    const double f = i / 400.0;
    u.push_back(f);
    for (const double w : v) {
      const double nose = (root_deg + (tip_deg - root_deg) * w) * kPi / 180.0;
      const Vec2 p = f < kNoseShare         ? arc(0.0, kNose, nose * (1.0 - f / kNoseShare))
                     : f > 1.0 - kTailShare ? arc(kSide, kTail, -kTailTurn * (f - 1.0 + kTailShare) / kTailShare)
                                            : Vec2(kSide * (f - kNoseShare) / (1.0 - kNoseShare - kTailShare), 0.0);
      points.emplace_back(p.x(), p.y(), 60.0 * w);
    }
  }
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return face;
}

TEST(FacePieces, AnEdgeThatFadesAlongTheSpanIsAnEdgeAllTheWay) {
  EXPECT_EQ(kinds_of(face_pieces(half_skin(80.0, 80.0))), "see");
  EXPECT_EQ(kinds_of(face_pieces(half_skin(30.0, 80.0))), "see")
      << "less than a third of the sections turn by less than 45 degrees";
  EXPECT_EQ(kinds_of(face_pieces(half_skin(80.0, 30.0))), "see");
  EXPECT_TRUE(face_pieces(half_skin(2.0, 80.0)).empty()) << "for more than a fifth of the span there is none";
}

TEST(FacePieces, OnlyWhatComesBackGoesAllRound) {
  const auto all_round = [](const Face& face) { return goes_all_round(face, face_pieces(face)); };
  EXPECT_TRUE(all_round(testing::elliptic_skin(40.0, 4.0, 30.0, 0.3)));
  EXPECT_TRUE(all_round(wrapped(40.0, 0.5, 1.0)));
  EXPECT_FALSE(all_round(wrapped(40.0, 0.5, 0.4))) << "two sides, of which one is a strip";
  EXPECT_FALSE(all_round(wrapped(40.0, 0.5, 0.02))) << "one side";
  // Two flanks that lead out of round roots, 60 degrees apart: a rotor's lobe.
  const auto lobe = [](double f) {
    const double s = 120.0 * f - 60.0, bent = std::min(std::abs(s), 50.0), out = std::abs(s) - bent;
    return Vec3(std::copysign(bent * 0.7 + 0.2 * out, s), 20.0 * std::cos(bent / 25.0) + out * 0.1, 0.0);
  };
  EXPECT_FALSE(all_round(testing::drawn_skin(lobe, 25.0, 0.2, 400)));
}

TEST(FacePieces, AnEdgeAtTheBorderOfASkinWithoutANormalInItsMiddle) {
  // Straight from section to section; in the middle one two control points are one, and no normal is at its start.
  const BSplineSurface drawn = wrapped(40.0, 0.5, 0.0).surface;
  Face skin;
  BSplineSurface& s = skin.surface;
  s.degree_u = drawn.degree_u, s.knots_u = drawn.knots_u, s.count_u = drawn.count_u;
  s.degree_v = 1, s.knots_v = {0.0, 0.0, 0.5, 1.0, 1.0}, s.count_v = 3;
  for (int i = 0; i < s.count_u; ++i)
    for (const double z : {0.0, 10.0, 20.0}) s.poles.emplace_back(drawn.pole(i, 0) + z * Vec3::UnitZ());
  s.pole(0, 1) = s.pole(1, 1);
  const std::vector<FacePiece> pieces = face_pieces(skin);
  EXPECT_EQ(kinds_of(pieces), "se");
  for (const FacePiece& piece : pieces) EXPECT_GT(area_of(piece.face.surface), 1.0);
}

TEST(FacePieces, WhatWrapsRoundNothingStaysWhole) {
  EXPECT_TRUE(face_pieces(testing::elliptic_skin(40.0, 40.0, 30.0)).empty()) << "a round bar";
  EXPECT_TRUE(face_pieces(testing::elliptic_skin(40.0, 25.0, 30.0)).empty()) << "nearly one";
  const auto arc = [](double f) { return Vec3(30.0 * std::sin(2.0 * f), 30.0 * std::cos(2.0 * f), 0.0); };
  EXPECT_TRUE(face_pieces(testing::drawn_skin(arc, 30.0, 0.4)).empty()) << "a cambered side";
  const auto ripples = [](double f) { return Vec3(60.0 * f, 0.01 * std::sin(200.0 * f), 0.0); };
  EXPECT_TRUE(face_pieces(testing::drawn_skin(ripples, 30.0, 0.4, 800)).empty()) << "ripples";
}

TEST(FacePieces, ASharpTrailingEdgeIsACut) {
  // A lens of two arcs: closed, with a kink at the seam and another in the middle.
  BSplineSurface s;
  s.degree_u = 2, s.degree_v = 1, s.count_u = 5, s.count_v = 2;
  s.knots_u = {0, 0, 0, 0.5, 0.5, 1, 1, 1}, s.knots_v = {0, 0, 1, 1};
  for (const Vec2& p : {Vec2(0, 0), Vec2(20, 5), Vec2(40, 0), Vec2(20, -5), Vec2(0, 0)})
    for (const double z : {0.0, 30.0}) s.poles.emplace_back(p.x(), p.y(), z);
  Face lens;
  lens.surface = s;
  const std::vector<FacePiece> pieces = face_pieces(lens);
  ASSERT_EQ(kinds_of(pieces), "ss");
  EXPECT_NEAR(pieces[0].face.surface.u_last(), 0.5, 1e-8);
  EXPECT_NEAR(area_of(pieces[0].face.surface), area_of(pieces[1].face.surface), 1e-6);
}

/// Half of a cone about Z, v from its rim to `past` beyond the apex, as a share of its length.
Face half_cone(double past) {
  BSplineSurface s;
  s.degree_u = 2, s.degree_v = 1, s.count_u = 5, s.count_v = 2;
  s.knots_u = {0, 0, 0, 0.5, 0.5, 1, 1, 1}, s.knots_v = {0, 0, 1, 1};
  const double half = std::sqrt(0.5);
  for (const Vec2& p : {Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(-1, 1), Vec2(-1, 0)}) {
    for (const double rest : {1.0, -past}) s.poles.emplace_back(20.0 * rest * p.x(), 20.0 * rest * p.y(), 30.0 * rest);
    for (int j = 0; j < 2; ++j) s.weights.push_back(p.norm() > 1.1 ? half : 1.0);
  }
  Face cone;
  cone.id = "F1";
  cone.surface = s;
  return cone;
}

TEST(FacePieces, TheApexOfAConeIsNoEdge) {
  // Past the apex the normal is turned round: by a rounding error's length of the surface there is no piece.
  for (const double past : {0.0, 1e-15, 1e-11, 1e-8, 1e-6}) {
    Face cone = half_cone(past);
    EXPECT_TRUE(face_pieces(cone).empty()) << past;
    cone.loops = {testing::circle_loop(0.5, 0.52, 0.48)};
    EXPECT_TRUE(face_pieces(cone).empty()) << past << ", trimmed";
  }
  // A cone and its mirror image are two sides.
  EXPECT_EQ(kinds_of(face_pieces(half_cone(0.8))), "ss");
}

TEST(FacePieces, APieceThatTrimsLeaveNothingOfIsNone) {
  Face cone = half_cone(0.8);
  cone.loops = {testing::circle_loop(0.5, 0.25, 0.2)};
  EXPECT_TRUE(face_pieces(cone).empty());
}

TEST(FacePieces, TrimsAreCutWithTheFace) {
  Face skin = testing::elliptic_skin(40.0, 2.0, 30.0);
  skin.loops = {testing::circle_loop(0.5, 0.5, 0.45)};
  const std::vector<FacePiece> pieces = face_pieces(skin);
  // The seam, in the middle of a side, is a border of a trimmed face.
  ASSERT_EQ(kinds_of(pieces), "sssee");
  for (const FacePiece& piece : pieces) EXPECT_FALSE(piece.face.loops.empty());
}

/// A thin skin whose seam lies within its edge, so that a little of the edge is on the other side of it.
Face skin_with_its_seam_in_an_edge() {
  return testing::drawn_skin(
      [](double f) {
        const double angle = 2.0 * kPi * f + 0.0866;
        return Vec3(20.0 * std::cos(angle), std::sin(angle), 0.0);
      },
      30.0, 0.0, 400);
}

TEST(FacePieces, TrimsThatFollowTheSurfacesBorderAreNone) {
  const Face skin = skin_with_its_seam_in_an_edge();
  Face trimmed = skin;
  const BSplineSurface& s = skin.surface;
  trimmed.loops = {rectangle_loop({s.u_first(), s.u_last(), s.v_first(), s.v_last()})};
  const std::vector<FacePiece> pieces = face_pieces(skin), others = face_pieces(trimmed);
  ASSERT_EQ(kinds_of(pieces), "ssee");
  ASSERT_EQ(kinds_of(others), "ssee");
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_TRUE(others[k].face.loops.empty());
    EXPECT_NEAR(area_of(pieces[k].face.surface), area_of(others[k].face.surface), 1e-9 * area_of(s));
  }
}

TEST(FacePieces, AnEdgeAtTheSeamOfATrimmedSkinIsOneEdgeInTwoParts) {
  Face skin = skin_with_its_seam_in_an_edge();
  TrimLoop cut = rectangle_loop({0.0, 1.0, 0.0, 0.9});
  skin.loops = {cut};
  const std::vector<FacePiece> pieces = face_pieces(skin);
  ASSERT_EQ(kinds_of(pieces), "sseee");
  for (const FacePiece& piece : pieces) {
    EXPECT_FALSE(piece.face.loops.empty());
    if (piece.edge) continue;
    EXPECT_LT(turn_of(piece.face.surface), 0.25 * kPi) << "nothing of the edge is left on a side";
  }
}

}  // namespace
}  // namespace flank::internal

// Borders of faces: their pieces, closest points on them, and which of them are seams or shared.
#include "flank/surface/nurbs/nurbs_border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

struct Borders {
  std::vector<Face> faces;
  std::vector<NurbsFace> prepared;
  NurbsBorders borders;

  explicit Borders(std::vector<Face> list) : faces(std::move(list)) {
    for (const Face& f : faces) prepared.emplace_back(f, 1, ExtensionOptions{});
    borders = NurbsBorders(faces, prepared);
  }
  [[nodiscard]] int count() const { return static_cast<int>(borders.pieces().size()); }
};

Face shifted(Face face, const Vec3& by) {
  for (Vec3& p : face.surface.poles) p += by;
  return face;
}

TEST(NurbsBorders, PiecesOfALoopFollowEachOtherInARing) {
  for (const Face& face : {test::plane(10), test::wavy(1, 3, 3, 7, 7, true, 20), test::cylinder(5, 9, 2)}) {
    const Borders b({face});
    int at = 0;
    for (int k = 0; k < b.count(); ++k) {
      const BorderPiece& piece = b.borders.piece(at);
      EXPECT_EQ(b.borders.piece(piece.next).previous, at);
      EXPECT_LT((b.borders.point(b.prepared, at, 1.0) - b.borders.point(b.prepared, piece.next, 0.0)).norm(), 1e-9);
      at = piece.next;
    }
    EXPECT_EQ(at, 0) << "once round";
    EXPECT_EQ(b.borders.hulls().size(), b.borders.pieces().size());
  }
}

TEST(NurbsBorders, PiecesAreNearlyStraightAndNotTooLong) {
  const Borders b({test::cylinder(10, 40, 2)});
  double circles = 0.0;
  for (int k = 0; k < b.count(); ++k) {
    double length = 0.0, off = 0.0;
    const Vec3 first = b.borders.point(b.prepared, k, 0.0), chord = b.borders.point(b.prepared, k, 1.0) - first;
    for (int i = 1; i <= 50; ++i) {
      const Vec3 x = b.borders.point(b.prepared, k, i / 50.0);
      length += (x - b.borders.point(b.prepared, k, (i - 1) / 50.0)).norm();
      off = std::max(off, (x - first).cross(chord).norm() / chord.norm());
    }
    EXPECT_LT(off, 0.05 * length);
    EXPECT_LT(length, 0.11 * b.prepared[0].size());
    if (std::abs(chord[2]) < 1e-9) circles += length;
  }
  EXPECT_NEAR(circles, 2 * std::numbers::pi * 10, 0.01) << "half a circle at both ends";
}

TEST(NurbsBorders, ClosestOnEachPieceIsThatOfDenseSearch) {
  const Borders b({test::wavy(3, 3, 2, 7, 6, true, 25)});
  Random random(4);
  for (int k = 0; k < b.count(); ++k)
    for (int trial = 0; trial < 4; ++trial) {
      const Vec3 p = test::random_in(random, Box3{Vec3(0, 0, -25), Vec3(100, 100, 25)}, 0.1);
      double least = 1e300;
      for (int i = 0; i <= 400; ++i) least = std::min(least, (b.borders.point(b.prepared, k, i / 400.0) - p).norm());
      const BorderPoint found = b.borders.closest(b.prepared, k, p);
      EXPECT_EQ(found.piece, k);
      EXPECT_LE(std::sqrt(found.squared), least + 1e-9);
      EXPECT_GT(std::sqrt(found.squared), least - 0.05) << "no nearer than the samples' spacing allows";
      EXPECT_NEAR((found.point - p).squaredNorm(), found.squared, 1e-9);
      const BorderPiece& piece = b.borders.piece(k);
      EXPECT_GE(found.t, std::min(piece.t0, piece.t1));
      EXPECT_LE(found.t, std::max(piece.t0, piece.t1));
      EXPECT_LT((b.faces[0].surface.value(found.u, found.v) - found.point).norm(), 1e-9);
    }
}

TEST(NurbsBorders, HullsHoldTheirPieces) {
  const Borders b({test::wavy(5, 3, 3, 7, 7, false, 25)});
  for (int k = 0; k < b.count(); ++k) {
    Box3 box;
    EXPECT_LE(b.borders.hulls()[static_cast<std::size_t>(k)].size(), 8u) << "a part may have hundreds of thousands";
    for (const Vec3& h : b.borders.hulls()[static_cast<std::size_t>(k)]) box.add(h);
    for (int i = 0; i <= 60; ++i) EXPECT_EQ(box.squared_distance(b.borders.point(b.prepared, k, i / 60.0)), 0.0);
  }
}

TEST(NurbsBorders, NothingOfASinglePlateIsInterior) {
  const Borders b({test::plane(10)});
  for (const BorderPiece& piece : b.borders.pieces()) {
    EXPECT_FALSE(piece.interior);
    EXPECT_EQ(piece.partner, -1);
  }
}

TEST(NurbsBorders, SeamAndPolesOfClosedFacesAreInterior) {
  const Borders tube({test::cylinder(5, 20, 4)});
  for (int k = 0; k < tube.count(); ++k) {
    const BorderPiece& piece = tube.borders.piece(k);
    const Vec3 middle = tube.borders.point(tube.prepared, k, 0.5);
    const bool seam = middle[2] > 1e-6 && middle[2] < 20 - 1e-6;
    EXPECT_EQ(piece.interior, seam) << middle.transpose();
    if (!seam) continue;
    ASSERT_GE(piece.partner, 0);
    EXPECT_NE(tube.borders.piece(piece.partner).edge, piece.edge) << "the other side of the seam";
  }
  const Borders ball({test::sphere(5)});
  for (const BorderPiece& piece : ball.borders.pieces()) EXPECT_TRUE(piece.interior);
  const Borders ring({test::torus(20, 5)});
  for (const BorderPiece& piece : ring.borders.pieces()) EXPECT_TRUE(piece.interior);
}

TEST(NurbsBorders, NeighboursShareTheEdgeBetweenThemAndNoOther) {
  const Borders b({test::plane(10), shifted(test::plane(10), Vec3(10, 0, 0))});
  int shared = 0;
  for (int k = 0; k < b.count(); ++k) {
    const BorderPiece& piece = b.borders.piece(k);
    const Vec3 middle = b.borders.point(b.prepared, k, 0.5);
    EXPECT_EQ(piece.interior, std::abs(middle[0] - 10.0) < 1e-9) << middle.transpose();
    if (!piece.interior) continue;
    ++shared;
    EXPECT_EQ(b.borders.piece(piece.partner).face, 1 - piece.face);
    EXPECT_NEAR(b.borders.closest(b.prepared, piece.partner, middle).squared, 0.0, 1e-12);
  }
  EXPECT_GT(shared, 10);
  const Borders apart({test::plane(10), shifted(test::plane(10), Vec3(10.01, 0, 0))});
  for (const BorderPiece& piece : apart.borders.pieces()) EXPECT_FALSE(piece.interior) << "a hundredth is a gap";
}

TEST(NurbsBorders, AnEdgeThatIsSharedInPartIsInteriorInPart) {
  // The neighbour is half as long: beyond its end the edge is open.
  Face half = test::bilinear({10, 0, 0}, {10, 5, 0}, {20, 0, 0}, {20, 5, 0});
  half.id = "F2";
  const Borders b({test::plane(10), half});
  for (int k = 0; k < b.count(); ++k) {
    const BorderPiece& piece = b.borders.piece(k);
    const Vec3 a = b.borders.point(b.prepared, k, 0.0), c = b.borders.point(b.prepared, k, 1.0);
    if (piece.face != 0 || std::abs(a[0] - 10.0) > 1e-9 || std::abs(c[0] - 10.0) > 1e-9) continue;
    if (std::max(a[1], c[1]) <= 5.0 + 1e-9) {
      EXPECT_TRUE(piece.interior);
    }
    if (std::min(a[1], c[1]) >= 5.0 - 1e-9) {
      EXPECT_FALSE(piece.interior);
    }
  }
}

TEST(NurbsBorders, FindsThePieceThatHoldsAPointOfABorder) {
  const Borders b({test::wavy(6, 3, 3, 7, 7, true, 20)});
  const NurbsFace& face = b.prepared[0];
  const ParameterBox& d = face.domain();
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const int border = k % 4;
    double u = random.uniform(d.u0, d.u1), v = random.uniform(d.v0, d.v1);
    (border < 2 ? u : v) = border == 0 ? d.u0 : border == 1 ? d.u1 : border == 2 ? d.v0 : d.v1;
    const int piece = b.borders.piece_at(face, 0, border, u, v);
    EXPECT_NEAR(b.borders.closest(b.prepared, piece, b.faces[0].surface.value(u, v)).squared, 0.0, 1e-14) << border;
  }
}

}  // namespace
}  // namespace flank::internal

// The flat cells of a face: they cover it once, their hulls hold them, and their curvatures bound its own.
#include "flank/surface/nurbs/nurbs_cells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

struct Prepared {
  NurbsFace face;
  FlatCells cells;

  explicit Prepared(const Face& f) : face(f, 1, {}) { append_flat_cells(face, 0, cells); }
};

TrimLoop rectangle(double u0, double u1, double v0, double v1) { return rectangle_loop({u0, u1, v0, v1}); }

/// How far a point sticks out of a convex hull in some random directions; not above 0 if it lies inside.
double out_of_hull(const std::vector<Vec3>& hull, const Vec3& p, Random& random) {
  double worst = -1e300;
  for (int k = 0; k < 12; ++k) {
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    double reach = -1e300;
    for (const Vec3& h : hull) reach = std::max(reach, direction.dot(h));
    worst = std::max(worst, direction.dot(p) - reach);
  }
  return worst;
}

TEST(FlatCells, CoverTheParametersOnce) {
  for (const Face& f : {test::plane(10), test::sphere(7), test::torus(20, 6), test::wavy(1, 3, 2, 8, 7, true, 20)}) {
    const Prepared p(f);
    const ParameterBox& d = p.face.domain();
    double sum = 0.0;
    for (const FlatCell& c : p.cells.cells) {
      EXPECT_LT(c.u0, c.u1);
      EXPECT_LT(c.v0, c.v1);
      EXPECT_FALSE(c.cut);
      EXPECT_EQ(c.face, 0);
      sum += (c.u1 - c.u0) * (c.v1 - c.v0);
    }
    EXPECT_NEAR(sum, (d.u1 - d.u0) * (d.v1 - d.v0), 1e-12);
    EXPECT_EQ(p.cells.hulls.size(), p.cells.cells.size());
    Random random(2);
    for (int k = 0; k < 100; ++k) {
      const double u = random.uniform(d.u0, d.u1), v = random.uniform(d.v0, d.v1);
      int holding = 0;
      for (const FlatCell& c : p.cells.cells) holding += c.u0 <= u && u < c.u1 && c.v0 <= v && v < c.v1;
      EXPECT_EQ(holding, 1);
    }
  }
}

TEST(FlatCells, HullsHoldTheirPartOfTheSurface) {
  const Prepared p(test::wavy(2, 3, 3, 7, 7, true, 25));
  Random random(3);
  for (std::size_t k = 0; k < p.cells.cells.size(); k += 3) {
    const FlatCell& c = p.cells.cells[k];
    for (int i = 0; i < 4; ++i) {
      const Vec3 x = p.face.patches().jet(random.uniform(c.u0, c.u1), random.uniform(c.v0, c.v1)).p;
      EXPECT_LT(out_of_hull(p.cells.hulls[k], x, random), 1e-10);
    }
  }
}

TEST(FlatCells, AreFlat) {
  for (const Face& f : {test::sphere(7), test::torus(20, 6), test::twisted_ruled()}) {
    const Prepared p(f);
    for (const FlatCell& c : p.cells.cells) {
      double size = 0.0, off = 0.0;
      for (int i = 0; i <= 4; ++i)
        for (int j = 0; j <= 4; ++j) {
          const Vec3 r = p.face.patches().jet(c.u0 + (c.u1 - c.u0) * i / 4, c.v0 + (c.v1 - c.v0) * j / 4).p - c.center;
          size = std::max(size, r.norm());
          off = std::max(off, std::abs(r.dot(c.normal)));
        }
      EXPECT_LT(off, 0.2 * size);
      EXPECT_LT(size, 0.4 * p.face.size());
    }
  }
}

TEST(FlatCells, FirstGuessIsTheFootpointOnTheTangentPlane) {
  const Prepared p(test::torus(20, 6));
  for (const FlatCell& c : p.cells.cells) {
    const double mid_u = 0.5 * (c.u0 + c.u1), mid_v = 0.5 * (c.v0 + c.v1);
    const SurfaceJet jet = p.face.patches().jet(mid_u, mid_v);
    EXPECT_LT((jet.p - c.center).norm(), 1e-12);
    const Vec3 q = c.center + 0.01 * jet.du - 0.02 * jet.dv + 3.0 * c.normal;
    EXPECT_NEAR((q - c.center).dot(c.to_u), 0.01, 1e-12);
    EXPECT_NEAR((q - c.center).dot(c.to_v), -0.02, 1e-12);
  }
}

TEST(FlatCells, CurvatureRangesHoldThoseOfTheCell) {
  Random random(4);
  const Prepared p(test::torus(20, 6));
  for (const FlatCell& c : p.cells.cells) {
    const Vec3 q = p.face.patches().jet(random.uniform(c.u0, c.u1), random.uniform(c.v0, c.v1)).p;
    const double ring = std::hypot(q[0], q[1]), cosine = (ring - 20.0) / 6.0, around = cosine / ring;
    const Vec3 out(q[0] / ring * cosine, q[1] / ring * cosine, q[2] / 6.0);
    const std::size_t outside = c.normal.dot(out) > 0.0 ? 0 : 1;
    const double towards_out = std::max(-1.0 / 6.0, -around), towards_in = std::max(1.0 / 6.0, around);
    EXPECT_GE(towards_out, c.curvature_low[outside] - 1e-9);
    EXPECT_LE(towards_out, c.curvature_high[outside] + 1e-9);
    EXPECT_GE(towards_in, c.curvature_low[1 - outside] - 1e-9);
    EXPECT_LE(towards_in, c.curvature_high[1 - outside] + 1e-9);
  }
}

TEST(FlatCells, OnlyTheCentreOfASphereIsFocal) {
  const Prepared p(test::sphere(10));
  for (const FlatCell& c : p.cells.cells) {
    if (c.normal.norm() == 0.0 || c.v0 == 0.0 || c.v1 == 2.0) continue;  // the poles' own cells
    const Vec3 out = c.center / 10.0;
    EXPECT_TRUE(can_be_focal(c, -10.0 * out));
    EXPECT_FALSE(can_be_focal(c, -2.0 * out)) << "near the surface";
    EXPECT_FALSE(can_be_focal(c, 10.0 * out)) << "on the side it bends away from";
    EXPECT_FALSE(can_be_focal(c, -40.0 * out)) << "far beyond the centre";
  }
}

TEST(FlatCells, LeaveOutWhatIsTrimmedAwayAndMarkWhatIsCut) {
  Face f = test::plane(10);
  f.loops = {rectangle(0, 1, 0, 1), rectangle(0.31, 0.69, 0.33, 0.71)};
  const Prepared p(f);
  double sum = 0.0;
  int cut = 0;
  for (const FlatCell& c : p.cells.cells) {
    const bool in_hole = c.u0 >= 0.311 && c.u1 <= 0.689 && c.v0 >= 0.331 && c.v1 <= 0.709;
    EXPECT_FALSE(in_hole);
    const bool crosses = c.u0 < 0.69 && c.u1 > 0.31 && c.v0 < 0.71 && c.v1 > 0.33;
    if (crosses) {
      EXPECT_TRUE(c.cut);
    }
    cut += c.cut;
    sum += (c.u1 - c.u0) * (c.v1 - c.v0);
  }
  EXPECT_GT(cut, 10);
  EXPECT_GE(sum, 1.0 - 0.38 * 0.38);
  EXPECT_LT(sum, 1.0 - 0.25 * 0.25) << "most of the hole is gone";
}

TEST(FlatCells, MayRoamALittleButNotAcrossACrease) {
  Face roof;
  roof.id = "F1";
  roof.surface = {1, 1, {0, 0, 0.5, 1, 1}, {0, 0, 1, 1}, 3, 2, {}, {}};
  for (const auto& [x, z] : {std::pair(0.0, 0.0), std::pair(5.0, 0.0), std::pair(10.0, 3.0)})
    for (const double y : {0.0, 8.0}) roof.surface.poles.emplace_back(x, y, z);
  const Prepared p(roof);
  for (const FlatCell& c : p.cells.cells) {
    EXPECT_LE(c.reach.u0, c.u0);
    EXPECT_GE(c.reach.u1, c.u1);
    EXPECT_GE(c.reach.v0, 0.0) << "not onto the extension either";
    EXPECT_LE(c.reach.v1, 1.0);
    EXPECT_TRUE(c.u1 <= 0.5 ? c.reach.u1 <= 0.5 : c.reach.u0 >= 0.5);
  }
}

/// A quarter of a flat ring: only its sides are bent.
Face ring() { return test::revolved(1, 1, {0, 0, 1, 1}, {{5, 0, 1}, {10, 0, 1}}); }

TEST(FlatCells, AreConvexForPointsNearerThanTheCentresOfTheirSides) {
  const Prepared p(ring());
  for (const FlatCell& cell : p.cells.cells) {
    EXPECT_TRUE(is_convex(cell, {1.0, 1.0, 1.0}));
    EXPECT_FALSE(is_convex(cell, {0.0, 0.0, 10.0}));
    EXPECT_FALSE(is_convex(cell, -cell.center)) << "the centre itself";
  }
}

/// Beyond the centre the nearest place is one of the ring's ends, and the other is nearest in turn to the middle.
TEST(FlatCells, OfARingFindTheNearerEndFromBeyondItsCentre) {
  const auto target = make_target({ring()});
  const Face face = ring();
  const BSplineSurface& s = face.surface;
  const Vec3 one = s.value(s.u_first(), s.v_first()), other = s.value(s.u_last(), s.v_first());
  Random random(5);
  for (int k = 0; k < 400; ++k) {
    const Vec3 away = -random.uniform(1.0, 4.0) * (one + other).normalized(),
               beside = random.uniform(-1.0, 1.0) * (one - other);
    const Vec3 x = away + 0.1 * beside + Vec3(0.0, 0.0, random.uniform(-1.0, 1.0));
    const double nearest = std::min((x - one).norm(), (x - other).norm());
    EXPECT_NEAR((x - target->closest(x).point).norm(), nearest, 1e-9) << x.transpose();
  }
}

}  // namespace
}  // namespace flank::internal

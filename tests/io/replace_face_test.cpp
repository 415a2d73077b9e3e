#include "flank/io/cad/replace_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "flank/base/atomic_file.h"
#include "flank/io/cad/write_solid.h"
#include "flank/part.h"
#include "flank/target.h"
#include "rotor37_file.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class ReplaceFace : public TemporaryFolder {
 protected:
  ReplaceFace() : TemporaryFolder("replace_face") {}
  const std::string file_ = test::rotor37_file("rotor37");
  const Part part_ = read_part(file_);
};

/// The surface, past its borders on all sides by extrapolation of its poles, and moved.
BSplineSurface moved(BSplineSurface surface, const Vec3& by) {
  for (Vec3& pole : surface.poles) pole += by;
  return surface;
}

TEST_F(ReplaceFace, ASurfaceBesideTheOldOneMakesAValidSolidWithTheSameNumbers) {
  // The old surface itself, a hundredth of a millimetre away: all borders have their nearest points on it or on its edge.
  const Face& old = part_.faces[0];
  const SurfaceJet middle = old.surface.jet(0.5 * (old.surface.u_first() + old.surface.u_last()),
                                            0.5 * (old.surface.v_first() + old.surface.v_last()));
  Face next = old;
  next.loops.clear();
  next.surface = moved(old.surface, 0.01 * middle.du.cross(middle.dv).normalized());
  const std::unique_ptr<Target> target = make_target({next});
  const auto nearest = [&](const Vec3& p) -> std::optional<Vec2> {
    const Footpoint foot = target->closest(p);
    return Vec2(foot.u, foot.v);
  };
  const ReplacedFaces out = replace_faces(file_, "STEP", {}, {{0, next.surface, nearest}});
  ASSERT_TRUE(out.why.empty()) << out.why;
  ASSERT_EQ(out.faces.size(), 1u);
  EXPECT_EQ(out.faces[0].id, "F1");
  EXPECT_LT(out.gap_mm[0], 0.011);
  const std::string file = (root_ / "new.step").string();
  write_file(file, out.step);
  const CheckedSolids checked = check_solids(file, "STEP", {});
  EXPECT_EQ(checked.solids, 1);
  EXPECT_EQ(checked.valid, 1);
  EXPECT_TRUE(checked.shape_valid);
  const Part again = read_part(file);
  ASSERT_EQ(again.faces.size(), part_.faces.size());
  EXPECT_EQ(again.faces[0].surface.poles.size(), next.surface.poles.size());
  EXPECT_EQ(again.faces[3].surface.poles.size(), part_.faces[3].surface.poles.size());
}

TEST_F(ReplaceFace, ASurfaceThatEndsBeforeTheBordersIsNotTaken) {
  const auto beyond = [](const Vec3&) -> std::optional<Vec2> { return {}; };
  const ReplacedFaces out = replace_faces(file_, "STEP", {}, {{0, part_.faces[0].surface, beyond}});
  EXPECT_NE(out.why.find("runs past"), std::string::npos) << out.why;
  EXPECT_TRUE(out.step.empty());
  EXPECT_TRUE(out.faces.empty());
}

/// A bilinear face through its corners, in the order of its normal.
Face plane(const std::string& id, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Face face;
  face.id = id;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1, s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {a, d, b, c};
  return face;
}

constexpr double kX = 20.0, kY = 12.0, kZ = 10.0;

/// A block; F1 is its top.
SolidModel block() {
  const auto at = [](double x, double y, double z) { return Vec3(x * kX, y * kY, z * kZ); };
  return sew_solid("block", {plane("F1", at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                             plane("F2", at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
                             plane("F3", at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)),
                             plane("F4", at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)),
                             plane("F5", at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)),
                             plane("F6", at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1))});
}

/// A hollow top that is so far above the old one in the middle and by 0.04 mm higher at the corners, and reaches past all borders.
Face hollow_top(double above) {
  constexpr int kCount = 6;
  std::vector<Vec3> points;
  std::vector<double> at;
  for (int k = 0; k < kCount; ++k) at.push_back(k / (kCount - 1.0));
  for (const double u : at)
    for (const double v : at) {
      const double x = 1.4 * (u - 0.5), y = 1.4 * (v - 0.5);
      points.emplace_back((x + 0.5) * kX, (y + 0.5) * kY, kZ + above + 0.08 * (x * x + y * y));
    }
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, at, at, 3);
  return face;
}

class OnABlock : public TemporaryFolder {
 protected:
  OnABlock() : TemporaryFolder("on_a_block") {}

  /// The block with another top, as it is read again.
  Part with_top(double above, ReplacedFaces& out) {
    const std::string old = (root_ / "block.step").string(), file = (root_ / "new.step").string();
    write_file(old, block().step);
    const std::shared_ptr<const Target> top = make_target({hollow_top(above)});
    const auto nearest = [top](const Vec3& p) -> std::optional<Vec2> {
      const Footpoint foot = top->closest(p);
      return Vec2(foot.u, foot.v);
    };
    out = replace_faces(old, "STEP", {}, {{0, hollow_top(above).surface, nearest}});
    EXPECT_TRUE(out.why.empty()) << out.why;
    write_file(file, out.step);
    EXPECT_EQ(check_solids(file, "STEP", {}).valid, 1);
    return read_part(file);
  }
};

TEST_F(OnABlock, NeighboursAreTrimmedToASurfaceBelowTheOldOne) {
  ReplacedFaces out;
  const Part part = with_top(-0.1, out);
  EXPECT_LT(out.gap_mm[0], 1e-6);
  EXPECT_NEAR(out.moved_mm[0], 0.08, 0.005);
  const std::unique_ptr<Target> top = make_target({hollow_top(-0.1)});
  ASSERT_EQ(part.faces.size(), 6u);
  for (std::size_t k = 1; k < part.faces.size(); ++k) {
    if (part.faces[k].id == "F2") continue;
    double highest = -1.0;
    for (const Vec3& p : make_target({part.faces[k]})->border_points(0.05))
      highest = std::max(highest, top->closest(p).distance);
    EXPECT_NEAR(highest, 0.0, 1e-6) << part.faces[k].id;
  }
}

TEST_F(OnABlock, ANeighbourThatEndsBelowTheSurfaceStays) {
  ReplacedFaces out;
  (void)with_top(0.02, out);
  EXPECT_NEAR(out.gap_mm[0], 0.06, 0.005);
  EXPECT_LT(out.moved_mm[0], 1e-6);
}

}  // namespace
}  // namespace flank::internal

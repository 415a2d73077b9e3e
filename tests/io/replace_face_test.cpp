#include "flank/io/cad/replace_face.h"

#include <gtest/gtest.h>

#include "flank/base/atomic_file.h"
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

}  // namespace
}  // namespace flank::internal

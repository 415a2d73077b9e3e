// Loose faces of files without solids.
#include "flank/io/cad/read_occt_sew.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Trsf.hxx>

#include "flank/base/random.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using testing_io::Scratch;
using testing_io::tells;

/// The faces of a shape by themselves, as a file of loose faces has them: every other one turned, none sharing an edge.
struct Loose {
  explicit Loose(double gap_mm = 0.0) : gap(gap_mm) { builder.MakeCompound(compound); }

  void add(const TopoDS_Shape& shape, int leave_out = -1) {
    int k = 0;
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next(), ++k) {
      if (k == leave_out) continue;
      // A copy as if it came from elsewhere: moved by the gap.
      gp_Trsf away;
      away.SetTranslation(gp_Vec(0.0, 0.0, k % 2 == 0 ? 0.0 : gap));
      TopoDS_Shape face = BRepBuilderAPI_Transform(it.Current(), away, true).Shape();
      if (k % 2 == 1) face.Reverse();
      builder.Add(compound, face);
    }
  }

  [[nodiscard]] Part read() const {
    const Scratch scratch;
    const std::string file = scratch.path("loose.brep");
    BRepTools::Write(compound, file.c_str());
    return read_part(file);
  }

  double gap;
  BRep_Builder builder;
  TopoDS_Compound compound;
};

/// The normal of a box's face at its middle points away from the middle of the box.
void expect_outward(const Part& part, const Vec3& middle) {
  for (const Face& face : part.faces) {
    const BSplineSurface& s = face.surface;
    const SurfaceJet jet = s.jet(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
    const Vec3 normal = (face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv);
    EXPECT_GT(normal.dot(jet.p - middle), 0.0) << face.id;
  }
}

TEST(LooseFaces, ThatCloseAreASolid) {
  for (const double gap : {0.0, 0.005}) {
    Loose loose(gap);
    loose.add(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
    const Part part = loose.read();
    EXPECT_EQ(part.solids, 1);
    ASSERT_EQ(part.faces.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(part.faces[k].id, "F" + std::to_string(k + 1));
      EXPECT_TRUE(part.faces[k].of_solid);
      EXPECT_EQ(part.faces[k].solid, 0);
    }
    expect_outward(part, Vec3(15.0, 10.0, 5.0));
    EXPECT_TRUE(tells(part, "sewn to 1 solid"));
  }
}

TEST(LooseFaces, SurfacesAndTrimsAreThoseOfTheFile) {
  Loose loose(0.005);
  loose.add(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
  for (const Face& face : loose.read().faces)
    EXPECT_TRUE(face.loops.empty()) << face.id << ": still the whole rectangle";
}

TEST(LooseFaces, ThatDoNotCloseAgree) {
  Loose loose;
  loose.add(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape(), 5);
  const Part part = loose.read();
  EXPECT_EQ(part.solids, 0);
  ASSERT_EQ(part.faces.size(), 5u);
  int outward = 0;
  for (const Face& face : part.faces) {
    EXPECT_FALSE(face.of_solid);
    const BSplineSurface& s = face.surface;
    const SurfaceJet jet = s.jet(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
    outward += (face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv).dot(jet.p - Vec3(15.0, 10.0, 5.0)) > 0.0;
  }
  EXPECT_TRUE(outward == 0 || outward == 5) << outward;
  EXPECT_TRUE(tells(part, "1 open sheet"));
}

TEST(LooseFaces, SeveralSolidsAndASheet) {
  Loose loose;
  loose.add(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
  loose.add(BRepPrimAPI_MakeBox(gp_Pnt(100.0, 0.0, 0.0), 5.0, 5.0, 5.0).Shape());
  loose.add(BRepPrimAPI_MakeBox(gp_Pnt(200.0, 0.0, 0.0), 5.0, 5.0, 5.0).Shape(), 0);
  const Part part = loose.read();
  EXPECT_EQ(part.solids, 2);
  ASSERT_EQ(part.faces.size(), 17u);
  EXPECT_EQ(part.faces[0].solid, 0);
  EXPECT_EQ(part.faces[11].solid, 1);
  EXPECT_EQ(part.faces[16].solid, -1);
  EXPECT_TRUE(tells(part, "sewn to 2 solids and 1 open sheet"));
}

TEST(LooseFaces, AFaceThatIsClosedByItselfIsASolid) {
  Loose loose;
  loose.add(BRepPrimAPI_MakeTorus(10.0, 3.0).Shape());
  EXPECT_EQ(loose.read().solids, 1);
}

TEST(LooseFaces, OfRealFiles) {
  FLANK_REAL_PART(shaft, "bladex_propeller_shaft.iges");
  const Part part = read_part(shaft);
  EXPECT_EQ(part.solids, 1);
  EXPECT_EQ(part.faces.size(), 22u);
  FLANK_REAL_PART(blade, "zoo/asitus_blade.igs");
  const Part sheet = read_part(blade);
  EXPECT_EQ(sheet.solids, 0);
  EXPECT_TRUE(tells(sheet, "1 open sheet"));
}

}  // namespace
}  // namespace flank::internal

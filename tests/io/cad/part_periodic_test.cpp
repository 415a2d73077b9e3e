// Periodic surfaces, and faces that cannot be read.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <gp.hxx>
#include <numbers>

#include "flank/io/cad/read_cad_check.h"
#include "io/cad_shapes.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using testing_io::Scratch;
using testing_io::tells;

/// A tube about z of a wavy section, cubic and periodic round about, linear along.
Handle(Geom_BSplineSurface) tube(bool periodic_u, bool rational, double far_mm = 0.0) {
  constexpr int kRound = 12;
  TColgp_Array2OfPnt poles(1, periodic_u ? kRound : 2, 1, periodic_u ? 2 : kRound);
  TColStd_Array2OfReal weights(1, periodic_u ? kRound : 2, 1, periodic_u ? 2 : kRound);
  for (int i = 0; i < kRound; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double angle = 2.0 * std::numbers::pi * i / kRound, r = 10.0 + i % 3;
      const gp_Pnt p(r * std::cos(angle) + (i == 5 && j == 1 ? far_mm : 0.0), r * std::sin(angle), 20.0 * j);
      poles.SetValue(1 + (periodic_u ? i : j), 1 + (periodic_u ? j : i), p);
      weights.SetValue(1 + (periodic_u ? i : j), 1 + (periodic_u ? j : i), rational ? 1.0 + 0.1 * (i % 4) : 1.0);
    }
  }
  TColStd_Array1OfReal round(1, kRound + 1), along(1, 2);
  TColStd_Array1OfInteger round_times(1, kRound + 1), along_times(1, 2);
  for (int i = 1; i <= kRound + 1; ++i) round.SetValue(i, 0.3 * i), round_times.SetValue(i, 1);
  for (int i = 1; i <= 2; ++i) along.SetValue(i, i), along_times.SetValue(i, 2);
  if (periodic_u)
    return new Geom_BSplineSurface(poles, weights, round, along, round_times, along_times, 3, 1, true, false);
  return new Geom_BSplineSurface(poles, weights, along, round, along_times, round_times, 1, 3, false, true);
}

/// Of the faces, as they stand.
std::string write_faces(const Scratch& scratch, const std::vector<TopoDS_Face>& faces) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Face& face : faces) builder.Add(compound, face);
  const std::string file = scratch.path("faces.brep");
  BRepTools::Write(compound, file.c_str());
  return file;
}

TEST(PartPeriodic, SurfacesAreThoseOfTheFile) {
  for (const bool periodic_u : {false, true}) {
    for (const bool rational : {false, true}) {
      const Handle(Geom_BSplineSurface) surface = tube(periodic_u, rational);
      double u0, u1, v0, v1;
      surface->Bounds(u0, u1, v0, v1);
      const double du = u1 - u0, dv = v1 - v0;
      const Scratch scratch;
      // The whole tube, a part of it, and a part across the seam.
      const std::string file = write_faces(
          scratch, {BRepBuilderAPI_MakeFace(surface, 1e-7),
                    BRepBuilderAPI_MakeFace(surface, u0 + 0.2 * du, u0 + 0.7 * du, v0 + 0.1 * dv, v0 + 0.8 * dv, 1e-7),
                    periodic_u ? BRepBuilderAPI_MakeFace(surface, u0 + 0.8 * du, u0 + 1.3 * du, v0, v1, 1e-7)
                               : BRepBuilderAPI_MakeFace(surface, u0, u1, v0 + 0.8 * dv, v0 + 1.3 * dv, 1e-7)});
      const Part part = read_part(file);
      EXPECT_TRUE(part.left_out.empty());
      for (const Face& face : part.faces) EXPECT_EQ(face.surface.weights.empty(), !rational) << face.id;
      for (const CadCheck& check : check_cad(file, "BREP")) {
        EXPECT_LT(check.surface_error_mm, kSurfaceConversionError * check.size_mm) << check.face;
        EXPECT_GT(check.size_mm, 10.0) << check.face;
      }
    }
  }
}

TEST(PartPeriodic, OfRealFiles) {
  FLANK_REAL_PART(wing, "zoo/occt_bug25994_wing.brep");
  FLANK_REAL_PART(blade, "zoo/clarkyeah_blade.igs");
  for (const auto& [file, format] : {std::pair(wing, "BREP"), std::pair(blade, "IGES")}) {
    EXPECT_TRUE(read_part(file).left_out.empty());
    for (const CadCheck& check : check_cad(file, format))
      EXPECT_LT(check.surface_error_mm, kSurfaceConversionError * check.size_mm) << file << " " << check.face;
  }
  FLANK_REAL_PART(compressor, "zoo/turbo3d_compressor_export.step");
  const Part part = read_part(compressor);
  EXPECT_TRUE(part.left_out.empty());
  EXPECT_EQ(part.faces.size(), 253u);
}

/// A strip of a cylinder of radius 5 mm between two threads, from z = 0 up, `turns` of 8 mm; 2 mm of it are strip.
TopoDS_Face root_of_a_thread(double turns) {
  const double angle = 2.0 * std::numbers::pi * turns;
  const gp_Pnt2d corners[] = {{-0.3, 0.0}, {angle - 0.3, 8.0 * turns}, {angle - 0.3, 8.0 * turns + 2.0}, {-0.3, 2.0}};
  const Handle(Geom_CylindricalSurface) cylinder = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), 5.0);
  BRepBuilderAPI_MakeWire wire;
  for (int k = 0; k < 4; ++k) {
    const GCE2d_MakeSegment side(corners[k], corners[(k + 1) % 4]);
    wire.Add(BRepBuilderAPI_MakeEdge(side.Value(), cylinder));
  }
  TopoDS_Face face = BRepBuilderAPI_MakeFace(cylinder, wire.Wire());
  BRepLib::BuildCurves3d(face);
  return face;
}

TEST(PartPeriodic, AStripThatWindsRoundItsCylinderIsAllThere) {
  for (const double turns : {0.7, 1.0, 2.3, 4.0}) {
    const Scratch scratch;
    const Part part = read_part(write_faces(scratch, {root_of_a_thread(turns)}));
    ASSERT_EQ(part.faces.size(), 1u);
    ASSERT_FALSE(part.is_left_out(0)) << turns;
    const double wanted = 2.0 * 10.0 * std::numbers::pi * turns;
    EXPECT_NEAR(testing_io::area_of(part.faces[0], 0.02), wanted, 2e-3 * wanted) << turns;
    EXPECT_NEAR(part.box.high.z(), 8.0 * turns + 2.0, 1e-6);
  }
}

TEST(PartLeftOut, AFaceThatCannotBeReadDoesNotLoseThePart) {
  const Scratch scratch;
  const std::string file = write_faces(
      scratch, {BRepBuilderAPI_MakeFace(tube(true, false), 1e-7), BRepBuilderAPI_MakeFace(tube(true, false, 1e9), 1e-7),
                BRepBuilderAPI_MakeFace(tube(false, false), 1e-7)});
  const Part part = read_part(file);
  ASSERT_EQ(part.faces.size(), 3u);
  EXPECT_EQ(part.faces[2].id, "F3") << "the others keep their names";
  EXPECT_TRUE(part.is_left_out(1));
  EXPECT_TRUE(tells(part, "face F2: a control point of its surface is at"));
  EXPECT_LT(part.box.diagonal(), 100.0);
  EXPECT_EQ(parse_face_list(part, "F1,F3"), (std::vector<int>{0, 2}));
  EXPECT_THROW((void)parse_face_list(part, "F2"), InputError);
}

TEST(PartLeftOut, APartOfWhichNothingCanBeReadIsRefused) {
  const Scratch scratch;
  const std::string file = write_faces(scratch, {BRepBuilderAPI_MakeFace(tube(true, false, 1e9), 1e-7)});
  EXPECT_NE(testing_io::refusal(file).find("a control point of its surface"), std::string::npos);
}

TEST(PartSize, AUnitThatCannotBeRightGetsANote) {
  const std::string cube =
      "solid c\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid c\n";
  const Scratch scratch;
  const std::string file = scratch.write("plate.stl", cube);
  EXPECT_FALSE(tells(read_part(file, "mm"), "is its unit"));
  EXPECT_FALSE(tells(read_part(file, "m"), "is its unit"));
  std::string small = cube, large = cube;
  for (std::string* text : {&small, &large}) {
    for (std::size_t at = text->find(" 1"); at != std::string::npos; at = text->find(" 1", at + 2))
      text->replace(at, 2, text == &small ? " 0.1" : " 99999");
  }
  EXPECT_TRUE(tells(read_part(scratch.write("small.stl", small), "mm"), "is its unit (mm) right"));
  EXPECT_TRUE(tells(read_part(scratch.write("large.stl", large), "mm"), "is its unit (mm) right"));
}

}  // namespace
}  // namespace flank::internal

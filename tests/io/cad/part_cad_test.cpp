// The real parts as the manifest describes them, and every face against the kernel's own geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "flank/io/cad/read_cad_check.h"
#include "io/part_files.h"
#include "rotor37_file.h"

namespace flank::internal {
namespace {

using testing_io::own_part;
using testing_io::refusal;
using testing_io::tells;

constexpr double kEdgeErrorMm = 1e-6;

void expect_size(const Part& part, double x, double y, double z, double tolerance) {
  const Vec3 size = part.box.high - part.box.low;
  EXPECT_NEAR(size.x(), x, tolerance);
  EXPECT_NEAR(size.y(), y, tolerance);
  EXPECT_NEAR(size.z(), z, tolerance);
}

void expect_true_to_file(const std::string& file, const std::string& format) {
  for (const CadCheck& check : check_cad(file, format)) {
    SCOPED_TRACE(check.face);
    EXPECT_LT(check.surface_error_mm, kSurfaceConversionError * check.size_mm);
    // What the file itself leaves open between its trims and its edges is not ours to close.
    EXPECT_LT(check.edge_error_mm, check.file_edge_gap_mm + kEdgeErrorMm);
    EXPECT_EQ(check.outward_wrong, 0) << "of " << check.outward_samples;
  }
}

/// Loops are closed, end to start, in every face.
void expect_closed_loops(const Part& part) {
  for (const Face& face : part.faces) {
    for (const TrimLoop& loop : face.loops) {
      for (std::size_t i = 0; i < loop.edges.size(); ++i) {
        const BSplineCurve2& a = loop.edges[i];
        const BSplineCurve2& b = loop.edges[(i + 1) % loop.edges.size()];
        const Eigen::Vector2d gap = a.poles.col(a.count() - 1) - b.poles.col(0);
        EXPECT_LT(gap.norm(), 1e-8) << face.id;
        EXPECT_EQ(a.knots.size(), static_cast<std::size_t>(a.count() + a.degree + 1)) << face.id;
      }
    }
  }
}

void expect_clamped(const Part& part) {
  for (const Face& face : part.faces) {
    const BSplineSurface& s = face.surface;
    EXPECT_EQ(s.knots_u.size(), static_cast<std::size_t>(s.count_u + s.degree_u + 1)) << face.id;
    EXPECT_EQ(s.knots_v.size(), static_cast<std::size_t>(s.count_v + s.degree_v + 1)) << face.id;
    EXPECT_EQ(s.knots_u.front(), s.u_first()) << face.id;
    EXPECT_EQ(s.knots_v.back(), s.v_last()) << face.id;
    EXPECT_TRUE(std::is_sorted(s.knots_u.begin(), s.knots_u.end())) << face.id;
    EXPECT_TRUE(std::is_sorted(s.knots_v.begin(), s.knots_v.end())) << face.id;
  }
}

TEST(PartCad, Rotor37Blade) {
  const std::string file = test::rotor37_file("rotor37");
  const Part part = read_part(file);
  EXPECT_EQ(part.format, "STEP");
  EXPECT_EQ(part.unit, "mm");
  EXPECT_EQ(part.solids, 1);
  ASSERT_EQ(part.faces.size(), 6u);
  expect_size(part, 42.8, 74.4, 48.4, 0.06);
  for (const Face& face : part.faces) {
    EXPECT_TRUE(face.of_solid);
    EXPECT_TRUE(face.loops.empty()) << face.id;
  }
  EXPECT_TRUE(part.repairs.empty());
  expect_clamped(part);
}

TEST(PartCad, Rotor37BladeIsTrueToItsFile) {
  const std::string file = test::rotor37_file("rotor37");
  expect_true_to_file(file, "STEP");
}

TEST(PartCad, Rotor37BliskSector) {
  const std::string file = test::rotor37_file("rotor37-blisk");
  const Part part = read_part(file);
  EXPECT_EQ(part.solids, 1);
  ASSERT_EQ(part.faces.size(), 16u);
  for (const int face : {9, 7, 13, 11}) {
    const BSplineSurface& s = part.faces[static_cast<std::size_t>(face - 1)].surface;
    EXPECT_EQ(s.degree_u, 3);
    EXPECT_EQ(s.degree_v, 3);
    EXPECT_EQ(s.count_u, 36);
    EXPECT_EQ(s.count_v, 14);
  }
  EXPECT_EQ(part.faces[0].loops.size(), 3u) << "the hub has two holes, one a blade";
  expect_closed_loops(part);
  expect_clamped(part);
}

TEST(PartCad, Rotor37BliskSectorIsTrueToItsFile) {
  const std::string file = test::rotor37_file("rotor37-blisk");
  expect_true_to_file(file, "STEP");
}

TEST(PartCad, Kj66Impeller) {
  FLANK_REAL_PART(file, "kj66_impeller.step");
  const Part part = read_part(file);
  EXPECT_EQ(part.unit, "mm");
  EXPECT_EQ(part.solids, 11);
  ASSERT_EQ(part.faces.size(), 92u);
  for (const int face : {1, 3, 10, 12, 24, 26, 33, 35, 42, 44, 51, 53, 60, 62, 70, 72, 79, 81}) {
    const BSplineSurface& s = part.faces[static_cast<std::size_t>(face - 1)].surface;
    EXPECT_EQ(s.degree_u, 3) << face;
    EXPECT_EQ(s.degree_v, 1) << face;
    EXPECT_EQ(s.count_u, 10) << face;
    EXPECT_EQ(s.count_v, 2) << face;
  }
  EXPECT_EQ(part.faces[87].solid, 10) << "F88 is the hub's spline face";
  EXPECT_EQ(part.surface_types[87], "B-spline");
  // Axis Y, tip radius 50.1: the z range has no stray sliver in it.
  EXPECT_NEAR(part.box.high.z(), 50.1, 0.01);
  EXPECT_NEAR(part.box.low.z(), -50.1, 0.01);
  expect_closed_loops(part);
  expect_clamped(part);
}

TEST(PartCad, Kj66ImpellerIsTrueToItsFile) {
  FLANK_REAL_PART(file, "kj66_impeller.step");
  expect_true_to_file(file, "STEP");
}

TEST(PartCad, BladexPropeller) {
  FLANK_REAL_PART(file, "bladex_propeller_shaft.iges");
  const Part part = read_part(file);
  EXPECT_EQ(part.format, "IGES");
  EXPECT_EQ(part.unit, "mm");
  EXPECT_EQ(part.solids, 1) << "its loose faces close";
  ASSERT_EQ(part.faces.size(), 22u);
  for (const int face : {7, 10, 12, 14, 16, 8, 11, 13, 15, 17}) {
    const Face& f = part.faces[static_cast<std::size_t>(face - 1)];
    EXPECT_EQ(f.surface.degree_u, 3);
    EXPECT_EQ(f.surface.degree_v, 2);
    EXPECT_EQ(f.surface.count_u, 242);
    EXPECT_TRUE(f.of_solid);
    EXPECT_EQ(f.solid, 0);
  }
  expect_closed_loops(part);
  expect_clamped(part);
}

TEST(PartCad, BladexPropellerIsTrueToItsFile) {
  FLANK_REAL_PART(file, "bladex_propeller_shaft.iges");
  expect_true_to_file(file, "IGES");
}

// Spheres, cones, tori, cylinders, oblique prisms, revolutions and periodic splines, whole and cut across their seams,
// reversed faces.
TEST(PartCad, EveryKindOfSurfaceIsTrueToItsFile) { expect_true_to_file(own_part("solids.brep"), "BREP"); }

TEST(PartCad, EveryKindOfSurfaceHasClosedLoops) {
  const Part part = read_part(own_part("solids.brep"));
  const std::set<std::string> types(part.surface_types.begin(), part.surface_types.end());
  for (const char* type : {"plane", "cylinder", "cone", "sphere", "torus", "revolution", "extrusion", "B-spline"})
    EXPECT_TRUE(types.contains(type)) << type;
  expect_closed_loops(part);
  expect_clamped(part);
}

TEST(PartCad, TurnsSolidsThatAreInsideOut) {
  const Part part = read_part(own_part("inside_out.brep"));
  ASSERT_EQ(part.faces.size(), 6u);
  EXPECT_TRUE(tells(part, "inside out"));
  for (const Face& face : part.faces) {
    const BSplineSurface& s = face.surface;
    const SurfaceJet jet = s.jet(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
    const Vec3 normal = (face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv);
    EXPECT_GT(normal.dot(jet.p - part.box.center()), 0.0) << face.id;
  }
}

TEST(PartCad, HonoursInches) {
  const std::string file = own_part("inch_cylinder.step");
  const Part part = read_part(file);
  EXPECT_EQ(part.unit, "in");
  EXPECT_DOUBLE_EQ(part.millimetres_per_unit, 25.4);
  expect_size(part, 50.8, 50.8, 50.8, 1e-5);
  EXPECT_EQ(read_part(file, "in").repairs, part.repairs) << "as it says itself";
}

TEST(PartCad, AUnitThatIsAskedForIsThatOfTheNumbers) {
  const Part part = read_part(own_part("inch_cylinder.step"), "mm");
  EXPECT_EQ(part.unit, "mm");
  EXPECT_DOUBLE_EQ(part.millimetres_per_unit, 1.0);
  expect_size(part, 2.0, 2.0, 2.0, 1e-6);
  EXPECT_EQ(part.solids, 1);
  EXPECT_TRUE(tells(part, "the file states its unit as in; its numbers were read as mm, as --unit says"));
}

TEST(PartCad, ScalesBrepByTheUnitAskedFor) {
  const Part mm = read_part(own_part("inside_out.brep")), cm = read_part(own_part("inside_out.brep"), "cm");
  expect_size(mm, 4.0, 5.0, 6.0, 1e-6);
  expect_size(cm, 40.0, 50.0, 60.0, 1e-5);
}

TEST(PartCad, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  (void)read_part(own_part("inch_cylinder.step"));
  (void)refusal(testing_io::corpus("cad/old_brep_version.brep"));
  const std::string out = ::testing::internal::GetCapturedStdout(), error = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(out, "");
  EXPECT_EQ(error, "");
}

TEST(PartCad, FaceLists) {
  const Part part = read_part(own_part("inside_out.brep"));
  EXPECT_EQ(parse_face_list(part, "F1"), (std::vector<int>{0}));
  EXPECT_EQ(parse_face_list(part, "F6, F2"), (std::vector<int>{5, 1}));
  for (const char* list : {"F7", "F0", "F", "", "1", "F1,", "F1,F9", "F1,F1", "G1", "F1F2", "F99999999999"}) {
    try {
      (void)parse_face_list(part, list);
      ADD_FAILURE() << list;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("inside_out.brep"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace flank::internal

#include "flank/io/cad/triangulate.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "rotor37_file.h"
#include "shared_data.h"

namespace flank::internal {
namespace {

double area_of(const TriangleMesh& m) {
  double area = 0.0;
  for (const auto& t : m.triangles) {
    const Vec3& a = m.vertices[static_cast<std::size_t>(t[0])];
    area +=
        0.5 *
        (m.vertices[static_cast<std::size_t>(t[1])] - a).cross(m.vertices[static_cast<std::size_t>(t[2])] - a).norm();
  }
  return area;
}

TEST(Triangulate, SaddleTrimmedToATriangle) {
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.poles = {{0, 0, 0}, {0, 40, 10}, {40, 0, 10}, {40, 40, 0}};
  const FaceTriangles whole = triangulate_face(face, 0.01);
  EXPECT_LE(whole.deviation_mm, 0.01);
  EXPECT_FALSE(whole.beyond_border);
  const double all = area_of(whole.mesh);
  TrimLoop loop;
  const Vec2 corners[3] = {{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}};
  for (int k = 0; k < 3; ++k) {
    BSplineCurve2 edge;
    edge.degree = 1;
    edge.knots = {0, 0, 1, 1};
    edge.poles.resize(2, 2);
    edge.poles.col(0) = corners[k];
    edge.poles.col(1) = corners[(k + 1) % 3];
    loop.edges.push_back(edge);
  }
  face.loops = {loop};
  const FaceTriangles part = triangulate_face(face, 0.01);
  EXPECT_LE(part.deviation_mm, 0.01);
  EXPECT_FALSE(part.beyond_border);
  EXPECT_NEAR(area_of(part.mesh) / all, 0.32, 0.02);
  EXPECT_THROW((void)triangulate_face(face, 0.0), UsageError);
}

TEST(Triangulate, TwoBladesOnTheirHubKeepTheStatedDeviation) {
  const std::vector<FaceTriangles> faces = triangulate(read_part(test::rotor37_file("rotor37-blisk")), 0.02);
  ASSERT_EQ(faces.size(), 16u);
  for (const FaceTriangles& face : faces) {
    EXPECT_FALSE(face.mesh.triangles.empty()) << face.face;
    EXPECT_LE(face.deviation_mm, 0.02) << face.face;
  }
}

/// The propeller has a spline knot every half millimetre and a tip that is nearly a point: a coarser mesh will do.
TEST(Triangulate, RealPartsKeepTheStatedDeviation) {
  const std::vector<std::pair<const char*, double>> parts = {{"kj66_impeller.step", 0.02},
                                                             {"bladex_propeller_shaft.iges", 0.5}};
  for (const auto& [name, wanted] : parts) {
    FLANK_REAL_PART(file, name);
    for (const FaceTriangles& face : triangulate(read_part(file), wanted)) {
      EXPECT_FALSE(face.mesh.triangles.empty()) << name << ' ' << face.face;
      EXPECT_LE(face.deviation_mm, wanted) << name << ' ' << face.face;
    }
  }
}

// A face that Open CASCADE's mesher folds: finer meshes of it are no nearer, and took minutes.
TEST(Triangulate, AFaceThatAMesherFoldsKeepsTheStatedDeviation) {
  FLANK_REAL_PART(propeller, "zoo/autogiro_prop1045.step");
  const Part part = read_part(propeller);
  const FaceTriangles blade = triangulate_face(part.faces[14], 0.02);
  EXPECT_EQ(part.faces[14].id, "F15");
  EXPECT_LE(blade.deviation_mm, 0.02);
  EXPECT_FALSE(blade.beyond_border);
  EXPECT_NEAR(area_of(blade.mesh), 2449.25, 0.01 * 2449.25);
}

}  // namespace
}  // namespace flank::internal

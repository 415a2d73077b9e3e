// What a wheel is cut from.
#include "flank/wheel/blank.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/io/mesh/write_mesh.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class Blank : public TemporaryFolder {
 protected:
  Blank() : TemporaryFolder("blank") {}
  /// A box of 8 x 6 x 10 mm whose middle is at (5, 0, 0), as a file.
  [[nodiscard]] std::string box() const {
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k)
      mesh.vertices.emplace_back(1.0 + 8.0 * (k & 1), -3.0 + 3.0 * (k & 2), -5.0 + 2.5 * (k & 4));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const std::string file = (root_ / "box.stl").string();
    write_mesh(file, mesh);
    return file;
  }
  [[nodiscard]] static WheelAxis axis() {
    WheelAxis out;
    out.point = {5.0, 0.0, 0.0};
    return out;
  }
};

double volume_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum;
}

TEST_F(Blank, ATurnedBlankHoldsThePartAndItsAllowance) {
  WheelRoles roles;
  roles.axis = axis();
  const WheelBlank blank = turned_blank(read_part(box(), std::string("mm")), roles, 0.5);
  // The box' corners are 5 mm from the axis.
  for (const Vec2& p : blank.outline) EXPECT_NEAR(p.y(), 5.5, 0.05);
  EXPECT_NEAR(blank.outline.front().x(), -5.5, 0.05);
  EXPECT_NEAR(blank.outline.back().x(), 5.5, 0.05);
  const double volume = M_PI * 5.5 * 5.5 * 11.0;
  EXPECT_GT(volume_of(blank.body), volume);
  EXPECT_LT(volume_of(blank.body), 1.03 * volume);
  for (const Vec3& p : blank.body.vertices)
    EXPECT_TRUE(axis().radius(p) <= 1.0 || axis().radius(p) >= 5.5) << axis().radius(p);
}

TEST_F(Blank, AFileIsTakenAsItIs) {
  const WheelBlank blank = read_blank(box(), std::string("mm"), axis());
  EXPECT_NEAR(volume_of(blank.body), 480.0, 1e-3);
  for (const Vec2& p : blank.outline) EXPECT_NEAR(p.y(), 5.0, 1e-3);
}

}  // namespace
}  // namespace flank::internal

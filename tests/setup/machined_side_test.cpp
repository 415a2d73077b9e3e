// Which side of a face is machined, by kinds of what a file may say of it.
#include "flank/setup/machined_side.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "flank/error.h"
#include "obstacle/obstacle_scene.h"
#include "shared_data.h"

namespace flank::internal {
namespace {

/// Loose faces of a box of this size: the walls y = 0 and y = depth (F1, F2), the ends x = 0 and x = length (F3, F4), the floor and the
/// lid (F5, F6). Their normals point outwards.
Part box(double length, double depth, double height) {
  const auto at = [&](double x, double y, double z) { return Vec3(length * x, depth * y, height * z); };
  Part part;
  part.faces = {testing::quad(at(0, 0, 0), at(1, 0, 0), at(0, 0, 1), at(1, 0, 1), "F1"),
                testing::quad(at(1, 1, 0), at(0, 1, 0), at(1, 1, 1), at(0, 1, 1), "F2"),
                testing::quad(at(0, 1, 0), at(0, 0, 0), at(0, 1, 1), at(0, 0, 1), "F3"),
                testing::quad(at(1, 0, 0), at(1, 1, 0), at(1, 0, 1), at(1, 1, 1), "F4"),
                testing::quad(at(0, 1, 0), at(1, 1, 0), at(0, 0, 0), at(1, 0, 0), "F5"),
                testing::quad(at(0, 0, 1), at(1, 0, 1), at(0, 1, 1), at(1, 1, 1), "F6")};
  part.box.add(at(0, 0, 0));
  part.box.add(at(1, 1, 1));
  return part;
}

Part without_ends(Part part) {
  part.faces.resize(4);
  return part;
}

Part turned(Part part) {
  for (Face& face : part.faces) face.reversed = !face.reversed;
  return part;
}

/// Of a face alone.
SheetSide side_of(Part part, int face, const PartRequest& request = {}) {
  const Part before = part;
  const std::vector<SheetSide> sides = turn_to_machined_side(request, {face}, part);
  EXPECT_EQ(sides.size(), 1u);
  if (sides.empty()) return {};
  const auto k = static_cast<std::size_t>(face);
  EXPECT_EQ(part.faces[k].reversed != before.faces[k].reversed, sides.front().side < 0) << "it is turned with its side";
  return sides.front();
}

TEST(MachinedSide, OfALoneSheetIsWhereItsNormalPoints) {
  Part part = box(40, 10, 30);
  part.faces.resize(1);
  const SheetSide side = side_of(part, 0);
  EXPECT_EQ(side.side, +1);
  EXPECT_FALSE(side.asked);
  EXPECT_NEAR((side.towards + Vec3::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_EQ(side_text(side), "side +, towards (0.00, -1.00, 0.00), mostly -Y: where the normal of the file points");
  EXPECT_EQ(side_of(turned(part), 0).side, +1) << "its own normal, wherever that is";
}

TEST(MachinedSide, OfABladeWithoutRootAndTipIsItsOutside) {
  const Part blade = without_ends(box(40, 4, 60));
  for (const int face : {0, 1, 2, 3}) {
    EXPECT_EQ(side_of(blade, face).side, +1) << face;
    const SheetSide side = side_of(turned(blade), face);
    EXPECT_EQ(side.side, -1) << face;
    EXPECT_GT(side.towards.dot(side.place - Vec3(20, 2, 30)), 0.0) << face;
    EXPECT_NE(side.reason.find("enclose"), std::string::npos) << side.reason;
  }
}

TEST(MachinedSide, OfAChannelIsWhereItsNormalsPoint) {
  // As deep as wide, open at the top and at one end: its normals look into it.
  Part channel = turned(box(50, 35, 40));
  channel.faces.erase(channel.faces.begin() + 5);
  channel.faces.erase(channel.faces.begin() + 3);
  for (const int face : {0, 1}) EXPECT_EQ(side_of(channel, face).side, +1) << face;
}

TEST(MachinedSide, OfTwoSheetsBackToBackIsAwayFromTheOther) {
  Part part = box(40, 2, 30);
  part.faces.resize(2);
  part.faces[1].reversed = true;  // both look to -y
  EXPECT_EQ(side_of(part, 0).side, +1);
  EXPECT_EQ(side_of(part, 1).side, -1);
}

TEST(MachinedSide, AFaceBesideAnOpeningGoesWithItsNeighbours) {
  // A bar that is open at x = 0, where a wall of it has a rim of its own.
  Part bar = box(40, 6, 6);
  bar.faces[2] = testing::quad(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 6), Vec3(2, 0, 6), "F3");
  bar.faces[0] = testing::quad(Vec3(2, 0, 0), Vec3(40, 0, 0), Vec3(2, 0, 6), Vec3(40, 0, 6), "F1");
  for (const int face : {0, 1, 2, 3, 4, 5}) {
    EXPECT_EQ(side_of(bar, face).side, +1) << face;
    EXPECT_EQ(side_of(turned(bar), face).side, -1) << face;
  }
}

TEST(MachinedSide, OfWallsOfACavityIsTowardsTheOther) {
  PartRequest request;
  request.facing = true;
  for (const bool first : {false, true})
    for (const bool second : {false, true}) {
      Part part = box(40, 12, 30);
      part.faces.resize(2);
      part.faces[0].reversed = first;
      part.faces[1].reversed = second;
      const std::vector<SheetSide> sides = turn_to_machined_side(request, {0, 1}, part);
      ASSERT_EQ(sides.size(), 2u);
      EXPECT_TRUE(part.faces[0].reversed && part.faces[1].reversed) << "both look between them";
      EXPECT_TRUE(sides[0].asked) << "the request says so";
    }
}

TEST(MachinedSide, IsWhatWasAskedFor) {
  PartRequest request;
  request.side = -1;
  const Part blade = without_ends(box(40, 4, 60));
  EXPECT_EQ(side_of(blade, 0, request).side, -1);
  EXPECT_EQ(side_of(turned(blade), 0, request).side, -1);
  EXPECT_TRUE(side_of(blade, 0, request).asked);
}

TEST(MachinedSide, OfASolidIsKnown) {
  Part part = box(40, 10, 30);
  for (Face& face : part.faces) face.of_solid = true, face.solid = 0;
  EXPECT_TRUE(turn_to_machined_side({}, {0, 1}, part).empty());
  PartRequest request;
  request.side = +1;
  EXPECT_TRUE(turn_to_machined_side(request, {0, 1}, part).empty());
  request.side = -1;
  EXPECT_THROW((void)turn_to_machined_side(request, {0, 1}, part), UsageError);
  part.faces[1].of_solid = false;
  const std::vector<SheetSide> sides = turn_to_machined_side(request, {0, 1}, part);
  ASSERT_EQ(sides.size(), 1u) << "of the sheet alone";
  EXPECT_EQ(sides.front().faces, "F2");
  EXPECT_FALSE(part.faces[0].reversed);
  EXPECT_TRUE(part.faces[1].reversed);
}

TEST(MachinedSide, OfAMeshTurnsItsTriangles) {
  // A pyramid on a wide base that is missing, its normals inwards; and one triangle alone.
  Part part;
  part.mesh.vertices = {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(10, 10, 0), Vec3(0, 10, 0), Vec3(5, 5, 40)};
  part.mesh.triangles = {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
  part.mesh_faces = {{0, 1, 2, 3}};
  part.box = part.mesh.box();
  const std::vector<SheetSide> sides = turn_to_machined_side({}, {0}, part);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(sides.front().side, -1);
  EXPECT_EQ(part.mesh.triangles.front(), (std::array<int, 3>{1, 4, 0}));
}

/// Open faces of IGES files whose outside is known: a wing and a blade.
TEST(MachinedSide, OfOpenIgesFacesIsTheirOutsideHoweverTheyAreTurned) {
  FLANK_REAL_PART(folder, "zoo");
  for (const char* name : {"asitus_blade.igs", "clarkyeah_blade.igs"}) {
    const Part part = read_part(folder + "/" + name);
    for (int face = 0; face < part.face_count(); ++face) {
      ASSERT_FALSE(part.faces[static_cast<std::size_t>(face)].of_solid);
      const SheetSide plus = side_of(part, face), minus = side_of(turned(part), face);
      EXPECT_GT(plus.towards.dot(minus.towards), 0.999) << name << " F" << face + 1;
      EXPECT_EQ(plus.side, +1) << name << " F" << face + 1;
      EXPECT_EQ(minus.side, -1) << name << " F" << face + 1;
    }
  }
}

}  // namespace
}  // namespace flank::internal

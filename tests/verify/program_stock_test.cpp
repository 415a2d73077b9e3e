// A program replayed by the judge: figures by kind, material that is left, faces that are entered.
#include "flank/verify/program_stock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

constexpr double kRadius = 3.0, kLength = 12.0, kHalf = 5.0;

Tool cylinder() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  return tool;
}

Strip straight(int id, const std::string& kind, double y) {
  Strip strip{id, kind, "F1", {}};
  for (int k = 0; k <= 30; ++k) strip.poses.push_back({{-15.0 + k, y, 0.0}, Vec3::UnitZ()});
  return strip;
}

/// A wall across y, of a solid, its samples on a grid between z = 3 and 7.
FaceSamples wall(const std::string& name, double y, const Vec3& normal) {
  FaceSamples out;
  out.face = name;
  out.target = out.of_solid = true;
  out.spacing_mm = 0.8;
  for (double x = -7.0; x <= 7.0; x += 1.0)
    for (double z = 3.0; z <= 7.0; z += 1.0) {
      out.points.emplace_back(x, y, z);
      out.areas.push_back(1.0);
      out.normals.push_back(normal);
    }
  return out;
}

/// A channel of width 2 kHalf along x, blank from x = -10 to 10 below z = 10.
std::vector<HalfSpace> blank() { return {{Vec3::UnitX(), 10.0}, {-Vec3::UnitX(), 10.0}, {Vec3::UnitZ(), 10.0}}; }

std::vector<FaceSamples> walls() { return {wall("F1", kHalf, -Vec3::UnitY()), wall("F2", -kHalf, Vec3::UnitY())}; }

const ProgramStockOptions kOptions{.cell_mm = 0.2, .tolerance_mm = 0.02, .most_triangles = 1e5};

TEST(ProgramStock, TellsByKindsWhatWasRemovedAndHowTheToolWasEngaged) {
  Path path{{straight(1, "front", kHalf - kRadius), straight(2, "side", -kHalf + kRadius)}};
  const ProgramStock out = replay_program(cylinder(), path, blank(), walls(), kOptions);
  ASSERT_EQ(out.report.kinds.size(), 2u);
  EXPECT_EQ(out.report.kinds[0].kind, "front");
  EXPECT_NEAR(out.report.kinds[0].engagement_deg, 180.0, 1.0) << "a full slot";
  EXPECT_EQ(out.report.cycles_deg(), out.report.kinds[0].engagement_deg) << "sides do not count as cycles";
  // The second slot lies 4 mm beside the first: the closed form of a cut of that depth.
  EXPECT_NEAR(out.report.kinds[1].engagement_deg, std::acos(1.0 - 4.0 / kRadius) * 180.0 / std::numbers::pi,
              out.report.resolution_deg);
  EXPECT_NEAR(out.report.kinds[0].way_mm, 30.0, 1e-9);
  EXPECT_NEAR(out.report.before_mm3 - out.report.left_mm3,
              out.report.kinds[0].volume_mm3 + out.report.kinds[1].volume_mm3, 1e-3);
  EXPECT_LT(out.report.uncut_mm, 0.2) << "the channel is empty";
  EXPECT_LT(out.report.entered_mm, 0.02);
  EXPECT_FALSE(out.left.triangles.empty());
}

TEST(ProgramStock, FindsARibBetweenTheSidesAndAWallThatIsEntered) {
  Path path{{straight(1, "side", kHalf - kRadius + 0.1), straight(2, "side", -kHalf + kRadius - 0.1)}};
  std::vector<FaceSamples> entered = walls();
  const ProgramStock deep = replay_program(cylinder(), path, blank(), entered, {.cell_mm = 0.2, .tolerance_mm = 0.2});
  EXPECT_NEAR(deep.report.entered_mm, 0.1, 0.02);
  // Walls 8 mm apart from the middle leave a rib of 4 mm between two slots of 6 mm.
  path = {{straight(1, "side", 8.0 - kRadius), straight(2, "side", -8.0 + kRadius)}};
  const ProgramStock rib = replay_program(cylinder(), path, blank(),
                                          {wall("F1", 8.0, -Vec3::UnitY()), wall("F2", -8.0, Vec3::UnitY())}, kOptions);
  EXPECT_NEAR(rib.report.uncut_mm, 2.0, 0.2) << "half of it: rays end in the middle";
}

TEST(ProgramStock, ThePartBetweenTheSidesIsNoMaterialThatIsLeft) {
  // Walls 20 mm apart, the tool goes along both: what is between the two slots is left, or is a part that fills them.
  const Path path{{straight(1, "side", 10.0 - kRadius), straight(2, "side", -10.0 + kRadius)}};
  std::vector<FaceSamples> faces = {wall("F1", 10.0, -Vec3::UnitY()), wall("F2", -10.0, Vec3::UnitY())};
  const ProgramStock open = replay_program(cylinder(), path, blank(), faces, kOptions);
  EXPECT_NEAR(open.report.uncut_mm, 4.0, 0.2) << "from the slot to the middle";
  for (const double side : {1.0, -1.0}) {
    faces.push_back(wall(side > 0.0 ? "F3" : "F4", side * 4.0, side * Vec3::UnitY()));
    faces.back().target = false;
  }
  const ProgramStock closed = replay_program(cylinder(), path, blank(), faces, kOptions);
  EXPECT_LT(closed.report.uncut_mm, 0.2) << "rays end where they enter the part";
  // A sheet has no side that is material.
  for (std::size_t k = 2; k < faces.size(); ++k) faces[k].of_solid = false;
  EXPECT_NEAR(replay_program(cylinder(), path, blank(), faces, kOptions).report.uncut_mm, open.report.uncut_mm, 1e-9);
}

TEST(ProgramStock, WhatIsLeftOnTheFloorIsNotBetweenTheSides) {
  // The tool is drawn up by 2 mm between the sides, so that it leaves that on a floor at z = -3; rays from the foot of a wall that
  // leans back go down into it.
  Path path{{straight(1, "side", 10.0 - kRadius), straight(2, "side", -10.0 + kRadius)}};
  for (double y = -6.0; y <= 6.0; y += 1.0) {
    path.strips.push_back(straight(static_cast<int>(path.strips.size()) + 1, "front", y));
    for (Pose& pose : path.strips.back().poses) pose.tip.z() += 2.0;
  }
  std::vector<FaceSamples> faces = {wall("F1", 10.0, -Vec3::UnitY()), wall("F2", -10.0, Vec3::UnitY())};
  for (FaceSamples& face : faces) {
    for (Vec3& point : face.points) point.z() -= 3.0;
    for (Vec3& normal : face.normals) normal = Vec3(0.0, normal.y(), -0.35).normalized();
  }
  const ProgramStock open = replay_program(cylinder(), path, blank(), faces, kOptions);
  EXPECT_GT(open.report.uncut_mm, 0.4) << "nobody knows of a floor";
  FaceSamples floor;
  floor.face = "F3";
  floor.of_solid = true;
  floor.spacing_mm = 0.8;
  for (double x = -9.0; x <= 9.0; x += 1.0)
    for (double y = -10.0; y <= 10.0; y += 1.0) {
      floor.points.emplace_back(x, y, -kRadius);
      floor.areas.push_back(1.0);
      floor.normals.push_back(Vec3::UnitZ());
    }
  faces.push_back(floor);
  EXPECT_LT(replay_program(cylinder(), path, blank(), faces, kOptions).report.uncut_mm, 0.2);
}

TEST(ProgramStock, NothingIsBetweenTheSidesWhereOneHasEnded) {
  // The tool goes along both; what is between the slots is left where F2 is across from F1, and is nobody's where it has ended.
  const Path path{{straight(1, "side", 10.0 - kRadius), straight(2, "side", -10.0 + kRadius)}};
  const FaceSamples one = wall("F1", 10.0, -Vec3::UnitY()), other = wall("F2", -10.0, Vec3::UnitY());
  FaceSamples ended = other;
  for (Vec3& point : ended.points) point.x() -= 40.0;
  EXPECT_NEAR(replay_program(cylinder(), path, blank(), {one, other}, kOptions).report.uncut_mm, 4.0, 0.2);
  EXPECT_EQ(replay_program(cylinder(), path, blank(), {one, ended}, kOptions).report.uncut_mm, 0.0);
}

TEST(ProgramStock, IsTheSameForOneAndTwoThreads) {
  const auto run = [](int threads) {
    set_thread_count(threads);
    const Path path{{straight(1, "front", 1.5), straight(2, "back", -0.5)}};
    const ProgramStock out = replay_program(cylinder(), path, blank(), walls(), kOptions);
    set_thread_count(0);
    return out;
  };
  const ProgramStock a = run(1), b = run(2);
  EXPECT_EQ(a.report.strip_deg, b.report.strip_deg);
  EXPECT_EQ(a.report.strip_mm3, b.report.strip_mm3);
  EXPECT_EQ(a.report.uncut_mm, b.report.uncut_mm);
  EXPECT_EQ(a.left.vertices.size(), b.left.vertices.size());
}

TEST(ProgramStock, RefusesAPathThatNeverMeetsTheBlank) {
  const Path path{{straight(1, "front", 0.0)}};
  EXPECT_THROW((void)replay_program(cylinder(), path, {{Vec3::UnitX(), -100.0}}, walls(), kOptions), InputError);
}

/// A block of 20 x 20 x 10 mm as triangles.
TriangleMesh block() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.emplace_back(20.0 * (k & 1), 10.0 * (k & 2), 2.5 * (k & 4));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(RoughStock, ASlotEngagesHalfOfTheToolAndASecondPassLess) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, 2.0));
  const auto pass = [](double y) {
    return Strip{1, "flank", "F1", {{Vec3(-4.0, y, 2.0), Vec3::UnitZ()}, {Vec3(24.0, y, 2.0), Vec3::UnitZ()}}};
  };
  const StockReport slot = rough_stock(tool, Path{{pass(10.0)}}, block(), 180.0);
  ASSERT_EQ(slot.kinds.size(), 1U);
  EXPECT_NEAR(slot.kinds[0].engagement_deg, 180.0, 1.5 * slot.resolution_deg);
  EXPECT_GT(slot.before_mm3, slot.kinds[0].volume_mm3);
  EXPECT_LT(slot.before_mm3, 4000.0) << "of the block, what is near the pass";
  EXPECT_GT(slot.kinds[0].volume_mm3, 4.0 * 20.0 * 8.0);
  // 1 mm beside the slot: acos((2 - 1) / 2).
  const StockReport both = rough_stock(tool, Path{{pass(10.0), pass(11.0)}}, block(), 180.0);
  ASSERT_EQ(both.strip_deg.size(), 2U);
  EXPECT_NEAR(both.strip_deg[1], 60.0, 2.0 * both.resolution_deg);
}

}  // namespace
}  // namespace flank::internal

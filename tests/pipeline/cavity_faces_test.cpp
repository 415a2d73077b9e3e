// Which two sides make a cavity, and what is said of those that do not.
#include "flank/pipeline/cavity/cavity_faces.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "flank/error.h"
#include "flank/example/example_cavity.h"
#include "obstacle/obstacle_scene.h"

namespace flank {
namespace {

/// Two walls of a cavity, F1 and F2, and F3, which goes on from F1 at its end.
internal::Setup two_walls() {
  internal::Setup setup;
  const Vec3 a(0, 10, 0), b(40, 10, 0), c(0, 10, 20), d(40, 10, 20);
  const Vec3 e(80, 10, 0), f(80, 10, 20);
  setup.part.faces = {
      internal::testing::quad(b, a, d, c, "F1"),
      internal::testing::quad(Vec3(0, -10, 0), Vec3(40, -10, 0), Vec3(0, -10, 20), Vec3(40, -10, 20), "F2"),
      internal::testing::quad(e, b, f, d, "F3")};
  return setup;
}

std::string refused(const std::string& left, const std::string& right, std::vector<int> targets) {
  internal::Setup setup = two_walls();
  setup.targets = std::move(targets);
  TrochoidJob job;
  job.left = left;
  job.right = right;
  try {
    (void)internal::cavity_faces(job, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CavityFaces, TwoThatFaceEachOtherAreTaken) { EXPECT_EQ(refused("F1", "F2", {0, 1}), ""); }

TEST(CavityFaces, WhatTouchesIsOneSideAndTheOtherIsNamed) {
  const std::string said = refused("F1", "F3", {0, 2});
  EXPECT_NE(said.find("1 connected side"), std::string::npos) << said;
  EXPECT_NE(said.find("F2 faces F1"), std::string::npos) << said;
}

TEST(CavityFaces, WhereNothingIsAcrossThatIsSaid) {
  internal::Setup setup = two_walls();
  setup.part.faces.erase(setup.part.faces.begin() + 1);  // F1 and F3 alone
  setup.targets = {0, 1};
  TrochoidJob job;
  job.left = "F1";
  job.right = "F3";
  try {
    (void)internal::cavity_faces(job, setup);
    FAIL() << "one side is no cavity";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no face of the part that is large enough faces F1"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace flank

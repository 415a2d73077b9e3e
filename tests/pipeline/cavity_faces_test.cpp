// Which two sides make a cavity, and what is said of those that do not.
#include "flank/pipeline/cavity/cavity_faces.h"

#include <gtest/gtest.h>

#include <string>

#include "flank/error.h"
#include "flank/example/example_cavity.h"
#include "flank/setup/machined_side.h"
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

/// What is said of F1 and another face; empty if they are taken.
std::string refused(const internal::Setup& setup, const std::string& right) {
  TrochoidJob job;
  job.left = "F1";
  job.right = right;
  try {
    (void)internal::cavity_faces(job, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CavityFaces, TwoThatFaceEachOtherAreTaken) {
  internal::Setup setup = two_walls();
  setup.targets = {0, 1};
  PartRequest request;
  request.facing = true;
  setup.sides = internal::turn_to_machined_side(request, setup.targets, setup.part);
  EXPECT_EQ(refused(setup, "F2"), "");
}

TEST(CavityFaces, WhatTouchesIsOneSideAndTheOtherIsNamed) {
  internal::Setup setup = two_walls();
  setup.targets = {0, 2};
  const std::string said = refused(setup, "F3");
  EXPECT_NE(said.find("1 connected side"), std::string::npos) << said;
  EXPECT_NE(said.find("F2 lies opposite F1"), std::string::npos) << said;
}

TEST(CavityFaces, WhereNothingIsAcrossThatIsSaid) {
  internal::Setup setup = two_walls();
  setup.part.faces.erase(setup.part.faces.begin() + 1);  // F1 and F3 alone
  setup.targets = {0, 1};
  const std::string said = refused(setup, "F3");
  EXPECT_NE(said.find("no large enough face of the part lies opposite F1"), std::string::npos) << said;
}

}  // namespace
}  // namespace flank

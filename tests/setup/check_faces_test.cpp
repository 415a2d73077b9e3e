#include "flank/setup/check_faces.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

Part part_of(int faces) {
  Part part;
  part.file = "part.step";
  for (int k = 1; k <= faces; ++k) part.faces.emplace_back().id = "F" + std::to_string(k);
  return part;
}

ObstacleRequest faces(const std::optional<std::string>& check, const std::optional<std::string>& ignore) {
  ObstacleRequest request;
  request.check_faces = check;
  request.ignore_faces = ignore;
  return request;
}

TEST(CheckFaces, EveryOtherFaceUnlessChosen) {
  const Part part = part_of(5);
  EXPECT_EQ(faces_to_check(part, {1}, {}), (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, faces("F5,F1", {})), (std::vector<int>{0, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, faces({}, "F1")), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, faces("F3", "F5")), (std::vector<int>{2}));
}

std::string refusal(const ObstacleRequest& request) {
  try {
    (void)faces_to_check(part_of(5), {1}, request);
  } catch (const UsageError& e) {
    return e.what();
  }
  return {};
}

TEST(CheckFaces, OfRangesTheRestIsMeant) {
  Part part = part_of(6);
  EXPECT_EQ(faces_to_check(part, {1}, faces("F1-F3", {})), (std::vector<int>{0, 2}));
  EXPECT_EQ(faces_to_check(part, {1}, faces({}, "F2-F4")), (std::vector<int>{0, 4, 5}));
  part.faces[1].id = "F2a", part.faces[2].id = "F2b";
  part.faces[3].id = "F3", part.faces[4].id = "F4", part.faces[5].id = "F5";
  EXPECT_EQ(faces_to_check(part, {1}, faces({}, "F2")), (std::vector<int>{0, 3, 4, 5})) << "the other piece";
  part.left_out[4] = "why";
  EXPECT_EQ(faces_to_check(part, {1}, {}), (std::vector<int>{0, 2, 3, 5})) << "nobody looks at what was left out";
}

TEST(CheckFaces, RefusesWhatIsNotThere) {
  EXPECT_NE(refusal(faces("F6", {})).find("check_faces F6"), std::string::npos);
  EXPECT_NE(refusal(faces("F6", {})).find("F1 to F5"), std::string::npos);
  EXPECT_NE(refusal(faces({}, "F0")).find("ignore_faces F0"), std::string::npos);
  EXPECT_NE(refusal(faces("", {})).find("check_faces"), std::string::npos);
  EXPECT_NE(refusal(faces("F1,F2", {})).find("F2 is machined"), std::string::npos);
  EXPECT_NE(refusal(faces({}, "F2")).find("F2 is machined"), std::string::npos);
  EXPECT_NE(refusal(faces("F3,F3", {})).find("twice"), std::string::npos);
  EXPECT_NE(refusal(faces("F3,F4", "F4")).find("`ignore_faces` names F4, too"), std::string::npos);
}

TEST(CheckFaces, WhatCouldNotBeReadIsSaidUnlessItIsIgnoredByName) {
  Part part = part_of(5);
  part.left_out[2] = "p.step, face F3: why";
  part.left_out[4] = "p.step, face F5: why";
  EXPECT_EQ(faces_unread(part, {1}, {}), (std::vector<int>{2, 4}));
  EXPECT_EQ(faces_unread(part, {1}, faces({}, "F3")), std::vector<int>{4});
  EXPECT_EQ(faces_unread(part, {1}, faces({}, "F3-F5")), std::vector<int>());
  EXPECT_EQ(faces_unread(part, {1}, faces("F4", {})), (std::vector<int>{2, 4})) << "nobody said that they may be cut";
  EXPECT_EQ(faces_to_check(part, {1}, faces({}, "F3-F4")), std::vector<int>{0});
  EXPECT_THROW((void)faces_to_check(part, {1}, faces("F3", {})), UsageError) << "it cannot be checked";
  EXPECT_EQ(unchecked_note(part, {1}, {0, 3}, {2, 4}), "");
  EXPECT_EQ(unchecked_note(part, {1}, {0, 3}, {4}), "not checked, by --ignore-faces: F3");
}

TEST(CheckFaces, SaysWhatIsLeftOut) {
  EXPECT_EQ(unchecked_note(part_of(5), {1}, {0, 2, 3, 4}, {}), "");
  EXPECT_EQ(unchecked_note(part_of(5), {1}, {0, 2}, {}), "not checked, by --ignore-faces: F4, F5");
  EXPECT_EQ(unchecked_note(part_of(20), {0}, {1}, {}),
            "not checked, by --ignore-faces: F3, F4, F5, F6, F7, F8, F9, F10 and 10 more faces");
}

TEST(CheckFaces, SaysHowOtherSolidsAreLeftOut) {
  Part part = part_of(6);
  for (std::size_t k = 0; k < 5; ++k) part.faces[k].of_solid = true, part.faces[k].solid = static_cast<int>(k);
  part.solids = 5;
  EXPECT_NE(other_solids_note(part, {1}, {0, 2, 3, 5}).find("3 other solids"), std::string::npos);
  EXPECT_NE(other_solids_note(part, {1}, {0, 2, 3, 5}).find("--ignore-faces S1,S3-S4"), std::string::npos);
  EXPECT_NE(other_solids_note(part, {0, 1}, {2}).find("1 other solid; if the part is machined without it"),
            std::string::npos);
  EXPECT_EQ(other_solids_note(part, {1}, {5}), "") << "a sheet";
  EXPECT_EQ(other_solids_note(part, {5}, {0, 1}), "") << "the target is one";
  EXPECT_EQ(faces_to_check(part, {1}, faces({}, "S1,S3-S5")), std::vector<int>{5});
}

}  // namespace
}  // namespace flank::internal

#include "flank/setup/check_faces.h"

#include <gtest/gtest.h>

#include "flank/artefact/view.h"
#include "flank/error.h"
#include "flank/job/job_json.h"

namespace flank::internal {
namespace {

Part part_of(int faces) {
  Part part;
  part.file = "part.step";
  part.faces.resize(static_cast<std::size_t>(faces));
  return part;
}

TEST(CheckFaces, EveryOtherFaceUnlessChosen) {
  const Part part = part_of(5);
  EXPECT_EQ(faces_to_check(part, {1}, {}), (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, {"F5,F1", {}}), (std::vector<int>{0, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, {{}, "F1"}), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(faces_to_check(part, {1}, {"F3", "F5"}), (std::vector<int>{2}));
}

std::string refusal(const CheckFaceChoice& choice) {
  try {
    (void)faces_to_check(part_of(5), {1}, choice);
  } catch (const UsageError& e) {
    return e.what();
  }
  return {};
}

TEST(CheckFaces, RefusesWhatIsNotThere) {
  EXPECT_NE(refusal({"F6", {}}).find("--check-faces F6"), std::string::npos);
  EXPECT_NE(refusal({"F6", {}}).find("F1 to F5"), std::string::npos);
  EXPECT_NE(refusal({{}, "F0"}).find("--ignore-faces F0"), std::string::npos);
  EXPECT_NE(refusal({"", {}}).find("--check-faces"), std::string::npos);
  EXPECT_NE(refusal({"F1,F2", {}}).find("F2 is a target"), std::string::npos);
  EXPECT_NE(refusal({{}, "F2"}).find("F2 is a target"), std::string::npos);
  EXPECT_NE(refusal({"F3,F3", {}}).find("twice"), std::string::npos);
  EXPECT_NE(refusal({"F3,F4", "F4"}).find("both name F4"), std::string::npos);
}

TEST(CheckFaces, SaysWhatIsLeftOut) {
  EXPECT_EQ(unchecked_note(part_of(5), {1}, {0, 2, 3, 4}), "");
  EXPECT_EQ(unchecked_note(part_of(5), {1}, {0, 2}), "not checked, as asked: F4, F5");
  EXPECT_EQ(unchecked_note(part_of(20), {0}, {1}),
            "not checked, as asked: F3, F4, F5, F6, F7, F8, F9, F10 and 10 more faces");
}

TEST(CheckFaces, AreKeptInTheJob) {
  FitJob job;
  job.part = "parts/part.step";
  job.check = {"F88,F12", "F5"};
  job.avoid = false;
  const FitJob back = job_from_json(job_to_json(job), "job.json");
  EXPECT_EQ(back.check.only, job.check.only);
  EXPECT_EQ(back.check.ignored, job.check.ignored);
  EXPECT_FALSE(back.avoid);
  EXPECT_EQ(job_command(job), "flank fit part.step --face F1 --check-faces F88,F12 --ignore-faces F5 --avoid off");
  FitJob plain;
  plain.part = "parts/part.step";
  const FitJob usual = job_from_json(job_to_json(plain), "job.json");
  EXPECT_FALSE(usual.check.any());
  EXPECT_TRUE(usual.avoid);
}

}  // namespace
}  // namespace flank::internal

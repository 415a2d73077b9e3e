// What an earlier run has done is kept where the same program would do the same again, and nowhere else.
#include "flank/wheel/perform.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "flank/error.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class Perform : public TemporaryFolder {
 protected:
  Perform() : TemporaryFolder("perform") {}
  void SetUp() override {
    TemporaryFolder::SetUp();
    job_.folder = root_.string();
    std::filesystem::create_directories(root_ / "ops/30-floor");
    std::ofstream(root_ / "ops/30-floor/path.json") << "{}";
  }
  [[nodiscard]] WheelWork work() const { return {job_, roles_, sector_, part_, blank_, FaceTargets(part_), {}}; }
  /// The operation after a run, and whether it was done in it.
  [[nodiscard]] std::pair<WheelOperation, bool> run(const WheelWork& work, const std::string& decides) const {
    bool done = false;
    WheelOperation operation{.id = "30", .kind = "floor", .folder = ""};
    operation = perform(work, operation, decides, [&]() -> Result {
      done = true;
      throw InputError("not needed here");
    });
    return {operation, done};
  }
  WheelRequest job_;
  WheelRoles roles_;
  WheelSector sector_;
  Part part_;
  WheelBlank blank_;
};

TEST_F(Perform, KeepsWhatTheSameProgramHasDoneOfTheSame) {
  WheelWork first = work();
  auto [operation, done] = run(first, "passes");
  ASSERT_TRUE(done);
  operation.done = true;
  WheelWork second = work();
  second.finished = {{"30", operation}};
  const auto [kept, again] = run(second, "passes");
  EXPECT_FALSE(again);
  EXPECT_TRUE(kept.kept);
  std::vector<std::string> begun;
  second.begins = [&](const std::string& id) { begun.push_back(id); };
  EXPECT_FALSE(run(second, "passes").second);
  EXPECT_TRUE(begun.empty());
  EXPECT_TRUE(run(second, "other passes").second);
  EXPECT_EQ(begun, (std::vector<std::string>{"30"}));
  second.program = "of another build";
  EXPECT_TRUE(run(second, "passes").second);
}

}  // namespace
}  // namespace flank::internal

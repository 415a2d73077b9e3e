// In which ways a tool is tried on a face, and whose result is kept. The tasks' results are said, not computed.
#include "flank/design/pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/base/atomic_file.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr double kLength = 20.0;

/// A tool of a catalogue and two equal faces: half a turn about z and a shift carry F1 to F2.
class DesignPairs : public TemporaryFolder {
 protected:
  DesignPairs() : TemporaryFolder("flank_pairs") {}
  void SetUp() override {
    TemporaryFolder::SetUp();
    fs::create_directories(root_ / "tools");
    motion_.linear() = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
    motion_.translation() = Vec3(0.0, 50.0, 3.0);
    result_.faces = {"F1", "F2"};
    result_.equal = {{1, 0, Eigen::Isometry3d::Identity()}, {1, 0, motion_}};
    result_.job.part.file = (root_ / "part.step").string();
    result_.reach_radius_mm = 2.0;
    DesignTool tool;
    tool.name = "T1";
    tool.source = "catalogue cylinder";
    tool.file = "tools/T1.json";
    tool.tool.radial = RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, 4.0));
    tool.tool.name = "cylinder";
    write_tool(tool.tool, (root_ / tool.file).string());
    result_.tools.push_back(tool);
  }

  static Path strip(const std::string& face) {
    Strip strip;
    strip.face = face;
    for (int k = 0; k < 17; ++k) strip.poses.push_back({Vec3(k, 0.1 * k * k, 0.0), Vec3::UnitZ()});
    return {{strip}};
  }

  /// Says what comes of each task that is named; of any other nothing does. A result is a share that is covered.
  void judge(const std::map<std::string, std::pair<TaskStatus, double>>& outcomes) {
    const auto run = [&](const std::vector<BatchTask>& tasks) {
      std::vector<TaskRow> rows;
      for (const BatchTask& task : tasks) {
        asked_.push_back(task.name);
        words_[task.name] = task.words;
        TaskRow row;
        row.status = TaskStatus::kRefused;
        if (const auto found = outcomes.find(task.name); found != outcomes.end()) {
          row.status = found->second.first;
          fs::create_directories(root_ / task.name);
          if (!task.judges) write_path(strip(task.name.substr(0, 2)), (root_ / task.name / "path.json").string());
          const nlohmann::json verdict = {{"coverage_reachable", found->second.second}, {"overcut_mm", 0.01}};
          write_file((root_ / task.name / "verify.json").string(), verdict.dump());
        }
        rows.push_back(row);
      }
      return rows;
    };
    judge_pairs(result_, {root_.string(), "inputs", run}, 0);
  }
  /// The word after an option of a task's command.
  [[nodiscard]] std::string option(const std::string& task, const std::string& name) const {
    const auto& words = words_.at(task);
    const auto at = std::find(words.begin(), words.end(), name);
    return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
  }

  Eigen::Isometry3d motion_ = Eigen::Isometry3d::Identity();
  DesignResult result_;
  std::vector<std::string> asked_;
  std::map<std::string, std::vector<std::string>> words_;
};

using Names = std::vector<std::string>;

TEST_F(DesignPairs, ACoverThatFinishesIsCarriedToEqualFaces) {
  judge({{"F1-T1-cover", {TaskStatus::kMeets, 1.0}}, {"F2-T1", {TaskStatus::kMeets, 0.995}}});
  EXPECT_EQ(asked_, (Names{"F1-T1-cover", "F2-T1"}));
  EXPECT_EQ(words_["F1-T1-cover"].front(), "cover");
  EXPECT_EQ(words_["F2-T1"].front(), "verify");
  EXPECT_EQ(result_.pair(0, 0).way, "cover");
  EXPECT_EQ(result_.pair(0, 1).way, "as F1");
  EXPECT_EQ(result_.pair(0, 1).coverage_reachable, 0.995);
  const Path path = read_path((root_ / "F2-T1/path.json").string());
  EXPECT_EQ(path.strips.at(0).face, "F2");
  EXPECT_LT((path.strips[0].poses[5].tip - motion_ * strip("F1").strips[0].poses[5].tip).norm(), 1e-12);
}

TEST_F(DesignPairs, WhereACoverFallsShortTheMotionAloneIsFitted) {
  judge({{"F1-T1-cover", {TaskStatus::kFallsShort, 0.6}},
         {"F1-T1-motion", {TaskStatus::kMeets, 0.99}},
         {"F2-T1", {TaskStatus::kMeets, 0.99}}});
  EXPECT_EQ(asked_, (Names{"F1-T1-cover", "F1-T1-motion", "F2-T1"}));
  EXPECT_EQ(words_["F1-T1-motion"].front(), "fit");
  EXPECT_EQ(option("F1-T1-motion", "--tool"), (root_ / "tools/T1.json").string());
  EXPECT_EQ(option("F1-T1-motion", "--face"), "F1");
  EXPECT_EQ(option("F1-T1-motion", "--guide"), "");
  EXPECT_EQ(result_.pair(0, 0).way, "motion");
  EXPECT_EQ(result_.pair(0, 0).folder, "F1-T1-motion");
  EXPECT_TRUE(result_.pair(0, 0).finishes());
  EXPECT_GT(result_.pair(0, 0).minutes, 0.0);
}

TEST_F(DesignPairs, WhatComesCloserIsKeptWhereNothingFinishes) {
  judge({{"F1-T1-cover", {TaskStatus::kFallsShort, 0.6}}, {"F1-T1-motion", {TaskStatus::kFallsShort, 0.5}}});
  EXPECT_EQ(result_.pair(0, 0).way, "cover");
  EXPECT_FALSE(result_.pair(0, 0).finishes());
  EXPECT_EQ(asked_, (Names{"F1-T1-cover", "F1-T1-motion", "F2-T1"})) << "no more is tried for F2 than what F1 has";
}

TEST_F(DesignPairs, AnEqualFaceWithOtherNeighboursGetsAMotionOfItsOwn) {
  judge({{"F1-T1-cover", {TaskStatus::kMeets, 1.0}},
         {"F2-T1", {TaskStatus::kFallsShort, 0.9}},
         {"F2-T1-guided", {TaskStatus::kMeets, 0.99}}});
  EXPECT_EQ(asked_, (Names{"F1-T1-cover", "F2-T1", "F2-T1-guided"}));
  EXPECT_EQ(result_.pair(0, 1).way, "motion");
  EXPECT_EQ(result_.pair(0, 1).folder, "F2-T1-guided");
  // The guide is the path of F1, moved: tip and holder end.
  std::ifstream stream(option("F2-T1-guided", "--guide"));
  std::vector<Vec3> points;
  for (double x = 0, y = 0, z = 0; stream >> x >> y >> z;) points.emplace_back(x, y, z);
  ASSERT_EQ(points.size(), 18u);
  const auto poses = strip("F1").strips[0].poses;
  for (std::size_t k = 0; k < 9; ++k) {
    const Pose& pose = poses[2 * k];
    EXPECT_LT((points[2 * k] - motion_ * pose.tip).norm(), 1e-12);
    EXPECT_LT((points[2 * k + 1] - motion_ * (pose.tip + kLength * pose.axis)).norm(), 1e-12);
  }
}

TEST_F(DesignPairs, ThenOneFromAnywhereThenACover) {
  judge({{"F1-T1-cover", {TaskStatus::kMeets, 1.0}},
         {"F2-T1", {TaskStatus::kFallsShort, 0.9}},
         {"F2-T1-guided", {TaskStatus::kFallsShort, 0.95}},
         {"F2-T1-cover", {TaskStatus::kMeets, 0.99}}});
  EXPECT_EQ(asked_, (Names{"F1-T1-cover", "F2-T1", "F2-T1-guided", "F2-T1-motion", "F2-T1-cover"}));
  EXPECT_EQ(result_.pair(0, 1).way, "cover");
}

}  // namespace
}  // namespace flank::internal

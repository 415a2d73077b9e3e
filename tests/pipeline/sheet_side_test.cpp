// On which side of an open sheet the tool goes: one side, whatever the tolerance and whichever command asks.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/run.h"
#include "flank/setup/read_setup.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class SheetSideTest : public TemporaryFolder {
 protected:
  SheetSideTest() : TemporaryFolder("sheets") {}
  [[nodiscard]] std::string file(const std::string& name) const { return (root_ / name).string(); }
};

/// The sides of a part's faces as a job of that tolerance has them.
flank::internal::Setup setup_of(const std::string& part, const std::string& faces, double tolerance) {
  PartRequest request;
  request.file = part;
  request.faces = faces;
  if (part.ends_with(".stl")) request.unit = "mm";
  std::vector<std::string> notes;
  return read_setup(request, {}, tolerance, notes);
}

/// Does the middle of a motion lie on the side that is machined?
bool is_towards(const RuledMotion& motion, const SheetSide& side) {
  double least = 1e300;
  Vec3 nearest = Vec3::Zero();
  for (int k = 0; k <= 50; ++k) {
    const Pose pose = motion.pose(k / 50.0);
    const double s = std::clamp((side.place - pose.tip).dot(pose.axis), 0.0, motion.axis_length);
    if (const double d = (pose.at(s) - side.place).norm(); d < least) least = d, nearest = pose.at(s);
  }
  return (nearest - side.place).dot(side.towards) > 0.0;
}

TEST_F(SheetSideTest, OfEveryExampleIsOneAtAnyToleranceAndThatOfItsOwnTool) {
  int sheets = 0;
  for (const std::string& name : example_names()) {
    ExampleOptions options;
    options.mesh_vertices = 400;
    options.relative_accuracy = 1e-4;
    const Example example = make_example(name, options);
    if (!example.step.empty()) continue;  // a solid
    if (kSanitized && sheets >= 3) break;
    ++sheets;
    const std::string part = file(name + (example.mesh ? ".stl" : ".step"));
    (void)write_example(example, part);
    const std::string faces = example.faces.size() > 1 ? "F1,F2" : "F1";
    std::set<std::string> said;
    for (const double tolerance : {0.001, 0.01, 0.02, 0.1, 0.5}) {
      const auto setup = setup_of(part, faces, tolerance);
      ASSERT_EQ(setup.sides.size(), example.faces.size() > 1 ? 2u : 1u) << name;
      std::string all;
      for (std::size_t k = 0; k < setup.sides.size(); ++k) {
        all += setup.sides[k].faces + (setup.sides[k].side > 0 ? "+" : "-");
        EXPECT_EQ(setup.sides[k].side, +1) << name << ": the normal of an example points to where it is machined";
        EXPECT_TRUE(!example.truth || is_towards(example.truth->motions[k], setup.sides[k])) << name;
      }
      said.insert(all);
    }
    EXPECT_EQ(said.size(), 1u) << name;
  }
  EXPECT_GE(sheets, kSanitized ? 3 : 12);
}

/// The round side of almost a cone.
class OneSheet : public SheetSideTest {
 protected:
  void SetUp() override {
    SheetSideTest::SetUp();
    part_.file = file("side.step");
    (void)write_example(make_example("elliptic-side"), part_.file);
  }
  static const SheetSide& only(const VerifyReport& report) {
    EXPECT_EQ(report.sheet_sides.size(), 1u);
    return report.sheet_sides.front();
  }
  static long cautions(const Acceptance& acceptance) {
    return std::count_if(acceptance.cautions.begin(), acceptance.cautions.end(),
                         [](const Shortfall& c) { return c.figure == "sheet_side"; });
  }
  PartRequest part_;
};

TEST_F(OneSheet, FitAndVerifyAgreeAndSayIt) {
  FitJob job;
  job.part = part_;
  job.tolerance_mm = 0.1;
  const Result found = run_fit(job);
  EXPECT_TRUE(found.acceptance().pass());
  EXPECT_EQ(only(found.verify).side, +1);
  EXPECT_EQ(cautions(found.acceptance()), 1);
  EXPECT_NE(summary_text(found).find("CAUTION     F1 belongs to no solid; machined from side +, towards"),
            std::string::npos);
  EXPECT_NE(summary_json(found).find("\"side\": \"+\""), std::string::npos);
  write_result(found, file("out"));
  VerifyJob again;
  again.folder = file("out");
  const Verification verdict = run_verify(again);
  EXPECT_TRUE(verdict.acceptance.pass());
  EXPECT_EQ(only(verdict.report).side, +1);
  EXPECT_EQ(cautions(verdict.acceptance), 1);
  again.side = -1;  // the other side is asked for: the tool is in the material then
  const Verification other = run_verify(again);
  EXPECT_FALSE(other.acceptance.pass());
  EXPECT_EQ(only(other.report).side, -1);
  EXPECT_EQ(cautions(other.acceptance), 0) << "a side that was asked for needs no caution";
  std::ifstream view(file("out") + "/view.json");
  const std::string text((std::istreambuf_iterator<char>(view)), {});
  EXPECT_NE(text.find("\"sides\":[{\"faces\":\"F1\",\"side\":"), std::string::npos);
}

TEST_F(OneSheet, IsNotSwitchedWhereItCannotBeMet) {
  // A cylinder lies on the round side along a line, and nowhere on the hollow one that bends as it does not.
  CoverJob job;
  job.part = part_;
  job.tool.spec = "cylinder:radius=4";
  job.tool.axis_length_mm = 20.0;
  job.tolerance_mm = 0.001;
  job.most_strips = 1;
  const Result found = run_cover(job);
  EXPECT_FALSE(found.acceptance().pass());
  EXPECT_EQ(only(found.verify).side, +1);
  EXPECT_NE(summary_text(found).find("--side - takes the other side"), std::string::npos);
}

TEST_F(OneSheet, AStartOnTheOtherSideIsRefused) {
  FitJob job;
  job.part = part_;
  job.tolerance_mm = 0.1;
  job.start = "0,38,-20,0,38,20";  // in the hollow
  EXPECT_THROW((void)run_fit(job), InputError);
}

}  // namespace
}  // namespace flank::internal

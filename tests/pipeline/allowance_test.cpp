// Material left on purpose: by the judge, by a fit, and from a folder again. What is left is measured here from the nominal faces and the
// tool as it is, by the swept distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/io/cad/write_step.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"
#include "flank/tool_file.h"
#include "sanitized.h"
#include "surface/nurbs_fixtures.h"
#include "temporary_folder.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr double kAllowance = 0.2, kTolerance = 0.01;

class Allowance : public TemporaryFolder {
 protected:
  Allowance() : TemporaryFolder("flank_allowance") {}

  [[nodiscard]] FitJob job_on(const Face& face) const {
    const std::string file = (root_ / "part.step").string();
    write_step(file, {face});
    FitJob job;
    job.part.file = file;
    job.part.allowance_mm = kAllowance;
    job.tolerance_mm = kTolerance;
    job.effort = "quick";
    return job;
  }
};

/// What is left on the nominal face, by the tool as it is: the least of it, and the share of the area on which it is the allowance within
/// the tolerance.
struct Left {
  double least = 1e300, share = 0.0;
};
Left left_on(const Face& face, const Result& result) {
  const FaceSamples samples = sample_face(face, 0.4, true);
  const SweptVolume volume(result.tool, result.path);
  const std::vector<SweptDistance> distances = swept_distances(volume, samples, 1e300);
  Left left;
  double area = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    left.least = std::min(left.least, distances[k].f);
    area += samples.areas[k];
    if (std::abs(distances[k].f - kAllowance) <= kTolerance) left.share += samples.areas[k];
  }
  left.share /= area;
  return left;
}

void expect_left(const Face& face, const Result& result) {
  EXPECT_TRUE(result.acceptance().pass());
  EXPECT_DOUBLE_EQ(result.verify.allowance_mm, kAllowance);
  const Left left = left_on(face, result);
  EXPECT_GE(left.least, kAllowance - kTolerance);
  EXPECT_GE(left.share, 0.985);
}

TEST_F(Allowance, OfACylinderIsLeftByAFit) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const Face face = test::quarter_cylinder("F1", 20.0, 15.0);
  FitJob job = job_on(face);
  job.tool.spec = "cylinder:radius=5";
  const Result result = run_fit(job);
  EXPECT_DOUBLE_EQ(result.tool.radial.smallest(), 5.0) << "the tool is not what grows";
  expect_left(face, result);
}

TEST_F(Allowance, OfASphereIsLeftByAFit) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const double r = 30.0;
  // 90 degrees round z, and 20 degrees up.
  const double up = 10.0 * std::numbers::pi / 180.0;
  const Face face = test::revolved(1, 2, {0, 0, 0, 1, 1, 1},
                                   {{r * std::cos(up), -r * std::sin(up), 1.0},
                                    {r / std::cos(up), 0.0, std::cos(up)},
                                    {r * std::cos(up), r * std::sin(up), 1.0}});
  FitJob job = job_on(face);
  expect_left(face, run_fit(job));
}

TEST_F(Allowance, OfAFreeFormIsLeftByAFit) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const Face face = test::twisted_ruled();
  FitJob job = job_on(face);
  job.tolerance_mm = kTolerance;
  expect_left(face, run_fit(job));
}

TEST_F(Allowance, ABendTowardsTheToolThatIsTooSharpIsRefused) {
  Face face = test::quarter_cylinder("F1", 2.0, 15.0);
  face.reversed = true;
  FitJob job = job_on(face);
  job.part.side = +1;
  job.part.allowance_mm = 2.5;
  try {
    (void)run_fit(job);
    FAIL() << "nothing is left of the face";
  } catch (const UsageError& e) {
    EXPECT_EQ(e.field(), "allowance_mm");
    EXPECT_NE(std::string(e.what()).find("F1 is concave with a radius of 2 mm"), std::string::npos) << e.what();
  }
  for (const double bad : {-0.1, 1.0 / 0.0, std::nan("")}) {
    job.part.allowance_mm = bad;
    EXPECT_THROW((void)run_fit(job), UsageError) << bad;
  }
}

/// A plane y = 0 of 60 x 30 mm, and a wall at x = 60 that is checked; a cylinder of 4 mm that runs along x, its axis along z.
struct Scene {
  Scene() {
    setup.part.faces = {test::plane_face("F1", 60.0, 30.0)};
    setup.part.surface_types = {"B-spline"};
    for (const Vec3& pole : setup.part.faces[0].surface.poles) setup.part.box.add(pole);
    setup.targets = {0};
    setup.tolerance_mm = kTolerance;
    setup.allowance_mm = kAllowance;
    setup.part.faces[0].reversed = true;
    tool.radial = RadialFunction(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 4.0));
  }
  [[nodiscard]] Path at(double height) const {
    Strip pass;
    for (const double x : {-1.0, 20.0, 40.0, 61.0}) pass.poses.push_back({Vec3(x, height, -5.0), Vec3::UnitZ()});
    return {{pass}};
  }
  flank::internal::Setup setup;
  Tool tool;
};

TEST(AllowanceJudged, IsMeasuredFromTheFaceMovedOut) {
  const Scene scene;
  const VerifyReport right = judge_job(scene.setup, {}, scene.tool, scene.at(4.0 + kAllowance));
  EXPECT_EQ(right.verdict, Verdict::kPass);
  EXPECT_NEAR(right.coverage, 1.0, 1e-12);
  EXPECT_LT(right.overcut_mm, 1e-6);
  EXPECT_LE(right.overcut_bound_mm, kTolerance);
  EXPECT_DOUBLE_EQ(right.reach_radius_mm, 4.0);
  const VerifyReport deep = judge_job(scene.setup, {}, scene.tool, scene.at(4.0 + kAllowance - 0.05));
  EXPECT_EQ(deep.verdict, Verdict::kOvercut);
  EXPECT_NEAR(deep.overcut_mm, 0.05, 1e-6);
  const VerifyReport high = judge_job(scene.setup, {}, scene.tool, scene.at(4.0 + kAllowance + 0.03));
  EXPECT_NEAR(high.undercut_covered_mm, 0.03, 1e-6);
  EXPECT_EQ(high.coverage, 0.0);
}

TEST(AllowanceJudged, HoldsForShankAndHolderBesideThePart) {
  Scene scene;
  scene.tool.shank = {{40.0, 4.0}, {60.0, 4.0}};
  scene.tool.radial = RadialFunction(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 3.0));
  scene.tool.shank = {{10.0, 4.0}, {60.0, 4.0}};
  const auto kept = [&](double height) {
    std::vector<std::string> notes;
    const ClearanceScene clearance = make_clearance_scene(scene.setup, {}, true, notes);
    return measure_clearance(clearance, scene.tool, scene.at(height)).kept();
  };
  EXPECT_TRUE(kept(4.0 + kAllowance + 0.01));
  EXPECT_FALSE(kept(4.0 + kAllowance - 0.05)) << "within what is left";
}

TEST_F(Allowance, IsTheSameFromAFolder) {
  if (kSanitized) GTEST_SKIP() << "a whole fit takes minutes under a sanitizer";
  FitJob job = job_on(test::quarter_cylinder("F1", 20.0, 15.0));
  job.tool.spec = "cylinder:radius=5";
  const Result result = run_fit(job);
  const std::string folder = (root_ / "out").string();
  write_result(result, folder);
  const PlanJob read = job_from_json(content("out/job.json"), "job.json");
  EXPECT_EQ(std::get<FitJob>(read).part.allowance_mm, kAllowance);
  VerifyJob again;
  again.folder = folder;
  const Verification verification = run_verify(again);
  EXPECT_TRUE(verification.acceptance.pass());
  EXPECT_DOUBLE_EQ(verification.report.allowance_mm, kAllowance);
  EXPECT_DOUBLE_EQ(verification.report.overcut_mm, result.verify.overcut_mm);
  EXPECT_NE(content("out/verify.json").find("\"allowance_mm\": 0.2"), std::string::npos);
  EXPECT_NE(verify_text(verification).find("0.2 mm left on purpose"), std::string::npos);
}

TEST_F(Allowance, OfNothingIsAsIfNotAskedFor) {
  if (kSanitized) GTEST_SKIP() << "whole fits take minutes under a sanitizer";
  FitJob job = job_on(test::quarter_cylinder("F1", 20.0, 15.0));
  job.tool.spec = "cylinder:radius=5";
  job.part.allowance_mm = 0.0;
  const Result zero = run_fit(job);
  job.part.allowance_mm.reset();
  const Result none = run_fit(job);
  EXPECT_EQ(job_to_json(zero.job), job_to_json(none.job));
  EXPECT_EQ(summary_json(zero), summary_json(none));
}

}  // namespace
}  // namespace flank::internal

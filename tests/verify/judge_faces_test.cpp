// How finely the proof of coverage looks: as finely as the share that is asked for needs, and no finer.
#include "flank/verify/judge_faces.h"

#include <gtest/gtest.h>

#include "verify/faces.h"

namespace flank::internal {
namespace {

/// A cylinder over the first half of a plane, at an angle to its samples' cells: the border of what is covered crosses them.
class HalfAPlane : public testing::Test {
 protected:
  HalfAPlane() {
    tool_.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 5.0));
    Strip strip;
    for (int i = 0; i <= 10; ++i)
      strip.poses.push_back({Vec3(-1.0 + 2.1 * i, 5.0, 0.0), Vec3(0.1, 0.0, 1.0).normalized()});
    path_.strips = {strip};
  }

  [[nodiscard]] VerifyReport judged(double least_coverage) const {
    verify::JudgedFace face{
        .face = "F1",
        .target = true,
        .size_mm = 45.0,
        .samples = [this](std::size_t, bool fine, const auto& use) { use(fine ? fine_ : samples_); },
        .shape = &shape_};
    return verify::judge_faces(tool_, path_, {face}, {}, {.reachable = least_coverage, .whole = 0.0});
  }

  Tool tool_;
  Path path_;
  const Face face_ = test::plane_face("F1", 40.0, 20.0);
  FaceSamples samples_ = sample_face(face_, 0.2, true);
  FaceSamples fine_ = samples_;  ///< where cells that are reachable in part are cut
  const FaceShape shape_ = &face_;
};

TEST_F(HalfAPlane, IsProvedWhereThatDecides) {
  const VerifyReport coarse = judged(1.0);
  const double measured = coarse.coverage_reachable, proved = *coarse.coverage_reachable_bound;
  ASSERT_LT(proved, measured);
  const double between = 0.5 * (proved + measured);
  const VerifyReport fine = judged(between);
  EXPECT_GE(*fine.coverage_reachable_bound, between);
  EXPECT_EQ(fine.coverage_reachable, measured);
}

TEST_F(HalfAPlane, CostsNoMoreThanItsSamplesWhereNothingHangsOnIt) {
  const VerifyReport coarse = judged(1.0);
  const double measured = coarse.coverage_reachable, proved = *coarse.coverage_reachable_bound;
  for (const double least : {0.9 * proved, 0.5 * (1.0 + measured), 1.0}) {
    const VerifyReport report = judged(least);
    EXPECT_LE(report.faces[0].cover_cells, samples_.points.size()) << least;
    EXPECT_EQ(report.coverage_reachable_bound, coarse.coverage_reachable_bound) << least;
  }
}

/// A no with "3 % proved" beside "47 % measured" tells the reader nothing.
TEST_F(HalfAPlane, ANoIsProvedAboutAsFarAsItIsMeasured) {
  samples_ = sample_face(face_, 1.6, true);
  const VerifyReport report = judged(0.97);
  ASSERT_LT(report.coverage_reachable, 0.6);
  EXPECT_GE(*report.coverage_bound, 0.85 * report.coverage);
  EXPECT_GT(report.faces[0].cover_cells, samples_.points.size()) << "a look of a ball a sample was not enough";
  EXPECT_LE(report.faces[0].cover_cells, 12 * samples_.points.size());
}

TEST_F(HalfAPlane, NothingIsProvedToBeFinishedWhereItIsCutTooDeepAnyway) {
  for (Pose& pose : path_.strips[0].poses) pose.tip.y() -= 0.1;
  const VerifyReport report = judged(0.4);
  EXPECT_EQ(report.verdict, Verdict::kOvercut);
  EXPECT_EQ(report.coverage_reachable_bound, 0.0);
  EXPECT_EQ(report.faces[0].cover_cells, 0u);
}

/// The blades of a wheel that one of them stands for.
TEST_F(HalfAPlane, CountsAsOftenAsThereAreCopiesOfIt) {
  const Face other = test::plane_face("F2", 10.0, 5.0);
  const FaceShape shape = &other;
  FaceSamples far = sample_face(other, 0.5, true);
  for (Vec3& p : far.points) p.z() += 500.0;
  verify::JudgedFace half{.face = "F1",
                          .target = true,
                          .size_mm = 45.0,
                          .samples = [this](std::size_t, bool, const auto& use) { use(samples_); },
                          .shape = &shape_,
                          .copies = 3};
  verify::JudgedFace none{.face = "F2",
                          .target = true,
                          .size_mm = 11.0,
                          .samples = [&](std::size_t, bool, const auto& use) { use(far); },
                          .shape = &shape};
  const VerifyReport report = verify::judge_faces(tool_, path_, {half, none}, {}, {});
  const FaceVerdict& first = report.faces[0];
  ASSERT_GT(first.coverage, 0.4);
  ASSERT_EQ(report.faces[1].coverage, 0.0);
  EXPECT_EQ(first.copies, 3);
  EXPECT_NEAR(first.area_mm2, 800.0, 1e-6) << "of one";
  EXPECT_NEAR(report.coverage, 3.0 * 800.0 * first.coverage / (3.0 * 800.0 + 50.0), 1e-12);
  EXPECT_NEAR(report.coverage_reachable, report.coverage, 1e-12);
}

TEST_F(HalfAPlane, CellsThatAreReachableInPartAreCutWhereThatDecides) {
  // Reachable is what is covered, but for a hair. Cells are 2 mm, then a quarter.
  const auto reach_to = [](FaceSamples& samples, double short_by) {
    samples.reachable.clear();
    for (const auto& [u_low, u_high, v_low, v_high] : samples.cells) {
      const double end = (20.0 + 0.1 * 20.0 * 0.5 * (v_low + v_high) - short_by) / 40.0;
      samples.reachable.push_back(std::clamp((end - u_low) / (u_high - u_low), 0.0, 1.0));
    }
  };
  samples_ = sample_face(face_, 2.0, true);
  reach_to(samples_, 0.2);
  fine_ = samples_;
  EXPECT_LT(*judged(0.985).coverage_reachable_bound, 0.985);
  fine_ = sample_face(face_, 0.25, true);
  reach_to(fine_, 0.2);
  EXPECT_GT(*judged(0.985).coverage_reachable_bound, 0.985);
}

}  // namespace
}  // namespace flank::internal

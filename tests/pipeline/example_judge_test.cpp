/// The judge shares no code with the generator of examples: where both agree, both are right.
#include <gtest/gtest.h>

#include "flank/example.h"
#include "flank/judge.h"

namespace flank::internal {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kSpacingMm = 8.0;
#else
constexpr double kSpacingMm = 1.5;
#endif

class ExampleJudged : public ::testing::TestWithParam<const char*> {};

TEST_P(ExampleJudged, TheTruthLeavesNothingAndCutsNothing) {
  const Example example = make_example(GetParam(), {.relative_accuracy = 1e-8});
  const ExampleTruth& truth = *example.truth;
  std::vector<FaceSamples> samples;
  for (const Face& face : example.faces) samples.push_back(sample_face(face, kSpacingMm, true));
  const double allowed_mm = truth.path_bound_mm + truth.face_error_mm + 1e-9;
  const VerifyReport report = judge(truth.tool, truth.path, samples, {.tolerance_mm = allowed_mm});
  EXPECT_LE(report.overcut_mm, allowed_mm);
  EXPECT_LE(report.undercut_mm, allowed_mm);
  EXPECT_EQ(report.coverage, 1.0);
  EXPECT_EQ(report.verdict, Verdict::kUnproved) << "samples so far apart prove nothing";
}

INSTANTIATE_TEST_SUITE_P(All, ExampleJudged,
                         ::testing::Values("envelope-barrel-2", "envelope-hyperbolic-3", "envelope-cone-1",
                                           "envelope-spline-2", "cavity-spline"));

TEST(DeformedEnvelope, TheBumpIsCutByTheTruth) {
  const Example example = make_example("deformed-envelope", {.relative_accuracy = 1e-7});
  const std::vector<FaceSamples> samples{sample_face(example.faces[0], 1.5, true)};
  const VerifyReport report = judge(example.truth->tool, example.truth->path, samples, {.tolerance_mm = 1e-3});
  EXPECT_NEAR(report.overcut_mm, 0.01 * example.diagonal_mm, 0.1 * 0.01 * example.diagonal_mm);
  EXPECT_LT(report.undercut_mm, 0.01);
}

}  // namespace
}  // namespace flank::internal

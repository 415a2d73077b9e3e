// The fit end to end on exact envelopes, whose truth is known.
#include "flank/fit.h"
#include "flank/fit/coverage.h"

#include <gtest/gtest.h>

#include "flank/example/example.h"
#include "flank/example/example_perturb.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

// Largest error, relative to the diagonal, on a grid three times denser than the fit's, footpoints cold.
constexpr double kExactError = 2e-6;

struct Scene {
  Example example;
  std::unique_ptr<Target> target;
  RuledMotion start;
};

Scene make_scene(const std::string& name, double off) {
  Scene scene{make_example(name), nullptr, {}};
  scene.target = make_target(std::vector<Face>{scene.example.faces.front()});
  Random random(7);
  scene.start = perturb(scene.example.truth->motions.front(), off, scene.example.diagonal_mm, random);
  return scene;
}

FlankFitOptions options_for(const Scene& scene) {
  FlankFitOptions options;
  options.tolerance_mm = 5e-5 * scene.example.diagonal_mm;
  options.bounds.smallest = 0.01 * scene.example.diagonal_mm;
  options.bounds.largest = 0.15 * scene.example.diagonal_mm;
  return options;
}

class ExactEnvelope : public ::testing::TestWithParam<const char*> {};

TEST_P(ExactEnvelope, IsFoundFromAStartThatIsOff) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; the model is tested there by itself";
  const Scene scene = make_scene(GetParam(), 1e-2);
  const FlankFitResult result = fit_from_starts({{scene.target.get(), scene.start}}, {}, options_for(scene), {});
  ASSERT_EQ(result.motions.size(), 1u);
  const ResidualSummary error = validate({{scene.target.get(), result.motions.front()}}, result.tool, 301, 91);
  EXPECT_LT(error.largest_mm / scene.example.diagonal_mm, kExactError);
  EXPECT_GT(error.inside_share, 0.9);
  EXPECT_GT(result.after.at_tolerance, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Envelopes, ExactEnvelope,
                         ::testing::Values("envelope-hyperbolic-1", "envelope-cone-1", "envelope-spline-2"));

// The last digits survive what is done against overcut.
TEST(FlankFit, AConeIsFoundOnAConeEnvelope) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; the model is tested there by itself";
  const Scene scene = make_scene("envelope-cone-3", 1e-2);
  ToolModel cone;
  cone.make = [&](double length, double) {
    Eigen::VectorXd parameters = scene.example.truth->tool.radial.parameters();
    parameters[0] *= 1.1;
    return RadialFunction(ToolFamily::kCone, length, parameters);
  };
  cone.free_parameters = {0, 1};
  const FlankFitResult result = fit_from_starts({{scene.target.get(), scene.start}}, cone, options_for(scene), {});
  const ResidualSummary error = validate({{scene.target.get(), result.motions.front()}}, result.tool, 301, 91);
  EXPECT_LT(error.largest_mm / scene.example.diagonal_mm, 2e-6);
}

TEST(FlankFit, AutomaticStartCoversAnExactEnvelope) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; the model is tested there by itself";
  const Scene scene = make_scene("envelope-hyperbolic-2", 0.0);
  const FlankFitResult result = fit_automatic(*scene.target, {}, options_for(scene), {});
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance) << result.message;
  EXPECT_GT(result.after.at_tolerance, 0.97);
}

}  // namespace
}  // namespace flank::internal

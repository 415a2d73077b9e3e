// The fit end to end on exact envelopes, whose truth is known.
#include "flank/fit.h"
#include "flank/fit/coverage.h"

#include <gtest/gtest.h>

#include "flank/base/tolerance_budget.h"
#include "flank/example.h"
#include "flank/example/example_envelope.h"
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

// Triangles lie as far off the envelope as a chord off its arc, and count as overcut; the motion is the envelope's all the same.
TEST(FlankFit, TheTrianglesOfAMeshCostAnExactFitNoDigits) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; the model is tested there by itself";
  const Example example = make_example("envelope-mesh");
  const RuledMotion& truth = example.truth->motions.front();
  const EnvelopeFace exact = envelope_face(truth, example.truth->tool.radial, 1e-8);
  const auto smooth = make_target(std::vector<Face>{exact.face});
  Scene scene{example, make_target(*example.mesh), {}};
  FlankFitOptions options = options_for(scene);
  options.tolerance_mm = 2.0 * scene.target->samples_off_mm();
  Random random(5);
  scene.start = perturb(truth, 1e-2, example.diagonal_mm, random);
  const FlankFitResult result = fit_from_starts({{scene.target.get(), scene.start}}, {}, options, {});
  ASSERT_EQ(result.motions.size(), 1u);
  const double error = validate({{smooth.get(), result.motions.front()}}, result.tool, 301, 91).largest_mm;
  EXPECT_GT(result.after.overcut_mm, kToleranceBudget.fit.exact_overcut * options.tolerance_mm) << "of the triangles";
  EXPECT_LT(result.after.overcut_mm, options.tolerance_mm);
  EXPECT_LT(error / example.diagonal_mm, kExactError);
}

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

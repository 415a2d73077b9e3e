#include "flank/pipeline/judge/judge_job.h"

#include <gtest/gtest.h>

#include "flank/setup/check_faces.h"
#include "flank/setup/target_reach.h"
#include "flank/setup/targets.h"
#include "rotor37_file.h"
#include "sanitized.h"
#include "shared_data.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

/// Samples of one target with their reachable shares, at each spacing; what holds the ball off is made ready once.
std::vector<FaceSamples> reach_of(const Part& part, int target, double radius, double tolerance,
                                  const std::vector<double>& spacings) {
  const Setup setup{part, {target}, faces_to_check(part, {target}, {}), tolerance, {}};
  std::vector<FaceSamples> found;
  for (const double spacing : spacings) found.push_back(target_samples(setup, spacing)[0]);
  const TargetReach reach(setup, {.radius_mm = radius}, {found[0]});
  for (FaceSamples& samples : found) reach.fill(target, samples);
  return found;
}

double share_of(const FaceSamples& face) {
  double part = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < face.points.size(); ++i) {
    part += face.areas[i] * face.reachable[i];
    whole += face.areas[i];
  }
  return part / whole;
}

/// The planner's footpoints on every other face say the same as the judge's triangles. What is held although its ball
/// touches nothing must lie below the hub's spline face.
void expect_as_footpoints(const Part& part, const FaceSamples& face, int own, double radius, double tolerance) {
  constexpr int kHub = 87;
  std::vector<std::unique_ptr<Target>> others;
  for (int k = 0; k < part.face_count(); ++k)
    if (k != own) others.push_back(make_target({part.faces[static_cast<std::size_t>(k)]}, +1));
  const std::unique_ptr<Target> hub = make_target({part.faces[kHub]}, +1);
  int free = 0, held = 0, buried = 0;
  for (std::size_t i = 0; i < face.points.size(); i += 7) {
    const Vec3 c = face.points[i] + radius * face.normals[i];
    double least = 1e300;
    for (const auto& other : others) least = std::min(least, (other->closest(c).point - c).norm());
    const double margin = least - (radius - tolerance);
    const Footpoint foot = hub->closest(c);
    const bool below = (c - foot.point).dot(foot.normal) < 0.0;
    if (face.reachable[i] == 1.0) {
      ++free;
      EXPECT_TRUE(margin > -0.006 && !below) << margin << " at " << face.points[i].transpose();
    } else if (face.reachable[i] == 0.0) {
      ++(margin < 0.006 ? held : buried);
      EXPECT_TRUE(margin < 0.006 || below) << margin << " at " << face.points[i].transpose();
    }
  }
  EXPECT_GT(std::min({free, held, buried}), 10) << free << ' ' << held << ' ' << buried;
}

TEST(JudgeJob, ASmallPartTakesAsManySamplesAsAHandsSize) {
  EXPECT_DOUBLE_EQ(default_spacing(5.0), 5.0 / 300.0);
  EXPECT_DOUBLE_EQ(default_spacing(100.0), 100.0 / 300.0);
  EXPECT_DOUBLE_EQ(default_spacing(300.0), 0.5);
  EXPECT_DOUBLE_EQ(default_spacing(2000.0), 2.0);
}

/// A target of these sides, and a plane of 400 x 300 mm below it.
Setup small_face_of_a_large_part(double width, double length) {
  Setup setup;
  setup.part.faces = {test::plane_face("F1", width, length), test::plane_face("F2", 400.0, 300.0, -20.0)};
  for (const Face& face : setup.part.faces)
    setup.part.box.add(face.surface.poles.back()), setup.part.box.add(face.surface.poles.front());
  setup.targets = {0};
  setup.checks = {1};
  return setup;
}

TEST(JudgeJob, AStoppedRunIsJudgedOnASmallFaceOfALargePart) {
  const auto setup = small_face_of_a_large_part(5.0, 10.0);
  const double spacing = coarse_spacing(setup, 20000.0);
  EXPECT_LT(spacing, default_spacing(setup.part.box.diagonal()));
  EXPECT_GE(50.0 / (spacing * spacing), 500.0) << "or the judge refuses it, and a result is lost";
}

TEST(JudgeJob, ASmallFaceOfALargePartIsLookedAtAsFinely) {
  const auto setup = small_face_of_a_large_part(2.0, 6.0);
  Tool tool;
  tool.radial = RadialFunction::spline(8.0, Eigen::VectorXd::Constant(6, 1.0));
  Strip pass;
  for (const double x : {-1.0, 0.0, 1.0, 2.0, 3.0}) pass.poses.push_back({Vec3(x, 1.0, -1.0), Vec3::UnitZ()});
  const VerifyReport report = judge_job(setup, {}, tool, {{pass}}, DepthProof::kProved);
  ASSERT_EQ(report.faces.size(), 2U);
  EXPECT_GT(report.faces[0].samples, 1500U);
  EXPECT_DOUBLE_EQ(report.coverage, 1.0);
  EXPECT_GT(report.coverage_bound.value(), 0.99);
}

TEST(JudgeJob, AStripTurnsBesideTheFaceThatItMachinesAndNotALargerOne) {
  auto setup = small_face_of_a_large_part(10.0, 20.0);
  setup.targets = {0, 1}, setup.checks = {};
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 2.0));
  // Round a quarter of a circle of 4 mm: in 1 % of the small face by a few degrees, in 1 % of the large one by 70.
  Strip strip{.id = 1, .kind = "flank", .face = "F1", .poses = {}};
  for (int k = 0; k <= 90; ++k) {
    const double angle = k * M_PI / 180.0;
    strip.poses.push_back({Vec3(4.0 * std::cos(angle), 4.0 * std::sin(angle), 2.0), Vec3::UnitZ()});
  }
  JudgeRequest request;
  request.sample_mm = 0.8;
  const auto turn_of = [&](const std::string& face) {
    strip.face = face;
    return judge_job(setup, request, tool, Path{{strip}}, DepthProof::kSampled).turn.value().angle_deg;
  };
  EXPECT_LT(turn_of("F1"), 5.0);
  EXPECT_GT(turn_of("F2"), 45.0);
  EXPECT_EQ(turn_of("F1,F2"), turn_of("F2"));
  setup.targets = {1}, setup.checks = {0};
  EXPECT_LT(turn_of("F1"), 5.0) << "copies of a wheel's blade are no targets";
  EXPECT_EQ(turn_of(""), turn_of("F2")) << "a path that names no face is no better off";
  EXPECT_EQ(turn_of("F7"), turn_of("F2")) << "nor one that names another face";
}

TEST(JudgeJob, ALargeFaceTakesNoMoreSamplesThanAreHeldAtOnce) {
  flank::internal::Setup setup;
  setup.part.faces = {test::plane_face("F1", 230.0, 210.0)};
  for (const Face& face : setup.part.faces)
    setup.part.box.add(face.surface.poles.back()), setup.part.box.add(face.surface.poles.front());
  setup.targets = {0};
  Tool tool;
  tool.radial = RadialFunction::spline(220.0, Eigen::VectorXd::Constant(6, 20.0));
  Strip pass;
  for (int k = -1; k < 12; ++k) pass.poses.push_back({Vec3(-10.0 + 20.0 * k, 20.0, -5.0), Vec3::UnitZ()});
  const auto samples = [&](std::optional<double> spacing) {
    JudgeRequest request;
    request.sample_mm = spacing;
    return judge_job(setup, request, tool, {{pass}}, DepthProof::kSampled).faces[0].samples;
  };
  EXPECT_LE(samples(std::nullopt), 65536U);
  EXPECT_GT(samples(std::nullopt), 50000U);
  EXPECT_GT(samples(0.5), 150000U) << "a spacing that is asked for is kept";
}

TEST(JudgeJob, AFaceAloneIsNotReachableInItsOwnCorner) {
  Part part;
  part.faces = {test::corner_face("F1", 20.0, 30.0)};
  part.faces[0].of_solid = true;
  part.solids = 1;
  EXPECT_NEAR(share_of(reach_of(part, 0, 5.0, 0.01, {0.1})[0]), 1.0 - (5.0 - 0.01) / 20.0, 0.005);
}

TEST(JudgeJob, ReachableShareOfAnImpellerBladeThatRunsOnInTheHub) {
  if (kSanitized) GTEST_SKIP() << "the same code as between two blades of one solid, on more faces";
  FLANK_REAL_PART(file, "kj66_impeller.step");
  const Part part = read_part(file);
  for (int target : {0, 2}) {
    const std::vector<FaceSamples> samples = reach_of(part, target, 1.5, 0.02, {1.0, 0.3});
    const FaceSamples &coarse = samples[0], &fine = samples[1];
    EXPECT_NEAR(share_of(coarse), share_of(fine), 1e-3);
    for (std::size_t i = 0; i < coarse.points.size(); ++i)
      EXPECT_TRUE(coarse.points[i].y() > 2.5 || coarse.reachable[i] == 0.0) << coarse.points[i].transpose();
    if (target == 0) expect_as_footpoints(part, coarse, target, 1.5, 0.02);
  }
}

TEST(JudgeJob, ReachableShareBetweenTwoBladesOfOneSolid) {
  const Part part = read_part(test::rotor37_file("rotor37-blisk"));
  for (int target : {8, 10}) {
    const std::vector<FaceSamples> samples = reach_of(part, target, 5.0, 0.1, {1.0, 0.4});
    const FaceSamples &coarse = samples[0], &fine = samples[1];
    EXPECT_NEAR(share_of(coarse), share_of(fine), 1e-3);
    EXPECT_GT(share_of(fine), 0.9) << "all but a strip along the hub";
    EXPECT_LT(share_of(fine), 0.97);
  }
}

}  // namespace
}  // namespace flank::internal

#include "flank/seed/direction/direction_filter.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "flank/example.h"
#include "seed/direction/direction_shapes.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

/// Footpoints of all samples of a target, as a seeding would ask for them.
std::vector<Footpoint> feet_of(const Target& target, double spacing_mm) {
  std::vector<Footpoint> feet;
  for (const SurfaceSample& sample : target.samples(spacing_mm)) {
    const Footpoint foot = target.closest(sample.point);
    if (foot.location == Location::kInside) feet.push_back(foot);
  }
  return feet;
}

std::unique_ptr<Target> example_side(const std::string& name) { return make_target(make_example(name).faces); }

/// Half of the largest minus the least d - r over the line: what the best shift along the normal leaves.
double shifted_error(const std::function<double(const Vec3&)>& distance, const RadialFunction& radial,
                     const Pose& axis) {
  double low = 1e9, high = -1e9;
  for (int j = 0; j <= 200; ++j) {
    const double s = radial.axis_length() * j / 200.0, e = distance(axis.at(s)) - radial.at(s).r;
    low = std::min(low, e);
    high = std::max(high, e);
  }
  return 0.5 * (high - low);
}

/// A cylinder and a cone beside a big ellipsoid: the error foretold is the error found, to the curvature's change over
/// the line.
TEST(DirectionFilter, ForetellsTheErrorOfAClampedLine) {
  const testing::Shape shape = testing::ellipsoid_shape(Vec3(50.0, 50.0, 4000.0));
  const Footpoint foot = testing::shape_foot(shape, 0.3, 0.0);
  for (const double slope : {0.0, 0.3}) {
    const RadialFunction radial(ToolFamily::kCone, 30.0, Eigen::Vector2d(9.0 - 15.0 * slope, std::asin(slope)));
    const CandidateDirections found = candidate_directions(foot, radial.at(15.0), {0.01, 30.0, 3.0});
    ASSERT_EQ(found.candidate, Candidate::kNear);
    ASSERT_EQ(found.count, 2);
    for (const Vec3& u : found.all()) {
      const Pose axis = contact_axis(foot, 9.0, 15.0, u);
      const double error =
          shifted_error([&](const Vec3& p) { return testing::shape_distance(shape, p, 0.3, 0.0); }, radial, axis);
      EXPECT_NEAR(error / found.error_mm, 1.0, 1e-3) << "slope " << slope;
      EXPECT_LT((axis.at(15.0) - foot.point - 9.0 * foot.normal).norm(), 1e-13);
    }
  }
}

TEST(DirectionFilter, RejectsAtSlackTimesTheTolerance) {
  Footpoint foot;
  foot.k1 = -0.02;
  foot.k2 = -1e-4;
  const RadialJet cylinder{5.0, 0.0, 0.0};
  const double error = 1e-4 / (1.0 + 5e-4) * 900.0 / 16.0;
  EXPECT_EQ(candidate_directions(foot, cylinder, {error / 2.99, 30.0, 3.0}).candidate, Candidate::kNear);
  const CandidateDirections rejected = candidate_directions(foot, cylinder, {error / 3.01, 30.0, 3.0});
  EXPECT_EQ(rejected.candidate, Candidate::kRejected);
  EXPECT_EQ(rejected.count, 0);
  EXPECT_NEAR(rejected.error_mm, error, 1e-15);
  EXPECT_EQ(candidate_directions(foot, {5.0, 1.0, 0.0}, {1.0, 30.0, 3.0}).candidate, Candidate::kRejected);
}

/// A cylinder in a groove of its own radius is the best fit that there is; a shade larger is within tolerance.
TEST(DirectionFilter, KeepsAGrooveOfTheToolsOwnRadius) {
  Footpoint groove;
  groove.k2 = 0.2;
  for (const double excess : {0.0, 0.02}) {
    const CandidateDirections found = candidate_directions(groove, {5.0 + excess, 0.0, 0.0}, {0.01, 30.0, 3.0});
    EXPECT_NE(found.candidate, Candidate::kRejected) << excess;
    EXPECT_NEAR(found.error_mm, excess, 1e-12);
    ASSERT_EQ(found.count, 2);
    EXPECT_LT((found.directions[0] - groove.d1).norm(), 1e-14);
  }
  EXPECT_EQ(candidate_directions(groove, {5.1, 0.0, 0.0}, {0.01, 30.0, 3.0}).candidate, Candidate::kRejected);
}

TEST(DirectionFilter, UmbilicsOfferEveryDirection) {
  Footpoint flat;
  const CandidateDirections exact = candidate_directions(flat, {5.0, 0.1, 0.0}, {0.01, 30.0, 3.0});
  EXPECT_EQ(exact.candidate, Candidate::kReal);
  EXPECT_TRUE(exact.every);
  EXPECT_EQ(exact.count, 4);
  EXPECT_EQ(candidate_directions(flat, {5.0, 0.1, -4e-4}, {0.01, 30.0, 3.0}).candidate, Candidate::kNear);
  EXPECT_EQ(candidate_directions(flat, {5.0, 0.1, -4e-2}, {0.01, 30.0, 3.0}).candidate, Candidate::kRejected);
}

/// On its own envelope no true pair is lost, by either test.
TEST(DirectionFilter, KeepsEveryPairOfAnExactEnvelope) {
  const testing::ExactTarget exact = testing::barrel_target();
  const DirectionFilterOptions options{1e-3, exact.tool.axis_length(), 3.0};
  int kept = 0, pairs = 0;
  for (int i = 1; i < 20; ++i) {
    for (int j = 1; j < 20; ++j) {
      const double s = exact.tool.axis_length() * j / 20.0;
      const Footpoint foot = exact.target->closest(exact.motion.pose(i / 20.0).at(s));
      kept += candidate_directions(foot, exact.tool.at(s), options).candidate != Candidate::kRejected;
      ++pairs;
    }
  }
  EXPECT_EQ(kept, pairs);
}

/// The count of paper B's figure 6: over all footpoints of a side and 30 spheres.
SearchSpace count(const std::string& side, const RadialFunction& radial, double tolerance_mm) {
  const std::unique_ptr<Target> target = example_side(side);
  DirectionFilterOptions options;
  options.tolerance_mm = tolerance_mm;
  const std::vector<Footpoint> feet = feet_of(*target, 3.0);
  const SearchSpace space = count_search_space(feet, radial, 30, options);
  EXPECT_EQ(space.pairs, 30 * static_cast<long>(feet.size()));
  EXPECT_EQ(space.real + space.near + space.rejected, space.pairs);
  return space;
}

TEST(DirectionFilter, KeepsAConeOnASlightlyEllipticSide) {
  const RadialFunction cone(ToolFamily::kCone, 40.0, Eigen::Vector2d(5.0, 0.06));
  const SearchSpace space = count("elliptic-side", cone, 0.01);
  EXPECT_EQ(space.removed_by_real_roots(), 1.0);
  EXPECT_EQ(space.removed_by_filter(), 0.0);
  EXPECT_EQ(count("elliptic-side", cone, 1e-3).removed_by_filter(), 1.0);
}

/// A barrel of arc 250 on the convex side of a blade: real roots leave a quarter, a tolerance of 0.05 mm most.
TEST(DirectionFilter, RemovesLessWhereTheToleranceIsWide) {
  const RadialFunction barrel(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(250.0, 5.0, 15.0));
  const SearchSpace wide = count("twisted-blade", barrel, 0.05), narrow = count("twisted-blade", barrel, 0.01);
  EXPECT_EQ(wide.real, narrow.real);
  EXPECT_NEAR(wide.removed_by_real_roots(), 0.75, 0.02);
  EXPECT_NEAR(wide.removed_by_filter(), 0.15, 0.02);
  EXPECT_NEAR(narrow.removed_by_filter(), 0.65, 0.02);
}

TEST(DirectionFilter, RemovesAToolOfTheWrongBend) {
  const RadialFunction barrel(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(85.0, 5.0, 15.0));
  const SearchSpace space = count("twisted-blade", barrel, 0.01);
  EXPECT_EQ(space.rejected, space.pairs);
  EXPECT_EQ(space.gouging, 0);
}

TEST(DirectionFilter, CountsSpheresThatAreTooLarge) {
  Footpoint groove;
  groove.k2 = 0.25;
  const RadialFunction cylinder(ToolFamily::kCylinder, 30.0, Eigen::VectorXd::Constant(1, 5.0));
  const SearchSpace space = count_search_space(std::vector<Footpoint>{groove}, cylinder, 7, {});
  EXPECT_EQ(space.pairs, 7);
  EXPECT_EQ(space.gouging, 7);
}

}  // namespace
}  // namespace flank::internal

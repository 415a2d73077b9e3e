#include "flank/correct/motion/aimed_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/correct/motion/path_motions.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/example.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.01;

/// An exact envelope: its tool leaves nothing of it.
class AimedMotion : public testing::Test {
 protected:
  void SetUp() override {
    const Example example = make_example("envelope-barrel-1", {.relative_accuracy = 1e-7});
    target_ = make_target(std::vector<Face>{example.faces.front()});
    problem_.target = target_.get();
    problem_.tool = example.truth->tool.radial;
    problem_.tolerance_mm = kTolerance;
    path_ = example.truth->path;
    problem_.motions = motions_through(path_, problem_.tool.axis_length(), 0.02 * kTolerance);
  }

  /// What motions leave at a point, mm.
  [[nodiscard]] double left(const std::vector<RuledMotion>& motions, const Vec3& p) const {
    const SweptEstimate swept(motions, problem_.tool, 400);
    return swept.refine(p, swept.nearest(p)).f;
  }

  /// Root mean square of what is left beyond what was asked for.
  [[nodiscard]] double off(const std::vector<RuledMotion>& motions) const {
    double squares = 0.0, count = 0.0;
    for (const SurfaceSample& sample : target_->samples(target_->diagonal() / 15.0)) {
      const double wanted = left(problem_.motions, sample.point) - problem_.less_mm(sample.point);
      squares += std::pow(left(motions, sample.point) - wanted, 2), count += 1.0;
    }
    return std::sqrt(squares / count);
  }

  std::unique_ptr<Target> target_;
  Path path_;
  AimProblem problem_;
};

TEST_F(AimedMotion, BeginsAtTheMotionOfThePath) {
  for (const SurfaceSample& sample : target_->samples(target_->diagonal() / 15.0))
    EXPECT_LT(std::abs(left(problem_.motions, sample.point)), 0.1 * kTolerance);
}

/// What a strip's last pose leaves at the border is the plan's doing. A motion that runs on cuts more there.
TEST_F(AimedMotion, EndsWhereTheStripEnds) {
  Path part = path_;
  std::vector<Pose>& poses = part.strips.front().poses;
  poses.resize(poses.size() * 2 / 3);
  const double length = problem_.tool.axis_length();
  const RuledMotion motion = motions_through(part, length, 0.02 * kTolerance).front();
  for (const auto& [pose, wanted] : {std::pair(motion.pose(0.0), poses.front()), {motion.pose(1.0), poses.back()}}) {
    EXPECT_LT((pose.tip - wanted.tip).norm(), 0.02 * kTolerance);
    EXPECT_LT((pose.at(length) - wanted.at(length)).norm(), 0.02 * kTolerance);
  }
}

TEST_F(AimedMotion, WithoutAnErrorTheMotionStays) {
  problem_.less_mm = [](const Vec3&) { return 0.0; };
  const AimedMotions aimed = aimed_motions(problem_);
  EXPECT_LT(off(aimed.motions), 0.01 * kTolerance);
  EXPECT_LT(aimed.rms_mm, 0.01 * kTolerance);
}

/// A shift and a turn of the part are errors that a motion can take away whole; the sum goes on both sides of the face.
TEST_F(AimedMotion, LeavesLessWhereTheMachineLeavesMore) {
  const Vec3 middle = target_->box().center(), shift(0.03, -0.02, 0.04), turn(0.001, 0.0005, -0.0007);
  problem_.less_mm = [&](const Vec3& p) { return target_->closest(p).normal.dot(shift + turn.cross(p - middle)); };
  const AimedMotions aimed = aimed_motions(problem_);
  EXPECT_GT(off(problem_.motions), 0.02);
  EXPECT_LT(off(aimed.motions), 0.0005);
}

TEST_F(AimedMotion, IsTheSameForOneAndThreeThreads) {
  problem_.less_mm = [&](const Vec3& p) { return 0.02 * std::sin(0.1 * p.x()); };
  set_thread_count(1);
  const AimedMotions one = aimed_motions(problem_);
  set_thread_count(3);
  const AimedMotions three = aimed_motions(problem_);
  set_thread_count(0);
  EXPECT_EQ(one.motions.front().tip.poles, three.motions.front().tip.poles);
  EXPECT_EQ(one.motions.front().direction.poles, three.motions.front().direction.poles);
}

}  // namespace
}  // namespace flank::internal

#include "flank/correct/motion/aimed_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
      const double wanted = left(problem_.motions, sample.point) - problem_.added_mm(sample.point, 0);
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
  problem_.added_mm = [](const Vec3&, std::size_t) { return 0.0; };
  const AimedMotions aimed = aimed_motions(problem_);
  EXPECT_LT(off(aimed.motions), 0.01 * kTolerance);
  EXPECT_LT(aimed.rms_mm, 0.01 * kTolerance);
}

/// A shift and a turn of the part are errors that a motion can take away whole; the sum goes on both sides of the face.
TEST_F(AimedMotion, LeavesLessWhereTheMachineLeavesMore) {
  const Vec3 middle = target_->box().center(), shift(0.03, -0.02, 0.04), turn(0.001, 0.0005, -0.0007);
  problem_.added_mm = [&](const Vec3& p, std::size_t) {
    return target_->closest(p).normal.dot(shift + turn.cross(p - middle));
  };
  const AimedMotions aimed = aimed_motions(problem_);
  EXPECT_GT(off(problem_.motions), 0.02);
  EXPECT_LT(off(aimed.motions), 0.0005);
}

/// On a machine that grows warm, the second of two passes that overlap is off by more. Neither may cut deeper where both touch.
TEST_F(AimedMotion, GivesEachOfTwoPassesItsOwnChange) {
  Path halves = path_;
  halves.strips.push_back(halves.strips.front());
  std::vector<Pose>&first = halves.strips.front().poses, &second = halves.strips.back().poses;
  first.resize(first.size() * 3 / 5);
  second.erase(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(second.size() * 2 / 5));
  problem_.motions = motions_through(halves, problem_.tool.axis_length(), 0.02 * kTolerance);
  const std::array<Vec3, 2> shifts = {Vec3(0.01, 0.0, -0.01), Vec3(0.03, -0.02, 0.04)};
  problem_.added_mm = [&](const Vec3& p, std::size_t pass) { return target_->closest(p).normal.dot(shifts[pass]); };
  const auto off = [&](const std::vector<RuledMotion>& motions, const Vec3& p) {
    const double of_first = left({motions[0]}, p) + problem_.added_mm(p, 0);
    return std::min(of_first, left({motions[1]}, p) + problem_.added_mm(p, 1)) - left(problem_.motions, p);
  };
  const AimedMotions aimed = aimed_motions(problem_);
  double before = 0.0, after = 0.0;
  for (const SurfaceSample& sample : target_->samples(target_->diagonal() / 15.0)) {
    before = std::max(before, std::abs(off(problem_.motions, sample.point)));
    after = std::max(after, std::abs(off(aimed.motions, sample.point)));
  }
  EXPECT_GT(before, 0.02);
  EXPECT_LT(after, 0.001);
}

TEST_F(AimedMotion, IsTheSameForOneAndThreeThreads) {
  problem_.added_mm = [&](const Vec3& p, std::size_t) { return 0.02 * std::sin(0.1 * p.x()); };
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

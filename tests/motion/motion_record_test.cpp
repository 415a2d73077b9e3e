// A motion of a finished step reads back as it was; rails that cannot be evaluated are refused.
#include "flank/motion/motion_record.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

RuledMotion sample() {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(k, std::sin(0.1 * k), 0.0), Vec3(0.01 * k, 0.0, 1.0).normalized()});
  }
  return fit_motion(poses, t, 12.0, 7);
}

StepValues written(RuledMotion motion) {
  StepCodec codec;
  code(codec, motion);
  EXPECT_TRUE(codec.writable());
  return codec.values();
}

RuledMotion read(const StepValues& values) {
  StepCodec codec(values);
  RuledMotion motion;
  code(codec, motion);
  codec.end();
  return motion;
}

TEST(MotionRecord, ReadsBackAsItWas) {
  const RuledMotion motion = sample(), back = read(written(motion));
  EXPECT_EQ(back.axis_length, motion.axis_length);
  EXPECT_EQ(back.tip.knots, motion.tip.knots);
  EXPECT_EQ(back.tip.poles, motion.tip.poles);
  EXPECT_EQ(back.direction.knots, motion.direction.knots);
  EXPECT_EQ(back.direction.poles, motion.direction.poles);
  EXPECT_EQ(read(written({})).tip.count(), 0) << "none is none";
}

TEST(MotionRecord, NoDamagedNumberMakesARailThatCannotBeEvaluated) {
  const StepValues good = written(sample());
  for (std::size_t k = 0; k < good.numbers.size(); ++k)
    for (const double bad : {-1.0, 0.5, 1e9, static_cast<double>(INFINITY), std::nan("")}) {
      StepValues values = good;
      values.numbers[k] = bad;
      try {
        const RuledMotion motion = read(values);
        for (const double t : {0.0, 0.3, 1.0}) (void)motion.pose(t);
        EXPECT_TRUE(std::isfinite(bad)) << k;
      } catch (const InputError&) {
        continue;
      }
    }
}

TEST(MotionRecord, RationalRailsAreNotWritable) {
  RuledMotion motion = sample();
  motion.tip.weights.assign(7, 1.0);
  StepCodec codec;
  code(codec, motion);
  EXPECT_FALSE(codec.writable());
}

}  // namespace
}  // namespace flank::internal

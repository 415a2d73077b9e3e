// The section of a screw: across all orbits, over the whole face, whose ends it knows.
#include "flank/seed/orbit_chart.h"

#include <gtest/gtest.h>

#include "seed/screw_sheet.h"

namespace flank::internal {
namespace {

struct Scene {
  std::unique_ptr<Target> target = testing::screw_target();
  SelfMotion motion = testing::screw_motion();
  OrbitSection section{*target, Chart(*target), motion};
};

TEST(OrbitSection, CrossesOrbitsAtRightAngles) {
  const Scene scene;
  constexpr double kStep = 0.2;
  for (double length = 1.0; length < scene.section.width() - 1.0; length += 1.5) {
    const Vec3 along = scene.section.at(length + kStep).point - scene.section.at(length - kStep).point;
    const Vec3 v = scene.motion.velocity(scene.section.at(length).point);
    EXPECT_NEAR(along.normalized().dot(v.normalized()), 0.0, 0.02) << length;
    EXPECT_NEAR(along.norm(), 2.0 * kStep, 0.01) << length;
  }
}

TEST(OrbitSection, KnowsWhereEveryPointOfTheTargetPassesIt) {
  const Scene scene;
  for (const SurfaceSample& sample : scene.target->samples(4.0)) {
    const OrbitSection::Crossing crossing = scene.section.crossing_of(sample.point);
    EXPECT_GE(crossing.length, -0.5);
    EXPECT_LE(crossing.length, scene.section.width() + 0.5);
    const Vec3 back = scene.motion.moved(sample.point, -crossing.time);
    EXPECT_NEAR((back - scene.section.at(crossing.length).point).norm(), 0.0, 0.3);
    const OrbitSection::Span span = scene.section.span_at(crossing.length);
    EXPECT_GE(crossing.time, span.first - 1e-9);
    EXPECT_LE(crossing.time, span.last + 1e-9);
  }
}

TEST(OrbitChart, ItsLinesGoWithTheMotion) {
  const Scene scene;
  const Chart chart = orbit_chart(scene.section);
  const OrbitSection::Span span = scene.section.span();
  for (const double b : {0.1, 0.5, 0.9}) {
    const ChartPoint first = chart.at(0.25, b), second = chart.at(0.5, b);
    const Vec3 moved = scene.motion.moved(first.point, 0.25 * (span.last - span.first));
    EXPECT_NEAR((second.point - moved).norm(), 0.0, 0.05);
    EXPECT_NEAR((scene.target->closest(chart.at(0.5, b).point).point - chart.at(0.5, b).point).norm(), 0.0, 0.1);
  }
}

}  // namespace
}  // namespace flank::internal

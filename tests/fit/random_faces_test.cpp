// Fits of random faces: sheared, twisted, bulged, in any unit, close to degenerate. Whatever comes in, a fit ends with
// numbers, a status that is true, and words. FLANK_RANDOM_FACES raises the number of faces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "flank/base/random.h"
#include "flank/fit.h"
#include "flank/target.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

int face_count() {
  const char* asked = std::getenv("FLANK_RANDOM_FACES");
  return asked != nullptr ? std::atoi(asked) : kSanitized ? 1 : 3;
}

/// A bicubic patch of 5 x 4 poles over a rectangle of any proportion, in units from a thousandth to a thousand.
Face random_face(Random& random) {
  const double unit = std::pow(10.0, random.uniform(-3.0, 3.0));
  const double length = 40.0 * std::pow(10.0, random.uniform(-1.0, 1.0)), height = 20.0;
  const double shear = random.uniform(-1.0, 1.0), twist = random.uniform(-1.2, 1.2), bulge = random.uniform(-0.3, 0.3);
  const double noise = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : 0.01 * height;
  const bool degenerate = random.uniform(0.0, 1.0) < 0.2;
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 3;
  s.knots_u = {0, 0, 0, 0, 0.5, 1, 1, 1, 1};
  s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
  s.count_u = 5;
  s.count_v = 4;
  for (int i = 0; i < 5; ++i) {
    const double u = i / 4.0, turn = twist * u;
    for (int j = 0; j < 4; ++j) {
      const double v = degenerate && i == 4 ? 1e-4 * j : j / 3.0, z = height * (v - 0.5);
      const Vec3 p(length * u + shear * z, z * std::sin(turn) + bulge * length * u * (1.0 - u), z * std::cos(turn));
      s.poles.push_back(unit * (p + noise * Vec3(random.normal(), random.normal(), random.normal())));
    }
  }
  return face;
}

/// Small: the point is what comes in, not how well it is fitted.
FlankFitOptions small_options(const Target& target) {
  FlankFitOptions options;
  options.tolerance_mm = 1e-3 * target.diagonal();
  options.bounds = {0.01 * target.diagonal(), 0.15 * target.diagonal(), 0.95, 8.0, 0.1};
  options.sample_share = 1.0 / 20.0;
  options.polished_candidates = 2;
  options.finalists = 1;
  return options;
}

TEST(RandomFaces, AFitEndsWithNumbersAndWords) {
  int within = 0;
  for (int k = 0; k < face_count(); ++k) {
    Random random(static_cast<std::uint64_t>(4711 + k));
    const auto target = make_target({random_face(random)}, random.uniform(0.0, 1.0) < 0.5 ? +1 : -1);
    const FlankFitResult result = fit_automatic(*target, {}, small_options(*target), {});
    EXPECT_NE(result.status, FitStatus::kNotRun) << k;
    EXPECT_FALSE(result.message.empty()) << k;
    if (result.motions.empty()) continue;
    EXPECT_TRUE(result.tool.parameters().allFinite()) << k;
    EXPECT_TRUE(result.motions.front().tip.poles.allFinite()) << k;
    EXPECT_GE(result.after.at_tolerance, 0.0) << k;
    EXPECT_LE(result.after.at_tolerance, 1.0) << k;
    EXPECT_TRUE(std::isfinite(result.after.overcut_mm)) << k;
    within += result.status == FitStatus::kWithinTolerance ? 1 : 0;
  }
  RecordProperty("within", within);
  std::cout << within << " of " << face_count() << " within the tolerance\n";
}

/// Everything is measured by the face and the tolerance: a face of a millimetre is fitted as one of a hundred is.
TEST(RandomFaces, AFaceIsFittedTheSameInAnySize) {
  if (kSanitized) GTEST_SKIP() << "two fits more on the path of the others";
  constexpr int kFaces = 2;
  constexpr double kSmaller = 1.0 / 64.0;  // a power of two, which rounds nothing
  for (int k = 0; k < kFaces; ++k) {
    Random random(static_cast<std::uint64_t>(815 + k));
    Face face = random_face(random);
    const double size = make_target({face}, +1)->diagonal();
    for (Vec3& pole : face.surface.poles) pole *= 64.0 / size;
    Face small = face;
    for (Vec3& pole : small.surface.poles) pole *= kSmaller;
    const auto fitted = [&](const Face& any) {
      const auto target = make_target({any}, +1);
      return fit_automatic(*target, {}, small_options(*target), {});
    };
    const FlankFitResult large = fitted(face), tiny = fitted(small);
    EXPECT_NEAR(tiny.after.at_tolerance, large.after.at_tolerance, 1e-3) << k;
    EXPECT_NEAR(tiny.tool.axis_length() / kSmaller, large.tool.axis_length(), 1e-2) << k;
    EXPECT_NEAR(tiny.tool.largest() / kSmaller, large.tool.largest(), 1e-2) << k;
  }
}

}  // namespace
}  // namespace flank::internal

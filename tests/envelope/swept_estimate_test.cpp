// The planner's swept distance: there is always a nearest place, whatever the radial function.
#include "flank/envelope/swept_estimate.h"

#include <gtest/gtest.h>

#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

TEST(SweptEstimate, FindsPlacesForARadialFunctionThatIsNoTool) {
  // A barrel on an axis that is too long for it: r < 0 at both ends.
  const std::vector<RuledMotion> motions{testing::straight_motion(80.0)};
  const RadialFunction radial = RadialFunction::spline(80.0, (Eigen::VectorXd(6) << -2, 1, 4, 4, 1, -2).finished());
  ASSERT_LT(radial.at(0.0).r, 0.0);
  const SweptEstimate swept(motions, radial, 60);
  std::vector<SweptContact> places;
  for (int k = 0; k <= 20; ++k) {
    const Vec3 x(3.0 * k, 6.0, 4.0 * k);
    swept.places(x, SweptContact{}, places);
    EXPECT_FALSE(places.empty()) << k;
    EXPECT_EQ(swept.nearest(x).motion, 0);
  }
}

}  // namespace
}  // namespace flank::internal

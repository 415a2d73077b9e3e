#include "flank/pipeline/reduce_radius.h"

#include <gtest/gtest.h>

#include "flank/tool_request/tool_model.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.01;

FitSearch found(const std::string& tool) {
  FitSearch search;
  search.tool = make_tool_model(parse_tool_spec(tool), {});
  search.fit.tool = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 4.0));
  search.options.bounds.smallest = 1.0;
  return search;
}

VerifyReport judged(double overcut_mm, double gouge_mm, double bound_mm) {
  VerifyReport report;
  report.overcut_mm = overcut_mm;
  report.gouge_mm = gouge_mm;
  report.overcut_bound_mm = std::max(overcut_mm, bound_mm);
  report.gouge_bound_mm = gouge_mm;
  return report;
}

double radius_after(FitSearch search, const VerifyReport& report, bool expected) {
  EXPECT_EQ(reduce_radius(kTolerance, search, report), expected);
  return search.fit.tool.at(7.0).r;
}

TEST(ThinTool, TakesOffWhatIsTooDeepAndALittleMore) {
  EXPECT_NEAR(radius_after(found("free"), judged(0.0107, 0.0, 0.0), true), 4.0 - 0.0107 + 0.0098, 1e-12);
  EXPECT_NEAR(radius_after(found("free"), judged(0.002, 0.0110, 0.0), true), 4.0 - 0.0110 + 0.0098, 1e-12);
  EXPECT_NEAR(radius_after(found("free"), judged(0.0107, 0.0, 0.6), true), 4.0 - 0.0107 + 0.0098, 1e-12)
      << "a bound beside a place that was found is only what nobody looked at";
  EXPECT_NEAR(radius_after(found("free"), judged(0.0099, 0.0, 0.0102), true), 4.0 - 0.0102 + 0.0098, 1e-12);
}

TEST(ThinTool, LeavesWhatIsWithinOrFarOffOrNotItsOwn) {
  EXPECT_EQ(radius_after(found("free"), judged(0.0099, 0.005, 0.01), false), 4.0);
  EXPECT_EQ(radius_after(found("free"), judged(0.013, 0.0, 0.0), false), 4.0);
  EXPECT_EQ(radius_after(found("cylinder:radius=4"), judged(0.0107, 0.0, 0.0), false), 4.0);
  FitSearch thin = found("free");
  thin.options.bounds.smallest = 4.0;
  EXPECT_EQ(radius_after(std::move(thin), judged(0.0107, 0.0, 0.0), false), 4.0) << "not thinner than it may be";
}

}  // namespace
}  // namespace flank::internal

// A radial function of a finished step reads back as it was, or is refused.
#include "flank/tool/radial_record.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

StepValues written(RadialFunction radial) {
  StepCodec codec;
  code(codec, radial);
  EXPECT_TRUE(codec.writable());
  return codec.values();
}

RadialFunction read(const StepValues& values) {
  StepCodec codec(values);
  RadialFunction radial;
  code(codec, radial);
  codec.end();
  return radial;
}

TEST(RadialRecord, ReadsBackAsItWas) {
  const RadialFunction barrel(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(100.0, 5.0, 10.0));
  const RadialFunction spline = RadialFunction::spline(17.0, Eigen::VectorXd::LinSpaced(6, 2.0, 3.0 + 1e-13));
  for (const RadialFunction& radial : {barrel, spline, RadialFunction()}) {
    const RadialFunction back = read(written(radial));
    EXPECT_EQ(back.family(), radial.family());
    EXPECT_EQ(back.axis_length(), radial.axis_length());
    EXPECT_EQ(back.parameters(), radial.parameters());
  }
}

TEST(RadialRecord, RefusesWhatIsNoFunction) {
  // Family, length, number of parameters, parameters.
  const StepValues good = written(RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(100.0, 5.0, 10.0)));
  const auto refused = [&](std::size_t k, double number) {
    StepValues bad = good;
    bad.numbers[k] = number;
    EXPECT_THROW((void)read(bad), InputError) << k << " " << number;
  };
  refused(0, 8.0);
  refused(0, 0.0);  // a cylinder has one parameter
  refused(1, 0.0);
  refused(1, -20.0);
  refused(1, INFINITY);
  refused(2, 2.0);
  refused(3, INFINITY);
  refused(4, std::nan(""));
}

}  // namespace
}  // namespace flank::internal

#include "flank/io/text/dxf_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/base/random.h"
#include "flank/error.h"
#include "io/dxf_reading.h"

namespace flank::internal {
namespace {

TEST(DxfText, CodesAreRightJustifiedAndValuesStandBelow) {
  DxfText out;
  out.add(0, "LINE").add(62, 7).add(1001, "ACAD").add(8, "");
  EXPECT_EQ(out.take(), "  0\nLINE\n 62\n7\n1001\nACAD\n  8\n\n");
}

TEST(DxfText, ATextIsNoNumber) {
  // A literal must not become a bool or a number on its way.
  DxfText out;
  const std::string name = "LAYER";
  out.add(2, name).add(2, "2.50").add(70, -3);
  EXPECT_EQ(out.take(), "  2\nLAYER\n  2\n2.50\n 70\n-3\n");
}

TEST(DxfText, NumbersHaveNoExponentAndReadBackTheSame) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double value = random.normal() * std::pow(10.0, random.uniform(-12.0, 12.0));
    DxfText out;
    out.add(40, value);
    const std::string text = out.take();
    EXPECT_EQ(text.find_first_of("eE"), std::string::npos) << text;
    EXPECT_NE(text.find('.'), std::string::npos) << text;
    EXPECT_EQ(std::stod(text.substr(4)), value);
  }
  DxfText whole;
  whole.add(40, 3.0).add(40, -0.25).add(40, 1e22).add(40, 0.0);
  EXPECT_EQ(whole.take(), " 40\n3.0\n 40\n-0.25\n 40\n10000000000000000000000.0\n 40\n0.0\n");
}

TEST(DxfText, APointIsThreeGroupsTenApart) {
  DxfText out;
  out.point(10, 1.5, -2.0).point(11, 0.25, 4.0);
  const auto groups = testing_io::dxf_groups(out.take());
  ASSERT_EQ(groups.size(), 6u);
  const int codes[] = {10, 20, 30, 11, 21, 31};
  const double values[] = {1.5, -2.0, 0.0, 0.25, 4.0, 0.0};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(groups[i].code, codes[i]);
    EXPECT_EQ(std::stod(groups[i].value), values[i]);
  }
}

TEST(DxfText, WhatIsNotFiniteIsNotWritten) {
  DxfText out;
  EXPECT_THROW(out.add(40, std::nan("")), InternalError);
  EXPECT_THROW(out.point(10, 0.0, std::numeric_limits<double>::infinity()), InternalError);
}

}  // namespace
}  // namespace flank::internal

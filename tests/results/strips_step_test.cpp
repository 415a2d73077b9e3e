#include "flank/results/strips_step.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_tools.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

class StripsStep : public ::testing::TestWithParam<int> {};

TEST_P(StripsStep, ReadsBackAsTheSameSurfaces) {
  const RadialFunction radial = example_tool("barrel").radial;
  const RuledMotion motion = example_motion(std::abs(GetParam()), radial.axis_length());
  const StripSurface made = strip_surface({7, motion, 0.125, 0.8, GetParam() > 0 ? +1 : -1}, radial, 0.01);
  const std::string text = strips_to_step({made, made}, radial.axis_length());
  EXPECT_EQ(text, strips_to_step({made, made}, radial.axis_length()));
  for (const char* name : {"'strip 7'", "'strip 7 axis'"}) EXPECT_NE(text.find(name), std::string::npos) << name;
  const auto file = std::filesystem::temp_directory_path() / ("flank_strips-" + std::to_string(::getpid()) + ".step");
  // Alone: coinciding sheets would be taken for one.
  write_file(file.string(), strips_to_step({made}, radial.axis_length()));
  const Part part = read_part(file.string());
  std::filesystem::remove(file);
  ASSERT_EQ(part.faces.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const BSplineSurface &before = k < 1 ? made.envelope : made.axis,
                         &after = part.faces[static_cast<std::size_t>(k)].surface;
    EXPECT_LT((before.value(0.3, 0.7) - after.value(0.3, 0.7)).norm(), 1e-9) << k;
    EXPECT_EQ(part.faces[static_cast<std::size_t>(k)].reversed, k < 1 && !made.towards_tool) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, StripsStep, ::testing::Values(1, -1, 2, -2, 3));

}  // namespace
}  // namespace flank::internal

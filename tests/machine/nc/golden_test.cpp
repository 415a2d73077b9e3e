// One short program a dialect, word by word. FLANK_UPDATE_GOLDEN=1 writes them anew; then read them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/machine/nc/dialects/write_nc.h"
#include "machine/nc/sample_programs.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class Golden : public ::testing::TestWithParam<NcCase> {};

TEST_P(Golden, IsWrittenWordByWord) {
  const fs::path file = fs::path(FLANK_SOURCE_DIR) / "tests/machine/nc/golden" / (GetParam().name + ".txt");
  const std::string text = write_nc(sample_program(GetParam()), GetParam().dialect);
  if (std::getenv("FLANK_UPDATE_GOLDEN") != nullptr) std::ofstream(file, std::ios::binary) << text;
  std::ifstream in(file, std::ios::binary);
  const std::string golden{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, golden);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40);
}

INSTANTIATE_TEST_SUITE_P(Dialects, Golden, ::testing::ValuesIn(nc_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace flank::internal

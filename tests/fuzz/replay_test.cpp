// The corpus of the fuzzers, and damage to it, without a fuzzer. What a fuzzer finds becomes a file of the corpus.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/targets.h"
#include "mutations.h"

namespace flank::fuzz {
namespace {

namespace fs = std::filesystem;

class Replay : public ::testing::TestWithParam<std::string> {};

TEST_P(Replay, TheCorpusAndDamageToItAreReadOrRefused) {
  const fs::path folder = fs::path(FLANK_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam();
  const Target target = targets().at(GetParam());
  EXPECT_NO_THROW(target(""));
  if (!fs::exists(folder)) GTEST_SKIP() << "no corpus";
  internal::Random random(7);
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NO_THROW(target(text)) << entry.path();
    for (int k = 0; k < internal::kMutants; ++k) {
      const std::string bad = internal::damaged(random, text);
      ASSERT_NO_THROW(target(bad)) << entry.path() << " damaged:\n" << bad;
    }
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, target] : targets()) all.push_back(name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Targets, Replay, ::testing::ValuesIn(names()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace flank::fuzz

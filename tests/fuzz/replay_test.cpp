// The corpus of the fuzzers, and damage to it, without a fuzzer. What a fuzzer finds becomes a file of the corpus.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "flank/io/isolated/part_bytes.h"
#include "fuzz/targets.h"
#include "io/isolated/small_part.h"
#include "mutations.h"

namespace flank::fuzz {
namespace {

namespace fs = std::filesystem;

class Replay : public ::testing::TestWithParam<std::string> {};

/// What a target reads well, by its name. Bytes of a part are no format and change with it: they are written here.
std::map<std::string, std::string> seeds(const std::string& target) {
  std::map<std::string, std::string> all;
  if (target == "part_bytes") all["a part"] = internal::encode_part(internal::small_part());
  const fs::path folder = fs::path(FLANK_SOURCE_DIR) / "tests/fuzz/corpus" / target;
  if (!fs::exists(folder)) return all;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    all[entry.path().string()] = std::string{std::istreambuf_iterator<char>(in), {}};
  }
  return all;
}

TEST_P(Replay, TheCorpusAndDamageToItAreReadOrRefused) {
  const Target target = targets().at(GetParam());
  EXPECT_NO_THROW(target(""));
  const std::map<std::string, std::string> all = seeds(GetParam());
  ASSERT_FALSE(all.empty()) << "no corpus";
  internal::Random random(7);
  for (const auto& [name, text] : all) {
    EXPECT_NO_THROW(target(text)) << name;
    for (int k = 0; k < internal::kMutants; ++k) {
      const std::string bad = internal::damaged(random, text);
      ASSERT_NO_THROW(target(bad)) << name << " damaged:\n" << bad;
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

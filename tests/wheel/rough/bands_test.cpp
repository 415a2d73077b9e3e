// Layers of all channels come in bands, the highest first.
#include "flank/wheel/rough/bands.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace flank::internal {
namespace {

/// Two channels, each from its highest layer down; the second one is lower, and has nothing in layer 2.
Path two_channels() {
  Path path;
  for (const auto& [face, layer] :
       {std::pair("F1", 5), {"F1", 4}, {"F1", 4}, {"F1", 3}, {"F1", 2}, {"F1", 1}, {"F2", 4}, {"F2", 3}, {"F2", 1}}) {
    path.strips.push_back({static_cast<int>(path.strips.size()) + 1, "rough", face, {}});
    path.strips.back().layer = layer;
  }
  return path;
}

std::string words(const Path& band) {
  std::string text;
  for (const Strip& strip : band.strips)
    text += std::to_string(strip.id) + strip.face + "/" + std::to_string(strip.layer) + " ";
  return text;
}

TEST(RoughBands, AreLayersOfAllChannels) {
  const std::vector<Path> bands = bands_of(two_channels(), 2);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(words(bands[0]), "1F1/1 2F1/2 3F1/2 4F2/2 ");
  EXPECT_EQ(words(bands[1]), "1F1/3 2F1/4 3F2/3 ");
  EXPECT_EQ(words(bands[2]), "1F1/5 2F2/5 ");
}

TEST(RoughBands, AllLayersAreOneWhereTheyMayBe) {
  const std::vector<Path> bands = bands_of(two_channels(), 1'000'000);
  ASSERT_EQ(bands.size(), 1U);
  EXPECT_EQ(bands.front().strips.size(), two_channels().strips.size());
  EXPECT_TRUE(bands_of({}, 2).empty());
}

}  // namespace
}  // namespace flank::internal

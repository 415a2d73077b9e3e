// Layers of all channels come in bands, the highest first.
#include "flank/wheel/rough/bands.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace flank::internal {
namespace {

/// Two channels, each from its highest layer down; the second one is lower, nothing is in the first layers, and nothing of the second in layer 6.
Path two_channels() {
  Path path;
  for (const auto& [face, layer] :
       {std::pair("F1", 3), {"F1", 4}, {"F1", 4}, {"F1", 5}, {"F1", 6}, {"F1", 7}, {"F2", 4}, {"F2", 5}, {"F2", 7}}) {
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
  ASSERT_EQ(bands.size(), 3U) << "layers 1 and 2 are empty";
  EXPECT_EQ(words(bands[0]), "1F1/3 ") << "below 0";
  EXPECT_EQ(words(bands[1]), "1F1/4 2F1/4 3F1/5 4F2/4 5F2/5 ");
  EXPECT_EQ(words(bands[2]), "1F1/6 2F1/7 3F2/7 ");
}

TEST(RoughBands, ABandEndsSoFarBelowTheLastLayerThatIsCut) {
  Path path = two_channels();
  // Nothing is in layer 5: the next band goes to layer 6, not to layer 7.
  std::erase_if(path.strips, [](const Strip& strip) { return strip.layer == 5; });
  const std::vector<Path> bands = bands_of(path, 2);
  ASSERT_EQ(bands.size(), 4U);
  EXPECT_EQ(words(bands[1]), "1F1/4 2F1/4 3F2/4 ");
  EXPECT_EQ(words(bands[2]), "1F1/6 ");
  EXPECT_EQ(words(bands[3]), "1F1/7 2F2/7 ");
}

TEST(RoughBands, AllLayersAreOneWhereTheyMayBe) {
  const std::vector<Path> bands = bands_of(two_channels(), 1'000'000);
  ASSERT_EQ(bands.size(), 1U);
  EXPECT_EQ(bands.front().strips.size(), two_channels().strips.size());
  EXPECT_TRUE(bands_of({}, 2).empty());
}

}  // namespace
}  // namespace flank::internal

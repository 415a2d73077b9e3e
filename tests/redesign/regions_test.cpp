#include "flank/redesign/regions.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

TEST(RedesignWeights, AreReadAsBordersWithFactors) {
  const std::vector<WeightRequest> all = parse_weights("le=10,root=0.2,F7=3");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].border, "le");
  EXPECT_EQ(all[0].factor, 10.0);
  EXPECT_EQ(all[2].border, "F7");
}

TEST(RedesignWeights, OfOtherWordsAreRefusedWithWhatIsExpected) {
  for (const char* text : {"", "le", "le=", "=3", "le=x", "le=10x", "le=0", "le=-1", "le=1e9", "le=nan"})
    EXPECT_THROW((void)parse_weights(text), UsageError) << text;
}

FaceBorders borders() {
  FaceBorders all;
  all.root.points = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}};
  all.leading.points = {{0.0, 0.0, 0.0}, {0.0, 10.0, 0.0}};
  all.leading.radius_mm = 1.0;
  all.trailing.radius_mm = 0.3;
  all.neighbours = {{"F2", all.leading.points}};
  return all;
}

TEST(RedesignWeights, CountAtTheirBorderAndFadeAwayFromIt) {
  const FaceWeights weights(parse_weights("root=0.2"), borders(), 10.0);
  EXPECT_NEAR(weights.at({10.0, 0.0, 0.0}), 0.2, 1e-12);
  EXPECT_NEAR(weights.at({10.0, 9.0, 0.0}), 1.0, 1e-12);
  const FaceWeights face(parse_weights("F2=10"), borders(), 10.0), edge(parse_weights("le=10"), borders(), 10.0);
  EXPECT_EQ(face.at({0.5, 10.0, 0.0}), edge.at({0.5, 10.0, 0.0}));
}

TEST(RedesignWeights, NameTheBordersThatThereAre) {
  try {
    const FaceWeights weights(parse_weights("F9=10"), borders(), 10.0);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("le, te, root, tip, F2"), std::string::npos) << error.what();
  }
  FaceBorders alike = borders();
  alike.edges_alike = true;
  EXPECT_THROW(FaceWeights(parse_weights("le=10"), alike, 10.0), UsageError);
}

}  // namespace
}  // namespace flank::internal

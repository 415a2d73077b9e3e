// Lines of material against a plain row of samples.
#include "flank/verify/stock/dexel_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace flank::internal::verify {
namespace {

constexpr int kPlaces = 200;  ///< the middles of so many steps of 1 mm

Box3 box_of_one_line() {
  Box3 box;
  box.add(Vec3::Zero());
  box.add(Vec3(kPlaces, 1.0, 1.0));
  return box;
}

/// What the quick looks know of a line agrees with its stretches.
void expect_ends_and_gap(const DexelField& field) {
  std::vector<DexelSpan> spans;
  field.visit(0, 0, [&](const DexelSpan& span) { spans.push_back(span); });
  const float low = field.lows(0)[0], high = field.highs(0)[0], gap_low = field.gap_lows(0)[0],
              gap_high = field.gap_highs(0)[0];
  EXPECT_EQ(field.is_whole(0, 0), spans.size() < 2);
  EXPECT_EQ(field.has_gaps(0), spans.size() > 1);
  if (spans.empty()) {
    EXPECT_GT(low, high);
    return;
  }
  EXPECT_EQ(low, spans.front().low);
  EXPECT_EQ(high, spans.back().high);
  float widest = 0.0F;
  for (std::size_t k = 1; k < spans.size(); ++k) widest = std::max(widest, spans[k].low - spans[k - 1].high);
  if (spans.size() > 1) {
    EXPECT_EQ(gap_high - gap_low, widest);
    EXPECT_FALSE(field.holds(0, 0, 0.5 * (gap_low + gap_high)));
  } else {
    EXPECT_EQ(gap_low, high);
    EXPECT_EQ(gap_high, low);
  }
}

TEST(DexelField, KeepsWhatIsNotTakenAway) {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> place(0, kPlaces), length(1, 12);
  for (int trial = 0; trial < 50; ++trial) {
    DexelField field(0, box_of_one_line(), 1.0);
    std::array<bool, kPlaces> there{};
    there.fill(true);
    for (int cut = 0; cut < 60; ++cut) {
      const int low = place(random), high = std::min(kPlaces, low + length(random));
      const auto from = there.begin() + low, to = there.begin() + high;
      const auto taken = static_cast<double>(std::count(from, to, true));
      std::fill(from, to, false);
      EXPECT_EQ(field.subtract(0, 0, low, high), taken);
      expect_ends_and_gap(field);
    }
    for (std::size_t k = 0; k < kPlaces; ++k) EXPECT_EQ(field.holds(0, 0, static_cast<double>(k) + 0.5), there[k]);
    EXPECT_EQ(field.subtract(0, 0, -1.0, kPlaces + 1.0),
              static_cast<double>(std::count(there.begin(), there.end(), true)));
    expect_ends_and_gap(field);
    EXPECT_FALSE(field.has_gaps(0));
  }
}

}  // namespace
}  // namespace flank::internal::verify

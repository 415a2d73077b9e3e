#include "flank/io/path/blank_json.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

TEST(BlankJson, ReadsBackWhatItWrote) {
  const std::vector<HalfSpace> blank{{Vec3::UnitX(), 1.0 / 3.0}, {Vec3(0.6, 0.0, -0.8), -7e-9}};
  const std::vector<HalfSpace> read = blank_from_json(blank_to_json(blank), "blank.json");
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(read[k].normal, blank[k].normal);
    EXPECT_EQ(read[k].offset, blank[k].offset);
  }
}

TEST(BlankJson, RefusesWithThePlace) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      (void)blank_from_json(text, "blank.json");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message(R"({"schema": "openflank/blank/1", "planes": [[1, 1, 0, 3]]})").find("planes[0]"),
            std::string::npos);
  EXPECT_NE(message(R"({"schema": "openflank/blank/1", "planes": [[1, 0, 0]]})").find("planes[0]"), std::string::npos);
  EXPECT_NE(message(R"({"schema": "openflank/path/1", "planes": []})").find("schema"), std::string::npos);
  EXPECT_NE(message(R"({"schema": "openflank/blank/1", "planes": [], "x": 1})").find("x"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal

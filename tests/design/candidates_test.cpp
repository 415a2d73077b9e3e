#include "flank/design/candidates.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

/// Faces 0, 2, 4 are equal, and 1, 3, 5; two tools, the first fitted to 0, the second to 0 and 1.
DesignResult two_tools() {
  DesignResult result;
  for (std::size_t f = 0; f < 6; ++f) {
    result.faces.push_back("F" + std::to_string(f));
    result.equal.push_back({static_cast<int>(f), f % 2, Eigen::Isometry3d::Identity()});
  }
  for (const std::vector<std::size_t>& fitted : {std::vector<std::size_t>{0}, {0, 1}}) {
    DesignTool tool;
    tool.fitted = fitted;
    result.tools.push_back(tool);
    for (std::size_t f = 0; f < 6; ++f) {
      DesignPair pair;
      pair.row.status = TaskStatus::kFallsShort;
      pair.other_faces_overcut_mm = 0.1 * static_cast<double>(f);
      result.pairs.push_back(pair);
    }
  }
  return result;
}

void finish(DesignResult& result, std::size_t tool, std::initializer_list<std::size_t> faces) {
  for (const std::size_t f : faces) result.pairs[tool * 6 + f].row.status = TaskStatus::kMeets;
}

TEST(RefitGroup, HoldsTheFacesThatTheBestToolEntersDeepestAt) {
  DesignResult result = two_tools();
  finish(result, 0, {0, 2});
  finish(result, 1, {0, 1, 3});
  EXPECT_EQ(refit_group(result), (std::vector<std::size_t>{4, 5}));
  finish(result, 1, {5});
  EXPECT_EQ(refit_group(result), (std::vector<std::size_t>{1, 4})) << "what is finished stays";
}

TEST(RefitGroup, IsEmptyWhereNothingWouldChange) {
  DesignResult result = two_tools();
  EXPECT_TRUE(refit_group(result).empty()) << "a tool that finishes nothing promises nothing";
  finish(result, 1, {0, 1, 2, 3, 4, 5});
  EXPECT_TRUE(refit_group(result).empty()) << "all are finished";
  result = two_tools();
  finish(result, 1, {0, 1, 2, 3});
  result.tools[0].fitted.clear();
  result.tools[1].fitted.clear();
  EXPECT_TRUE(refit_group(result).empty()) << "tools of a catalogue cannot be changed";
}

}  // namespace
}  // namespace flank::internal

// Files of which an edge goes astray between its ends: its curve in space is not where its curve in the surface's parameters is, and
// the kernel takes one here and the other there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class AstrayBorder : public ::testing::Test {
 protected:
  AstrayBorder() : file_(fs::path(::testing::TempDir()) / ("flank_border_" + std::to_string(::getpid()) + ".step")) {
    (void)write_example(make_example("twisted-blade"), file_.string());
    std::ifstream in(file_, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
  }
  ~AstrayBorder() override { fs::remove(file_); }

  [[nodiscard]] std::vector<std::string> notes_of(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    return read_part(file_.string()).repairs;
  }

  /// The text with the first coordinate of a point of space moved.
  [[nodiscard]] std::string moved(const std::string& point, double by) const {
    const std::regex place("\n#" + point + " = CARTESIAN_POINT\\('',\\(([-+.0-9Ee]+),(?=[^,]+,)");
    std::smatch found;
    if (!std::regex_search(text_, found, place)) throw std::logic_error("#" + point + " is no point of space");
    return found.prefix().str() + "\n#" + point + " = CARTESIAN_POINT('',(" + std::to_string(std::stod(found[1]) + by) +
           "," + found.suffix().str();
  }

  fs::path file_;
  std::string text_;
};

TEST_F(AstrayBorder, AControlPointOfAnEdgeThatIsElsewhereIsTold) {
  EXPECT_TRUE(notes_of(text_).empty());
  // The second and the third: what they move is near an end, between the places that a few steps along the edge would look at.
  const std::regex edge("B_SPLINE_CURVE_WITH_KNOTS\\('',3,\\(#\\d+,#(\\d+),#(\\d+),");
  int edges = 0;
  for (std::sregex_iterator it(text_.begin(), text_.end(), edge), end; it != end; ++it, ++edges) {
    for (const int k : {1, 2}) {
      const std::vector<std::string> notes = notes_of(moved((*it)[k], 5.0));
      ASSERT_FALSE(notes.empty()) << "#" << (*it)[k];
      EXPECT_NE(notes.front().find("the parts of its border are up to "), std::string::npos) << notes.front();
    }
  }
  EXPECT_EQ(edges, 4);
}

// No border follows it, so that nothing else of the file contradicts it.
TEST_F(AstrayBorder, AControlPointInsideASurfaceThatIsElsewhereIsTold) {
  const std::regex rows(
      "B_SPLINE_SURFACE_WITH_KNOTS[^#]*#\\d+(?:,#\\d+)*\\)\\s*,\\(#\\d+(?:,#\\d+)*\\)\\s*,\\(#\\d+,#\\d+,#\\d+,#(\\d+"
      ")");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(text_, found, rows));
  const std::vector<std::string> notes = notes_of(moved(found[1], 40.0));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes.front().find("control point 3, 4 of its surface is"), std::string::npos) << notes.front();
}

}  // namespace
}  // namespace flank::internal

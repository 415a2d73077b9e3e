// Files of which an edge goes astray between its ends: its curve in space is not where its curve in the surface's parameters is, and
// the kernel takes one here and the other there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
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
#include "shared_data.h"
#include "temporary_folder.h"

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
  EXPECT_NE(notes.front().find("control point 3, 4 of its surface lies "), std::string::npos) << notes.front();
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool says(const Part& part, const std::string& words) {
  return std::any_of(part.repairs.begin(), part.repairs.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

class AstrayEntry : public TemporaryFolder {
 protected:
  AstrayEntry() : TemporaryFolder("flank_astray") {}

  /// The part of a file with `before` changed to `after`, which is as long.
  [[nodiscard]] Part changed(const fs::path& sound, const std::string& before, const std::string& after) const {
    std::string text = content_of(sound);
    const std::size_t at = text.find(before);
    if (at == std::string::npos) throw std::logic_error(before + " is not in " + sound.string());
    const fs::path file = root_ / sound.filename();
    std::ofstream(file, std::ios::binary) << text.replace(at, before.size(), after);
    return read_part(file.string());
  }
};

// The kernel takes the curve in the surface's parameters, and nothing that it makes of it contradicts itself.
TEST_F(AstrayEntry, ACurveInParametersThatIsElsewhereIsTold) {
  FLANK_REAL_PART(blade, "zoo/asitus_blade.igs");
  const std::string parts = "parameters of its surface are up to 6.";
  EXPECT_FALSE(says(read_part(blade), parts));
  EXPECT_TRUE(says(changed(blade, "108.0080124,0.01176649239,", "108.0080124,15           ,"), parts));
}

// A curve that runs there and back on itself is nowhere off the other one.
TEST_F(AstrayEntry, ACurveInParametersThatRunsThereAndBackIsTold) {
  FLANK_REAL_PART(blade, "zoo/asitus_blade.igs");
  EXPECT_TRUE(
      says(changed(blade, "128.3715312,157.8285904,0.0,126.8316914,", "128.3715312,157.8285904,0.0,3          ,"),
           "or differ so much in length"));
}

TEST_F(AstrayEntry, AWeightThatIsElsewhereIsTold) {
  FLANK_REAL_PART(blade, "zoo/asitus_blade.igs");
  const std::string line = "P    485", weight = "the weight of control point";
  EXPECT_FALSE(says(read_part(blade), weight));
  const std::string text = content_of(blade), row = text.substr(text.find(line) - 72, 72 + line.size());
  std::string other = row;
  EXPECT_TRUE(says(changed(blade, row, other.replace(60, 4, "15 ,")), weight));
}

TEST_F(AstrayEntry, AWeightOfABorderThatIsElsewhereIsTold) {
  FLANK_REAL_PART(blade, "zoo/asitus_blade.igs");
  const std::string line = "P   1575", weight = "a weight of a border curve";
  EXPECT_FALSE(says(read_part(blade), weight));
  const std::string text = content_of(blade), row = text.substr(text.find(line) - 72, 72 + line.size());
  std::string other = row;
  EXPECT_TRUE(says(changed(blade, row, other.replace(8, 3, "406")), weight));
}

// The kernel takes the first of two vertices that begin an edge, and misses no end.
TEST_F(AstrayEntry, AVertexThatIsOfAnotherEdgeIsTold) {
  FLANK_REAL_PART(blade, "zoo/occt_bug26264_blade.brep");
  const std::string gap = "the parts of its border are up to ";
  EXPECT_FALSE(says(read_part(blade), gap));
  EXPECT_TRUE(says(changed(blade, "\n+7 0 -7 0 *", "\n+7 0 +9 0 *"), gap));
  EXPECT_TRUE(says(changed(blade, "\n+7 0 -7 0 *", "\n+7 0 +7 0 *"), gap)) << "it begins twice and does not end";
}

// A border that runs along one edge twice the same way leaves another one out.
TEST_F(AstrayEntry, AnEdgeThatIsThereTwiceIsTold) {
  FLANK_REAL_PART(blade, "zoo/occt_bug26264_blade.brep");
  for (const char* twice : {"-8 0 -6 0 -6 0 +4 0 *", "-8 0 -6 0 -8 0 +4 0 *"})
    EXPECT_TRUE(says(changed(blade, "-8 0 -6 0 +5 0 +4 0 *", twice), "the parts of its border are up to ")) << twice;
}

// The kernel makes no curve of knots that fall, and draws the border anew.
TEST_F(AstrayEntry, KnotsThatFallAreTold) {
  FLANK_REAL_PART(blade, "r37_blade.step");
  EXPECT_TRUE(read_part(blade).left_out.empty());
  const Part part =
      changed(blade, "(4,1,1,1,1,1,4),(0.,\n    0.242215360034,", "(4,1,1,1,1,1,4),(0.242215360034,\n    0.,");
  ASSERT_FALSE(part.left_out.empty());
  EXPECT_NE(part.left_out.begin()->second.find("its knots do not rise"), std::string::npos)
      << part.left_out.begin()->second;
}

// A curve in the surface's parameters that the kernel cannot make, here by a knot a hundred times there, is dropped without a word, and
// drawn anew from the curve in space.
TEST_F(AstrayEntry, ACurveInParametersThatCannotBeReadIsTold) {
  FLANK_REAL_PART(wing, "zoo/occt_bug25994_wing.brep");
  const std::string lost = "1 edge of its border has no curve on its surface";
  EXPECT_FALSE(says(read_part(wing), lost));
  EXPECT_TRUE(says(changed(wing, " 89.250150098260249 1 ", " 89.250150098260249 9 "), lost));
}

// A reference that names another shape of the file: what it named before belongs to nothing.
TEST_F(AstrayEntry, AShapeThatNothingRefersToIsTold) {
  FLANK_REAL_PART(wing, "zoo/occt_bug25994_wing.brep");
  const std::string unused = "the file also holds 3 faces, ";
  EXPECT_FALSE(says(read_part(wing), "belong to no shape"));
  EXPECT_TRUE(says(changed(wing, "1100000\n+2 1 *", "1100000\n-4 0 *"), unused));
}

// An arc that runs the other way round its circle: the border winds round the cone, and the kernel closes it over the apex.
TEST_F(AstrayEntry, AnArcThatRunsTheOtherWayIsTold) {
  FLANK_REAL_PART(pocket, "peer/draft_pocket_r6.step");
  const std::string edge = "EDGE_CURVE('',#353,#325,#355,";
  EXPECT_TRUE(read_part(pocket).left_out.empty());
  const Part part = changed(pocket, edge + ".T.", edge + ".F.");
  ASSERT_FALSE(part.left_out.empty());
  EXPECT_NE(part.left_out.begin()->second.find("does not close in the parameters of its surface"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal

// On which side of an open sheet the tool goes: where another sheet lies close behind it, as of a thin blade whose faces are
// loose, there is one side in the open, and no fit is needed to see it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "flank/run.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

/// A flat sheet of 40 x 30 mm at a height y, as facets; its corners are its own, so it is a face of its own.
void write_sheet(std::ofstream& file, double y) {
  const auto vertex = [&](double x, double z) { file << "vertex " << x << ' ' << y << ' ' << z << '\n'; };
  constexpr int kCells = 8;
  const auto x_at = [](int k) { return 40.0 * k / kCells; };
  const auto z_at = [](int k) { return 30.0 * k / kCells; };
  const auto facet = [&](int i, int j, bool upper) {
    file << "facet normal 0 1 0\nouter loop\n";
    vertex(x_at(i), z_at(j));
    if (upper) vertex(x_at(i), z_at(j + 1));
    vertex(x_at(i + 1), z_at(j + 1));
    if (!upper) vertex(x_at(i + 1), z_at(j));
    file << "endloop\nendfacet\n";
  };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (const bool upper : {false, true}) facet(i, j, upper);
}

std::string said_of_side(const Result& result) {
  const auto found = std::find_if(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.find("open sheet: side") != std::string::npos;
  });
  return found == result.notes.end() ? "nothing" : *found;
}

class SheetSideTest : public TemporaryFolder {
 protected:
  SheetSideTest() : TemporaryFolder("sheets") {}
};

TEST_F(SheetSideTest, IsTheOneInTheOpenWhereTheOtherIsHidden) {
  const std::string path = (root_ / "sheets.stl").string();
  {
    std::ofstream file(path);
    file << "solid sheets\n";
    write_sheet(file, 0.0);
    write_sheet(file, 2.0);
    file << "endsolid sheets\n";
  }
  for (const char* face : {"F1", "F2"}) {
    FitJob job;
    job.part.file = path;
    job.part.unit = "mm";
    job.part.faces = face;
    job.tolerance_mm = 0.02;
    job.radius.min_mm = 2.0;
    job.radius.max_mm = 4.0;
    const Result result = run_fit(job);
    EXPECT_TRUE(result.acceptance().pass()) << face;
    EXPECT_LE(result.verify.gouge_mm, 0.02) << face;
    EXPECT_NE(said_of_side(result).find("leave 100 % to be reached, of the other 0 %"), std::string::npos)
        << face << ": " << said_of_side(result);
  }
}

}  // namespace
}  // namespace flank::internal

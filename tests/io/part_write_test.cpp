// What is written reads back as the same faces.
#include <gtest/gtest.h>

#include <algorithm>

#include "flank/io/cad/write_step.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"
#include "rotor37_file.h"

namespace flank::internal {
namespace {

using testing_io::own_part;
using testing_io::Scratch;

/// STEP has fifteen digits, and a part has 250 mm.
constexpr double kRoundTripMm = 1e-9;

void expect_same_surface(const Face& a, const Face& b) {
  double error = 0.0;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      const double u = a.surface.u_first() + (a.surface.u_last() - a.surface.u_first()) * i / 10;
      const double v = a.surface.v_first() + (a.surface.v_last() - a.surface.v_first()) * j / 10;
      error = std::max(error, (a.surface.value(u, v) - b.surface.value(u, v)).norm());
    }
  }
  EXPECT_LT(error, kRoundTripMm) << a.id;
}

void expect_round_trip(const std::string& file) {
  const Scratch scratch;
  const Part before = read_part(file);
  write_step(scratch.path("again.step"), before.faces);
  const Part after = read_part(scratch.path("again.step"));
  EXPECT_EQ(after.unit, "mm");
  EXPECT_EQ(after.solids, 1) << "loose faces that close are a solid";
  ASSERT_EQ(after.faces.size(), before.faces.size());
  for (std::size_t i = 0; i < before.faces.size(); ++i) {
    const Face &a = before.faces[i], &b = after.faces[i];
    expect_same_surface(a, b);
    EXPECT_EQ(a.loops.size(), b.loops.size()) << a.id;
    EXPECT_EQ(a.reversed, b.reversed) << a.id;
    EXPECT_TRUE(b.of_solid) << a.id;
  }
}

TEST(WriteStep, Rotor37Blade) {
  const std::string file = test::rotor37_file("rotor37");
  expect_round_trip(file);
}

TEST(WriteStep, Rotor37BliskWithTrims) {
  const std::string file = test::rotor37_file("rotor37-blisk");
  expect_round_trip(file);
}

TEST(WriteStep, SameBytesEveryTime) {
  const Scratch scratch;
  const Part part = read_part(own_part("inside_out.brep"));
  write_step(scratch.path("a.step"), part.faces);
  const std::string first = read_bytes(scratch.path("a.step"));
  write_step(scratch.path("a.step"), part.faces);
  EXPECT_TRUE(first == read_bytes(scratch.path("a.step")));
}

TEST(WriteStep, RefusesAFolderThatIsNotThere) {
  const Part part = read_part(own_part("inside_out.brep"));
  EXPECT_THROW(write_step(own_part("no/such/a.step"), part.faces), InputError);
}

TEST(WriteMesh, RefusesOtherExtensions) {
  const Scratch scratch;
  EXPECT_THROW(write_mesh(scratch.path("a.step"), TriangleMesh()), UsageError);
  EXPECT_FALSE(testing_io::fs::exists(scratch.path("a.step")));
}

}  // namespace
}  // namespace flank::internal

// A part goes through bytes as it is; damaged bytes are refused, whatever they say.
#include "flank/io/isolated/part_bytes.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/io/cad/read_cad.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

Part small_part() {
  Part part;
  part.file = "a\xff.step", part.format = "STEP", part.unit = "in", part.millimetres_per_unit = 25.4;
  part.solids = 1;
  part.box.add(Vec3(0, 0, 0));
  part.box.add(Vec3(1, 2, 3));
  Face face;
  face.id = "F1", face.reversed = true, face.of_solid = true, face.solid = 0;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1, s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.poles = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1e-17}};
  s.weights = {1, 2, 3, 4};
  BSplineCurve2 edge;
  edge.degree = 1, edge.knots = {0, 0, 1, 1};
  edge.poles.resize(2, 2);
  edge.poles << 0, 1, 0, 0.1;
  face.loops.resize(1);
  face.loops[0].edges = {edge};
  part.faces = {face, Face{}};
  part.faces[1].id = "F2";
  part.surface_types = {"B-spline", "unknown"};
  part.left_out[1] = "why";
  part.repairs = {"sewn", ""};
  return part;
}

TEST(PartBytes, ReadBackAsTheyWere) {
  const std::string bytes = encode_part(small_part());
  const Part back = decode_part(bytes);
  EXPECT_EQ(encode_part(back), bytes);
  EXPECT_EQ(back.file, "a\xff.step");
  EXPECT_EQ(back.faces[0].surface.poles[3].z(), 1e-17);
  EXPECT_EQ(back.faces[0].loops[0].edges[0].poles(1, 1), 0.1);
  EXPECT_TRUE(back.is_left_out(1));
  EXPECT_EQ(back.repairs, small_part().repairs);
}

TEST(PartBytes, ARealPartReadsBack) {
  FLANK_REAL_PART(file, "r37_blade.step");
  const std::string bytes = encode_part(read_cad(file, "STEP", std::nullopt));
  EXPECT_EQ(encode_part(decode_part(bytes)), bytes);
}

TEST(PartBytes, DamagedOnesAreRefused) {
  const std::string whole = encode_part(small_part());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW((void)decode_part(whole.substr(0, size)), InternalError) << size;
  EXPECT_THROW((void)decode_part(whole + "x"), InternalError);
  Random random(11);
  for (int k = 0; k < 20000; ++k) {
    std::string bytes = whole;
    for (int flips = 0; flips <= k % 3; ++flips)
      bytes[static_cast<std::size_t>(random.uniform() * 0.9999 * static_cast<double>(bytes.size()))] =
          static_cast<char>(random.uniform() * 255.9);
    try {
      (void)decode_part(bytes);
    } catch (const InternalError&) {
    }
  }
}

}  // namespace
}  // namespace flank::internal

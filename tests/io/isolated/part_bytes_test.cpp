// A part goes through bytes as it is; damaged bytes are refused, whatever they say.
#include "flank/io/isolated/part_bytes.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/io/cad/read_cad.h"
#include "io/isolated/small_part.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

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
          static_cast<char>(static_cast<unsigned char>(random.uniform() * 255.9));
    try {
      (void)decode_part(bytes);
    } catch (const InternalError&) {
    }
  }
}

}  // namespace
}  // namespace flank::internal

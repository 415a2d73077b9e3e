// Files in one, read back by another program.
#include "flank/studio/zip.h"

#include <gtest/gtest.h>

#include <fstream>

#include "cli/process.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

TEST(Zip, HasTheChecksumOfTheStandard) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U) << "the check value of CRC-32";
  EXPECT_EQ(crc32(""), 0U);
}

class ZipFile : public TemporaryFolder {
 protected:
  ZipFile() : TemporaryFolder("studio_zip") {}
};

TEST_F(ZipFile, IsReadByAnotherProgram) {
  const std::string bytes("\0\xff zip", 6);
  const std::string file = (root_ / "all.zip").string();
  std::ofstream(file, std::ios::binary) << zip_of({{"a.txt", "first"}, {"größe.bin", bytes}, {"empty", ""}});
  const cli::Outcome listed = cli::run_program("/usr/bin/python3",
                                               {"-c",
                                                "import sys, zipfile\n"
                                                "z = zipfile.ZipFile(sys.argv[1])\n"
                                                "assert z.testzip() is None\n"
                                                "print([(i.filename, z.read(i)) for i in z.infolist()])\n",
                                                file},
                                               root_);
  EXPECT_EQ(listed.out, "[('a.txt', b'first'), ('größe.bin', b'\\x00\\xff zip'), ('empty', b'')]\n") << listed.err;
}

}  // namespace
}  // namespace flank::internal

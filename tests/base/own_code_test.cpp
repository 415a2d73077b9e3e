// Two builds of the program are told apart, and one is always the same.
#include "flank/base/own_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTellTo = "FLANK_OWN_CODE_TELL_TO";  ///< a file: the test writes there what it finds, and is over

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string bytes_of_hex(const std::string& hex) {
  std::string out;
  for (std::size_t k = 0; k + 1 < hex.size(); k += 2)
    out += static_cast<char>(std::stoi(hex.substr(k, 2), nullptr, 16));
  return out;
}

class OwnCode : public TemporaryFolder {
 protected:
  OwnCode() : TemporaryFolder("own_code") {}
};

TEST_F(OwnCode, IsInTheFileThatItNames) {
  EXPECT_TRUE(fs::is_regular_file(own_code_file()));
  EXPECT_GE(own_code_id().size(), 16U);  // digits: lld's id has 64 bits, that of the other linkers 160
  EXPECT_EQ(own_code_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST_F(OwnCode, ABuildThatDiffersHasAnotherId) {
  if (const char* file = std::getenv(kTellTo); file != nullptr) {
    std::ofstream(file) << own_code_id();
    return;
  }
  if (!fs::equivalent(own_code_file(), "/proc/self/exe")) GTEST_SKIP() << "the library is shared: " << own_code_file();
  const auto id_of = [&](const fs::path& program) {
    const fs::path told = root_ / "id.txt";
    const std::string command = std::string(kTellTo) + "=" + told.string() + " " + program.string() +
                                " --gtest_filter=OwnCode.ABuildThatDiffersHasAnotherId > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return bytes_of(told);
  };
  std::string bytes = bytes_of(own_code_file());
  const auto write = [&](const char* name) {
    const fs::path file = root_ / name;
    std::ofstream(file, std::ios::binary) << bytes;
    fs::permissions(file, fs::perms::owner_all);
    return file;
  };
  EXPECT_EQ(id_of(write("same")), own_code_id());
  // As a linker does that has linked something else: the id in the file is another one.
  const std::size_t at = bytes.find(bytes_of_hex(own_code_id()));
  ASSERT_NE(at, std::string::npos) << "no build id in the file";
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  EXPECT_NE(id_of(write("other")), own_code_id());
}

}  // namespace
}  // namespace flank::internal

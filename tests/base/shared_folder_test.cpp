// Where folders of data are looked for.
#include "flank/base/shared_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

SharedFolder wanted(const char* name, const char* installed) {
  return {.name = name,
          .variable = "FLANK_TEST_SHARED_FOLDER",
          .installed = installed,
          .content = "pages",
          .things = "library",
          .advice = "name it"};
}

TEST(SharedFolder, ABuildTreeHasItsOwn) {
  unsetenv("FLANK_TEST_SHARED_FOLDER");
  const std::string found = find_shared_folder(wanted("machines", "/nowhere"));
  EXPECT_TRUE(fs::exists(fs::path(found) / "linuxcnc-xyzac-trt.toml")) << found;
}

TEST(SharedFolder, TheEnvironmentGoesFirstAndMustBeRight) {
  const fs::path folder = fs::path(::testing::TempDir()) / "flank_shared_folder";
  fs::create_directories(folder);
  setenv("FLANK_TEST_SHARED_FOLDER", folder.c_str(), 1);
  EXPECT_EQ(find_shared_folder(wanted("machines", "/nowhere")), folder.string());
  setenv("FLANK_TEST_SHARED_FOLDER", "/nowhere", 1);
  EXPECT_THROW((void)find_shared_folder(wanted("machines", "/nowhere")), InputError);
  unsetenv("FLANK_TEST_SHARED_FOLDER");
  fs::remove_all(folder);
}

TEST(SharedFolder, WhereItWasInstalledGoesLast) {
  unsetenv("FLANK_TEST_SHARED_FOLDER");
  EXPECT_EQ(find_shared_folder(wanted("no-such-pages", "/tmp")), "/tmp");
  try {
    (void)find_shared_folder(wanted("no-such-pages", "/nowhere"));
    ADD_FAILURE() << "found";
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("no library: tried share/openflank/no-such-pages above /"), std::string::npos) << what;
    EXPECT_NE(what.find(", /nowhere; name it"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace flank::internal

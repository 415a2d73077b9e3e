#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/part.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

const ExampleOptions kQuick{.relative_accuracy = 1e-6, .mesh_vertices = 2000};

/// The STEP writer keeps 12 decimals of a knot in [0, 1]; a parameter off by that moves a point by |S_u| (about 100 mm)
/// times it.
constexpr double kStepDigitsMm = 1e-10;

std::string bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class WriteExample : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("flank_example_") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::filesystem::path folder_;
};

TEST_F(WriteExample, WritesTheFacesAndTheTruth) {
  const Example example = make_example("cavity-spline", kQuick);
  const std::vector<std::string> written = write_example(example, in("part.step"));
  EXPECT_EQ(written, (std::vector<std::string>{in("part.step"), in("part.truth.json"), in("part.tool.json"),
                                               in("part.path.json")}));
  const Part part = read_part(in("part.step"), std::nullopt);
  ASSERT_EQ(part.faces.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_FALSE(part.faces[k].reversed);
    for (const double u : {0.0, 0.31, 1.0})
      for (const double v : {0.0, 0.57, 1.0})
        EXPECT_LT((part.faces[k].surface.value(u, v) - example.faces[k].surface.value(u, v)).norm(), kStepDigitsMm);
  }
  const Tool tool = read_tool(in("part.tool.json"));
  EXPECT_EQ(tool.radial.parameters(), example.truth->tool.radial.parameters());
  const Path path = read_path(in("part.path.json"));
  ASSERT_EQ(path.strips.size(), 2u);
  EXPECT_EQ(path.strips[1].poses.size(), example.truth->path.strips[1].poses.size());
  const auto truth = nlohmann::json::parse(bytes(in("part.truth.json")));
  EXPECT_EQ(truth["schema"], "openflank/truth/1");
  EXPECT_EQ(truth["motions"].size(), 2u);
  EXPECT_EQ(truth["motions"][1]["tip"]["poles"][2][1].get<double>(), example.truth->motions[1].tip.poles(1, 2));
  EXPECT_EQ(truth["face_error"].get<double>(), example.truth->face_error_mm);
}

TEST_F(WriteExample, WritesTheSameBytesTwice) {
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(in(name));
    write_example(make_example("envelope-cone-3", kQuick), in(name + std::string("/part.step")));
    write_example(make_example("envelope-noisy", kQuick), in(name + std::string("/mesh.ply")));
  }
  for (const char* name : {"part.step", "part.truth.json", "part.tool.json", "part.path.json", "mesh.ply"})
    EXPECT_TRUE(bytes(in(std::string("a/") + name)) == bytes(in(std::string("b/") + name))) << name;
}

TEST_F(WriteExample, WritesMeshesInTheFormatOfTheirEnding) {
  const Example example = make_example("envelope-mesh", kQuick);
  for (const char* name : {"m.stl", "m.obj", "m.ply"}) {
    write_example(example, in(name));
    const Part part = read_part(in(name), "mm");
    EXPECT_EQ(part.mesh.triangles.size(), example.mesh->triangles.size()) << name;
  }
}

TEST_F(WriteExample, WritesNoTruthWhereNoneIsKnown) {
  EXPECT_EQ(write_example(make_example("twisted-blade"), in("blade.step")).size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(in("blade.truth.json")));
}

TEST_F(WriteExample, RefusesEndingsAndFoldersThatDoNotSuit) {
  EXPECT_THROW(write_example(make_example("twisted-blade"), in("blade.stl")), UsageError);
  EXPECT_THROW(write_example(make_example("envelope-mesh", kQuick), in("mesh.step")), UsageError);
  EXPECT_THROW(write_example(make_example("envelope-cone-1", kQuick), in("no/such/folder/a.step")), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace flank::internal

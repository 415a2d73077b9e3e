// Bad input is exit 3 with one line that names what is wrong and what would be accepted; nothing is left behind.
#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

const std::string kFacets =
    "solid s\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 10 0 0\n   vertex 0 10 0\n  endloop\n "
    "endfacet\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 10 0 0\n   vertex 10 10 0\n   vertex 0 10 0\n  endloop\n "
    "endfacet\nendsolid s\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST_F(Cli, ARefusedSideOfACavityNamesTheFaceThatIsAcross) {
  const std::string wheel = path("wheel.step");
  ASSERT_EQ(flank({"example", "impeller", "-o", wheel}).exit_code, 0);
  expect_refused({"trochoid", wheel, "--left", "F9", "--right", "F19", "-o", path("out")}, 3, "F11 lies opposite F9");
  // Back to back: opposite normals, and no cavity.
  expect_refused({"trochoid", wheel, "--left", "F7", "--right", "F9", "-o", path("out")}, 3, "lies behind");
}

TEST_F(Cli, TrochoidRefusesAToolThatIsThickerThanTheCavityIsWide) {
  const std::string cavity = path("cavity.step");
  ASSERT_EQ(flank({"example", "cavity", "-o", cavity}).exit_code, 0);
  expect_refused(
      {"trochoid", cavity, "--left", "F1", "--right", "F2", "--tool", "cylinder:radius=20", "-o", path("out")}, 3,
      "40 mm thick");
  expect_refused({"trochoid", cavity, "--left", "F1", "--right", "F2", "--radius-min", "15", "-o", path("out")}, 3,
                 "--radius-min: the tool is at least 30 mm thick");
}

TEST_F(Cli, RefusesFilesThatAreNoParts) {
  expect_refused({"inspect", path("missing.step")}, 3, "missing.step");
  write_file(root_ / "empty.step", "");
  expect_refused({"inspect", path("empty.step")}, 3, "empty");
  write_file(root_ / "prose.step", "This is not a part.\n");
  expect_refused({"inspect", path("prose.step")}, 3, "prose.step");
  write_file(root_ / "mesh.step", kFacets);
  expect_refused({"inspect", path("mesh.step")}, 3, "STL");
  write_file(root_ / "part.xyz", "1 2 3\n");
  expect_refused({"inspect", path("part.xyz")}, 3, "STEP");
  expect_refused({"inspect", root_.string()}, 3, "");
}

TEST_F(Cli, RefusesATruncatedStepFile) {
  const std::string whole = read_file(make_blade());
  write_file(root_ / "half.step", whole.substr(0, whole.size() / 2));
  expect_refused({"inspect", path("half.step")}, 3, "half.step");
  expect_refused({"fit", path("half.step"), "--face", "F1", "-o", path("out")}, 3, "half.step");
}

TEST_F(Cli, RefusesAMeshWithoutUnitAndShowsItsSizeInEach) {
  write_file(root_ / "plate.stl", kFacets);
  expect_refused({"inspect", path("plate.stl")}, 3, "--unit");
  const std::string message = flank({"inspect", path("plate.stl")}).err;
  for (const char* unit : {"mm", "cm", " m", "in"}) EXPECT_NE(message.find(unit), std::string::npos) << message;
  EXPECT_EQ(flank({"inspect", path("plate.stl"), "--unit", "mm"}).exit_code, 0);
}

TEST_F(Cli, RefusesDamagedMeshes) {
  write_file(root_ / "nan.stl", replaced(kFacets, "10 10 0", "10 nan 0"));
  expect_refused({"inspect", path("nan.stl"), "--unit", "mm"}, 3, "nan.stl");
  write_file(
      root_ / "flat.stl",
      "solid s\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 2 0 0\n  endloop\n"
      " endfacet\nendsolid s\n");
  expect_refused({"inspect", path("flat.stl"), "--unit", "mm"}, 3, "flat.stl");
  write_file(root_ / "cut.stl", kFacets.substr(0, 150));
  expect_refused({"inspect", path("cut.stl"), "--unit", "mm"}, 3, "cut.stl");
}

TEST_F(Cli, RefusesFacesThatAreNotThere) {
  const std::string blade = make_blade();
  for (const char* face : {"F99", "F0", "G1", "F1,F99", ""}) {
    SCOPED_TRACE(face);
    const Outcome outcome = flank({"fit", blade, "--face", face, "-o", path("out")});
    EXPECT_TRUE(outcome.exit_code == 2 || outcome.exit_code == 3) << outcome.exit_code;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("F1"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(root_ / "out/tool.json"));
  }
}

TEST_F(Cli, RefusesAnAxisLongerThanThePart) {
  const Outcome outcome = flank({"fit", make_blade(), "--face", "F1", "--axis-length", "1e6", "-o", path("out")});
  EXPECT_TRUE(outcome.exit_code == 2 || outcome.exit_code == 3) << outcome.exit_code;
  EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
}

// A path below a file: not even root can write there.
TEST_F(Cli, RefusesUnwritableOutput) {
  const std::string blade = make_blade();
  write_file(root_ / "file", "x");
  expect_refused({"fit", blade, "--face", "F1", "-o", path("file/out")}, 3, "file/out");
  expect_refused({"example", "twisted-blade", "-o", path("file/blade.step")}, 3, "file/blade.step");
  expect_refused({"tool", "cylinder", "--param", "diameter=8", "-o", path("file/tool.json")}, 3, "file/tool.json");
  EXPECT_EQ(read_file(root_ / "file"), "x");
}

TEST_F(Cli, RefusesBadToolFiles) {
  const std::string blade = make_blade();
  write_file(root_ / "broken.json", "{\"schema\": ");
  expect_refused({"fit", blade, "--face", "F1", "--tool", path("broken.json"), "-o", path("out")}, 3, "broken.json");
  write_file(root_ / "other.json", "{\"schema\": \"openflank/path/1\"}");
  expect_refused({"fit", blade, "--face", "F1", "--tool", path("other.json"), "-o", path("out")}, 3, "other.json");
  // The radius falls faster than the axis advances: no profile has these spheres.
  write_file(
      root_ / "steep.json",
      "{\"schema\":\"openflank/tool/1\",\"units\":\"mm\",\"axis_length\":10,\"samples\":[[0,30],[5,15],[10,1]]}");
  expect_refused({"fit", blade, "--face", "F1", "--tool", path("steep.json"), "-o", path("out")}, 3, "steep.json");
}

TEST_F(Cli, RefusesToVerifyAFolderWithoutArtefacts) {
  expect_refused({"verify", path("nowhere")}, 3, "nowhere");
  fs::create_directories(root_ / "bare");
  expect_refused({"verify", path("bare")}, 3, "bare");
}

TEST_F(Cli, RefusesATruncatedPart) {
  ASSERT_EQ(flank({"example", "rotor37", "-o", path("whole.step")}).exit_code, 0);
  const std::string whole = read_file(root_ / "whole.step");
  write_file(root_ / "truncated.step", whole.substr(0, whole.size() * 6 / 10));
  expect_refused({"inspect", path("truncated.step")}, 3, "truncated.step");
}

}  // namespace
}  // namespace flank::cli

// Nothing that a command reads is ever written: every output of every command against everything that is read, by every name that
// leads there.
#include <map>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// A folder as fit makes one, with a job that reads a file of every kind, and files that other commands read.
class CliKept : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (kSanitized)
      GTEST_SKIP() << "the command starts a hundred times; tests/base and tests/manifest do the same within one";
    ASSERT_EQ(flank({"example", "envelope-barrel-1", "-o", path("barrel.step")}).exit_code, 0);
    fs::copy_file(root_ / "barrel.step", root_ / "vice.step");
    fs::create_directories(root_ / "out");
    fs::copy_file(root_ / "barrel.tool.json", root_ / "out/tool.json");
    fs::copy_file(root_ / "barrel.path.json", root_ / "out/path.json");
    write_file(root_ / "holder.txt", "30 10\n70 10\n");
    write_file(root_ / "guide.txt", "0 0 0 0 0 10\n1 0 0 1 0 10\n");
    const fs::path machines = fs::path(FLANK_SOURCE_DIR) / "share/machines";
    fs::copy_file(machines / "linuxcnc-xyzac-trt.toml", root_ / "machine.toml");
    fs::create_directories(root_ / "tools");
    fs::copy_file(root_ / "barrel.tool.json", root_ / "tools/one.json");
    write_file(root_ / "plan.toml",
               "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"barrel.step\"\nfaces = [\"F1\"]\n"
               "tools = [\"tools/one.json\"]\n[options]\ntolerance_mm = 0.1\nfixtures = \"vice.step\"\n");
    const json job = {{"schema", "openflank/job/1"},    {"command", "cover"},
                      {"part", path("barrel.step")},    {"faces", "F1"},
                      {"tool", path("tools/one.json")}, {"fixtures", json::array({path("vice.step")})},
                      {"holder", path("holder.txt")},   {"tolerance", 0.1}};
    write_file(root_ / "out/job.json", job.dump());
    for (const char* name : {"verify.json", "view.json", "summary.json"})
      write_file(root_ / "out" / name,
                 R"({"schema": "openflank/)" + std::string(name).substr(0, std::string(name).find('.')) + R"(/1"})");
  }

  /// All files of the folder but what tests print into.
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(root_))
      if (entry.is_regular_file() && entry.path().parent_path() != root_ / "streams")
        all[entry.path().string()] = read_file(entry.path());
    return all;
  }

  /// Refused with 2 or 3 in one line that names the output, and every file is as it was.
  void expect_kept(const Words& words, const std::string& output) const {
    const auto before = files();
    std::string line;
    for (const std::string& word : words) line += word + " ";
    SCOPED_TRACE(line);
    const Outcome outcome = flank(words);
    EXPECT_TRUE(outcome.exit_code == 2 || outcome.exit_code == 3) << outcome.exit_code << outcome.err << outcome.out;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(output + ": "), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.find("would be overwritten") != std::string::npos ||
                outcome.err.find("is a file of the result") != std::string::npos ||
                outcome.err.find("is a link or no file") != std::string::npos)
        << outcome.err;
    EXPECT_TRUE(files() == before) << "a file was written";
  }

  /// Other names of a file: another spelling, a link, a link of a link through a linked folder, a hard link.
  [[nodiscard]] std::vector<std::string> names_of(const std::string& file) const {
    const fs::path other = root_ / "names" / fs::path(file).filename();
    fs::remove_all(root_ / "names");
    fs::create_directories(root_ / "names");
    fs::create_symlink(file, other.string() + ".link");
    fs::create_symlink(root_ / "names", root_ / "names/here");
    fs::create_hard_link(file, other.string() + ".hard");
    return {
        (fs::path(file).parent_path() / "../" / fs::path(file).parent_path().filename() / fs::path(file).filename()),
        other.string() + ".link", (root_ / "names/here" / other.filename()).string() + ".link",
        other.string() + ".hard"};
  }
};

/// The commands that write one file, with what they read beside the folder.
struct FileCommand {
  std::string name;
  Words words;            ///< without the output
  Words reads;            ///< beside what is common
  bool of_folder = true;  ///< reads out/, with all that its job names
};

TEST_F(CliKept, NoCommandThatWritesAFileWritesWhatItReads) {
  const Words common{"barrel.step",  "vice.step",     "holder.txt",   "tools/one.json",
                     "out/job.json", "out/tool.json", "out/path.json"};
  const std::vector<FileCommand> commands = {
      {"post",
       {"post", path("out"), "--machine", path("machine.toml"), "--spindle", "5000", "--feed", "500", "-o"},
       {"machine.toml"}},
      {"report", {"report", path("out"), "-o"}, {"out/verify.json", "out/view.json", "out/summary.json"}},
      {"view", {"view", path("out"), "-o"}, {}},
      {"png", {"report", path("out"), "-o", path("page.html"), "--png"}, {"out/verify.json"}},
      {"tool", {"tool", path("tools/one.json"), "-o"}, {"tools/one.json"}, false},
  };
  for (const FileCommand& command : commands) {
    Words reads = command.reads;
    if (command.of_folder) reads.insert(reads.end(), common.begin(), common.end());
    for (const std::string& read : reads) {
      Words words = command.words;
      words.push_back(path(read));
      expect_kept(words, words.back());
    }
    // By its other names, one of what each reads.
    for (const std::string& name : names_of(path(reads.front()))) {
      Words words = command.words;
      words.push_back(name);
      expect_kept(words, name);
    }
  }
}

/// The commands that write a folder: what they read stands under a name that they write, as a link or with the same bytes.
TEST_F(CliKept, NoCommandThatWritesAFolderWritesWhatItReads) {
  struct FolderCommand {
    Words words;
    std::map<std::string, std::string> reads;  ///< file, name in the folder that the command writes
  };
  const std::string part = path("barrel.step");
  const Words obstacles{"--fixture", path("vice.step"), "--holder", path("holder.txt"), "--tolerance", "0.1"};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::map<std::string, std::string> result{{"barrel.step", "tool.step"},
                                                  {"vice.step", "strips.step"},
                                                  {"holder.txt", "path.csv"},
                                                  {"tools/one.json", "view.json"}};
  auto fit = result, cover = result;
  fit["guide.txt"] = "path.cls";
  cover["tools/one.json"] = "summary.json";
  const std::vector<FolderCommand> commands = {
      {with({"fit", part, "--face", "F1", "--tool", path("tools/one.json"), "--guide", path("guide.txt")}, obstacles),
       fit},
      {with({"cover", part, "--face", "F1", "--tool", "catalogue", "--catalogue", path("tools")}, obstacles), cover},
      {with({"trochoid", part, "--left", "F1", "--right", "F2", "--tool", path("tools/one.json")}, obstacles), result},
      {{"sweep", path("plan.toml")},
       {{"plan.toml", "sweep.html"},
        {"barrel.step", "sweep.csv"},
        {"tools/one.json", "F1-1/tool.json"},
        {"vice.step", "F1-1.task.json"}}},
      {with({"design", part, "--faces", "F1", "--tools", "1"}, obstacles),
       {{"barrel.step", "design.json"}, {"vice.step", "design.csv"}, {"holder.txt", "design.html"}}},
      {{"bound", part, "--map", "--tool", path("tools/one.json")},
       {{"barrel.step", "map.json"}, {"tools/one.json", "map.html"}}},
      {{"bound", part, "--face", "F1", "--tool", path("tools/one.json")}, {{"barrel.step", "bound.txt"}}},
      {{"redesign", part, "--face", "F1", "--tool", path("tools/one.json")},
       {{"barrel.step", "redesigned.step"}, {"tools/one.json", "tool.json"}}},
      {{"correct", path("out"), "--profile", path("guide.txt")},
       {{"guide.txt", "guide.txt"}, {"out/path.json", "path.json"}, {"barrel.step", "correct.json"}}},
  };
  for (const FolderCommand& command : commands)
    for (const auto& [read, written] : command.reads)
      for (const bool hard : {false, true}) {
        const fs::path output = root_ / "new" / written;
        fs::remove_all(root_ / "new");
        fs::create_directories(output.parent_path());
        if (hard)
          fs::create_hard_link(root_ / read, output);
        else
          fs::create_symlink(root_ / read, output);
        expect_kept(with(command.words, {"-o", path("new")}), output.string());
        EXPECT_EQ(fs::is_symlink(output), !hard);
      }
}

TEST_F(CliKept, AVerdictIsNotWrittenOverThePartThatItIsAbout) {
  fs::remove(root_ / "out/view.json");
  for (const char* read : {"barrel.step", "vice.step"}) {
    fs::remove(root_ / "out/view.json");
    fs::create_hard_link(root_ / read, root_ / "out/view.json");
    expect_kept({"verify", path("out")}, path("out/view.json"));
  }
}

TEST_F(CliKept, FilesOfAResultAreNoOutputs) {
  // As if fit had made it.
  json manifest = {{"schema", "openflank/manifest/1"},
                   {"made_by", "fit"},
                   {"folder", path("out")},
                   {"part", {{"file", path("barrel.step")}, {"sha256", ""}}},
                   {"judged", {{"file", path("barrel.step")}, {"sha256", ""}}},
                   {"files", {{"tool.dxf", std::string(64, '0')}, {"path.json", std::string(64, '0')}}}};
  write_file(root_ / "out/manifest.json", manifest.dump());
  write_file(root_ / "out/tool.dxf", "0\n");
  fs::create_symlink("out/tool.dxf", root_ / "link.dxf");
  expect_kept({"tool", "cylinder:radius=3", "-o", path("out/tool.dxf")}, path("out/tool.dxf"));
  expect_kept({"tool", "cylinder:radius=3", "-o", path("link.dxf")}, path("link.dxf"));
  expect_kept({"example", "twisted-blade", "-o", path("out/manifest.json")}, path("out/manifest.json"));
}

TEST_F(CliKept, ThePictureIsNotThePage) {
  const Outcome outcome = flank({"report", path("out"), "-o", path("page"), "--png", path("out/../page")});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("--png"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(root_ / "page"));
}

TEST_F(CliKept, NamesOfAnyLengthThatTheFileSystemTakes) {
  for (const std::size_t length : {243u, 255u}) {
    const std::string name = std::string(length - 5, 'x') + ".json";
    EXPECT_EQ(flank({"tool", "cylinder:radius=3", "-o", path(name)}).exit_code, 0) << length;
    EXPECT_TRUE(fs::exists(root_ / name));
  }
}

TEST_F(CliKept, AStrangersFileIsNotReplacedInAFolderWithoutAManifest) {
  write_file(root_ / "d/tool.dxf", "a stranger's");
  const Outcome outcome = flank({"fit", path("barrel.step"), "--face", "F1", "--tolerance", "0.1", "-o", path("d")});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find(path("d/tool.dxf")), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("give another folder"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_file(root_ / "d/tool.dxf"), "a stranger's");
}

}  // namespace
}  // namespace flank::cli

// Help: 80 columns, the usual options first, every way to ask for it; and the nearest word for one that is not known.
#include "help.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "cli/cli_fixture.h"
#include "messages.h"

namespace flank::cli {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The first word of every line that is indented by two columns.
std::vector<std::string> entries_of(const std::string& help) {
  std::vector<std::string> entries;
  for (const std::string& line : lines_of(help))
    if (line.size() > 2 && line.starts_with("  ") && line[2] != ' ')
      entries.push_back(line.substr(2, line.find(' ', 2) - 2));
  return entries;
}

class Help : public Cli {
 protected:
  [[nodiscard]] std::string help(const std::vector<std::string>& words) const {
    const Outcome outcome = flank(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }
  /// Of the whole program's help: all that is not an option is a command.
  [[nodiscard]] std::vector<std::string> commands() const {
    std::vector<std::string> names = entries_of(help({"--help"}));
    std::erase_if(names, [](const std::string& name) { return name.starts_with('-'); });
    return names;
  }
};

TEST_F(Help, FitsATerminal) {
  const std::vector<std::string> names = commands();
  EXPECT_GE(names.size(), 18u);
  std::vector<std::vector<std::string>> asked{{"--help"}};
  for (const std::string& name : names) asked.insert(asked.end(), {{name, "--help"}, {name, "--help-all"}});
  for (const std::vector<std::string>& words : asked)
    for (const std::string& line : lines_of(help(words))) EXPECT_LE(line.size(), 80u) << words.front() << ": " << line;
}

TEST_F(Help, ShowsTheUsualOptionsFirstAndAllOfThemOnRequest) {
  for (const std::string& name : commands()) {
    const std::string few = help({name, "--help"}), all = help({name, "--help-all"});
    EXPECT_LT(few.size(), all.size()) << name;
    EXPECT_NE(few.find("flank " + name + " --help-all"), std::string::npos) << name;
    // What the short help shows, the long one shows, too.
    const std::vector<std::string> known = entries_of(all);
    for (const std::string& entry : entries_of(few))
      EXPECT_NE(std::find(known.begin(), known.end(), entry), known.end()) << name << " " << entry;
    EXPECT_EQ(few.find("--threads"), std::string::npos) << name;
    EXPECT_NE(all.find("--threads"), std::string::npos) << name;
  }
  const std::string fit = help({"fit", "--help"});
  EXPECT_LE(lines_of(fit).size(), 64u);
  for (const char* option : {"--tolerance", "--face", "--holder", "--shank-diameter", "--output"})
    EXPECT_NE(fit.find(option), std::string::npos) << option;
  EXPECT_EQ(fit.find("--reach-radius"), std::string::npos);
}

TEST_F(Help, ItsExamplesNameMaterialsThatThereAre) {
  std::ifstream rows(std::string(FLANK_SOURCE_DIR) + "/share/materials/materials.toml");
  std::string known(std::istreambuf_iterator<char>(rows), {}), option = "--material ";
  int found = 0;
  for (const std::string& name : commands()) {
    std::string text = help({name, "--help-all"});
    text.erase(0, std::min(text.find("Example"), text.size()));
    for (std::size_t at = text.find(option); at != std::string::npos; at = text.find(option, at + 1), ++found) {
      const std::size_t first = at + option.size();
      const std::string material = text.substr(first, text.find_first_of(" \n", first) - first);
      EXPECT_NE(known.find("name = \"" + material + "\""), std::string::npos) << name << " " << material;
    }
  }
  EXPECT_GT(found, 0);
}

TEST_F(Help, IsACommandToo) {
  EXPECT_EQ(help({"help"}), help({"--help"}));
  EXPECT_EQ(help({"help", "fit"}), help({"fit", "--help"}));
  EXPECT_EQ(help({"help", "fit", "--help-all"}), help({"fit", "--help-all"}));
  expect_refused({"help", "fitt"}, 2, "did you mean fit?");
}

TEST_F(Help, AWrongWordIsToldTheNearest) {
  expect_refused({"fitt"}, 2, "unknown command 'fitt'; did you mean fit? Commands: inspect, fit");
  expect_refused({"fit", "blade.step", "--tolernce", "0.1", "-o", path("out")}, 2,
                 "flank fit has no option --tolernce; did you mean --tolerance? (see flank fit --help)");
  expect_refused({"fit", "blade.step", "--strip=2", "-o", path("out")}, 2, "did you mean --strips?");
  expect_refused({"post", "out", "--no-such-option"}, 2,
                 "flank post has no option --no-such-option (see flank post --help)");
  expect_refused({"fit", "blade.step", "--tolernce", "0.1"}, 2, "did you mean --tolerance?");
  expect_refused({"inspect"}, 2, "PART is required (see flank inspect --help)");
  expect_refused({}, 2, "give a command (see flank --help)");
}

TEST_F(Help, ANumberWithAUnitIsRefusedWithTheUnit) {
  expect_refused({"fit", make_blade(), "--tolerance", "0.1mm", "-o", path("out")}, 2,
                 "--tolerance 0.1mm: expected a number of mm without a unit");
}

TEST(DidYouMean, NamesTheNearestWordOrNone) {
  const std::vector<std::string> known{"--tolerance", "--strips", "--tool", "--side"};
  EXPECT_EQ(did_you_mean("--tolernce", known), "; did you mean --tolerance?");
  EXPECT_EQ(did_you_mean("--toolerance", known), "; did you mean --tolerance?");
  EXPECT_EQ(did_you_mean("--stirps", known), "; did you mean --strips?");
  EXPECT_EQ(did_you_mean("--toler", known), "; did you mean --tolerance?");
  EXPECT_EQ(did_you_mean("--feedrate", known), "");
  EXPECT_EQ(did_you_mean("x", {"abc"}), "");
  EXPECT_EQ(did_you_mean("", {}), "");
}

TEST(HelpText, WrapsBetweenWords) {
  EXPECT_EQ(wrapped("one two three", 2, 0, 7), "one two\n  three");
  EXPECT_EQ(wrapped("one two", 4, 5, 8), "one\n    two");
  EXPECT_EQ(wrapped("averyverylongword b", 1, 0, 5), "averyverylongword\n b");
  EXPECT_EQ(wrapped("", 1), "");
  EXPECT_EQ(wrapped("a  b ", 1), "a b");
}

TEST(HelpText, AnExampleHasOneCommandALine) {
  EXPECT_EQ(footer_text("Example: flank a -o x && flank b x; flank c. The rest is told.\nAnother sentence."),
            "\nExample:\n  flank a -o x\n  flank b x\n  flank c\n\nThe rest is told.\n\nAnother sentence.\n");
  const std::string text = footer_text("Example: flank " + std::string(70, 'x') + " --option value");
  EXPECT_EQ(text, "\nExample:\n  flank " + std::string(70, 'x') + " \\\n      --option value\n");
}

}  // namespace
}  // namespace flank::cli

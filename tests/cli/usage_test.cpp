// Wrong usage is exit 2 with one line; help is exit 0.
#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

TEST_F(Cli, HelpNamesTheCommands) {
  const Outcome help = flank({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command :
       {"inspect", "example", "tool", "fit", "cover", "verify", "report", "view", "machine", "post"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    EXPECT_EQ(flank({command, "--help"}).exit_code, 0) << command;
  }
}

TEST_F(Cli, RefusesWrongUsage) {
  EXPECT_EQ(flank({}).exit_code, 2);
  expect_refused({"polish"}, 2, "polish");
  expect_refused({"inspect"}, 2, "");
  expect_refused({"inspect", "a.step", "--no-such-option"}, 2, "--no-such-option");
  expect_refused({"example", "no-such-part", "-o", path("x.step")}, 2, "twisted-blade");
  expect_refused({"tool", "no-such-family", "-o", path("x.json")}, 2, "barrel");
}

TEST_F(Cli, RefusesOptionsOutOfRange) {
  const std::string blade = make_blade();
  const std::vector<std::string> fit = {"fit", blade, "--face", "F1", "-o", path("out")};
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"--tolerance", "-0.01"}, {"--tolerance", "0"},      {"--tolerance", "nan"}, {"--tolerance", "thin"},
      {"--threads", "-1"},      {"--axis-length", "-5"},   {"--strips", "0"},      {"--strips", "many"},
      {"--tool", "spoon"},      {"--tool", "cone:edge=3"}, {"--start", "1,2,3"},   {"--unit", "furlong"}};
  for (const auto& [option, value] : wrong) {
    SCOPED_TRACE(option + " " + value);
    std::vector<std::string> arguments = fit;
    arguments.insert(arguments.end(), {option, value});
    expect_refused(arguments, 2, option);
  }
}

}  // namespace
}  // namespace flank::cli

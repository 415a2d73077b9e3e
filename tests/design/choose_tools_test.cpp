// The exact choice against all sets, and against Cbc where it is installed.
#include "flank/design/choose_tools.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/base/random.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Times of a random shop: each tool finishes a share of the faces.
SetProblem random_problem(Random& random, int tools, int faces, double share, double tool_minutes) {
  SetProblem problem{tools, faces, {}, tool_minutes};
  for (int k = 0; k < tools * faces; ++k)
    problem.minutes.push_back(random.uniform() < share ? 1.0 + 9.0 * random.uniform() : kNeverFinishes);
  return problem;
}

struct Value {
  int unfinished = 0;
  double minutes = 0.0;
};
Value value_of(const SetProblem& problem, const std::vector<int>& tools) {
  Value value{0, problem.tool_minutes * static_cast<double>(tools.size())};
  for (int f = 0; f < problem.faces; ++f) {
    double least = kNeverFinishes;
    for (const int t : tools) least = std::min(least, problem.at(t, f));
    if (std::isfinite(least))
      value.minutes += least;
    else
      ++value.unfinished;
  }
  return value;
}

/// The best of all sets of at most `most` tools.
Value best_of_all(const SetProblem& problem, int most) {
  Value best = value_of(problem, {});
  for (unsigned set = 1; set < 1u << problem.tools; ++set) {
    if (std::popcount(set) > most) continue;
    std::vector<int> tools;
    for (int t = 0; t < problem.tools; ++t)
      if (set >> t & 1u) tools.push_back(t);
    const Value now = value_of(problem, tools);
    if (now.unfinished < best.unfinished || (now.unfinished == best.unfinished && now.minutes < best.minutes))
      best = now;
  }
  return best;
}

void expect_sound(const SetProblem& problem, const ToolSet& set, int most) {
  EXPECT_LE(static_cast<int>(set.tools.size()), most);
  EXPECT_TRUE(std::is_sorted(set.tools.begin(), set.tools.end()));
  const Value value = value_of(problem, set.tools);
  EXPECT_EQ(set.unfinished, value.unfinished);
  EXPECT_NEAR(set.minutes, value.minutes, 1e-9);
  for (int f = 0; f < problem.faces; ++f)
    for (const int t : set.tools)
      if (const int chosen = set.tool_of_face[static_cast<std::size_t>(f)]; chosen >= 0) {
        EXPECT_LE(problem.at(chosen, f), problem.at(t, f));
      }
}

TEST(ChooseTools, IsTheBestOfAllSets) {
  Random random(5);
  for (int k = 0; k < 150; ++k) {
    const int tools = 1 + static_cast<int>(9.0 * random.uniform()),
              faces = 1 + static_cast<int>(12.0 * random.uniform());
    const SetProblem problem =
        random_problem(random, tools, faces, 0.2 + 0.8 * random.uniform(), k % 3 == 0 ? 3.0 * random.uniform() : 0.0);
    for (int most = 1; most <= tools; ++most) {
      const ToolSet set = choose_tools(problem, most);
      const Value best = best_of_all(problem, most);
      EXPECT_EQ(set.unfinished, best.unfinished) << k << " " << most;
      EXPECT_NEAR(set.minutes, best.minutes, 1e-7) << k << " " << most;
      expect_sound(problem, set, most);
    }
  }
}

TEST(ChooseTools, TheFewestAreAsFewAsPossible) {
  Random random(6);
  for (int k = 0; k < 60; ++k) {
    const SetProblem problem = random_problem(random, 8, 10, 0.35, 0.0);
    const ToolSet set = choose_fewest(problem);
    const int count = static_cast<int>(set.tools.size());
    EXPECT_EQ(set.unfinished, best_of_all(problem, problem.tools).unfinished);
    if (count > 1) {
      EXPECT_GT(best_of_all(problem, count - 1).unfinished, set.unfinished);
    }
    EXPECT_NEAR(set.minutes, best_of_all(problem, count).minutes, 1e-7);
  }
}

TEST(ChooseTools, AFaceThatNoToolFinishesIsToldAndTheOthersAreChosen) {
  const SetProblem problem{2, 3, {1.0, kNeverFinishes, 2.0, 2.0, kNeverFinishes, 1.5}, 0.0};
  const ToolSet one = choose_fewest(problem);
  EXPECT_EQ(one.unfinished, 1);
  EXPECT_EQ(one.tools, std::vector<int>{0});
  EXPECT_EQ(one.tool_of_face, (std::vector<int>{0, -1, 0}));
  const ToolSet two = choose_tools(problem, 2);
  EXPECT_EQ(two.tools, (std::vector<int>{0, 1}));
  EXPECT_NEAR(two.minutes, 2.5, 1e-12);
  // A tool costs more than it saves.
  SetProblem dear = problem;
  dear.tool_minutes = 1.0;
  EXPECT_EQ(choose_tools(dear, 2).tools, std::vector<int>{0});
}

TEST(ChooseTools, NothingToChooseFromAndNothingToFinish) {
  EXPECT_EQ(choose_fewest({0, 3, {}, 0.0}).unfinished, 3);
  EXPECT_TRUE(choose_fewest({2, 0, {}, 0.0}).tools.empty());
  EXPECT_THROW((void)choose_tools({1, 1, {-1.0}, 0.0}, 1), InternalError);
  EXPECT_THROW((void)choose_tools({1, 1, {std::nan("")}, 0.0}, 1), InternalError);
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The same problem for Cbc: y of a tool, x of a face by a tool, u of a face that is left.
void write_lp(const SetProblem& problem, int most, double penalty, const fs::path& file) {
  std::ofstream lp(file);
  lp.precision(17);
  // A name twice in one row is an error to Cbc.
  lp << "Minimize\n obj:";
  for (int t = 0; t < problem.tools; ++t) lp << " + " << problem.tool_minutes << " y" << t << "\n";
  for (int f = 0; f < problem.faces; ++f) {
    lp << " + " << penalty << " u" << f << "\n";
    for (int t = 0; t < problem.tools; ++t)
      if (std::isfinite(problem.at(t, f))) lp << " + " << problem.at(t, f) << " x" << t << "_" << f << "\n";
  }
  lp << "Subject To\n";
  for (int f = 0; f < problem.faces; ++f) {
    lp << " f" << f << ": u" << f;
    for (int t = 0; t < problem.tools; ++t)
      if (std::isfinite(problem.at(t, f))) lp << " + x" << t << "_" << f << "\n";
    lp << " = 1\n";
    for (int t = 0; t < problem.tools; ++t)
      if (std::isfinite(problem.at(t, f)))
        lp << " l" << t << "_" << f << ": x" << t << "_" << f << " - y" << t << " <= 0\n";
  }
  lp << " most:";
  for (int t = 0; t < problem.tools; ++t) lp << " + y" << t << "\n";
  lp << " <= " << most << "\nBinaries\n";
  for (int t = 0; t < problem.tools; ++t) lp << " y" << t << "\n";
  lp << "End\n";
}

TEST(ChooseTools, AgreesWithCbcOnTensOfToolsAndFaces) {
  if (std::system("command -v cbc > /dev/null 2>&1") != 0) GTEST_SKIP() << "Cbc is not installed (Debian: coinor-cbc)";
  const fs::path root = fs::path(::testing::TempDir()) / ("flank_cbc_" + std::to_string(::getpid()));
  fs::create_directories(root);
  Random random(8);
  constexpr double kPenalty = 1000.0;
  for (const auto& [tools, faces, most, share] :
       {std::tuple{20, 30, 3, 0.6}, {30, 30, 5, 0.3}, {40, 50, 6, 0.5}, {50, 20, 2, 0.9}, {30, 60, 30, 0.2}}) {
    const SetProblem problem = random_problem(random, tools, faces, share, most == 30 ? 2.0 : 0.0);
    const ToolSet set = choose_tools(problem, most);
    expect_sound(problem, set, most);
    write_lp(problem, most, kPenalty, root / "set.lp");
    const std::string command = "cbc '" + (root / "set.lp").string() + "' ratioGap 0 allowableGap 0 solve solution '" +
                                (root / "set.sol").string() + "' > '" + (root / "log").string() + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string text = text_of(root / "set.sol");
    const std::size_t value = text.find("objective value");
    ASSERT_TRUE(text.starts_with("Optimal") && value != std::string::npos) << text.substr(0, 80) << "\nCbc said:\n"
                                                                           << text_of(root / "log");
    const double objective = std::stod(text.substr(value + std::string("objective value").size()));
    EXPECT_NEAR(set.minutes + kPenalty * set.unfinished, objective, 1e-5) << tools << " " << faces << " " << most;
  }
  fs::remove_all(root);
}

}  // namespace
}  // namespace flank::internal

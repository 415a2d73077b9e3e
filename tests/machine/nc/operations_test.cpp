// Programs of several operations: each is read back as the program that it is, and begins from any state of the control.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "flank/error.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/nc/header_text.h"
#include "machine/nc/sample_programs.h"

namespace flank::internal {
namespace {

constexpr int kCount = 3;

/// The sample three times: another tool, another spindle, another place.
std::vector<NcProgram> sample_operations(const NcCase& c) {
  std::vector<NcProgram> all;
  for (int k = 0; k < kCount; ++k) {
    NcProgram p = sample_program(c);
    p.header.tool.number = 3 + k;
    p.header.tool.name = "TOOL " + std::string(1, static_cast<char>('A' + k));
    p.header.spindle_rpm = 5000.0 + 1000.0 * k;
    p.header.coolant = k == 0 ? "flood" : k == 1 ? "mist" : "";
    p.header.operation = NcOperation{k + 1, kCount, 1, 1, "PASS " + std::string(1, static_cast<char>('A' + k))};
    for (NcMove& m : p.moves) m.position += Vec3(0.0, 7.0 * k, 0.0);
    all.push_back(p);
  }
  return all;
}

std::string written(const NcCase& c) {
  const std::vector<NcProgram> operations = sample_operations(c);
  return write_nc(std::span(operations), c.dialect);
}

class Operations : public ::testing::TestWithParam<NcCase> {};

TEST_P(Operations, AreReadBackEachAsItsOwnProgram) {
  const NcCase& c = GetParam();
  const std::vector<NcProgram> want = sample_operations(c);
  const std::vector<NcProgram> read = read_nc_operations(written(c), "f", c.dialect);
  ASSERT_EQ(read.size(), want.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    const NcProgram alone = printed(want[k], c.dialect);
    EXPECT_EQ(read[k].header.operation, want[k].header.operation);
    EXPECT_EQ(read[k].header.program, want[k].header.program);
    EXPECT_EQ(read[k].header.tool.number, want[k].header.tool.number);
    EXPECT_EQ(read[k].header.tool.name, want[k].header.tool.name);
    EXPECT_EQ(read[k].header.spindle_rpm, want[k].header.spindle_rpm);
    EXPECT_EQ(read[k].header.stated.contradiction, "");
    ASSERT_EQ(read[k].moves.size(), alone.moves.size());
    for (std::size_t i = 0; i < alone.moves.size(); ++i) {
      EXPECT_LT((read[k].moves[i].position - alone.moves[i].position).norm(), 1e-10);
      EXPECT_LT((read[k].moves[i].orientation - alone.moves[i].orientation).norm(), 1e-10);
      const NcModes& modes = read[k].modes[static_cast<std::size_t>(read[k].moves[i].modes)];
      EXPECT_TRUE(modes.spindle);
      if (modes.tool_name.empty()) {
        EXPECT_EQ(modes.tool, want[k].header.tool.number);
      }
    }
    // An operation begins where nothing is known: not by a way from the one before.
    EXPECT_FALSE(read[k].moves.front().joined);
  }
}

TEST_P(Operations, AreRefusedWhereAProgramOfOneIsExpected) {
  EXPECT_THROW((void)read_nc(written(GetParam()), "f", GetParam().dialect), InputError);
}

/// The text without the lines from the comment of operation `first` to that of operation `last`.
std::string without(const std::string& text, int first, int last) {
  const auto place = [&](int k) { return text.rfind('\n', text.find("OPERATION " + std::to_string(k) + " OF")) + 1; };
  return text.substr(0, place(first)) + text.substr(place(last));
}

TEST_P(Operations, OneThatIsMissingIsNotOverlooked) {
  const std::string text = written(GetParam());
  for (const std::string& cut : {without(text, 1, 2), without(text, 2, 3)})
    EXPECT_THROW((void)read_nc_operations(cut, "f", GetParam().dialect), InputError);
}

/// A program of the one operation k alone, entered there: the lines that open the program, those of the operation, and its end.
std::string entered(const NcCase& c, int k) {
  std::string text = written(c);
  const auto place = [&](int n) { return text.rfind('\n', text.find("OPERATION " + std::to_string(n) + " OF")) + 1; };
  const std::size_t begin = place(1), own = place(k);
  const std::size_t end = k < kCount ? place(k + 1) : std::string::npos;
  std::string tail;
  if (k < kCount) {
    std::vector<NcProgram> last = sample_operations(c);
    const std::string all = written(c);
    // What ends the program stands behind the last operation's own words: the same two or three lines everywhere.
    static const std::vector<std::string> kEnds{"FINI\n", "M30\n", "M2\n", "%\n"};
    std::istringstream lines(all.substr(place(kCount)));
    for (std::string line; std::getline(lines, line);)
      for (const std::string& word : kEnds)
        if ((line + "\n").ends_with(word) || line.find("END PGM") != std::string::npos) {
          tail += line + "\n";
          break;
        }
  }
  std::string alone = text.substr(0, begin) + text.substr(own, end == std::string::npos ? end : end - own) + tail;
  const std::string count = "OPERATION " + std::to_string(k) + " OF " + std::to_string(kCount);
  return alone.replace(alone.find(count), count.size(), "OPERATION 1 OF 1");
}

TEST_P(Operations, CanBeEnteredByThemselves) {
  const NcCase& c = GetParam();
  const std::vector<NcProgram> all = read_nc_operations(written(c), "f", c.dialect);
  for (int k = 1; k <= kCount; ++k) {
    const NcProgram alone = read_nc(entered(c, k), "f", c.dialect);
    const NcProgram& want = all[static_cast<std::size_t>(k) - 1];
    ASSERT_EQ(alone.moves.size(), want.moves.size()) << k;
    EXPECT_EQ(alone.header.tool.number, want.header.tool.number);
    for (std::size_t i = 0; i < want.moves.size(); ++i) {
      EXPECT_EQ(alone.moves[i].position, want.moves[i].position) << k;
      EXPECT_EQ(alone.moves[i].feed, want.moves[i].feed) << k;
      EXPECT_EQ(alone.modes[static_cast<std::size_t>(alone.moves[i].modes)],
                want.modes[static_cast<std::size_t>(want.moves[i].modes)]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Dialects, Operations, ::testing::ValuesIn(nc_cases()),
                         [](const ::testing::TestParamInfo<NcCase>& one) { return one.param.name; });

NcCase fanuc() { return nc_cases()[3]; }

/// The modes with which the second operation cuts, after its text was changed.
NcModes second_modes(const std::function<void(std::string&)>& spoil) {
  const NcCase c = fanuc();
  std::string text = written(c);
  const std::size_t at = text.find("OPERATION 2 OF"), end = text.find("OPERATION 3 OF");
  std::string own = text.substr(at, end - at);
  spoil(own);
  text = text.substr(0, at) + own + text.substr(end);
  const NcProgram second = read_nc_operations(text, "f", c.dialect).at(1);
  return second.modes[static_cast<std::size_t>(second.moves.back().modes)];
}

void erase_block(std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  ASSERT_NE(at, std::string::npos) << words << " is not in\n" << text;
  text.erase(at, text.find('\n', at) + 1 - at);
}

TEST(OperationsOfAProgram, KeepNothingOfTheToolBefore) {
  EXPECT_EQ(second_modes([](std::string&) {}).tool, 4);
  EXPECT_EQ(second_modes([](std::string& t) { erase_block(t, "T4 M6"); }).tool, std::nullopt);
  EXPECT_EQ(second_modes([](std::string& t) { erase_block(t, "G54"); }).work_offset, std::nullopt);
  EXPECT_FALSE(second_modes([](std::string& t) { erase_block(t, "S6000 M3"); }).spindle);
  EXPECT_THROW((void)second_modes([](std::string& t) { erase_block(t, "G43.4 H4"); }), InputError);
}

TEST(OperationsOfAProgram, HaveANumberToEnterTheProgramAt) {
  const std::string text = written(fanuc());
  for (int k = 1; k <= kCount; ++k)
    EXPECT_NE(text.find("\nN" + std::to_string(k) + " G21 G17 G90"), std::string::npos) << text.substr(0, 800);
}

TEST(OperationsOfAProgram, HaveNumbersThatNoOtherBlockHas) {
  NcCase c = fanuc();
  c.dialect.line_numbers = true;
  std::istringstream lines(written(c));
  std::vector<int> seen;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('N')) seen.push_back(std::stoi(line.substr(1)));
  EXPECT_EQ(std::count_if(seen.begin(), seen.end(), [](int n) { return n <= kCount; }), kCount);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(OperationsOfAProgram, AreTheSameInAllWaysOfStating) {
  std::vector<NcProgram> operations = sample_operations(fanuc());
  operations[1].header.operation->number = 3;
  EXPECT_THROW((void)write_nc(std::span(operations), fanuc().dialect), InternalError);
  operations = sample_operations(fanuc());
  operations[1].feed_mode = NcFeedMode::kInverseTime;
  EXPECT_THROW((void)write_nc(std::span(operations), fanuc().dialect), InternalError);
}

TEST(OperationComment, IsReadBack) {
  const NcOperation plain{2, 5, 1, 1, "finish F1"}, copy{4, 6, 2, 3, "COPY shop"};
  EXPECT_EQ(read_operation_comment(operation_comment(plain)), plain);
  EXPECT_EQ(read_operation_comment(operation_comment(copy)), copy);
  EXPECT_EQ(read_operation_comment("OPERATION 1 OF 2 COPY shop")->name, "COPY shop");
  for (const char* other :
       {"OPERATION 3 OF 2", "OPERATION 1", "OPERATION ONE OF 2", "OPERATION 0 OF 2", "OPERATIONS 1 OF 2"})
    EXPECT_FALSE(read_operation_comment(other)) << other;
}

}  // namespace
}  // namespace flank::internal

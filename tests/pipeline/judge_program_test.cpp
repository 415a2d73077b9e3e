// Programs of every machine that is shipped, each spoilt in every way that a shop has spoilt one: none may pass; as they were written
// they must.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/io/path/blank_json.h"
#include "flank/job/job_json.h"
#include "flank/machine/model/machine_file.h"
#include "flank/path_file.h"
#include "flank/run.h"
#include "flank/tool_file.h"
#include "sanitized.h"
#include "shared_data.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

constexpr double kToleranceMm = 0.02;

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) (text += line) += '\n';
  return text;
}

/// Part, tool and path of an example whose tool is known, in a folder as `flank fit` leaves one.
class Result {
 public:
  Result() : folder_(fs::path(::testing::TempDir()) / ("flank_judge_program_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    const Example example = make_example("envelope-cone-1", {.relative_accuracy = 1e-6});
    const std::string part = (folder_ / "part.step").string();
    (void)write_example(example, part);
    FitJob job;
    job.part.file = part;
    job.tolerance_mm = kToleranceMm;
    job.judge.sample_mm = 2.5;
    write(folder_ / "job.json", job_to_json(job));
    write_tool(example.truth->tool, (folder_ / "tool.json").string());
    write_path(example.truth->path, (folder_ / "path.json").string());
  }

  [[nodiscard]] std::string post(const std::string& machine) const {
    PostJob job;
    job.folder = folder_.string();
    job.machine = machine;
    job.feed_mm_min = 1000.0;
    job.spindle_rpm = 5000.0;
    return run_post(job).program;
  }

  [[nodiscard]] VerifyJob asked(const std::string& text, const std::string& machine) const {
    write(folder_ / "p.nc", text);
    VerifyJob job;
    job.folder = folder_.string();
    job.nc.file = (folder_ / "p.nc").string();
    job.nc.machine = machine;
    return job;
  }

  [[nodiscard]] const fs::path& path() const { return folder_; }

  ~Result() { fs::remove_all(folder_); }
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;

 private:
  fs::path folder_;
};

const Result& result() {
  static const Result kResult;
  return kResult;
}

/// Why a program does not pass, or is not read at all; empty: it passes. Samples take a tenth of the time of proofs, and so prove
/// nothing of what lies between them: that is left out, and has tests of its own.
std::string complaint(const VerifyJob& job) {
  try {
    std::string all;
    for (const Shortfall& reason : run_verify(job).acceptance.reasons)
      if (reason.figure != "overcut_bound_mm") all += reason.figure + ": " + reason.text + "\n";
    return all;
  } catch (const InputError& e) {
    return std::string("refused: ") + e.what();
  }
}

std::string complaint(const std::string& text, const std::string& machine) {
  return complaint(result().asked(text, machine));
}

/// The blocks of the first strip that cuts: from the one behind its comment on, to its end.
std::pair<std::size_t, std::size_t> cut_of(const Lines& lines) {
  static const std::regex kStrip("STRIP \\d+ (\\S+)", std::regex::icase);
  std::size_t begin = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::smatch found;
    if (!std::regex_search(lines[k], found, kStrip)) continue;
    std::string kind = found[1];
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (begin == 0 && kind == "flank")
      begin = k + 1;
    else if (begin > 0)
      return {begin, k};
  }
  throw std::logic_error("no strip in\n" + text_of(lines));
}

/// Replaces everywhere; throws where there is nothing to replace.
std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  const std::string out = std::regex_replace(text, std::regex(from), to);
  if (out == text) throw std::logic_error(from + " is not in\n" + text.substr(0, 2000));
  return out;
}

NcLanguage language(const Machine& machine) { return machine.dialect.language; }
bool is_heidenhain(const Machine& m) { return language(m) == NcLanguage::kHeidenhain; }
bool is_siemens(const Machine& m) { return language(m) == NcLanguage::kSiemens; }

/// One block as a rapid one.
void make_rapid(std::string& line, const Machine& machine) {
  if (is_heidenhain(machine))
    line = std::regex_replace(line, std::regex(" F[0-9,.]+$|$"), " FMAX", std::regex_constants::format_first_only);
  else
    line = std::regex_replace(line, std::regex("(^N\\d+ |^)(G1 )?"), "$1G0 ", std::regex_constants::format_first_only);
}

std::string all_rapid(const std::string& text, const Machine& m) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  for (std::size_t k = begin; k < end; ++k) make_rapid(lines[k], m);
  return text_of(lines);
}

std::string one_rapid(const std::string& text, const Machine& m) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  make_rapid(lines[(begin + end) / 2], m);
  return text_of(lines);
}

std::string other_offset(const std::string& text, const Machine& m) {
  return is_heidenhain(m) ? replaced(text, "Q339=1", "Q339=2") : replaced(text, "G54", "G55");
}

std::string no_offset(const std::string& text, const Machine& m) {
  return is_heidenhain(m) ? replaced(text, "\n\\d+ CYCL DEF 247[^\n]*", "")
                          : replaced(text, "\n(N\\d+ )?G54(?=\n)", "");
}

std::string other_length(const std::string& text, const Machine& m) {
  // Of joints there is none, and of Heidenhain it is that of the tool.
  if (m.positions == NcPositions::kJoint) return replaced(text, "\nG93", "\nG43 H2\nG93");
  if (is_heidenhain(m)) return replaced(text, "TOOL CALL 1 Z", "TOOL CALL 1 Z DL+1");
  return is_siemens(m) ? replaced(text, " D1", " D2") : replaced(text, " H1", " H2");
}

std::string no_length(const std::string& text, const Machine& m) {
  if (m.positions == NcPositions::kJoint || is_heidenhain(m)) return other_length(text, m);
  if (is_siemens(m)) return replaced(text, " D1", " D0");
  return language(m) == NcLanguage::kFanuc ? replaced(text, " H1", "") : replaced(text, "\nG43 H1", "");
}

std::string other_tool(const std::string& text, const Machine& m) {
  if (is_heidenhain(m)) return replaced(text, "TOOL CALL 1 Z", "TOOL CALL 2 Z");
  return is_siemens(m) ? replaced(text, "T=\"", "T=\"OTHER_") : replaced(text, "T1 M6", "T2 M6");
}

std::string tool_change(const std::string& text, const Machine& m) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>((begin + end) / 2),
               is_heidenhain(m) ? "TOOL CALL 2 Z S5000\nM3"
               : is_siemens(m)  ? "T=\"OTHER\" M6\nS5000 M3"
                                : "T2 M6\nS5000 M3");
  return text_of(lines);
}

std::string half_deleted(const std::string& text, const Machine&) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  const auto quarter = static_cast<std::ptrdiff_t>((end - begin) / 4);
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(begin) + quarter,
              lines.begin() + static_cast<std::ptrdiff_t>(end) - quarter);
  return text_of(lines);
}

/// One coordinate of the block in the middle, by 0.1 mm.
std::string moved(const std::string& text, char letter, double by) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  std::string& line = lines[(begin + end) / 2];
  std::smatch found;
  if (!std::regex_search(line, found, std::regex(std::string(1, letter) + "([-+]?[0-9]+[.,][0-9]+)")))
    throw std::logic_error(line);
  std::string number = found[1];
  const bool comma = number.find(',') != std::string::npos;
  std::replace(number.begin(), number.end(), ',', '.');
  std::array<char, 40> shown{};
  std::snprintf(shown.data(), shown.size(), "%c%.5f", letter, std::stod(number) + by);
  number = shown.data();
  if (comma) std::replace(number.begin(), number.end(), '.', ',');
  line = found.prefix().str() + number + found.suffix().str();
  return text_of(lines);
}

std::string inches(const std::string& text, const Machine& m) {
  if (is_heidenhain(m)) return replaced(text, "(PGM \\S+) MM", "$1 INCH");
  return is_siemens(m) ? replaced(text, "G710", "G700") : replaced(text, "G21", "G20");
}

std::string turned_round(const std::string& text, const Machine& m) {
  const std::string letter = m.positions == NcPositions::kTipVector ? "A3=" : m.dialect.rotary.substr(1, 1);
  Lines lines = lines_of(text);
  const std::regex value("([ L])" + letter + "([-+]?)([0-9]+[.,])");
  for (std::string& line : lines) {
    std::smatch found;
    if (line.find("SETUP") != std::string::npos || !std::regex_search(line, found, value)) continue;
    line = found.prefix().str() + found[1].str() + letter + (found[2] == "-" ? "+" : "-") + found[3].str() +
           found.suffix().str();
  }
  // Only Heidenhain writes a sign before a positive number.
  return is_heidenhain(m) ? text_of(lines) : std::regex_replace(text_of(lines), std::regex(letter + "\\+"), letter);
}

/// Joint programs have none: theirs are run under it.
std::string no_tool_centre(const std::string& text, const Machine& m) {
  if (m.positions == NcPositions::kJoint) return replaced(text, "\nG93", "\nG43 H1\nG93");
  return replaced(text, "\n(\\d+ |N\\d+ )?(G43\\.4 H1|M428|TRAORI|M128|FUNCTION TCPM[^\n]*)(?=\n)", "");
}

std::string too_fast(const std::string& text, const Machine& m) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  std::string& line = lines[(begin + end) / 2];
  line = std::regex_replace(line, std::regex(" F[0-9,.]+"), "") + (is_heidenhain(m) ? " F900000" : " F900000.0");
  return text_of(lines);
}

std::string swapped(const std::string& text, const Machine&) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  const std::size_t middle = (begin + end) / 2;
  // In inverse time the words of a move belong together.
  std::swap(lines[middle], lines[middle + 1]);
  return text_of(lines);
}

std::string far_swapped(const std::string& text, const Machine&) {
  Lines lines = lines_of(text);
  const auto [begin, end] = cut_of(lines);
  std::swap(lines[begin + (end - begin) / 4], lines[end - (end - begin) / 4]);
  return text_of(lines);
}

struct Edit {
  const char* name;
  std::string (*make)(const std::string&, const Machine&);
  const char* figure;  ///< in which it must show, unless the program is refused; empty: any
};

constexpr std::array<Edit, 16> kEdits = {{
    {"all in rapid", all_rapid, "rapid"},
    {"one block in rapid", one_rapid, "rapid"},
    {"another work offset", other_offset, "work_offset"},
    {"no work offset", no_offset, "work_offset"},
    {"another tool's length", other_length, "tool_length"},
    {"no tool's length", no_length, "tool_length"},
    {"another tool", other_tool, "tool_number"},
    {"a tool change in the cut", tool_change, "tool_number"},
    {"half of the blocks deleted", half_deleted, "program_path"},
    {"inches", inches, ""},
    {"a rotary axis turned round", turned_round, ""},
    {"no tool-centre control", no_tool_centre, ""},
    {"too fast", too_fast, "axis_speed"},
    {"two blocks swapped", swapped, "program_path"},
    {"two far blocks swapped", far_swapped, "program_path"},
    {"one pose moved", [](const std::string& text, const Machine&) { return moved(text, 'Y', 0.1); }, "program_path"},
}};

class Programs : public ::testing::TestWithParam<std::string> {};

TEST_P(Programs, AsWrittenPassAndSpoiltDoNot) {
  const Machine machine = read_machine(GetParam());
  const std::string text = result().post(GetParam());
  EXPECT_EQ(complaint(text, GetParam()), "") << text.substr(0, 1500);
  for (const Edit& edit : kEdits) {
    if (kSanitized && &edit != &kEdits.front() && std::string(edit.figure) != "axis_speed") continue;
    const std::string why = complaint(edit.make(text, machine), GetParam());
    EXPECT_NE(why, "") << edit.name;
    EXPECT_NE(why.find("line "), std::string::npos) << edit.name << ": " << why;
    const bool refused = why.starts_with("refused");
    EXPECT_TRUE(refused || why.find(std::string(edit.figure) + ":") != std::string::npos) << edit.name << ": " << why;
  }
}

TEST_P(Programs, OfOneMachineDoNotPassOnAnother) {
  if (kSanitized) GTEST_SKIP() << "seven more judgements of the kind that is made beside it";
  const std::string text = result().post(GetParam());
  for (const std::string& other : machine_names()) {
    if (other == GetParam()) continue;
    EXPECT_NE(complaint(text, other), "") << other;
  }
}

/// A judgement takes ten times as long under a sanitizer, and runs the same code for every machine: one of a control's own does there.
std::vector<std::string> machines_to_ask() {
  return kSanitized ? std::vector<std::string>{"siemens-ac"} : machine_names();
}

INSTANTIATE_TEST_SUITE_P(All, Programs, ::testing::ValuesIn(machines_to_ask()), [](const auto& of) {
  std::string name = of.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Program, APoseMovedByATenthIsFoundInEveryDirection) {
  const std::string text = result().post("fanuc-ac");
  for (const char letter : {'X', 'Y', 'Z'})
    for (const double by : {-0.1, 0.1}) {
      if (kSanitized && (letter != 'Y' || by < 0.0)) continue;
      EXPECT_NE(complaint(moved(text, letter, by), "fanuc-ac"), "") << letter << by;
    }
}

TEST(Program, WhatTheRequestSaysTakesThePlaceOfTheHeader) {
  if (kSanitized) GTEST_SKIP() << "four more judgements of the kind that is made beside it";
  const Machine machine = read_machine("fanuc-ac");
  const std::string text = result().post("fanuc-ac");
  VerifyJob job = result().asked(other_offset(text, machine), "fanuc-ac");
  job.nc.work_offset = 2;
  EXPECT_EQ(complaint(job), "");
  job = result().asked(replaced(other_tool(text, machine), " H1", " H2"), "fanuc-ac");
  job.nc.tool_number = 2;
  EXPECT_EQ(complaint(job), "");
  // A pose that is off the path by less than the tolerance hurts nothing but the path.
  job = result().asked(moved(text, 'X', 0.015), "fanuc-ac");
  EXPECT_NE(complaint(job).find("program_path"), std::string::npos) << complaint(job);
  job.nc.follow = "any";
  EXPECT_EQ(complaint(job).find("program_path"), std::string::npos) << complaint(job);
}

TEST(Program, AHeaderThatContradictsItselfIsTold) {
  if (kSanitized) GTEST_SKIP() << "four more judgements of the kind that is made beside it";
  const std::string text = result().post("fanuc-ac");
  EXPECT_NE(complaint(replaced(text, "HOLDS X", "HOLDS X1"), "fanuc-ac").find("setup:"), std::string::npos);
  EXPECT_NE(complaint(replaced(text, "\\(MACHINE ", "(MACHINE NO-"), "fanuc-ac").find("machine:"), std::string::npos);
  EXPECT_NE(complaint(replaced(text, "\n(?=\\(SETUP )", "\n(SETUP 1,2,3)\n"), "fanuc-ac").find("setup:"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(text, "DIAMETER ", "DIAMETER 1"), "fanuc-ac").find("tool_number:"), std::string::npos);
}

TEST(Program, TheSpindleTurnsOrItIsADryRun) {
  const std::string text = result().post("fanuc-ac");
  const std::string still = replaced(text, "\nS5000(\\.0)? M3", "");
  EXPECT_NE(complaint(still, "fanuc-ac").find("spindle:"), std::string::npos) << complaint(still, "fanuc-ac");
  const Verification dry =
      run_verify(result().asked(replaced(still, "\n(?=\\(SETUP )", "\n(DRY RUN: THE SPINDLE STANDS)\n"), "fanuc-ac"));
  for (const Shortfall& reason : dry.acceptance.reasons) EXPECT_EQ(reason.figure, "overcut_bound_mm") << reason.text;
  EXPECT_TRUE(std::any_of(dry.acceptance.cautions.begin(), dry.acceptance.cautions.end(),
                          [](const Shortfall& caution) { return caution.figure == "spindle"; }));
}

/// Programs that were spoilt by one edit each, where $FLANK_DATA has them, and the figure in which it shows; empty: it is read.
TEST(Program, SpoiltFilesAreFoundOut) {
  if (kSanitized) GTEST_SKIP() << "a dozen judgements of the kind that is made of the spoilt program of a machine";
  FLANK_REAL_PART(part, "faults/nc/tb.step");
  const fs::path folder = fs::path(part).parent_path();
  Tool tool;
  tool.radial =
      RadialFunction(ToolFamily::kCone, 60.0, Eigen::Vector2d(9.010948, std::asin((12.017229 - 9.010948) / 60.0)));
  write_tool(tool, (result().path() / "like_theirs.json").string());
  struct Case {
    const char *file, *machine, *figure;
  };
  for (const Case& c : {Case{"rapid-through-the-cut.nc", "fanuc-ac", "rapid"},
                        {"rapid-from-line-142.nc", "fanuc-ac", "rapid"},
                        {"g55-instead-of-g54.nc", "fanuc-ac", "work_offset"},
                        {"g54.1-p3.nc", "fanuc-ac", "work_offset"},
                        {"no-work-offset.nc", "fanuc-ac", "work_offset"},
                        {"h2-instead-of-h1.nc", "fanuc-ac", "tool_length"},
                        {"g43.4-without-h.nc", "fanuc-ac", "tool_length"},
                        {"tool-change-in-the-cut.nc", "fanuc-ac", "tool_number"},
                        {"setup-and-holds-disagree.nc", "fanuc-ac", "setup"},
                        {"joint-program-in-g55.nc", "joint-ac", "work_offset"},
                        {"m11-clamp-refused.nc", "fanuc-ac", ""},
                        {"cycle800-refused.nc", "siemens-ac", ""}}) {
    // Their tool but for its meridian, so that there is more to say against them, too: their own fault is what is looked for.
    // One of them still has the G1 that it is said to be without.
    const std::string text = read(folder / c.file);
    const bool rapid = std::string(c.file) == "rapid-through-the-cut.nc";
    VerifyJob job = result().asked(rapid ? std::regex_replace(text, std::regex("\nG1 "), "\n") : text, c.machine);
    job.part = (folder / "tb.step").string();
    job.sample_mm = 3.0;
    job.nc.tool = (result().path() / "like_theirs.json").string();
    job.nc.follow = "any";
    const std::string why = complaint(job);
    EXPECT_EQ(why.find("refused"), std::string::npos) << c.file << ": " << why;
    for (const char* figure : {"rapid", "work_offset", "tool_length", "setup", "machine"}) {
      const bool wanted = std::string(figure) == c.figure;
      EXPECT_EQ(("\n" + why).find("\n" + std::string(figure) + ":") != std::string::npos, wanted)
          << c.file << ": " << why;
    }
    EXPECT_TRUE(std::string(c.figure) != "tool_number" || why.find("tool 2 is in the spindle") != std::string::npos)
        << why;
  }
}

/// A channel between two walls, and cycles along it that a cylinder cuts, just off the walls: circles that go on by a step each.
class Channel {
 public:
  Channel() : folder_(fs::path(::testing::TempDir()) / ("flank_channel_program_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    ExampleOptions options{.relative_accuracy = 1e-6};
    options.cavity = {
        .width_mm = 20.0, .depth_mm = 10.0, .length_mm = 16.0, .twist_deg = 0.0, .lean_deg = 0.0, .hollow_mm = 0.0};
    const std::string part = (folder_ / "part.step").string();
    (void)write_example(make_example("cavity", options), part);
    TrochoidJob job;
    job.part.file = part;
    job.tolerance_mm = kToleranceMm;
    job.cycles.most_engagement_deg = 70.0;
    job.cycles.stock_cell_mm = 0.25;
    job.judge.sample_mm = 0.5;
    write(folder_ / "job.json", job_to_json(job));
    Tool tool;
    tool.name = "cylinder";
    tool.radial = RadialFunction(ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, kRadius));
    write_tool(tool, (folder_ / "tool.json").string());
    write_path(cycles(), (folder_ / "path.json").string());
    write(folder_ / "blank.json",
          blank_to_json({{Vec3::UnitX(), 8.0}, {-Vec3::UnitX(), 8.0}, {Vec3::UnitZ(), 5.0}, {-Vec3::UnitZ(), 5.0}}));
  }
  ~Channel() { fs::remove_all(folder_); }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  [[nodiscard]] std::string post() const {
    PostJob job;
    job.folder = folder_.string();
    job.machine = "fanuc-ac";
    job.feed_mm_min = 1000.0;
    job.spindle_rpm = 5000.0;
    return run_post(job).program;
  }

  [[nodiscard]] std::string complaint(const std::string& text, const std::string& follow = "path") const {
    write(folder_ / "p.nc", text);
    VerifyJob job;
    job.folder = folder_.string();
    job.nc.file = (folder_ / "p.nc").string();
    job.nc.machine = "fanuc-ac";
    job.nc.follow = follow;
    return internal::complaint(job);
  }

 private:
  static constexpr double kRadius = 4.0, kCircle = 5.5, kStep = 0.8, kTip = -6.0;

  /// A half circle that cuts, and one back in what is cut already.
  static Path cycles() {
    Path path;
    constexpr int kPoses = 48;
    int id = 0;
    for (double x = -8.0 - kCircle - kRadius; x < 9.0; x += kStep)
      for (const bool front : {true, false}) {
        Strip strip{++id, front ? "front" : "back", "F1,F2", {}, 1};
        for (int k = 0; k <= kPoses; ++k) {
          const double share = static_cast<double>(k) / kPoses;
          const double angle = std::numbers::pi * (front ? 0.5 - share : -0.5 - share);
          const double along = x + 0.5 * kStep * (share + (front ? 0.0 : 1.0));
          strip.poses.push_back({{along + kCircle * std::cos(angle), kCircle * std::sin(angle), kTip}, Vec3::UnitZ()});
        }
        path.strips.push_back(strip);
      }
    return path;
  }

  fs::path folder_;
};

TEST(CavityProgram, IsReplayedInItsStock) {
  if (kSanitized)
    GTEST_SKIP() << "replays of a whole cavity take a minute each; the replay and the judge are tested one by one";
  const Channel channel;
  const std::string text = channel.post();
  const std::string sound = channel.complaint(text);
  for (const char* figure : {"stock:", "rapid:", "program_path:"})
    EXPECT_EQ(sound.find(figure), std::string::npos) << sound;
  // Cycles that are left out: the next one ploughs through what they have left.
  Lines lines = lines_of(text);
  const auto first =
      std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return l.find("FRONT") != l.npos; });
  const auto begin = first + (lines.end() - first) / 2;
  Lines shorter(lines.begin(), begin);
  shorter.insert(shorter.end(), begin + (lines.end() - first) / 5, lines.end());
  for (const char* follow : {"path", "any"}) {
    const std::string why = channel.complaint(text_of(shorter), follow);
    EXPECT_NE(why.find("stock: "), std::string::npos) << why;
    EXPECT_NE(why.find("line "), std::string::npos) << why;
    EXPECT_EQ(why.find("program_path:") != std::string::npos, std::string(follow) == "path") << why;
  }
  // A comment that calls the cycles a ramp excuses nothing.
  const std::string excused = replaced(text_of(shorter), "FRONT", "RAMP");
  EXPECT_NE(channel.complaint(excused).find("stock: "), std::string::npos);
  const std::string rapid = channel.complaint(replaced(text, "\nG1 ", "\nG0 "));
  EXPECT_NE(rapid.find("rapid: "), std::string::npos) << rapid;
  EXPECT_NE(rapid.find("of the stock"), std::string::npos) << rapid;
}

}  // namespace
}  // namespace flank::internal

#include "flank/pipeline/program/program_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"
#include "flank/results/acceptance.h"

namespace flank::internal {
namespace {

/// What a header's decimals may hide, mm.
constexpr double kSameMm = 1e-4;
/// Of the largest diameter, which is looked for in steps along the flank, mm.
constexpr double kSameDiameterMm = 1e-2;

/// Names as a comment and a control's word for a tool both have them.
std::string plain(std::string_view name) {
  std::string out = safe_comment(name);
  for (char& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (c == ' ') c = '_';
  }
  return out;
}

/// "X-0.194 Y-26.851 Z56.229".
std::optional<Vec3> read_origin(std::string_view text) {
  Vec3 origin;
  for (int k = 0; k < 3; ++k) {
    if (text.empty() || text.front() != "XYZ"[k]) return std::nullopt;
    const auto number = leading_number(text.substr(1));
    if (!number) return std::nullopt;
    origin(k) = number->value;
    text.remove_prefix(1 + number->length);
    if (text.starts_with(' ')) text.remove_prefix(1);
  }
  return text.empty() ? std::optional(origin) : std::nullopt;
}

class SetUpCheck {
 public:
  SetUpCheck(const NcRequest& request, const NcProgram& program, const Machine& machine, const Tool& tool,
             const BackplotOptions& options, Acceptance& acceptance)
      : request_(request),
        program_(program),
        stated_(program.header.stated),
        machine_(machine),
        tool_(tool),
        options_(options),
        acceptance_(acceptance) {}

  void run() {
    check_header();
    check_tool_of_header();
    check_offset();
    check_tool();
    check_length();
    check_spindle();
  }

 private:
  void add(Figure figure, const std::string& text) { add_reason(acceptance_, figure, *request_.file + ": " + text); }

  /// Adds a reason at the first move that a question is about, if there is one.
  void first(Figure figure, const std::function<std::string(const NcMove&, const NcModes&)>& why) {
    for (const NcMove& move : program_.moves) {
      if (move.modes < 0) continue;
      const std::string text = why(move, program_.modes[static_cast<std::size_t>(move.modes)]);
      if (text.empty()) continue;
      add(figure, fmt::format("line {}: {}", move.line, text));
      return;
    }
  }

  void check_header() {
    const NcHeader& header = program_.header;
    if (!stated_.contradiction.empty()) add(Figure::kSetup, stated_.contradiction);
    if (!header.machine.empty() && plain(header.machine) != plain(machine_.name))
      add(Figure::kMachine,
          fmt::format("its header names machine {}, but it is checked on {}", header.machine, machine_.name));
    // Where the part sits was said anew: what the work offset held before is of no account.
    if (header.origin.empty() || request_.setup) return;
    const bool joint = program_.positions == NcPositions::kJoint;
    const Vec3 wanted = joint ? Vec3(Vec3::Zero()) : Vec3(options_.setup.translation);
    const std::optional<Vec3> origin = read_origin(header.origin);
    if (origin && (*origin - wanted).norm() <= kSameMm) return;
    add(Figure::kSetup,
        fmt::format("its header contradicts itself: the work offset HOLDS {}, but {}X{} Y{} Z{}", header.origin,
                    joint ? "a program of axis positions needs " : "SETUP puts the part's origin at ", wanted.x(),
                    wanted.y(), wanted.z()));
  }

  void check_tool_of_header() {
    const NcTool& said = program_.header.tool;
    if (!(said.diameter > 0.0)) return;
    double radius = 0.0;
    constexpr int kLooks = 200;
    for (int k = 0; k <= kLooks; ++k)
      radius = std::max(radius, tool_.radial.at(tool_.radial.axis_length() * k / kLooks).r);
    if (std::abs(said.diameter - 2.0 * radius) > kSameDiameterMm)
      add(Figure::kToolNumber, fmt::format("its header's tool has a diameter of {:.6g} mm, the checked tool {:.6g}",
                                           said.diameter, 2.0 * radius));
    if (std::abs(said.tip_offset - options_.tip_offset) > kSameMm)
      add(Figure::kToolLength,
          fmt::format("its header's TIP OFFSET is {:.6g} mm; of this tool and machine it is {:.6g}", said.tip_offset,
                      options_.tip_offset));
  }

  void check_offset() {
    const int wanted = request_.work_offset.value_or(stated_.work_offset.value_or(machine_.work_offset));
    const char* const whose = request_.work_offset  ? "--work-offset is"
                              : stated_.work_offset ? "its header says"
                                                    : "the machine's is";
    first(Figure::kWorkOffset, [&](const NcMove&, const NcModes& modes) -> std::string {
      if (modes.work_offset == wanted) return {};
      return fmt::format("{}; {} {} (--work-offset allows another)",
                         modes.work_offset ? fmt::format("work offset {} holds", *modes.work_offset)
                                           : std::string("no work offset has been set"),
                         whose, wanted);
    });
  }

  /// The number that the tool must have; none: the program's first tool counts.
  [[nodiscard]] std::optional<int> wanted_tool() const {
    return request_.tool_number ? request_.tool_number : stated_.tool;
  }

  void check_tool() {
    const std::optional<int> wanted = wanted_tool();
    const NcModes* known = nullptr;  // the first tool, where nobody says which one is right
    first(Figure::kToolNumber, [&](const NcMove&, const NcModes& modes) -> std::string {
      if (!modes.tool_name.empty()) return wrong_name(modes, known);
      if (!wanted) {
        if (known == nullptr) known = &modes;
        return modes.tool == known->tool ? std::string() : "the tool changes; one program has one tool";
      }
      if (modes.tool == *wanted) return {};
      return fmt::format(
          "{}; expected tool {} (--tool-number allows another)",
          modes.tool ? fmt::format("tool {} is in the spindle", *modes.tool) : std::string("no tool has been called"),
          *wanted);
    });
    if (!wanted && stated_.tool_name.empty())
      add_caution(
          acceptance_, Figure::kToolNumber,
          fmt::format("{}: neither its header nor --tool-number says which tool is in the spindle", *request_.file));
  }

  std::string wrong_name(const NcModes& modes, const NcModes*& known) const {
    if (stated_.tool_name.empty()) {
      if (known == nullptr) known = &modes;
      return modes.tool_name == known->tool_name ? std::string() : "the tool changes; one program has one tool";
    }
    if (plain(modes.tool_name) == plain(stated_.tool_name)) return {};
    return fmt::format("tool \"{}\" is in the spindle; its header says \"{}\"", plain(modes.tool_name),
                       stated_.tool_name);
  }

  void check_length() {
    if (program_.positions == NcPositions::kJoint) return;  // of no tool: the reader sees to that
    first(Figure::kToolLength, [&](const NcMove&, const NcModes& modes) -> std::string {
      if (modes.edge && *modes.edge != 1)
        return fmt::format("D{} is another length than that of the tool, D1", *modes.edge);
      const std::optional<int> wanted = wanted_tool() ? wanted_tool() : modes.tool;
      if (!modes.length || !wanted || *modes.length == *wanted) return {};
      return fmt::format("{}; expected that of tool {}",
                         *modes.length == 0 ? std::string("no tool length is switched on")
                                            : fmt::format("the length of tool {} is switched on", *modes.length),
                         *wanted);
    });
  }

  void check_spindle() {
    if (stated_.dry_run) {
      add_caution(acceptance_, Figure::kSpindle,
                  *request_.file + ": is a dry run, says its header: the spindle stands");
      return;
    }
    first(Figure::kSpindle, [](const NcMove& move, const NcModes& modes) -> std::string {
      return move.kind == NcKind::kFeed && !modes.spindle ? "a cutting move while the spindle stands still" : "";
    });
  }

  const NcRequest& request_;
  const NcProgram& program_;
  const NcStated& stated_;
  const Machine& machine_;
  const Tool& tool_;
  const BackplotOptions& options_;
  Acceptance& acceptance_;
};

}  // namespace

void accept_set_up(const NcRequest& request, const NcProgram& program, const Machine& machine, const Tool& tool,
                   const BackplotOptions& options, Acceptance& acceptance) {
  SetUpCheck(request, program, machine, tool, options, acceptance).run();
}

}  // namespace flank::internal

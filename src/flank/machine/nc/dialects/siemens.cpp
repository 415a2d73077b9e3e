#include "flank/machine/nc/dialects/siemens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/read/program_builder.h"
#include "flank/machine/nc/read/siemens_words.h"
#include "flank/machine/nc/without_effect.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "Siemens";
constexpr double kInch = 25.4;
constexpr int kMostFrames = 99, kMostEdges = 9;  // G505 to G599; D1 to D9

/// They smooth within a tolerance, compress, look ahead or move no axis of ours: what is verified is the program's own
/// polyline.
constexpr std::array<std::string_view, 19> kIgnored = {
    "COMPCAD", "COMPCURV", "COMPON", "COMPOF",   "COMPSURF", "FFWON", "FFWOF", "SOFT", "BRISK", "CTOL",
    "OTOL",    "CYCLE832", "FGROUP", "FIFOCTRL", "STOPRE",   "MSG",   "UPATH", "ADIS", "ORISON"};

bool is_ignored(std::string_view name) { return std::find(kIgnored.begin(), kIgnored.end(), name) != kIgnored.end(); }

class SiemensReader {
 public:
  SiemensReader(const std::string& file, const NcDialect& dialect) : builder_(file, dialect), dialect_(dialect) {
    // Machines without a magazine change a tool where it is called; those with one wait for M6 (miscellaneous).
    builder_.change_at_call(true);
  }

  std::vector<NcProgram> read(std::string_view text) {
    NcLines lines(text);
    while (lines.next()) {
      builder_.at(lines.number());
      if (lines.upper().starts_with("%_N_")) continue;  // the name of a file in a transfer
      split_siemens(lines.line(), lines.upper(), builder_.place(), block_);
      builder_.comment(block_.comment);
      if (block_.words.empty()) continue;
      if (builder_.ended()) builder_.place().refuse("a block after the end of the program");
      block();
    }
    return builder_.finish();
  }

 private:
  void block() {
    if (block_.skipped) require_same_if_skipped();
    for (const SiemensWord& word : block_.words) {
      // One letter with a number is an address; T="NAME" has one letter and no number, and is a name.
      if (word.name.size() == 1 && word.value && !word.string)
        letter(word);
      else
        named(word);
    }
    if (changes_) builder_.change_tool();
    if (turns_) builder_.spindle_turns(*turns_);
    changes_ = false;
    turns_.reset();
    builder_.end_block();
    // Axes in the block of M30 still move: it ends the program behind its block.
    if (ends_) builder_.end_program();
  }

  [[noreturn]] void refuse(const SiemensWord& word) const { builder_.place().refuse_word(word.text, kName); }

  /// The value as a whole number from 0; refused if it is none.
  [[nodiscard]] int whole(const SiemensWord& word) const {
    if (!word.value || *word.value < 0.0 || *word.value > 1e6 || *word.value != std::floor(*word.value)) refuse(word);
    return static_cast<int>(*word.value);
  }

  void letter(const SiemensWord& word) {
    const char c = word.name[0];
    if (c >= 'X' && c <= 'Z') {
      builder_.linear(static_cast<std::size_t>(c - 'X'), *word.value);
    } else if (c >= 'A' && c <= 'C') {
      builder_.rotary(c, *word.value);
    } else if (c == 'G') {
      preparatory(word, whole(word));
    } else if (c == 'M') {
      miscellaneous(word, whole(word));
    } else if (c == 'F') {
      if (!dwell()) builder_.feed(*word.value);
    } else if (c == 'S') {
      if (*word.value < 0.0) refuse(word);
      if (!dwell()) builder_.spindle_speed(*word.value);
    } else if (c == 'T') {
      builder_.call_tool(whole(word));
    } else if (c == 'D') {
      if (whole(word) > kMostEdges) refuse(word);
      // D0 switches the tool's length off; with an edge it counts, as tool-centre control needs.
      builder_.length_compensation(whole(word) > 0);
      builder_.edge(whole(word));
    } else if (c != 'N') {
      refuse(word);
    }
  }

  /// G4 F and G4 S: a time, not a feed.
  [[nodiscard]] bool dwell() const {
    return std::any_of(block_.words.begin(), block_.words.end(),
                       [](const SiemensWord& w) { return w.name == "G" && w.value == 4.0; });
  }

  void preparatory(const SiemensWord& word, int code) {
    // G54 to G57 are offsets 1 to 4; G505 to G599 go on from 5 to 99.
    if ((code >= 54 && code <= 57) || (code > 504 && code <= 500 + kMostFrames)) {
      builder_.work_offset(code > 500 ? code - 500 : code - 53);
      return;
    }
    switch (code) {
      case 0:
      case 1:
        builder_.motion(code == 0 ? NcKind::kRapid : NcKind::kFeed);
        break;
      case 4:
      case 9:
      case 17:
      case 40:
      case 60:
      case 64:
      case 90:
      case 601:
      case 602:
      case 603:
      case 641:
      case 642:
      case 643:
      case 645:
        break;
      // G53 and G153 suppress the frames for one block: its coordinates are the machine's.
      case 53:
      case 153:
        builder_.to_reference();
        break;
      // G70 and G71 are about coordinates alone: F stays in the control's own unit, which is taken as millimetres.
      case 70:
        builder_.unit(kInch, 1.0);
        break;
      case 700:
        builder_.unit(kInch);
        break;
      case 71:
      case 710:
        builder_.unit(1.0);
        break;
      case 93:
      case 94:
        builder_.feed_mode(code == 93 ? NcFeedMode::kInverseTime : NcFeedMode::kPerMinute);
        break;
      default:
        if (!is_without_effect(dialect_, 'G', *word.value)) refuse(word);
    }
  }

  /// Whether the machine's file says that a word moves nothing.
  [[nodiscard]] bool is_ignored_here(const SiemensWord& word) const {
    if (word.name.size() == 1 && word.value) return is_without_effect(dialect_, word.name[0], *word.value);
    const bool bare = word.arguments && trimmed(*word.arguments).empty();
    return is_without_effect(dialect_, std::string(word.name) + (bare ? "()" : "")) ||
           is_without_effect(dialect_, word.name);
  }

  /// A block that may be left out says the same with and without it, or is refused.
  void require_same_if_skipped() const {
    for (const SiemensWord& word : block_.words) {
      const double m = word.name == "M" && word.value ? *word.value : -1.0;
      const bool same = word.name == "N" || m == 0.0 || m == 1.0 || (m >= 7.0 && m <= 9.0) || word.name == "MSG" ||
                        is_ignored_here(word);
      if (!same)
        builder_.place().refuse(quoted(word.text) +
                                " stands in a block that may be skipped (/); only words without "
                                "effect on the motion may stand there");
    }
  }

  /// From the first M6 on, a call only readies the next tool.
  void change() {
    changes_ = true;
    builder_.change_at_call(false);
  }

  void miscellaneous(const SiemensWord& word, int code) {
    // M17 ends a subprogram, which a program that was cut out of a larger one may be.
    if (code == 2 || code == 30 || code == 17)
      ends_ = true;
    else if (code == 3 || code == 4)
      turns_ = true;
    else if (code == 5)
      turns_ = false;
    else if (code == 6)
      change();
    else if (code > 9 && !is_without_effect(dialect_, 'M', *word.value))
      refuse(word);
  }

  void named(const SiemensWord& word) {
    const std::string_view name = word.name;
    if (name == "TRAORI") {
      // A machine may hold several transformations; the first is the one that its file describes.
      if (word.arguments && trimmed(*word.arguments) != "1" && !trimmed(*word.arguments).empty()) refuse(word);
      builder_.tool_centre(true);
    } else if (name == "TRAFOOF") {
      builder_.tool_centre(false);
    } else if (name == "ORIAXES") {
      builder_.join(NcJoin::kAxes);
    } else if (name == "ORIVECT" || name == "ORIPLANE") {
      builder_.join(NcJoin::kGreatCircle);
    } else if (name == "SUPA") {
      builder_.to_reference();
    } else if (name == "A3" || name == "B3" || name == "C3") {
      if (!word.value) refuse(word);
      builder_.vector(static_cast<std::size_t>(name[0] - 'A'), *word.value);
    } else if (name == "T" && word.string) {
      builder_.call_tool(*word.string);
    } else if (name != "ORIWKS" && !is_ignored(name) && !is_ignored_here(word)) {
      refuse(word);
    }
  }

  ProgramBuilder builder_;
  const NcDialect& dialect_;
  SiemensBlock block_;
  std::optional<bool> turns_;  ///< what the block says of the spindle
  bool changes_ = false, ends_ = false;
};

/// As read_nc, for a text that was not recognised as one of another language.
std::vector<NcProgram> read_siemens(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return SiemensReader(file, dialect).read(text);
}

constexpr int kLastSimple = 4, kLastOffset = 99;  // G505 to G599 follow G57

/// G54 to G57 for 1 to 4, then G505 to G599.
std::string work_offset(int number) { return "G" + std::to_string(number <= kLastSimple ? 53 + number : 500 + number); }

/// Tools have names, without spaces; one that has none here is called by its number.
std::string tool_call(const NcTool& tool, bool length_compensation) {
  std::string name = safe_comment(tool.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return (name.empty() ? "T" + std::to_string(tool.number) : "T=\"" + name + '"') +
         (length_compensation ? " D1" : " D0");
}

/// G642 blends within the contour tolerance CTOL, mm, and that of the orientation OTOL, degrees.
std::string smoothing(const NcDialect& dialect) {
  std::string words = "G642 CTOL=";
  append_decimal(words, dialect.smoothing_mm, kMostNcDecimals);
  if (dialect.smoothing_deg > 0.0) append_decimal(words += " OTOL=", dialect.smoothing_deg, kMostNcDecimals);
  return words;
}

void tool_centre_on(GCodeWriter& out, const NcProgram& program) {
  out.block("TRAORI");
  // The transformation may drop the frame.
  out.block(work_offset(program.header.work_offset));
  // ORIWKS: directions, and the plane in which the tool turns between two of them, are in the frame of the part.
  out.block(program.join == NcJoin::kGreatCircle ? "ORIWKS ORIVECT" : "ORIWKS ORIAXES");
}

/// One operation: TRAORI with rotary words or with the tool vector A3= B3= C3=, ORIAXES or ORIVECT as the control shall join blocks;
/// or joint coordinates without a transformation.
void write_operation(GCodeWriter& out, const NcProgram& program, const NcDialect& dialect) {
  const NcHeader& header = program.header;
  const bool tip = program.positions != NcPositions::kJoint;
  const std::string coolant = coolant_words(header);
  out.operation(program);
  const auto retract = [&] {
    // Without frames and without the tool's length: Z of the machine itself, not of the part.
    std::string words = "SUPA G0 Z";
    append_decimal(words, dialect.retract_mm.value_or(0.0), dialect.length_decimals);
    out.block(words + " D0");
  };
  out.block("G0 G17 G40 G90 G94 G710");
  // Wherever the tool stands, and whatever the last program has left: nothing turns before it is out of the way.
  out.block("TRAFOOF");
  retract();
  out.block(tool_call(header.tool, tip));
  out.block("M6");
  out.block(work_offset(header.work_offset));
  // The rotary axes turn before TRAORI: afterwards the control would hold the tip where it is meanwhile.
  out.start_rotary();
  if (const std::string spindle = spindle_words(header); !spindle.empty()) out.block(spindle);
  if (!coolant.empty()) out.block(coolant);
  if (tip) tool_centre_on(out, program);
  if (dialect.smoothing_mm > 0.0) out.block(smoothing(dialect));
  // F is the feed of the tip, not of tip and rotary axes together.
  if (program.feed_mode == NcFeedMode::kPerMinute) out.block("FGROUP(X,Y,Z)");
  if (program.feed_mode == NcFeedMode::kInverseTime) out.block("G93");
  out.moves([&](const NcMove& move) {
    if (tip) out.block("TRAFOOF");
    retract();
    out.block(tip ? "D1" : "D0");
    out.rotary_of(move);
    if (tip) tool_centre_on(out, program);
  });
  if (tip) out.block("TRAFOOF");
  retract();
  if (!coolant.empty()) out.block("M9");
  out.block("G94 M5");
  out.end_rotary();
}

/// As write_nc, for operations that passed its checks.
std::string write_siemens(std::span<const NcProgram> operations, const NcDialect& dialect) {
  const NcHeader& header = operations.front().header;
  if (header.work_offset > kLastOffset) throw UsageError("dialect", "siemens", "has work offsets 1 to 99");
  GCodeWriter out(operations, dialect, {"; ", "", false, {"A3=", "B3=", "C3="}});
  out.comment(safe_comment("PROGRAM " + header.program));
  for (const NcProgram& operation : operations) write_operation(out, operation, dialect);
  out.block("M30");
  return out.take();
}

}  // namespace

constexpr NcLanguageRow kSiemensRow{
    .language = NcLanguage::kSiemens,
    .name = "siemens",
    .title = kName,
    .read = read_siemens,
    .write = write_siemens,
    .first = {"%_N_"},
    .anywhere = {"TRAORI", "TRAFOOF", "ORIWKS", "A3=", "T=\"", "CYCLE832", "FGROUP", "G710", "SUPA"},
    .retract_word = false,
};

}  // namespace flank::internal

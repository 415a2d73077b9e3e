#include "flank/machine/nc/dialects/fanuc.h"

#include <algorithm>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/read/gcode_words.h"
#include "flank/machine/nc/read/program_builder.h"
#include "flank/machine/nc/without_effect.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "Fanuc";
constexpr double kInch = 25.4;
constexpr int kLastSimpleOffset = 6, kLargestProgram = 99999999;  // G54 to G59; G54.1 P1 is offset 7

class FanucReader {
 public:
  FanucReader(const std::string& file, const NcDialect& dialect) : builder_(file, dialect), dialect_(dialect) {}

  std::vector<NcProgram> read(std::string_view text) {
    NcLines lines(text);
    while (lines.next()) {
      builder_.at(lines.number());
      split_gcode(lines.line(), lines.upper(), builder_.place(), block_);
      for (const std::string_view comment : block_.comments) this->comment(comment);
      if (block_.words.empty()) continue;
      if (builder_.ended()) builder_.place().refuse("a block after the end of the program");
      block();
    }
    return builder_.finish();
  }

 private:
  /// The comment beside the number is the name of the program.
  void comment(std::string_view text) {
    if (block_.find('O') != nullptr)
      builder_.header().program = trimmed(text);
    else
      builder_.comment(text, true);
  }

  void block() {
    require_same_if_skipped(block_, dialect_, builder_.place());
    for (const GWord& word : block_.words) {
      // Modes first, whatever their place in the block: see below.
      switch (word.letter) {
        case 'G':
          preparatory(word);
          break;
        case 'M':
          miscellaneous(word);
          break;
        default:
          break;
      }
    }
    // G43.4 and G49 come into force before the axes of their block move.
    for (const GWord& word : block_.words)
      if (word.letter != 'G' && word.letter != 'M') other(word);
    modes_behind_words();
    builder_.end_block();
    if (ends_) builder_.end_program();
  }

  /// T, S and H may stand on either side of the words that they belong to.
  void modes_behind_words() {
    if (block_.has_code('M', 60)) builder_.change_tool();
    if (block_.has_code('M', 30) || block_.has_code('M', 40)) builder_.spindle_turns(true);
    if (block_.has_code('M', 50)) builder_.spindle_turns(false);
    if (!block_.has_code('G', 434) && !block_.has_code('G', 435)) return;
    const GWord* const h = block_.find('H');
    if (h != nullptr && h->whole() < 0) builder_.place().refuse_word(h->text, kName);
    // Without H it is the length of none.
    builder_.length_of(h != nullptr ? h->whole() : 0);
  }

  void tool_centre(bool on, bool vectors) {
    builder_.tool_centre(on);
    // I J K are tool vectors only under G43.5; elsewhere they would be centres of arcs, and are refused.
    if (on) vectors_ = vectors;
    centred_ = on;
    if (!on) builder_.length_of(0);
  }

  void preparatory(const GWord& word) {
    const int code = word.code();
    switch (code) {
      case 0:
      case 10:
        builder_.motion(code == 0 ? NcKind::kRapid : NcKind::kFeed);
        break;
      case 40:  // dwell
      case 51:  // G5.1, contour control
      case 170:
      case 400:
      case 640:
      case 690:
      case 800:
        break;
      case 200:
      case 210:
        builder_.unit(code == 200 ? kInch : 1.0);
        break;
      // The axes of G28 and G30 are an intermediate point. With G91 and Z0 it is where the machine stands; absolute
      // ones are a move through the part that is not of the path.
      case 280:
      case 300:
        if (!block_.has_code('G', 910))
          builder_.place().refuse(quoted(word.text) + " goes by way of a point in part coordinates; expected G91 G28");
        builder_.to_reference();
        break;
      case 434:
      case 435:
        tool_centre(true, code == 435);
        break;
      case 490:
        tool_centre(false, false);
        break;
      case 530:
        builder_.to_reference();
        break;
      case 540:
      case 541:
      case 550:
      case 560:
      case 570:
      case 580:
      case 590:
        work_offset(code);
        break;
      case 900:
      case 910:
        builder_.incremental(code == 910);
        break;
      case 930:
      case 940:
        builder_.feed_mode(code == 930 ? NcFeedMode::kInverseTime : NcFeedMode::kPerMinute);
        break;
      default:
        ignore(word);
    }
  }

  /// A word that the machine's file calls without effect; refuses any other.
  void ignore(const GWord& word) const {
    if (!is_without_effect(dialect_, word.letter, word.value)) builder_.place().refuse_word(word.text, kName);
  }

  void work_offset(int code) {
    const GWord* const p = block_.find('P');
    // Codes are tenths (GWord::code): 540 to 590 are G54 to G59.
    if (code != 541)
      builder_.work_offset(code / 10 - 53);
    else if (p != nullptr && p->whole() >= 1)
      builder_.work_offset(p->whole() + kLastSimpleOffset);
    else
      builder_.place().refuse("G54.1 without P");
  }

  void miscellaneous(const GWord& word) {
    switch (word.whole()) {
      case 0:
      case 1:
      case 3:
      case 4:
      case 5:
      case 6:
      case 7:
      case 8:
      case 9:
        break;
      case 2:
      case 30:
        ends_ = true;
        break;
      default:
        ignore(word);
    }
  }

  /// A coordinate without a point is a whole number of millimetres on one machine and of micrometres on another.
  [[nodiscard]] double coordinate(const GWord& word) const {
    // Zero is zero in either unit.
    if (!word.point && word.value != 0.0)
      builder_.place().refuse(quoted(word.text) +
                              " has no decimal point; the control may read it as a thousandth of that value");
    return word.value;
  }

  void other(const GWord& word) {
    // What is not refused here but has no effect (H, P, Q, N) is in parameter(): only beside the G word that it
    // belongs to.
    if (is_linear(word.letter)) {
      builder_.linear(static_cast<std::size_t>(word.letter - 'X'), coordinate(word));
    } else if (is_rotary(word.letter)) {
      builder_.rotary(word.letter, coordinate(word));
    } else if (word.letter >= 'I' && word.letter <= 'K') {
      if (!vectors_) refuse_vector(word);
      builder_.vector(static_cast<std::size_t>(word.letter - 'I'), coordinate(word));
    } else if (word.letter == 'F') {
      builder_.feed(word.value);
    } else if (word.letter == 'S' && word.value >= 0.0) {
      builder_.spindle_speed(word.value);
    } else if (word.letter == 'T' && word.whole() >= 0) {
      builder_.call_tool(word.whole());
    } else if (word.letter == 'O' && word.whole() >= 1 && word.whole() <= kLargestProgram) {
      builder_.header().number = word.whole();
    } else if (!parameter(word)) {
      builder_.place().refuse_word(word.text, kName);
    }
  }

  /// G43.4 takes rotary axes: with vectors it is G43.5 that was meant, or the words of another control.
  [[noreturn]] void refuse_vector(const GWord& word) const {
    if (centred_)
      builder_.place().refuse(quoted(word.text) + " is a tool vector under G43.4; expected rotary axes, or G43.5");
    builder_.place().refuse_word(word.text, kName);
  }

  /// Letters that belong to other words of the block.
  [[nodiscard]] bool parameter(const GWord& word) const {
    if (is_parameter_letter(word.letter) && has_ignored()) return true;
    switch (word.letter) {
      case 'N':
        return true;
      case 'H':
        return block_.has_code('G', 434) || block_.has_code('G', 435);
      case 'P':
        return block_.has_code('G', 541) || block_.has_code('G', 40);
      case 'Q':
        return block_.has_code('G', 51);
      default:
        return false;
    }
  }

  [[nodiscard]] bool has_ignored() const {
    return std::any_of(block_.words.begin(), block_.words.end(),
                       [&](const GWord& w) { return is_without_effect(dialect_, w.letter, w.value); });
  }

  ProgramBuilder builder_;
  const NcDialect& dialect_;
  GBlock block_;
  bool vectors_ = false, centred_ = false, ends_ = false;
};

/// As read_nc, for a text that was not recognised as one of another language.
std::vector<NcProgram> read_fanuc(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return FanucReader(file, dialect).read(text);
}

constexpr int kLastSimple = 6, kLastOffset = 54, kLargestWritten = 9999;  // G54.1 P1 to P48 follow G59

/// G54 to G59 for 1 to 6, then the additional frames of G54.1.
std::string work_offset(int number) {
  return number <= kLastSimple ? "G" + std::to_string(53 + number) : "G54.1 P" + std::to_string(number - kLastSimple);
}

/// "O" and four digits, as controls list programs.
std::string program_number(int number) {
  const std::string digits = std::to_string(number);
  return "O" + std::string(4 - digits.size(), '0') + digits;
}

/// One operation: G43.4 with rotary words, G43.5 with the tool vector I J K on every block, or joint coordinates without length
/// compensation. G5.1 Q1 where a smoothing tolerance is given.
void write_operation(GCodeWriter& out, const NcProgram& program, const NcDialect& dialect) {
  const NcHeader& header = program.header;
  const bool tip = program.positions != NcPositions::kJoint, smooth = dialect.smoothing_mm > 0.0;
  const std::string tool = std::to_string(header.tool.number);
  const std::string tcp = (program.positions == NcPositions::kTipVector ? "G43.5 H" : "G43.4 H") + tool;
  const std::string coolant = coolant_words(header);
  out.operation(program);
  const auto retract = [&] {
    // A place of the machine's own Z, where its file gives one; else the reference position.
    if (dialect.retract_mm) return out.retract();
    out.block("G91 G28 Z0.0");
    out.block("G90");
  };
  // Whatever state the last program has left: millimetres, absolute, no compensation, no cycle.
  out.block("G21 G17 G90 G94 G40 G49 G80");
  // Wherever the tool stands: nothing turns before it is out of the way.
  retract();
  out.block("T" + tool + " M6");
  out.block(work_offset(header.work_offset));
  // The rotary axes turn before G43.4 or G43.5: afterwards the control would hold the tip where it is meanwhile.
  out.start_rotary();
  if (const std::string spindle = spindle_words(header); !spindle.empty()) out.block(spindle);
  if (!coolant.empty()) out.block(coolant);
  if (smooth) out.block("G5.1 Q1");
  if (tip) out.block(tcp);
  if (program.feed_mode == NcFeedMode::kInverseTime) out.block("G93");
  out.moves([&](const NcMove& move) {
    // G28 is about the machine's own axes, which tool-centre control would move with the tip in mind.
    if (tip) out.block("G49");
    retract();
    out.rotary_of(move);
    if (tip) out.block(tcp);
  });
  // Programs end in the state in which they are expected to begin.
  if (program.feed_mode == NcFeedMode::kInverseTime) out.block("G94");
  if (tip) out.block("G49");
  if (smooth) out.block("G5.1 Q0");
  retract();
  if (!coolant.empty()) out.block("M9");
  out.block("M5");
  out.end_rotary();
}

/// As write_nc, for operations that passed its checks.
std::string write_fanuc(std::span<const NcProgram> operations, const NcDialect& dialect) {
  const NcHeader& header = operations.front().header;
  if (header.work_offset > kLastOffset) throw UsageError("dialect", "fanuc", "has work offsets 1 to 54");
  if (header.number < 1 || header.number > kLargestWritten)
    throw UsageError("dialect", "fanuc", "has program numbers 1 to 9999");
  GCodeWriter out(operations, dialect, {"(", ")", true, {"I", "J", "K"}});
  out.raw("%");
  out.raw(program_number(header.number) + " " + out.comment_text(safe_comment(header.program)));
  for (const NcProgram& operation : operations) write_operation(out, operation, dialect);
  out.block("M30");
  out.raw("%");
  return out.take();
}

/// "O0001" and ":0001", which begin a program of Fanuc; "O100 SUB" is LinuxCNC's.
bool is_program_number(std::string_view code) {
  if (code.size() < 2 || (code[0] != 'O' && code[0] != ':')) return false;
  return std::all_of(code.begin() + 1, code.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

constexpr NcLanguageRow kFanucRow{
    .language = NcLanguage::kFanuc,
    .name = "fanuc",
    .title = kName,
    .read = read_fanuc,
    .write = write_fanuc,
    .is_first = is_program_number,
    .anywhere = {"G43.4", "G43.5", "G5.1"},
    // Plain G-code is LinuxCNC's where nothing else is said; a program for Fanuc has words that only it has.
    .always_has = "program number (O0001), G43.4 or G43.5",
};

}  // namespace flank::internal

#include "flank/machine/nc/read/read_fanuc.h"

#include <algorithm>

#include "flank/machine/nc/read/gcode_words.h"
#include "flank/machine/nc/read/program_builder.h"
#include "flank/machine/nc/without_effect.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "Fanuc";
constexpr double kInch = 25.4;
constexpr int kLastSimpleOffset = 6, kLargestProgram = 99999999;  // G54 to G59; G54.1 P1 is offset 7

class FanucReader {
 public:
  FanucReader(const std::string& file, const NcDialect& dialect) : builder_(file, dialect), dialect_(dialect) {}

  NcProgram read(std::string_view text) {
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
          builder_.place().refuse(quoted(word.text) + " passes a point of the part; accepted is G91 G28");
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
                              " has no decimal point, and may be a thousandth of it on the machine");
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
      builder_.place().refuse(quoted(word.text) + " is a tool vector under G43.4; accepted are rotary axes, or G43.5");
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

}  // namespace

NcProgram read_fanuc(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return FanucReader(file, dialect).read(text);
}

}  // namespace flank::internal

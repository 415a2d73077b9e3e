#include "flank/machine/nc/dialects/linuxcnc.h"

#include <algorithm>
#include <vector>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/read/gcode_words.h"
#include "flank/machine/nc/read/program_builder.h"
#include "flank/machine/nc/without_effect.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "LinuxCNC";
constexpr double kInch = 25.4;

class LinuxCncReader {
 public:
  LinuxCncReader(const std::string& file, const NcDialect& dialect)
      : builder_(file, dialect),
        dialect_(dialect),
        tcp_on_(words_of(dialect.tcp_on)),
        tcp_off_(words_of(dialect.tcp_off)) {
    // It interpolates its axes linearly; no word changes that.
    builder_.join(NcJoin::kAxes);
    // G43 is a word of its own here: from now on the builder holds feed moves to it.
    builder_.length_compensation(false);
    // Where the machine switches its kinematics by M words, what stands before the first of them is joint
    // coordinates. Where it does not, no word says which of the two they are: the machine's file does.
    builder_.allow_joint(!tcp_on_.empty() || dialect.positions == NcPositions::kJoint);
    if (tcp_on_.empty() && dialect.positions != NcPositions::kJoint) builder_.tool_centre(true);
  }

  std::vector<NcProgram> read(std::string_view text) {
    NcLines lines(text);
    while (lines.next()) {
      builder_.at(lines.number());
      split_gcode(lines.line(), lines.upper(), builder_.place(), block_);
      for (const std::string_view comment : block_.comments) builder_.comment(comment);
      if (block_.percent) percent();
      if (block_.words.empty()) continue;
      if (builder_.ended()) builder_.place().refuse("a block after the end of the program");
      block();
    }
    return builder_.finish();
  }

 private:
  /// Of a machine's file.
  [[nodiscard]] static std::vector<GWord> words_of(const std::string& text) {
    GBlock block;
    split_gcode(text, upper_case(text), NcPlace{"the machine's tcp_on or tcp_off"}, block);
    return block.words;
  }

  /// A file between two percent signs ends with the second.
  /// A first "%" only opens the file if nothing came before it.
  void percent() {
    if (opened_) builder_.end_program();
    opened_ = true;
  }

  void block() {
    opened_ = opened_ || !block_.words.empty();
    require_same_if_skipped(block_, dialect_, builder_.place());
    if (switches()) return builder_.end_block();
    for (const GWord& word : block_.words) {
      switch (word.letter) {
        case 'G':
          preparatory(word);
          break;
        case 'M':
          miscellaneous(word);
          break;
        default:
          other(word);
      }
    }
    modes_behind_words();
    builder_.end_block();
    if (ends_) builder_.end_program();
  }

  /// The machine's own words for its kinematics.
  bool switches() {
    const bool on = has_words(block_, tcp_on_), off = has_words(block_, tcp_off_);
    if (!on && !off) return false;
    // Beside other words it would matter which of them the machine runs first, and that is its remapping's own
    // business.
    const std::size_t own = (on ? tcp_on_ : tcp_off_).size() + (block_.find('N') != nullptr ? 1 : 0);
    if (block_.words.size() > own)
      builder_.place().refuse(quoted(block_.words.back().text) +
                              " stands beside the word that switches the kinematics; expected a block of its own");
    builder_.tool_centre(on);
    return true;
  }

  /// T, S and H may stand on either side of the words that they belong to.
  void modes_behind_words() {
    if (block_.has_code('M', 60)) builder_.change_tool();
    if (block_.has_code('M', 30) || block_.has_code('M', 40)) builder_.spindle_turns(true);
    if (block_.has_code('M', 50)) builder_.spindle_turns(false);
    if (block_.has_code('G', 490)) builder_.length_of(0);
    if (!block_.has_code('G', 430)) return;
    // G43 alone takes the tool in the spindle.
    const GWord* const h = block_.find('H');
    if (h == nullptr) return builder_.own_length();
    if (h->whole() < 0) builder_.place().refuse_word(h->text, kName);
    builder_.length_of(h->whole());
  }

  void preparatory(const GWord& word) {
    const int code = word.code();
    // In tenths: G54 to G59 are 540 to 590, G59.1 to G59.3 are 591 to 593 and follow them as offsets 7 to 9.
    if (code >= 540 && code <= 593 && (code % 10 == 0 || code > 590)) {
      builder_.work_offset(code > 590 ? code - 590 + 6 : code / 10 - 53);
      return;
    }
    switch (code) {
      case 0:
      case 10:
        builder_.motion(code == 0 ? NcKind::kRapid : NcKind::kFeed);
        break;
      case 40:  // dwell
      case 170:
      case 400:
      case 610:
      case 640:
      case 800:
      case 900:
      case 910:
        // G91 is taken note of, not refused: only a move under it is (end_block), since G91 G28 goes to the reference
        // position.
        if (code >= 900) builder_.incremental(code == 910);
        break;
      case 200:
      case 210:
        builder_.unit(code == 200 ? kInch : 1.0);
        break;
      // The axes of G28 and G30 are an intermediate point; only with G91 it is where the machine stands.
      case 280:
      case 300:
        if (!block_.has_code('G', 910))
          builder_.place().refuse(quoted(word.text) + " goes by way of a point in part coordinates; expected G91 G28");
        builder_.to_reference();
        break;
      case 430:
      case 490:
        builder_.length_compensation(code == 430);
        break;
      case 530:
        builder_.to_reference();
        break;
      case 930:
      case 940:
        builder_.feed_mode(code == 930 ? NcFeedMode::kInverseTime : NcFeedMode::kPerMinute);
        break;
      default:
        ignore(word);
    }
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

  /// A word that the machine's file calls without effect; refuses any other.
  void ignore(const GWord& word) const {
    if (!is_without_effect(dialect_, word.letter, word.value)) builder_.place().refuse_word(word.text, kName);
  }

  void other(const GWord& word) {
    if (is_linear(word.letter)) {
      builder_.linear(static_cast<std::size_t>(word.letter - 'X'), word.value);
    } else if (is_rotary(word.letter)) {
      builder_.rotary(word.letter, word.value);
    } else if (word.letter == 'F') {
      builder_.feed(word.value);
    } else if (word.letter == 'S' && word.value >= 0.0) {
      builder_.spindle_speed(word.value);
    } else if (word.letter == 'T' && word.whole() >= 0) {
      builder_.call_tool(word.whole());
    } else if (!parameter(word)) {
      builder_.place().refuse_word(word.text, kName);
    }
  }

  /// Letters that belong to other words of the block.
  [[nodiscard]] bool parameter(const GWord& word) const {
    // H is the tool's length of G43, P and Q are the tolerances of G64, and P is the time of G4.
    if (is_parameter_letter(word.letter) && has_ignored()) return true;
    switch (word.letter) {
      case 'N':
        return true;
      case 'H':
        return block_.has_code('G', 430);
      case 'P':
        return block_.has_code('G', 640) || block_.has_code('G', 40);
      case 'Q':
        return block_.has_code('G', 640);
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
  std::vector<GWord> tcp_on_, tcp_off_;  ///< their texts are not kept
  GBlock block_;
  bool opened_ = false, ends_ = false;
};

/// As read_nc, for a text that was not recognised as one of another language.
std::vector<NcProgram> read_linuxcnc(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return LinuxCncReader(file, dialect).read(text);
}

/// Degrees per minute with which the rotary axes turn where kinematics cannot be switched off meanwhile.
constexpr double kTurnFeed = 600.0;
constexpr int kFirstOfExtended = 7, kLastOffset = 9;  // G59.1 to G59.3 follow G59

/// What LinuxCNC cannot say, as a user's error: another dialect, or another entry in the machine's file, mends it.
void refuse_unsayable(const NcProgram& program, const NcDialect& dialect) {
  if (program.positions == NcPositions::kTipVector)
    throw UsageError("dialect", "linuxcnc", "has no tool vectors; expected rotary axes or axis positions");
  if (program.join == NcJoin::kGreatCircle)
    throw UsageError("dialect", "linuxcnc", "joins blocks linearly in its axes, never on a great circle");
  if (program.header.work_offset > kLastOffset)
    throw UsageError("dialect", "linuxcnc", "has work offsets 1 to 9 (G54 to G59.3)");
  if (dialect.tcp_on.empty() != dialect.tcp_off.empty())
    throw UsageError("dialect", "linuxcnc", "needs both words that switch its kinematics, or neither");
  // Only where kinematics are switched is there a stretch in joint coordinates, in which the rotary axes can turn by
  // themselves before the next move.
  if (!dialect.tcp_on.empty() && program.positions != NcPositions::kJoint) return;
  for (std::size_t i = 1; i < program.moves.size(); ++i)
    if (!program.moves[i].joined)
      throw UsageError("dialect", "linuxcnc",
                       "cannot go to a reference position between two moves unless its kinematics are switched");
}

std::string work_offset(int number) {
  return number < kFirstOfExtended ? "G" + std::to_string(53 + number)
                                   : "G59." + std::to_string(number - kFirstOfExtended + 1);
}

/// G61 keeps the exact path; G64 P blends corners within the tolerance. Q0 keeps it from leaving out points on its
/// own.
std::string smoothing(const NcDialect& dialect) {
  if (dialect.smoothing_mm <= 0.0) return "G61";
  std::string words = "G64 P";
  append_decimal(words, dialect.smoothing_mm, kMostNcDecimals);
  return words + " Q0.0";
}

/// One operation. Tool-centre control is the machine's kinematics, switched by the dialect's M words where it has some; joint
/// coordinates stand without length compensation.
void write_operation(GCodeWriter& out, const NcProgram& program, const NcDialect& dialect) {
  const NcHeader& header = program.header;
  const bool tip = program.positions != NcPositions::kJoint, switched = tip && !dialect.tcp_on.empty();
  const std::string tool = std::to_string(header.tool.number), coolant = coolant_words(header);
  out.operation(program);
  out.block("G21 G17 G90 G94 G40 G49 G80");
  out.block(smoothing(dialect));
  // Wherever the tool stands: nothing turns before it is out of the way.
  if (switched) out.block(dialect.tcp_off);
  out.retract();
  out.block("T" + tool + " M6");
  out.block(work_offset(header.work_offset));
  // Without a word for them the kinematics hold the gauge point meanwhile, which no rapid may do.
  out.start_rotary(tip && !switched ? kTurnFeed : 0.0);
  // The kinematics take the tool's length from here; joints are stated for none. They do not jump: the tool stands upright.
  if (tip) out.block("G43 H" + tool);
  if (const std::string spindle = spindle_words(header); !spindle.empty()) out.block(spindle);
  if (!coolant.empty()) out.block(coolant);
  if (switched) out.block(dialect.tcp_on);
  // From here on: a G0 under G93 is right, but nothing before it needs G93.
  if (program.feed_mode == NcFeedMode::kInverseTime) out.block("G93");
  out.moves([&](const NcMove& move) {
    if (switched) out.block(dialect.tcp_off);
    out.retract();
    out.rotary_of(move);
    if (switched) out.block(dialect.tcp_on);
  });
  if (switched) out.block(dialect.tcp_off);
  // Upright once more: without the tool's length the kinematics hold the joints where they are.
  out.block("G94 G49");
  out.retract();
  if (!coolant.empty()) out.block("M9");
  out.block("M5");
  if (!tip || switched) out.end_rotary();
}

/// As write_nc, for operations that passed its checks.
std::string write_linuxcnc(std::span<const NcProgram> operations, const NcDialect& dialect) {
  for (const NcProgram& operation : operations) refuse_unsayable(operation, dialect);
  GCodeWriter out(operations, dialect, {});
  out.raw("%");
  out.comment(safe_comment("PROGRAM " + operations.front().header.program));
  for (const NcProgram& operation : operations) write_operation(out, operation, dialect);
  out.block("M2");
  out.raw("%");
  return out.take();
}

}  // namespace

constexpr NcLanguageRow kLinuxCncRow{
    .language = NcLanguage::kLinuxCnc,
    .name = "linuxcnc",
    .title = kName,
    .read = read_linuxcnc,
    .write = write_linuxcnc,
    // Of G-code in general, but not of Siemens, where nothing better is found.
    .plain = {"G21", "G20", "G43"},
    .great_circle = false,
    .vectors = false,
    .retract_word = false,
};

}  // namespace flank::internal

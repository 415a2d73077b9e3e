#include "flank/machine/nc/write/write_heidenhain.h"

#include <array>
#include <cctype>
#include <string_view>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr std::size_t kBytesOfMove = 80;  // of a block as it usually is: the text is reserved once

/// The name of a program is the name of its file: letters, digits and _.
std::string program_name(const std::string& name) {
  std::string out = name.substr(0, 32);
  for (char& c : out)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return out.empty() ? "FLANK" : out;
}

class HeidenhainWriter {
 public:
  HeidenhainWriter(std::span<const NcProgram> operations, const NcDialect& dialect)
      : operations_(operations),
        program_(&operations.front()),
        dialect_(dialect),
        style_{dialect.decimal_comma ? ',' : '.', true} {
    // The control takes coordinates with a sign; feeds, speeds and tolerances have none.
    unsigned_ = style_;
    unsigned_.plus = false;
    std::size_t moves = 0;
    for (const NcProgram& operation : operations) moves += operation.moves.size();
    text_.reserve(1000 * operations.size() + kBytesOfMove * moves);
  }

  std::string write() {
    const std::string name = program_name(program_->header.program) + " MM";
    block("BEGIN PGM " + name);
    for (const NcProgram& operation : operations_) {
      program_ = &operation;
      feed_.clear();
      write_operation();
    }
    block("M30");
    block("END PGM " + name);
    return std::move(text_);
  }

 private:
  void write_operation() {
    // Rotary axes first, in the air and without tool-centre control: switched on before, the tip would be held in
    // place and the linear axes would run after it.
    header();
    start_rotary();
    tool_centre(true);
    moves();
    tool_centre(false);
    // Away from the part before the spindle stops.
    retract();
    if (!program_->header.coolant.empty()) block("M9");
    block("M5");
    if (program_->end_rotary) rotary_block(program_->end_rotary->x(), program_->end_rotary->y());
  }

  /// M128 always runs the rotary axes linearly: only the function can say that the tool turns on a great circle.
  [[nodiscard]] bool function() const { return dialect_.function_tcpm || program_->join == NcJoin::kGreatCircle; }

  void begin() { (text_ += std::to_string(number_++)) += ' '; }
  void block(std::string_view words) {
    begin();
    (text_ += words) += '\n';
  }

  void header() {
    const NcHeader& h = program_->header;
    for (const std::string& line : header_comments(h)) block("; " + line);
    // Wherever the tool stands, and whatever the last program has left: nothing turns before it is out of the way.
    tool_centre(false);
    retract();
    std::string call = "TOOL CALL " + std::to_string(h.tool.number) + " Z";
    if (h.spindle_rpm > 0.0) append_short_decimal(call += " S", h.spindle_rpm, 3, unsigned_);
    block(call);
    block("CYCL DEF 247 Q339=" + std::to_string(h.work_offset));
    if (dialect_.smoothing_mm > 0.0) tolerance();
    if (h.spindle_rpm > 0.0) block("M3");
    if (!h.coolant.empty()) block(h.coolant == "mist" ? "M7" : "M8");
    // Rotary axes take the shorter way, which is what the unwound values of our blocks mean.
    block("M126");
  }

  /// To a place of the machine's own Z, where its file gives one; else back along the tool's axis to the end of the travel.
  void retract() {
    if (!dialect_.retract_mm) return block("L M140 MB MAX FMAX");
    std::string words = "L Z";
    append_decimal(words, *dialect_.retract_mm, dialect_.length_decimals, style_);
    block(words + " R0 FMAX M91");
  }

  void tolerance() {
    block("CYCL DEF 32.0 TOLERANCE");
    std::string words = "CYCL DEF 32.1 T";
    append_decimal(words, dialect_.smoothing_mm, kMostNcDecimals, unsigned_);
    block(words);
    words = "CYCL DEF 32.2 HSC-MODE:0 TA";
    append_decimal(words, dialect_.smoothing_deg, kMostNcDecimals, unsigned_);
    // TA only where it is given: 0 would be a demand, and the control takes a default without it.
    if (dialect_.smoothing_deg > 0.0) block(words);
  }

  void tool_centre(bool on) {
    if (!on)
      block(function() ? "FUNCTION RESET TCPM" : "M129");
    else if (!function())
      block("M128");
    else
      block(program_->join == NcJoin::kGreatCircle ? "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR"
                                                   : "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS");
  }

  void rotary(double first, double second) {
    append_decimal((text_ += ' ') += program_->rotary[0], first, dialect_.angle_decimals, style_);
    append_decimal((text_ += ' ') += program_->rotary[1], second, dialect_.angle_decimals, style_);
  }
  void rotary_block(double first, double second) {
    begin();
    text_ += 'L';
    rotary(first, second);
    text_ += " R0 FMAX\n";
  }
  void rotary_of(const NcMove& m) {
    if (program_->positions != NcPositions::kTipVector) rotary_block(m.orientation.x(), m.orientation.y());
  }
  /// The angles from which the path begins: where blocks state tool vectors, they decide which solution the control
  /// takes.
  void start_rotary() {
    if (program_->positions == NcPositions::kTipVector && program_->start_rotary)
      rotary_block(program_->start_rotary->x(), program_->start_rotary->y());
    else
      rotary_of(program_->moves.front());
  }

  void moves() {
    std::int32_t strip = -1;
    for (std::size_t i = 0; i < program_->moves.size(); ++i) {
      const NcMove& m = program_->moves[i];
      if (m.strip != strip)
        block("; " + (m.strip < 0 ? std::string(kEndOfStrip)
                                  : strip_comment(program_->strips[static_cast<std::size_t>(m.strip)])));
      strip = m.strip;
      // The machine leaves its reference position anew: as at the beginning, axes turn without tool-centre control.
      if (!m.joined && i > 0) {
        tool_centre(false);
        retract();
        rotary_of(m);
        tool_centre(true);
      }
      if (m.kind == NcKind::kRapid && (i == 0 || !m.joined))
        approach(m);
      else
        move(m);
    }
  }

  void axes(const NcMove& m, int from, int to) {
    for (int i = from; i <= to; ++i)
      append_decimal((text_ += ' ') += static_cast<char>('X' + i), m.position[i], dialect_.length_decimals, style_);
  }

  /// From the safe place: over the point first, then down to it. The rotary axes are there already.
  void approach(const NcMove& m) {
    begin();
    text_ += 'L';
    axes(m, 0, 1);
    text_ += " FMAX\n";
    if (program_->positions == NcPositions::kTipVector) return move(m);
    begin();
    text_ += 'L';
    axes(m, 2, 2);
    text_ += " FMAX\n";
  }

  void move(const NcMove& m) {
    static constexpr std::array<std::string_view, 3> kVector = {" TX", " TY", " TZ"};
    const bool vector = program_->positions == NcPositions::kTipVector;
    begin();
    text_ += vector ? "LN" : "L";
    axes(m, 0, 2);
    if (vector)
      for (int i = 0; i < 3; ++i)
        append_decimal(text_ += kVector[static_cast<std::size_t>(i)], m.orientation[i], dialect_.vector_decimals,
                       style_);
    else if (m.kind == NcKind::kFeed)  // a rapid leaves the rotary axes where they are (write_nc.cpp)
      rotary(m.orientation.x(), m.orientation.y());
    if (m.kind == NcKind::kRapid)
      text_ += " FMAX";
    else
      feed(m);
    text_ += '\n';
  }

  /// F is modal and FMAX is not: the last F holds again after a rapid block, so only a change is written.
  void feed(const NcMove& m) {
    std::string feed = " F";
    append_short_decimal(feed, m.feed, nc_feed_decimals(program_->feed_mode, m.feed, dialect_), unsigned_);
    if (feed == feed_) return;
    text_ += feed;
    feed_ = std::move(feed);
  }

  std::span<const NcProgram> operations_;
  const NcProgram* program_;
  const NcDialect& dialect_;
  NcNumberStyle style_, unsigned_;
  std::string text_, feed_;
  long number_ = 0;
};

}  // namespace

std::string write_heidenhain(std::span<const NcProgram> operations, const NcDialect& dialect) {
  if (operations.front().feed_mode == NcFeedMode::kInverseTime)
    throw UsageError("dialect", "heidenhain", "has no inverse time; expected a feed in mm/min");
  if (operations.front().positions == NcPositions::kJoint)
    throw UsageError(
        "dialect", "heidenhain",
        "always compensates the tool's length; expected coordinates of the controlled point, not axis positions");
  return HeidenhainWriter(operations, dialect).write();
}

}  // namespace flank::internal

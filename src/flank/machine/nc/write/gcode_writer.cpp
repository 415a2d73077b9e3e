#include "flank/machine/nc/write/gcode_writer.h"

#include <cctype>
#include <utility>

#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr long kNumberStep = 10, kLargestNumber = 99990;  // N words have at most five digits: then they begin again
/// Of a program of several operations all blocks but their first have larger numbers than those.
constexpr long kAboveOperations = 10'000;
constexpr std::size_t kBytesOfMove = 80;  // of a block as it usually is: the text is reserved once

}  // namespace

GCodeWriter::GCodeWriter(std::span<const NcProgram> operations, const NcDialect& dialect, GCodeStyle style)
    : program_(&operations.front()), dialect_(dialect), style_(style) {
  std::size_t moves = 0;
  for (const NcProgram& operation : operations) moves += operation.moves.size();
  text_.reserve(1000 * operations.size() + kBytesOfMove * moves);
  if (operations.size() > 1) number_ = first_number_ = kAboveOperations;
}

void GCodeWriter::operation(const NcProgram& program) {
  program_ = &program;
  motion_ = "";
  feed_.clear();
  for (const std::string& line : header_comments(program.header)) comment(line);
  if (program.header.operation) enter_ = program.header.operation->number;
}

void GCodeWriter::raw(std::string_view line) { (text_ += line) += '\n'; }

/// Between the dialect's signs, and in upper case where the control shows no small letters.
std::string GCodeWriter::comment_text(std::string_view text) const {
  std::string out(text);
  if (style_.upper_comments)
    for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return std::string(style_.comment_begin) + out + std::string(style_.comment_end);
}

void GCodeWriter::comment(std::string_view text) { raw(comment_text(text)); }

void GCodeWriter::begin() {
  const int enter = std::exchange(enter_, 0);
  if (enter > 0) {
    ((text_ += 'N') += std::to_string(enter)) += ' ';
    return;
  }
  if (!dialect_.line_numbers) return;
  number_ = number_ + kNumberStep > kLargestNumber ? first_number_ + kNumberStep : number_ + kNumberStep;
  ((text_ += 'N') += std::to_string(number_)) += ' ';
}

void GCodeWriter::block(std::string_view words) {
  begin();
  text_ += words;
  end();
  // The block may have stated a motion word of its own ("G91 G28"): the next move says again which one holds.
  motion_ = "";
}

void GCodeWriter::rotary(double first, double second, double feed) {
  begin();
  motion_ = feed > 0.0 ? "G1" : "G0";
  (text_ += motion_) += ' ';
  append_decimal(text_ += program_->rotary[0], first, dialect_.angle_decimals);
  append_decimal((text_ += ' ') += program_->rotary[1], second, dialect_.angle_decimals);
  if (feed > 0.0) append_decimal(text_ += " F", feed, dialect_.feed_decimals);
  end();
}

void GCodeWriter::start_rotary(double feed) {
  const Vec3& first = program_->moves.front().orientation;
  // Moves that state the rotary axes begin where the first of them has them.
  if (program_->positions != NcPositions::kTipVector)
    rotary(first.x(), first.y(), feed);
  else if (program_->start_rotary)
    rotary(program_->start_rotary->x(), program_->start_rotary->y(), feed);
}

void GCodeWriter::end_rotary() {
  if (program_->end_rotary) rotary(program_->end_rotary->x(), program_->end_rotary->y());
}

void GCodeWriter::retract() {
  std::string words = "G53 G0 Z";
  append_decimal(words, dialect_.retract_mm.value_or(0.0), dialect_.length_decimals);
  block(words);
}

void GCodeWriter::rotary_of(const NcMove& move) {
  if (program_->positions != NcPositions::kTipVector) rotary(move.orientation.x(), move.orientation.y());
}

void GCodeWriter::feed(const NcMove& move) {
  const bool inverse = program_->feed_mode == NcFeedMode::kInverseTime;
  std::string feed = " F";
  append_decimal(feed, move.feed, nc_feed_decimals(program_->feed_mode, move.feed, dialect_));
  // In inverse time F is the time of one block: controls demand it in each. Compared as text, so that feeds which
  // differ in digits that are not written count as the same.
  if (!inverse && feed == feed_) return;
  text_ += feed;
  feed_ = std::move(feed);
}

/// X to Z, as far as asked for.
void GCodeWriter::axes(const NcMove& move, int from, int to) {
  for (int i = from; i <= to; ++i) {
    if (i > from) text_ += ' ';
    append_decimal(text_ += static_cast<char>('X' + i), move.position[i], dialect_.length_decimals);
  }
}

void GCodeWriter::orientation(const NcMove& move) {
  if (program_->positions == NcPositions::kTipVector) {
    for (int i = 0; i < 3; ++i)
      append_decimal((text_ += ' ') += style_.vector[static_cast<std::size_t>(i)], move.orientation[i],
                     dialect_.vector_decimals);
    return;
  }
  // Under tool-centre control a rapid leaves the rotary axes where they are (write_nc.cpp): it need not name them.
  if (program_->positions == NcPositions::kTipRotary && move.kind == NcKind::kRapid) return;
  for (int i = 0; i < 2; ++i)
    append_decimal((text_ += ' ') += program_->rotary[static_cast<std::size_t>(i)], move.orientation[i],
                   dialect_.angle_decimals);
}

/// From the safe place: over the point first, then down to it. The rotary axes are there already.
void GCodeWriter::approach(const NcMove& move) {
  begin();
  text_ += "G0 ";
  motion_ = "G0";
  axes(move, 0, 1);
  end();
  begin();
  axes(move, 2, 2);
  if (program_->positions == NcPositions::kTipVector) orientation(move);
  end();
}

void GCodeWriter::move(const NcMove& move) {
  begin();
  const char* const motion = move.kind == NcKind::kRapid ? "G0" : "G1";
  if (std::string_view(motion) != motion_) (text_ += motion) += ' ';
  motion_ = motion;
  axes(move, 0, 2);
  orientation(move);
  if (move.kind == NcKind::kFeed) feed(move);
  end();
}

void GCodeWriter::moves(const std::function<void(const NcMove&)>& from_reference) {
  std::int32_t strip = -1;
  for (std::size_t i = 0; i < program_->moves.size(); ++i) {
    const NcMove& m = program_->moves[i];
    if (m.strip != strip)
      comment(m.strip < 0 ? std::string(kEndOfStrip)
                          : strip_comment(program_->strips[static_cast<std::size_t>(m.strip)]));
    strip = m.strip;
    // The first move comes from the header, which has turned the axes and switched on what is needed.
    if (!m.joined && i > 0) {
      from_reference(m);
      // What stands between may have changed the feed mode; stating F once more costs nothing.
      feed_.clear();
    }
    if (m.kind == NcKind::kRapid && (i == 0 || !m.joined))
      approach(m);
    else
      move(m);
  }
}

std::string spindle_words(const NcHeader& header) {
  if (header.spindle_rpm <= 0.0) return {};
  std::string words = "S";
  append_short_decimal(words, header.spindle_rpm, 3);
  return words + " M3";
}

std::string coolant_words(const NcHeader& header) {
  return header.coolant.empty() ? "" : header.coolant == "mist" ? "M7" : "M8";
}

}  // namespace flank::internal

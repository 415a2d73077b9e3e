/// Blocks of letters and numbers, as LinuxCNC, Fanuc and Siemens have them.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// What differs between these dialects.
struct GCodeStyle {
  std::string_view comment_begin = "(", comment_end = ")";
  bool upper_comments = false;
  std::array<std::string_view, 3> vector;  ///< addresses of the tool vector
};

/// Writes blocks one after the other. Motion words and feeds are modal: they are written where they change.
class GCodeWriter {
 public:
  /// Both must outlive this. Begins with the first of the operations.
  GCodeWriter(std::span<const NcProgram> operations, const NcDialect& dialect, GCodeStyle style);

  /// Goes on with this operation: its comments, and of several a number to enter the program at ("N2") in its first block.
  void operation(const NcProgram& program);

  /// A line as it stands, without a number.
  void raw(std::string_view line);
  void comment(std::string_view text);
  [[nodiscard]] std::string comment_text(std::string_view text) const;
  /// A block of these words; the next move states its motion word again.
  void block(std::string_view words);
  /// The two rotary axes at rapid, where the program begins, or at a feed in degrees per minute where tool-centre control
  /// cannot be switched off meanwhile.
  void start_rotary(double feed = 0.0);
  /// The rotary axes of a move at rapid; nothing where moves state vectors.
  void rotary_of(const NcMove& move);
  /// The rotary axes where the program leaves them, if it says so.
  void end_rotary();
  /// The tool out of the way: the machine's own Z.
  void retract();
  /// All moves. `from_reference` writes what stands before a move that comes from the reference position, but the first.
  void moves(const std::function<void(const NcMove&)>& from_reference);

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void begin();
  void end() { text_ += '\n'; }
  void rotary(double first, double second, double feed = 0.0);
  void axes(const NcMove& move, int from, int to);
  void orientation(const NcMove& move);
  void approach(const NcMove& move);
  void move(const NcMove& move);
  void feed(const NcMove& move);

  const NcProgram* program_;
  const NcDialect& dialect_;
  GCodeStyle style_;
  std::string text_;
  long number_ = 0, first_number_ = 0;
  int enter_ = 0;  ///< number of the operation that the next block begins; 0: none
  const char* motion_ = "";
  std::string feed_;
};

/// " S5000 M3" of the header; empty without a spindle.
[[nodiscard]] std::string spindle_words(const NcHeader& header);
/// "M8" or "M7" of the header; empty where the coolant is off.
[[nodiscard]] std::string coolant_words(const NcHeader& header);

}  // namespace flank::internal

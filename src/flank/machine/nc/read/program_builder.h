/// Blocks of any dialect, one after the other, into a program: what is modal, what is known, and what must be refused.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/nc/dialect.h"
#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

/// A reader states the words of a block in any order and ends the block; the builder keeps what is modal. Rapid moves
/// before position and orientation are known in full are the approach: they say where things stand, and are no moves.
/// Everything throws InputError with the present line.
class ProgramBuilder {
 public:
  ProgramBuilder(const std::string& file, const NcDialect& dialect);

  void at(int line) { place_.line = line; }
  [[nodiscard]] const NcPlace& place() const { return place_; }
  [[nodiscard]] NcHeader& header() { return program_.header; }

  /// Takes what our own comments say: part, tool, strips. Others say nothing. `upper`: the dialect writes them in upper
  /// case.
  void comment(std::string_view text, bool upper = false);

  // What is modal.
  /// Of coordinates, and of feeds, which not all words for units change.
  void unit(double millimetres) { unit(millimetres, millimetres); }
  void unit(double millimetres, double feed_millimetres);
  void work_offset(int number);
  void feed_mode(NcFeedMode mode) { mode_ = mode; }
  void join(NcJoin join) { join_ = join; }
  void tool_centre(bool on);
  /// Whether joint coordinates can be read at all; where not, feed moves need tool-centre control.
  void allow_joint(bool allowed) { joint_allowed_ = allowed; }
  /// Length compensation, where it is a word of its own: feed moves need it under tool-centre control and forbid it
  /// without.
  void length_compensation(bool on) { length_ = on; }
  /// The tool whose length counts from here on; 0: of none.
  void length_of(int tool) { modes_.length = tool; }
  /// The length of the tool in the spindle, whichever it is.
  void own_length() { modes_.length = modes_.tool; }
  void edge(int number) { modes_.edge = number; }
  /// A tool is called, and is the one in the spindle from here on, or when it is changed.
  void call_tool(int number);
  void call_tool(std::string_view name);
  void change_tool();
  /// Not every control needs a word that changes the tool.
  void change_at_call(bool at_call) { change_at_call_ = at_call; }
  void spindle_speed(double turns);
  void spindle_turns(bool turns);
  void incremental(bool on) { incremental_ = on; }
  void motion(NcKind kind);

  // The words of this block.
  void linear(std::size_t axis, double value);
  void rotary(char letter, double value);
  void vector(std::size_t component, double value);
  void feed(double value);
  void rapid() { block_.rapid = true; }             ///< this block alone
  void to_reference() { block_.reference = true; }  ///< this block goes to a point of the machine
  [[nodiscard]] bool moves() const;                 ///< whether the block states an axis

  void end_block();
  /// The word that ends a program. Anything but comments after it is refused.
  void end_program() { ended_ = true; }
  [[nodiscard]] bool ended() const { return ended_; }
  /// The program's operations in their order, each a program; one where no comment of ours begins an operation.
  [[nodiscard]] std::vector<NcProgram> finish();

 private:
  struct Block {
    std::array<std::optional<double>, 3> linear, vector;
    std::array<std::optional<double>, 2> rotary;
    std::optional<double> feed;
    bool rapid = false, reference = false, motion = false;
  };

  void begin_operation(const NcOperation& operation);
  void end_operation();
  void go_to_reference();
  void apply_words();
  void apply_vector();
  void forget_position();
  void record(NcKind kind);
  [[nodiscard]] NcPositions stated() const;
  [[nodiscard]] std::string unknown() const;
  void restart_unless_cut(const std::string& why);
  void check_feed_move();
  [[nodiscard]] double feed_of_move();
  [[nodiscard]] std::int32_t present_modes();

  NcPlace place_;
  NcDialect dialect_;
  NcProgram program_;
  std::vector<NcProgram> done_;  ///< the operations before it
  Block block_;
  std::map<std::string, std::int32_t> strips_;  ///< by what their comment says
  std::int32_t strip_ = -1;

  std::array<std::optional<double>, 3> linear_;
  std::array<std::optional<double>, 2> rotary_, rotary_before_;
  std::optional<Vec3> vector_;
  std::optional<double> feed_;
  std::optional<NcKind> motion_;
  std::optional<bool> length_;
  NcFeedMode mode_ = NcFeedMode::kPerMinute;
  NcJoin join_ = NcJoin::kAxes;
  double unit_ = 1.0, feed_unit_ = 1.0;
  bool tool_centre_ = false, switched_ = false, joint_allowed_ = true, incremental_ = false;
  bool by_vector_ = false;  ///< what was stated last: vector or rotary values
  bool joined_ = false, cut_ = false, ended_ = false;
  NcModes modes_;
  std::optional<int> called_;  ///< and not in the spindle yet
  std::string called_name_;
  double turns_per_minute_ = 0.0;
  bool turns_ = false, change_at_call_ = false;
};

}  // namespace flank::internal

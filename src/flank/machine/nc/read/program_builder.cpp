#include "flank/machine/nc/read/program_builder.h"

#include <cmath>

#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr double kShortestVector = 1e-3;  // shorter ones have lost their direction to rounding
constexpr std::array<char, 3> kLinearName = {'X', 'Y', 'Z'};

/// Values that no machine reaches are refused: what is computed with the others stays finite.
void check_size(double value, const NcPlace& place) {
  if (!(std::abs(value) <= kLargestNcValue)) place.refuse("a value beyond 1000000");
}

/// Whether every one of the optional values is known.
bool all(const auto& values) {
  for (const auto& v : values)
    if (!v) return false;
  return true;
}

/// Whether at least one of the optional values is known.
bool any(const auto& values) {
  for (const auto& v : values)
    if (v) return true;
  return false;
}

}  // namespace

ProgramBuilder::ProgramBuilder(const std::string& file, const NcDialect& dialect)
    : place_{file}, dialect_(dialect), join_(dialect.join) {
  program_.rotary = dialect.rotary;
  // Its default is a name for programs that we write; of one that is read, only what it says itself may stand there.
  program_.header.program.clear();
}

void ProgramBuilder::comment(std::string_view text, bool upper) {
  text = trimmed(text);
  if (text == kEndOfStrip) {
    strip_ = -1;
  } else if (const auto operation = read_operation_comment(text)) {
    begin_operation(*operation);
  } else if (auto strip = read_strip_comment(text)) {
    // Kinds of strips are words in lower case everywhere else (Path, the judge's report); a dialect that writes its
    // comments in upper case must not make them other kinds.
    if (upper)
      for (char& c : strip->kind) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    // A strip may be left and come back, e.g. round a link: the same comment means the same strip, not another one.
    const auto [at, is_new] =
        strips_.try_emplace(strip_comment(*strip), static_cast<std::int32_t>(program_.strips.size()));
    if (is_new) program_.strips.push_back(*strip);
    strip_ = at->second;
  } else if (text.starts_with("PROGRAM ")) {
    // The word of the language, where it has one, comes first and counts; a comment only stands in for it.
    if (program_.header.program.empty()) program_.header.program = trimmed(text.substr(8));
  } else {
    // Comments of others are free text: what says nothing of ours is no fault.
    (void)read_header_comment(text, program_.header);
  }
}

void ProgramBuilder::end_operation() {
  const NcOperation& last = *program_.header.operation;
  if (program_.moves.empty()) place_.refuse("operation " + std::to_string(last.number) + " has no moves");
  done_.push_back(std::move(program_));
}

// An operation must be one to enter the program at: what it needs, it states. What the control does with a word stays as it was (units,
// planes, tool-centre control, compensation), for the program is run from its beginning, too.
void ProgramBuilder::begin_operation(const NcOperation& operation) {
  const std::string name = program_.header.program;
  if (program_.header.operation) {
    if (operation.number != program_.header.operation->number + 1 ||
        operation.count != program_.header.operation->count)
      place_.refuse("operation " + std::to_string(operation.number) + " of " + std::to_string(operation.count) +
                    " follows operation " + std::to_string(program_.header.operation->number) + " of " +
                    std::to_string(program_.header.operation->count));
    end_operation();
  } else if (!program_.moves.empty() || operation.number != 1) {
    place_.refuse("operation " + std::to_string(operation.number) +
                  " begins where operation 1 is expected, before any move");
  }
  program_ = NcProgram{};
  program_.rotary = dialect_.rotary;
  program_.header.program = name;
  program_.header.operation = operation;
  strips_.clear();
  strip_ = -1;
  forget_position();
  rotary_ = rotary_before_ = {};
  feed_.reset();
  motion_.reset();
  modes_ = {};
  called_.reset();
  called_name_.clear();
  turns_per_minute_ = 0.0;
  by_vector_ = cut_ = turns_ = false;
}

void ProgramBuilder::unit(double millimetres, double feed_millimetres) {
  // Values are stored in millimetres where they are modal and in the program's unit within a block: after either, a
  // change would reinterpret what stands there.
  if ((millimetres != unit_ && (any(linear_) || any(block_.linear))) || (feed_millimetres != feed_unit_ && feed_))
    place_.refuse("the unit changes after coordinates or feeds were stated");
  unit_ = millimetres;
  feed_unit_ = feed_millimetres;
}

void ProgramBuilder::work_offset(int number) {
  if (!program_.moves.empty() && number != program_.header.work_offset)
    place_.refuse("the work offset changes after the first move; expected programs in one frame");
  program_.header.work_offset = number;
  modes_.work_offset = number;
}

void ProgramBuilder::call_tool(int number) {
  program_.header.tool.number = number;
  called_ = number;
  called_name_.clear();
  if (change_at_call_) change_tool();
}

void ProgramBuilder::call_tool(std::string_view name) {
  // A comment of ours says it with its spaces.
  if (program_.header.tool.name.empty()) program_.header.tool.name = name;
  called_.reset();
  called_name_ = name;
  if (change_at_call_) change_tool();
}

// The spindle stands while a tool is changed, and is started anew for the next one.
void ProgramBuilder::change_tool() {
  modes_.tool = called_;
  modes_.tool_name = called_name_;
  spindle_turns(false);
}

void ProgramBuilder::spindle_speed(double turns) {
  program_.header.spindle_rpm = turns;
  turns_per_minute_ = turns;
  modes_.spindle = turns_ && turns_per_minute_ > 0.0;
}

void ProgramBuilder::spindle_turns(bool turns) {
  turns_ = turns;
  modes_.spindle = turns_ && turns_per_minute_ > 0.0;
}

void ProgramBuilder::tool_centre(bool on) {
  if (on == tool_centre_) return;  // G49 in a header and M129 at an end say what holds already
  // The axes of the block would be read with the new meaning or with the old one: controls differ, so neither is
  // taken.
  if (moves()) place_.refuse("tool-centre control is switched within a move; expected a block before it");
  tool_centre_ = on;
  // Before the first switch joint coordinates may have been read as moves; with it they turn out to have been the
  // approach.
  if (on && !switched_) restart_unless_cut("a feed move stands before tool-centre control is switched on");
  switched_ = true;
  // The same words mean something else from here on, and the controlled point has jumped by the tool's length.
  forget_position();
}

void ProgramBuilder::motion(NcKind kind) {
  if (block_.motion) place_.refuse("the block states G0 or G1 twice");
  block_.motion = true;
  motion_ = kind;
}

void ProgramBuilder::linear(std::size_t axis, double value) {
  if (block_.linear[axis]) place_.refuse(std::string("the block states ") + kLinearName[axis] + " twice");
  check_size(value * unit_, place_);
  block_.linear[axis] = value;
}

void ProgramBuilder::rotary(char letter, double value) {
  // npos where the letter is none of the two, hence more than 1 as well.
  const std::size_t axis = dialect_.rotary.find(letter);
  if (axis > 1)
    place_.refuse(std::string("the machine has no axis ") + letter + "; it has " + dialect_.rotary[0] + " and " +
                  dialect_.rotary[1]);
  if (block_.rotary[axis]) place_.refuse(std::string("the block states ") + letter + " twice");
  check_size(value, place_);
  block_.rotary[axis] = value;
}

void ProgramBuilder::vector(std::size_t component, double value) {
  if (block_.vector[component]) place_.refuse("the block states a component of the tool vector twice");
  check_size(value, place_);
  block_.vector[component] = value;
}

void ProgramBuilder::feed(double value) {
  if (block_.feed) place_.refuse("the block states F twice");
  if (!(value > 0.0)) place_.refuse("a feed must be more than 0");
  check_size(value * feed_unit_, place_);
  block_.feed = value;
}

bool ProgramBuilder::moves() const { return any(block_.linear) || any(block_.rotary) || any(block_.vector); }

void ProgramBuilder::end_block() {
  // Also in a block that does not move: F alone in its line is modal. In inverse time F belongs to its own move only
  // (feed_of_move).
  if (block_.feed && mode_ == NcFeedMode::kPerMinute) feed_ = *block_.feed * feed_unit_;
  // First, because the axes of such a block are coordinates of the machine, not of the part.
  if (block_.reference) {
    go_to_reference();
  } else if (moves()) {
    // Not refused where G91 is read: "G91 G28 Z0" is the usual way to the reference position, and G90 follows it.
    if (incremental_) place_.refuse("an incremental move; expected absolute coordinates");
    if (!block_.rapid && !motion_) place_.refuse("a move before any G0 or G1");
    apply_words();
    record(block_.rapid ? NcKind::kRapid : *motion_);
  }
  block_ = Block{};
}

// A rotary axis that the block names is sent to the machine's own angle, which is not known here; the others stay. Of
// the linear axes nothing is kept: where they end is the machine's.
void ProgramBuilder::go_to_reference() {
  for (std::size_t i = 0; i < 2; ++i)
    if (block_.rotary[i]) rotary_[i].reset();
  forget_position();
}

void ProgramBuilder::forget_position() {
  linear_ = {};
  vector_.reset();
  joined_ = false;
}

void ProgramBuilder::apply_words() {
  for (std::size_t i = 0; i < 3; ++i)
    if (block_.linear[i]) linear_[i] = *block_.linear[i] * unit_;
  rotary_before_ = rotary_;  // record() needs it for the first move: where the rotary axes stood
  for (std::size_t i = 0; i < 2; ++i)
    if (block_.rotary[i]) rotary_[i] = block_.rotary[i];
  if (any(block_.rotary)) by_vector_ = false;
  if (any(block_.vector)) apply_vector();
}

void ProgramBuilder::apply_vector() {
  if (!tool_centre_) place_.refuse("a tool vector before tool-centre control is switched on");
  if (any(block_.rotary)) place_.refuse("the block states rotary axes and a tool vector");
  if (!all(block_.vector)) place_.refuse("a tool vector needs its three components");
  const Vec3 v(*block_.vector[0], *block_.vector[1], *block_.vector[2]);
  if (!(v.norm() > kShortestVector)) place_.refuse("the tool vector has no length");
  // Controls take vectors of any length; poses need unit vectors.
  vector_ = v.normalized();
  by_vector_ = true;
}

NcPositions ProgramBuilder::stated() const {
  if (!tool_centre_) return NcPositions::kJoint;
  return by_vector_ ? NcPositions::kTipVector : NcPositions::kTipRotary;
}

/// What is not known yet of position and orientation; empty if nothing is missing.
std::string ProgramBuilder::unknown() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (!linear_[i]) return {kLinearName[i]};
  // With a tool vector the rotary axes follow from it: they need never be stated.
  if (tool_centre_ && by_vector_) return vector_ ? "" : "the tool vector";
  for (std::size_t i = 0; i < 2; ++i)
    if (!rotary_[i]) return {dialect_.rotary[i]};
  return {};
}

/// Rapid moves before what counts are dropped; feed moves are not.
void ProgramBuilder::restart_unless_cut(const std::string& why) {
  if (cut_) place_.refuse(why);
  program_.moves.clear();
  joined_ = false;
}

/// Refuses what cannot be judged as one path: an unknown position, no tool-centre control where it is expected, and a
/// change of feed mode or join after the first cut.
void ProgramBuilder::check_feed_move() {
  // Where the program has switched tool-centre control once, moves without it are ways to a reference position:
  // cutting there means that a word was forgotten.
  if (!tool_centre_ && (switched_ || !joint_allowed_)) place_.refuse("a feed move without tool-centre control");
  // Under tool-centre control the length places the tip. Without it we read the joints themselves, which a control
  // that compensates the length would shift by it.
  if (length_ && *length_ != tool_centre_)
    place_.refuse(tool_centre_ ? "a feed move without the tool's length (G43 H)"
                               : "axis positions under length compensation; expected them without (G49)");
  if (const std::string what = unknown(); !what.empty()) place_.refuse("a feed move before " + what + " is stated");
  if (!cut_) return;  // modes may change as they like until something is cut
  if (program_.feed_mode != mode_) place_.refuse("the feed mode changes between feed moves");
  if (program_.join != join_)
    place_.refuse(
        "how the tool turns within a block (linearly in the axes, or on a great circle) changes between feed moves");
}

/// mm/min, or 1/min in inverse time: there controls demand F in every feed block, because it says how long this block
/// takes.
double ProgramBuilder::feed_of_move() {
  if (mode_ == NcFeedMode::kInverseTime) {
    if (!block_.feed) place_.refuse("a feed move in inverse time without F");
    return *block_.feed;
  }
  if (!feed_) place_.refuse("a feed move before any F");
  return *feed_;
}

void ProgramBuilder::record(NcKind kind) {
  // The rotary axes brought upright at a feed, where tool-centre control cannot be switched off for that (LinuxCNC without
  // such words): approach, like the rapids before position and orientation are known.
  if (kind == NcKind::kFeed && program_.moves.empty() && !any(linear_) && block_.feed && all(block_.rotary)) return;
  const bool feed = kind == NcKind::kFeed;
  if (feed) check_feed_move();
  // A rapid between two stretches of tool-centre control: its end is in joint coordinates and says nothing of the
  // tip.
  if (!tool_centre_ && switched_) return forget_position();
  // The approach: it only adds to what is known.
  if (!unknown().empty() || (!tool_centre_ && !joint_allowed_)) return;
  // What was recorded so far has another kind of position; rapids alone can be dropped as approach, cuts cannot.
  if (!program_.moves.empty() && program_.positions != stated())
    restart_unless_cut("rotary axes and tool vectors in one program");
  NcMove move{.kind = kind, .joined = joined_, .strip = strip_, .line = place_.line};
  move.position = Vec3(*linear_[0], *linear_[1], *linear_[2]);
  const bool vector = stated() == NcPositions::kTipVector;
  move.orientation = vector ? *vector_ : Vec3(*rotary_[0], *rotary_[1], 0.0);
  if (feed) move.feed = feed_of_move();
  // Until the first cut every rapid may still turn out to be approach, so the last one decides.
  if (!cut_) {
    program_.positions = stated();
    program_.feed_mode = mode_;
    program_.join = tool_centre_ ? join_ : NcJoin::kAxes;
  }
  // Of programs with tool vectors this tells which of the two solutions the control begins with.
  if (program_.moves.empty() && all(rotary_before_))
    program_.start_rotary = Vec2(*rotary_before_[0], *rotary_before_[1]);
  cut_ = cut_ || feed;
  joined_ = true;
  move.modes = present_modes();
  program_.moves.push_back(move);
}

std::int32_t ProgramBuilder::present_modes() {
  if (program_.modes.empty() || program_.modes.back() != modes_) program_.modes.push_back(modes_);
  return static_cast<std::int32_t>(program_.modes.size()) - 1;
}

std::vector<NcProgram> ProgramBuilder::finish() {
  place_.line = 0;  // what is missing is missing in the file as a whole
  if (!ended_) place_.refuse("the program has no end");
  if (const auto& last = program_.header.operation; last && last->number != last->count)
    place_.refuse("its last operation is " + std::to_string(last->number) + " of " + std::to_string(last->count));
  if (program_.moves.empty()) place_.refuse("the program has no moves");
  done_.push_back(std::move(program_));
  return std::move(done_);
}

}  // namespace flank::internal

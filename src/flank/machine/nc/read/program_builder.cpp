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

bool all(const auto& values) {
  for (const auto& v : values)
    if (!v) return false;
  return true;
}

bool any(const auto& values) {
  for (const auto& v : values)
    if (v) return true;
  return false;
}

}  // namespace

ProgramBuilder::ProgramBuilder(const std::string& file, const NcDialect& dialect)
    : place_{file}, dialect_(dialect), join_(dialect.join) {
  program_.rotary = dialect.rotary;
  program_.header.program.clear();
}

void ProgramBuilder::comment(std::string_view text, bool upper) {
  text = trimmed(text);
  if (text == kEndOfStrip) {
    strip_ = -1;
  } else if (auto strip = read_strip_comment(text)) {
    if (upper)
      for (char& c : strip->kind) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto [at, is_new] =
        strips_.try_emplace(strip_comment(*strip), static_cast<std::int32_t>(program_.strips.size()));
    if (is_new) program_.strips.push_back(*strip);
    strip_ = at->second;
  } else if (text.starts_with("PROGRAM ")) {
    if (program_.header.program.empty()) program_.header.program = trimmed(text.substr(8));
  } else {
    (void)read_header_comment(text, program_.header);
  }
}

void ProgramBuilder::unit(double millimetres) {
  if (millimetres != unit_ && (any(linear_) || any(block_.linear) || feed_))
    place_.refuse("the unit changes after coordinates or feeds were stated");
  unit_ = millimetres;
}

void ProgramBuilder::work_offset(int number) {
  if (!program_.moves.empty() && number != program_.header.work_offset)
    place_.refuse("the work offset changes after the first move; accepted are programs in one frame");
  program_.header.work_offset = number;
}

void ProgramBuilder::tool_centre(bool on) {
  if (on == tool_centre_) return;
  if (moves()) place_.refuse("tool-centre control is switched within a move; accepted is a block before it");
  tool_centre_ = on;
  if (on && !switched_) restart_unless_cut("a feed move stands before tool-centre control is switched on");
  switched_ = true;
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
  if (!(value > 0.0)) place_.refuse("a feed is more than 0");
  check_size(value * unit_, place_);
  block_.feed = value;
}

bool ProgramBuilder::moves() const { return any(block_.linear) || any(block_.rotary) || any(block_.vector); }

void ProgramBuilder::end_block() {
  if (block_.feed && mode_ == NcFeedMode::kPerMinute) feed_ = *block_.feed * unit_;
  if (block_.reference) {
    go_to_reference();
  } else if (moves()) {
    if (incremental_) place_.refuse("an incremental move; accepted are absolute coordinates");
    if (!block_.rapid && !motion_) place_.refuse("a move before any G0 or G1");
    apply_words();
    record(block_.rapid ? NcKind::kRapid : *motion_);
  }
  block_ = Block{};
}

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
  rotary_before_ = rotary_;
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

void ProgramBuilder::check_feed_move() {
  if (!tool_centre_ && (switched_ || !joint_allowed_)) place_.refuse("a feed move without tool-centre control");
  if (length_ && *length_ != tool_centre_)
    place_.refuse(tool_centre_ ? "a feed move without the tool's length (G43 H)"
                               : "joint coordinates under length compensation; accepted are they without (G49)");
  if (const std::string what = unknown(); !what.empty()) place_.refuse("a feed move before " + what + " is stated");
  if (!cut_) return;
  if (program_.feed_mode != mode_) place_.refuse("the feed mode changes between feed moves");
  if (program_.join != join_) place_.refuse("the way in which blocks are joined changes between feed moves");
}

double ProgramBuilder::feed_of_move() {
  if (mode_ == NcFeedMode::kInverseTime) {
    if (!block_.feed) place_.refuse("a feed move in inverse time without F");
    return *block_.feed;
  }
  if (!feed_) place_.refuse("a feed move before any F");
  return *feed_;
}

void ProgramBuilder::record(NcKind kind) {
  const bool feed = kind == NcKind::kFeed;
  if (feed) check_feed_move();
  if (!tool_centre_ && switched_) return forget_position();
  if (!unknown().empty() || (!tool_centre_ && !joint_allowed_)) return;
  if (!program_.moves.empty() && program_.positions != stated())
    restart_unless_cut("rotary axes and tool vectors in one program");
  NcMove move{.kind = kind, .joined = joined_, .strip = strip_, .line = place_.line};
  move.position = Vec3(*linear_[0], *linear_[1], *linear_[2]);
  const bool vector = stated() == NcPositions::kTipVector;
  move.orientation = vector ? *vector_ : Vec3(*rotary_[0], *rotary_[1], 0.0);
  if (feed) move.feed = feed_of_move();
  if (!cut_) {
    program_.positions = stated();
    program_.feed_mode = mode_;
    program_.join = tool_centre_ ? join_ : NcJoin::kAxes;
  }
  if (program_.moves.empty() && all(rotary_before_))
    program_.start_rotary = Vec2(*rotary_before_[0], *rotary_before_[1]);
  cut_ = cut_ || feed;
  joined_ = true;
  program_.moves.push_back(move);
}

NcProgram ProgramBuilder::finish() {
  place_.line = 0;
  if (!ended_) place_.refuse("the program has no end");
  if (program_.moves.empty()) place_.refuse("the program has no moves");
  return std::move(program_);
}

}  // namespace flank::internal

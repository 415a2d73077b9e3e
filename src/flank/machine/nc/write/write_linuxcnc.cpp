#include "flank/machine/nc/write/write_linuxcnc.h"

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

/// Degrees per minute with which the rotary axes turn where kinematics cannot be switched off meanwhile.
constexpr double kTurnFeed = 600.0;
constexpr int kFirstOfExtended = 7, kLastOffset = 9;  // G59.1 to G59.3 follow G59

/// What LinuxCNC cannot say, as a user's error: another dialect, or another entry in the machine's file, mends it.
void refuse_unsayable(const NcProgram& program, const NcDialect& dialect) {
  if (program.positions == NcPositions::kTipVector)
    throw UsageError("dialect", "linuxcnc", "has no tool vectors; accepted are rotary axes or joint coordinates");
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

}  // namespace

std::string write_linuxcnc(const NcProgram& program, const NcDialect& dialect) {
  refuse_unsayable(program, dialect);
  const NcHeader& header = program.header;
  const bool tip = program.positions != NcPositions::kJoint, switched = tip && !dialect.tcp_on.empty();
  const std::string tool = std::to_string(header.tool.number);
  GCodeWriter out(program, dialect, {});
  out.raw("%");
  out.comment(safe_comment("PROGRAM " + header.program));
  for (const std::string& line : header_comments(header)) out.comment(line);
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
  out.block("M5");
  if (!tip || switched) out.end_rotary();
  out.block("M2");
  out.raw("%");
  return out.take();
}

}  // namespace flank::internal

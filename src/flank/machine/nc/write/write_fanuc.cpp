#include "flank/machine/nc/write/write_fanuc.h"

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

constexpr int kLastSimple = 6, kLastOffset = 54, kLargestProgram = 9999;  // G54.1 P1 to P48 follow G59

/// G54 to G59 for 1 to 6, then the additional frames of G54.1.
std::string work_offset(int number) {
  return number <= kLastSimple ? "G" + std::to_string(53 + number) : "G54.1 P" + std::to_string(number - kLastSimple);
}

/// "O" and four digits, as controls list programs.
std::string program_number(int number) {
  const std::string digits = std::to_string(number);
  return "O" + std::string(4 - digits.size(), '0') + digits;
}

}  // namespace

std::string write_fanuc(const NcProgram& program, const NcDialect& dialect) {
  const NcHeader& header = program.header;
  if (header.work_offset > kLastOffset) throw UsageError("dialect", "fanuc", "has work offsets 1 to 54");
  if (header.number < 1 || header.number > kLargestProgram)
    throw UsageError("dialect", "fanuc", "has program numbers 1 to 9999");
  const bool tip = program.positions != NcPositions::kJoint, smooth = dialect.smoothing_mm > 0.0;
  const std::string tool = std::to_string(header.tool.number);
  const std::string tcp = (program.positions == NcPositions::kTipVector ? "G43.5 H" : "G43.4 H") + tool;
  GCodeWriter out(program, dialect, {"(", ")", true, {"I", "J", "K"}});
  out.raw("%");
  out.raw(program_number(header.number) + " " + out.comment_text(safe_comment(header.program)));
  for (const std::string& line : header_comments(header)) out.comment(line);
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
  out.block("M5");
  out.end_rotary();
  out.block("M30");
  out.raw("%");
  return out.take();
}

}  // namespace flank::internal

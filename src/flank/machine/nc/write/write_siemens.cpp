#include "flank/machine/nc/write/write_siemens.h"

#include <algorithm>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/write/gcode_writer.h"

namespace flank::internal {

namespace {

constexpr int kLastSimple = 4, kLastOffset = 99;  // G505 to G599 follow G57

/// G54 to G57 for 1 to 4, then G505 to G599.
std::string work_offset(int number) { return "G" + std::to_string(number <= kLastSimple ? 53 + number : 500 + number); }

/// Tools have names, without spaces; one that has none here is called by its number.
std::string tool_call(const NcTool& tool, bool length_compensation) {
  std::string name = safe_comment(tool.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return (name.empty() ? "T" + std::to_string(tool.number) : "T=\"" + name + '"') +
         (length_compensation ? " D1" : " D0");
}

/// G642 blends within the contour tolerance CTOL, mm, and that of the orientation OTOL, degrees.
std::string smoothing(const NcDialect& dialect) {
  std::string words = "G642 CTOL=";
  append_decimal(words, dialect.smoothing_mm, kMostNcDecimals);
  if (dialect.smoothing_deg > 0.0) append_decimal(words += " OTOL=", dialect.smoothing_deg, kMostNcDecimals);
  return words;
}

void tool_centre_on(GCodeWriter& out, const NcProgram& program) {
  out.block("TRAORI");
  // The transformation may drop the frame.
  out.block(work_offset(program.header.work_offset));
  // ORIWKS: directions, and the plane in which the tool turns between two of them, are in the frame of the part.
  out.block(program.join == NcJoin::kGreatCircle ? "ORIWKS ORIVECT" : "ORIWKS ORIAXES");
}

}  // namespace

std::string write_siemens(const NcProgram& program, const NcDialect& dialect) {
  const NcHeader& header = program.header;
  if (header.work_offset > kLastOffset) throw UsageError("dialect", "siemens", "has work offsets 1 to 99");
  const bool tip = program.positions != NcPositions::kJoint;
  GCodeWriter out(program, dialect, {"; ", "", false, {"A3=", "B3=", "C3="}});
  out.comment(safe_comment("PROGRAM " + header.program));
  for (const std::string& line : header_comments(header)) out.comment(line);
  const auto retract = [&] {
    // Without frames and without the tool's length: Z of the machine itself, not of the part.
    std::string words = "SUPA G0 Z";
    append_decimal(words, dialect.retract_mm.value_or(0.0), dialect.length_decimals);
    out.block(words + " D0");
  };
  out.block("G0 G17 G40 G90 G94 G710");
  // Wherever the tool stands, and whatever the last program has left: nothing turns before it is out of the way.
  out.block("TRAFOOF");
  retract();
  out.block(tool_call(header.tool, tip));
  out.block("M6");
  out.block(work_offset(header.work_offset));
  // The rotary axes turn before TRAORI: afterwards the control would hold the tip where it is meanwhile.
  out.start_rotary();
  if (const std::string spindle = spindle_words(header); !spindle.empty()) out.block(spindle);
  if (tip) tool_centre_on(out, program);
  if (dialect.smoothing_mm > 0.0) out.block(smoothing(dialect));
  // F is the feed of the tip, not of tip and rotary axes together.
  if (program.feed_mode == NcFeedMode::kPerMinute) out.block("FGROUP(X,Y,Z)");
  if (program.feed_mode == NcFeedMode::kInverseTime) out.block("G93");
  out.moves([&](const NcMove& move) {
    if (tip) out.block("TRAFOOF");
    retract();
    out.block(tip ? "D1" : "D0");
    out.rotary_of(move);
    if (tip) tool_centre_on(out, program);
  });
  if (tip) out.block("TRAFOOF");
  retract();
  out.block("G94 M5");
  out.end_rotary();
  out.block("M30");
  return out.take();
}

}  // namespace flank::internal

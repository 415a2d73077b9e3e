#include "flank/machine/nc/dialects/write_nc.h"

#include <cmath>

#include "flank/error.h"
#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr double kUnitVectorError = 1e-6;  // rounding is far below: what is farther off was never normalised
constexpr double kSmallestFeed = 1e-6;     // keeps four digits of what nine decimals can say

/// More decimals than this would not fit into the integer by which numbers are printed (nc_number.cpp).
void check_decimals(const NcDialect& dialect) {
  for (const int decimals :
       {dialect.length_decimals, dialect.angle_decimals, dialect.vector_decimals, dialect.feed_decimals})
    if (decimals < 0 || decimals > kMostNcDecimals)
      throw UsageError("decimals", std::to_string(decimals), "expected 0 to 9");
}

/// What a program of our own making always keeps is an InternalError; a feed may come from a user's wish.
void check_move(const NcProgram& program, const NcMove& move) {
  if (move.strip < -1 || move.strip >= static_cast<std::int32_t>(program.strips.size()))
    throw InternalError("a move belongs to a pass that the program does not have");
  if (!move.position.allFinite() || !move.orientation.allFinite() || !std::isfinite(move.feed))
    throw InternalError("a program has a number that is not finite");
  if (program.positions == NcPositions::kTipVector && std::abs(move.orientation.norm() - 1.0) > kUnitVectorError)
    throw InternalError("a program has a tool vector that is not of unit length");
  if (move.kind == NcKind::kFeed && !(move.feed >= kSmallestFeed))
    throw UsageError("feed", std::to_string(move.feed), "expected feeds of at least 0.000001");
}

/// A rapid is no straight line on many controls, and turning under tool-centre control it drives the linear axes after it.
void check_rapid(const NcProgram& program, std::size_t i) {
  const NcMove& move = program.moves[i];
  if (move.kind != NcKind::kRapid || program.positions == NcPositions::kJoint || i == 0) return;
  // Behind a reference position the rotary axes are turned first, where blocks state them.
  if (!move.joined && program.positions == NcPositions::kTipRotary) return;
  if (move.orientation != program.moves[i - 1].orientation)
    throw UsageError("program: move " + std::to_string(i + 1) +
                     " is a rapid that turns the rotary axes under tool-centre control; expected a feed move");
}

void check_program(const NcProgram& program) {
  if (program.moves.empty()) throw UsageError("program: has no moves");
  require_rotary_letters(program.rotary);
  if (program.header.tool.number < 0 || program.header.tool.number > kLargestNcValue || program.header.work_offset < 1)
    throw UsageError("program: the tool's number must be from 0 to 1000000, that of the work offset at least 1");
  if (program.positions == NcPositions::kJoint && program.join == NcJoin::kGreatCircle)
    throw UsageError("program: axis positions are joined linearly, not on a great circle");
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    check_move(program, program.moves[i]);
    check_rapid(program, i);
  }
}

}  // namespace

std::string write_nc(std::span<const NcProgram> operations, const NcDialect& dialect) {
  check_decimals(dialect);
  if (operations.empty()) throw UsageError("program: has no operations");
  const NcProgram& first = operations.front();
  for (std::size_t k = 0; k < operations.size(); ++k) {
    const NcProgram& p = operations[k];
    check_program(p);
    if (p.positions != first.positions || p.join != first.join || p.feed_mode != first.feed_mode ||
        p.rotary != first.rotary || p.header.work_offset != first.header.work_offset)
      throw InternalError("the operations of one program differ in positions, feed mode or work offset");
    const std::optional<NcOperation>& of = p.header.operation;
    if (operations.size() > 1 &&
        (!of || of->number != static_cast<int>(k) + 1 || of->count != static_cast<int>(operations.size())))
      throw InternalError("the operations of a program are not numbered in their order");
  }
  return row_of(dialect.language).write(operations, dialect);
}

std::string write_nc(const NcProgram& program, const NcDialect& dialect) {
  return write_nc(std::span(&program, 1), dialect);
}

}  // namespace flank::internal

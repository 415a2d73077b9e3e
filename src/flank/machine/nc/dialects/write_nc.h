/// NC programs as text.
#pragma once

#include <span>
#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// The program in the words of the dialect. The same program gives the same bytes; numbers are decimals of the
/// dialect's digits without exponents, names of the header are made safe for its comments.
/// Throws UsageError where the dialect cannot say it (a great circle in LinuxCNC, inverse time in Heidenhain, vectors in
/// joint mode), InternalError for numbers that are not finite.
[[nodiscard]] std::string write_nc(const NcProgram& program, const NcDialect& dialect);

/// The operations one after the other in one program, each with its own tool, from a safe state of the control to the tool out of the
/// way. They have one work offset, and one way in which positions and feeds are stated; each of several has its NcOperation, in order. Throws likewise.
[[nodiscard]] std::string write_nc(std::span<const NcProgram> operations, const NcDialect& dialect);

}  // namespace flank::internal

/// Programs for LinuxCNC.
#pragma once

#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As write_nc, for a program that passed its checks. Tool-centre control is the machine's kinematics, switched by the
/// dialect's M words where it has some; joint coordinates stand without length compensation.
[[nodiscard]] std::string write_linuxcnc(const NcProgram& program, const NcDialect& dialect);

}  // namespace flank::internal

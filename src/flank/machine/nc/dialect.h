/// The dialects of NC programs and their options; what each of them can say is in docs/schema/nc.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flank/machine/nc/program.h"

namespace flank::internal {

enum class NcLanguage : std::uint8_t { kLinuxCnc, kFanuc, kSiemens, kHeidenhain, kApt };

/// A language and how a machine wants it written. What a program means stands in the program, not here.
struct NcDialect {
  NcLanguage language = NcLanguage::kLinuxCnc;

  /// LinuxCNC: what programs state where no word of theirs says so (its kinematics are the machine's, not the program's).
  NcPositions positions = NcPositions::kTipRotary;
  /// Fanuc, and Siemens without a word: how the control joins blocks (the machine's setting, not the program's).
  NcJoin join = NcJoin::kAxes;
  std::string rotary = "AC";  ///< letters of the machine's rotary axes, in its order: what a program is read with
  /// LinuxCNC: words that switch tool-centre kinematics on and off, e.g. "M428" and "M429", or "G12.1 P1" and "G13.1"; empty
  /// where the machine does not switch.
  std::string tcp_on = {}, tcp_off = {};
  /// Words that move nothing on this machine, in upper case, as its file names them (without_effect.h).
  std::vector<std::string> without_effect = {};
  /// Where the machine's own Z stands, mm, when the tool is out of the way: before rotary axes turn, before a tool is changed,
  /// and at the end. None: Fanuc goes to its reference position, Heidenhain to the end of the travel, others to 0.
  std::optional<double> retract_mm = {};
  /// Heidenhain: FUNCTION TCPM instead of M128. A program whose axis turns on a great circle always has the former.
  bool function_tcpm = false;
  bool decimal_comma = true;  ///< Heidenhain: comma as decimal separator
  /// The contour tolerance that the control may smooth within, mm, and that of the orientation, degrees (Siemens,
  /// Heidenhain). 0: not stated, and LinuxCNC keeps the exact path.
  double smoothing_mm = 0.0, smoothing_deg = 0.0;
  bool line_numbers = false;  ///< N words; Heidenhain numbers its blocks always, APT never

  int length_decimals = 4;  ///< of millimetres, 0 to 9
  int angle_decimals = 5;   ///< of degrees
  int vector_decimals = 8;  ///< of unit vectors
  int feed_decimals = 3;    ///< of mm/min; inverse time has eight significant digits
};

/// Decimals with which a feed > 0 is written: as many as the dialect says, more where it would lose itself.
[[nodiscard]] int nc_feed_decimals(NcFeedMode mode, double feed, const NcDialect& dialect);

}  // namespace flank::internal

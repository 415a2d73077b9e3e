/// `flank setup`: the sheet of paper that goes to the machine with a program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/machine/work_setup.h"
#include "flank/run.h"
#include "flank/tool.h"

namespace flank::internal {

struct SheetJob {
  std::vector<std::string> folders;    ///< of the operations, in the order of the program
  std::optional<std::string> nc;       ///< the program; none: the sheet has no set-up, speeds and times
  std::optional<std::string> machine;  ///< name or file; needed with a program
  std::optional<std::string> setup;    ///< "x,y,z,a,b,c"; none: the program's own
};

/// One operation, as the program runs it.
struct SheetOperation {
  std::string name, folder, faces, kind;  ///< kind: "flank milling", "trochoidal roughing and finishing", ...
  int strips = 0, copies = 1;
  int tool_number = 0;          ///< 0: no program says it
  double tool_length_mm = 0.0;  ///< from the gauge line to the controlled point; 0: no program says it
  double tolerance_mm = 0.0;
  double spindle_rpm = 0.0;                ///< 0: it stands, or no program says it
  double feed_low = 0.0, feed_high = 0.0;  ///< mm/min of what cuts; 0: not known (inverse time)
  double minutes = 0.0;                    ///< of all copies; 0: not known
  Acceptance verdict;  ///< of the folder: verify.json, and motion.json where it was posted for this machine
};

struct SheetTool {
  int number = 0;
  Tool tool;
  double length_mm = 0.0;     ///< from the gauge line to the controlled point; 0: no program says it
  double stick_out_mm = 0.0;  ///< from the tool's lowest point to its holder, or to the end of its shank
};

struct SetupSheet {
  std::string part, part_sha256, program, program_sha256, machine;
  int work_offset = 0;  ///< 0: no program
  std::string origin;   ///< what the work offset holds
  WorkSetup place;
  bool placed = false;  ///< a program or the job says where the part sits
  bool dry_run = false;
  Box3 box;                  ///< of the part where it is clamped, mm
  std::string front, above;  ///< drawings (SVG)
  std::vector<SheetOperation> operations;
  std::vector<SheetTool> tools;
  Acceptance verdict;  ///< of all operations
};

/// Reads the folders, and the program. Throws UsageError for a program without a machine, InputError for what is no folder of results,
/// folders of several parts, and a program of other operations.
[[nodiscard]] SetupSheet make_setup_sheet(const SheetJob& job);

}  // namespace flank::internal

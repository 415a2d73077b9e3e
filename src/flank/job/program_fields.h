/// Fields of NC programs: of one that is checked, and of the operations and loads of one that is written.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"

namespace flank::internal {

inline constexpr std::string_view kMachineHelp = "The machine: a name (flank machine --list) or a file NAME.toml";

template <class Visitor, Is<NcRequest> Request>
void visit_nc(Request& nc, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Program";
  visit(FieldInfo{"nc", "", kGroup, "Check this NC program, run on --machine, instead of the path of DIR", kAny,
                  Spelling::kFile},
        nc.file);
  visit(FieldInfo{"machine", "", kGroup, kMachineHelp, kAny, Spelling::kFileOrText}, nc.machine);
  visit(FieldInfo{"setup", "", kGroup,
                  "Set-up of the part x,y,z,a,b,c (mm, degrees). Default: the one in the program's header", kAny},
        nc.setup);
  visit(FieldInfo{"tool", "", kGroup, "Tool file of the program. Default: that of DIR", kAny, Spelling::kFile},
        nc.tool);
  visit(FieldInfo{"faces", "", kGroup, "Faces that the program machines. Default: those of DIR, else F1", kAny,
                  Spelling::kPlain, "--face"},
        nc.faces);
  visit(
      FieldInfo{
          "work_offset", "", kGroup,
          "Work offset that holds the set-up; 1 is G54. Default: the one in the header, else in the machine's file",
          kWorkOffset},
      nc.work_offset);
  visit(FieldInfo{"tool_number", "", kGroup, "Number of the tool in the program. Default: the one in its header",
                  kToolNumber},
        nc.tool_number);
  visit(FieldInfo{"follow", "", kGroup,
                  "path: the program must cut the whole path of DIR in its order; any: only what it cuts counts",
                  kFollow},
        nc.follow);
}

/// Of a program of several operations.
template <class Visitor, Is<PostJob> Job>
void visit_operations(Job& job, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Operations";
  visit(FieldInfo{"operations", "", kGroup,
                  "Settings of one operation, NUMBER:KEY=VALUE,...: name, tool (number), length (mm), spindle "
                  "(1/min), feed (mm/min), flutes; as 2:name=finish,tool=7. May be given several times",
                  kAny, Spelling::kPlain, "--operation"},
        job.operations);
  visit(
      FieldInfo{"copies", "", kGroup,
                "Run each operation so many times, turned by 360 degrees / copies about --copy-axis. The part must be "
                "the same when it is turned",
                kCopies},
      job.copies);
  visit(
      FieldInfo{"copy_axis", "", kGroup,
                "Axis of the copies in the part's frame x,y,z,x,y,z: a point (mm) and a direction. Default: its Z axis",
                kAny},
      job.copy_axis);
  visit(FieldInfo{"coolant", "", "", "Coolant while the tool cuts: off, flood (M8) or mist (M7)", kCoolant},
        job.coolant);
}

/// What the feed follows, and what bounds it.
template <class Visitor, Is<PostJob> Job>
void visit_loads(Job& job, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Load (with --material)";
  visit(FieldInfo{"helix", "", kGroup, "Helix angle of the cutting edges, degrees", kHelix}, job.helix_deg);
  visit(FieldInfo{"finish_stock", "mm", kGroup,
                  "Thickness of what roughing has left on the machined faces: the feed follows the load of taking it. "
                  "Not needed for a cavity, whose folder holds its load",
                  kLength},
        job.finish_stock_mm);
  visit(FieldInfo{"most_force", "", kGroup, "Largest cutting force, N: the feed is slower where it would be exceeded",
                  kRatio},
        job.most_force_n);
  visit(FieldInfo{"most_power", "", kGroup, "Largest cutting power, W", kRatio}, job.most_power_w);
  visit(FieldInfo{"most_deflection", "mm", kGroup, "Largest deflection of the tool's tip", kLength},
        job.most_deflection_mm);
}

}  // namespace flank::internal

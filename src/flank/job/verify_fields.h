/// Fields of `flank verify`.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"
#include "flank/job/part_fields.h"
#include "flank/job/program_fields.h"

namespace flank::internal {

template <class Visitor, Is<BendingRequest> Request>
void visit_bending(Request& bending, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Bending";
  visit(FieldInfo{"bending", "", kGroup,
                  "Also report the errors with the tool bent by its load, at the feed of flank post with this material",
                  kAny, Spelling::kFlag},
        bending.on);
  visit(FieldInfo{"material", "", kGroup, "Workpiece material (share/materials); needed by --bending"},
        bending.material);
  visit(FieldInfo{"flutes", "", kGroup, "Number of the tool's cutting edges; needed by --bending", kToolNumber},
        bending.flutes);
  visit(FieldInfo{"helix", "", kGroup, "Helix angle of the cutting edges, degrees", kHelix}, bending.helix_deg);
  visit(FieldInfo{"finish_stock", "mm", kGroup,
                  "Thickness of what roughing has left on the machined faces. Not needed for a cavity, whose folder "
                  "holds its load",
                  kLength},
        bending.finish_stock_mm);
}

template <class Visitor, Is<VerifyJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid; not needed with --nc", kAny,
                  Spelling::kFile, "DIR"},
        job.folder);
  visit(FieldInfo{"more_folders", "", "", "The folders of the program's other operations, in their order", kAny,
                  Spelling::kFile, "MORE"},
        job.more_folders);
  visit_nc(job.nc, visit);
  visit(
      FieldInfo{"part", "", "", "Check against this part instead of the one named in job.json", kAny, Spelling::kFile},
      job.part);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, job.side);
  visit(FieldInfo{"tolerance", "mm", "", "Another tolerance than that of the job", kLength}, job.tolerance_mm);
  visit(FieldInfo{"sample", "mm", "", kSampleHelp, kLength}, job.sample_mm);
  visit(FieldInfo{"reach_radius", "mm", "Other faces", kReachHelp, kRadius}, job.reach_radius_mm);
  visit(FieldInfo{"stock_cell", "mm", "", kCellHelp, kLength}, job.stock_cell_mm);
  visit_obstacles(job.obstacles, visit);
  visit_bending(job.bending, visit);
}

}  // namespace flank::internal

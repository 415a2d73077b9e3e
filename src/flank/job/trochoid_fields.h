/// Fields of `flank trochoid`.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"
#include "flank/job/part_fields.h"
#include "flank/job/tool_fields.h"

namespace flank::internal {

template <class Visitor, Is<CycleRequest> Request>
void visit_cycles(Request& cycles, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Cycles";
  visit(FieldInfo{"max_engagement", "", kGroup, "Largest engagement angle of the cutter, degrees", kEngagement},
        cycles.most_engagement_deg);
  visit(FieldInfo{"cut", "", kGroup, "climb or conventional milling; the spindle turns clockwise seen from the holder",
                  kCut},
        cycles.cut);
  visit(FieldInfo{"layers", "", kGroup, "Number of layers with one tool, or auto: as many as the tolerance needs",
                  kLayers, Spelling::kAutoOrCount},
        cycles.layers);
  visit(FieldInfo{"entry", "", kGroup,
                  "How a layer is entered: open, from outside the blank; ramp, to and fro while sinking; plunge, along "
                  "the tool's axis; auto: open where an end is open, else ramp. Ramps and plunges cut a slot, beyond "
                  "--max-engagement; their engagement is reported by itself",
                  kEntry},
        cycles.entry);
  visit(FieldInfo{"ramp_angle", "", kGroup, "Steepest slope of a ramp, degrees", kRampAngle}, cycles.ramp_angle_deg);
  visit(FieldInfo{"strategy", "", kGroup,
                  "volume: optimise the shape of every cycle for removed volume per path length; plain: optimise its "
                  "step only; paper: the published method, to compare",
                  kCycles},
        cycles.strategy);
  visit(FieldInfo{"feed", "mm/min", kGroup, "Feed of cycles and side paths, for the machining time", kRate},
        cycles.feed_mm_min);
  visit(FieldInfo{"rapid", "mm/min", kGroup, "Rapid rate of the links, for the machining time", kRate},
        cycles.rapid_mm_min);
  visit(FieldInfo{"stock_cell", "mm", kGroup, kCellHelp, kLength}, cycles.stock_cell_mm);
}

template <class Visitor, Is<TrochoidJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "STEP, IGES or BREP file", kAny, Spelling::kFile, "PART", true}, job.part.file);
  visit(FieldInfo{"left", "", "", "Faces of one side of the cavity, as F9, or several that are joined, F9,F10", kAny,
                  Spelling::kPlain, "", true},
        job.left);
  visit(FieldInfo{"right", "", "", "Faces of the opposite side", kAny, Spelling::kPlain, "", true}, job.right);
  visit(FieldInfo{"floor", "", "",
                  "A face at the bottom of the cavity, where the tool's tip is. Default: found from the walls, else at "
                  "the narrower end"},
        job.floor);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Length of the tool's axis, tip centre to upper end. Default: as a layer needs", kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"effort", "", "",
                  "How long to search: quick ends after about 20 s of one processor, normal after about 90 s, with the "
                  "best so far; thorough has no limit",
                  kEffort},
        job.effort);
  visit_cycles(job.cycles, visit);
  visit_radius(job.radius, visit);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(FieldInfo{"avoid", "", "Other faces",
                  "on: plan around the neighbouring faces; off: plan without them (they are checked all the same)",
                  kAny, Spelling::kOnOff},
        job.avoid);
}

}  // namespace flank::internal

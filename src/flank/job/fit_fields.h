/// Fields of `flank fit`.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"
#include "flank/job/part_fields.h"
#include "flank/job/tool_fields.h"

namespace flank::internal {

inline constexpr std::string_view kCurveHelp =
    "on: also fit free tools of other L:D and report finished area, gouge and excess material of each";

inline constexpr std::string_view kBendHelp =
    "Smallest radius of curvature of the paths of tip and holder end that meets the request. Default: any";

template <class Visitor, Is<FitJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Length of the tool's axis, tip centre to upper end. Default: as the face needs", kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"strips", "", "",
                  "Number of passes side by side with one tool, or auto: as many as the tolerance needs", kPassCount,
                  Spelling::kAutoOrCount},
        job.strips);
  visit(FieldInfo{"effort", "", "",
                  "How long to search: quick ends after about 20 s of one processor, with at most four passes; normal "
                  "after about five minutes; thorough has no limit",
                  kEffort},
        job.effort);
  visit(FieldInfo{"start", "", "", "First tool axis x,y,z,x,y,z (tip, holder end), mm. Default: found"}, job.start);
  visit(FieldInfo{"guide", "", "", "File of several axes, one a line, that the motion follows", kAny, Spelling::kFile},
        job.guide);
  visit_radius(job.radius, visit);
  visit(FieldInfo{"stiffness_curve", "", "Stiffness", kCurveHelp, kAny, Spelling::kOnOff}, job.stiffness_curve);
  visit(FieldInfo{"cut", "", "Motion", kCutHelp, kCut}, job.cut);
  visit(FieldInfo{"min_bend_radius", "mm", "Motion", kBendHelp, kRadius}, job.min_bend_radius_mm);
  visit(FieldInfo{"turn_max", "", "Motion", kTurnHelp, kTurn}, job.judge.most_turn_deg);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(FieldInfo{"avoid", "", "Other faces",
                  "on: plan around the neighbouring faces; off: plan without them (they are checked all the same)",
                  kAny, Spelling::kOnOff},
        job.avoid);
}

}  // namespace flank::internal

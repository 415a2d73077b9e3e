/// Fields of `flank cover`.
#pragma once

#include "flank/job.h"
#include "flank/job/field_info.h"
#include "flank/job/part_fields.h"
#include "flank/job/tool_fields.h"

namespace flank::internal {

template <class Visitor, Is<CoverJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(
      FieldInfo{
          "tool", "", "",
          "A tool file; a family with all its parameters (barrel:arc=85,radius=5) and --axis-length; a family with "
          "some or none (barrel), the others are found for this face; or catalogue, the best of a folder of tools",
          kAny, Spelling::kFileOrText, "", true},
      job.tool.spec);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Axis length of a family's tool. If parameters are found, default: the width of the face over 1, 2, "
                  "3 and 4 passes, all tried",
                  kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"strategy", "", "",
                  "How passes are found: grow (extended step by step), or curves (the published method, to compare)",
                  kStrategy},
        job.strategy);
  visit(FieldInfo{"seed", "", "", "Seed of the random numbers of --strategy curves. Default: 1"}, job.seed);
  visit(FieldInfo{"seeds", "", "", "Where passes start: grid, spread evenly; shape, more where the face is curved more",
                  kSeeds},
        job.seeds);
  visit(FieldInfo{"strips", "", "", "Largest number of passes. Default: until another one adds less than --strip-price",
                  kStrips},
        job.most_strips);
  visit(FieldInfo{"strip_price", "", "", "Share of the face that another pass must add. Default: 0.005", kPrice},
        job.strip_price);
  visit(FieldInfo{"cut", "", "Motion", kCutHelp, kCut}, job.cut);
  visit(FieldInfo{"turn_max", "", "Motion", kTurnHelp, kTurn}, job.judge.most_turn_deg);
  visit_judge(job.judge, visit);
  visit_choice(job.choice, visit);
  visit_obstacles(job.obstacles, visit);
}

}  // namespace flank::internal

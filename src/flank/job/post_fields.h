/// Fields of `flank post`.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"
#include "flank/job/program_fields.h"

namespace flank::internal {

template <class Visitor, Is<PostJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  constexpr std::string_view kLinks = "Links";
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid", kAny, Spelling::kFile, "DIR",
                  true},
        job.folder);
  visit(FieldInfo{"more_folders", "", "",
                  "More folders of the same part: the program has an operation for each, with its own tool", kAny,
                  Spelling::kFile, "MORE"},
        job.more_folders);
  visit(FieldInfo{"machine", "", "", kMachineHelp, kAny, Spelling::kFileOrText, "", true}, job.machine);
  visit(FieldInfo{"part", "", "", "Another part than the one named in job.json", kAny, Spelling::kFile}, job.part);
  visit(FieldInfo{"setup", "", "",
                  "Set-up of the part on the table, x,y,z,a,b,c: its origin in mm, its turns about X, then Y, then Z "
                  "in degrees. Default: found, so that the machine reaches everything",
                  kAny},
        job.setup);
  visit(
      FieldInfo{
          "feed", "mm/min", "",
          "Feed rate of the contact point along the passes; required, except for a dry run (1000) and --speed optimal",
          kRate},
      job.feed_mm_min);
  visit(FieldInfo{"clamp", "", "",
                  "How the part is clamped, where --setup is not given. any: any way up; bottom: its Z axis up; bore: "
                  "--copy-axis (default: its Z axis) up and on the axis of the table",
                  kClamp},
        job.clamp);
  visit(FieldInfo{"speed", "", "",
                  "feed: --feed, slower where the axes need it, and in a cavity adapted to the engagement so that the "
                  "thickest chip stays the same; constant: --feed everywhere; optimal: as fast as the axes can",
                  kSpeed},
        job.speed);
  visit(FieldInfo{"most_feed", "mm/min", "",
                  "In a cavity: largest feed, where little or nothing is engaged. Default: three times --feed", kRate},
        job.most_feed_mm_min);
  visit(FieldInfo{"deviation", "mm", "",
                  "Allowed deviation of the control's motion from the path. Default: 0.5 % of the tolerance", kLength},
        job.deviation_mm);
  visit(FieldInfo{"tool_length", "mm", "",
                  "Tool length, from the gauge line to the controlled point. Default: the machine's", kLength},
        job.tool_length_mm);
  visit(
      FieldInfo{"spindle", "", "", "Spindle speed, 1/min; required, except for a dry run and with --material", kTurns},
      job.spindle_rpm);
  visit(FieldInfo{"material", "", "",
                  "Workpiece material (share/materials: aluminium, titanium, ...): derives --spindle and --feed from "
                  "its cutting speed and chip load; needs --flutes"},
        job.material);
  visit(FieldInfo{"flutes", "", "", "Number of the tool's cutting edges, for the feed of --material", kToolNumber},
        job.flutes);
  visit_loads(job, visit);
  visit_operations(job, visit);
  visit(FieldInfo{"dry", "", "", "Dry run: the spindle stands still, and the program's header says so", kAny,
                  Spelling::kFlag},
        job.dry);
  visit(FieldInfo{"force", "", "",
                  "Write the program although it does not meet its request; its header says why, and the exit code is "
                  "still 1",
                  kAny, Spelling::kFlag},
        job.force);
  visit(FieldInfo{"link_clearance", "mm", kLinks, "Distance of the links from the part and its surroundings", kLength},
        job.link_clearance_mm);
  visit(FieldInfo{"lift", "mm", kLinks, "Lead-in and lead-out distance from the surface, before and after each pass",
                  kLength},
        job.lift_mm);
  visit(FieldInfo{"order", "", kLinks,
                  "Order of the passes: shortest (short links) or given (as in the path). Trochoidal "
                  "cycles keep their order",
                  kOrder},
        job.order);
}

}  // namespace flank::internal

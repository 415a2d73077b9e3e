/// The fields of a redesign: the part of the table (fields.h) that asks for the nearest millable surface.
#pragma once

#include <string>
#include <string_view>

#include "flank/job/fields.h"
#include "flank/job/other_faces_fields.h"
#include "flank/job/redesign_job.h"

namespace flank::internal::accepted {

inline constexpr Accepted kNearest{"must be mean or largest", nullptr,
                                   [](std::string_view x) { return x == "mean" || x == "largest"; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

template <class Visitor, Is<RedesignJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Length of the tool's axis, tip centre to upper end. Default: as the face needs", kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"weight", "", "",
                  "Weight of the deviation near a border, as le=10,root=0.2: le, te, root, tip, or a neighbouring face "
                  "(F7=3). Elsewhere: 1"},
        job.weight);
  visit(FieldInfo{"thickness_min", "mm", "",
                  "Smallest thickness of the new blade; where it was thinner before, it gets no thinner. Default: any",
                  kLength},
        job.thickness_min_mm);
  visit(FieldInfo{"nearest", "", "",
                  "What is minimised: mean, the mean square deviation, or largest, the largest deviation", kNearest},
        job.nearest);
  visit(FieldInfo{"heights", "", "", "Heights of the section tables, percent from root to tip"}, job.heights);
  visit(FieldInfo{"effort", "", "", "How long to search for the tool and the motion to start from", kEffort},
        job.effort);
  visit(FieldInfo{"tolerance", "mm", "",
                  "Tolerance of the first search, and limit in the deviation map. Default: as in flank fit", kLength},
        job.tolerance_mm);
  visit_radius(job.radius, visit);
  visit_other_faces(job, visit);
}

inline std::string_view command_name(const RedesignJob&) { return "redesign"; }

/// As for the other jobs (check_fields.h, command_line.h).
void check_fields(const RedesignJob& job);
[[nodiscard]] std::string command_line(const RedesignJob& job);

}  // namespace flank::internal

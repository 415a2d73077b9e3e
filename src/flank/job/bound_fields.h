/// The fields of a bound: the part of the table (fields.h) that asks for proofs.
#pragma once

#include <string>
#include <string_view>

#include "flank/job/bound_job.h"
#include "flank/job/fields.h"
#include "flank/job/other_faces_fields.h"

namespace flank::internal::accepted {

inline constexpr Accepted kPoints{"expected a number from 1 to 100000", [](double x) { return x >= 1.0 && x <= 1e5; }};
inline constexpr Accepted kGap{"expected a share between 0.005 and 1", [](double x) { return x >= 0.005 && x <= 1.0; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

template <class Visitor, Is<BoundJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(FieldInfo{"tool", "", "",
                  "free (any tool whose radii are large enough), a tool.json, or a family with all its parameters "
                  "(cone:radius=2,angle=3)",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(
      FieldInfo{"radius_min", "mm", "", "Smallest radius of a free tool. Default: 1 % of the face's diagonal", kRadius},
      job.radius_min_mm);
  visit(FieldInfo{"axis_length", "mm", "", "Axis length of a family's tool", kLength}, job.tool.axis_length_mm);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"map", "", "",
                  "Examine every face of the part: one pass, several, or not by flank. With -o: map.json and map.html",
                  kAny, Spelling::kFlag},
        job.map);
  visit(FieldInfo{"points", "", "",
                  "Approximate number of samples at which a limit is proved first; with --map of the whole part",
                  kPoints},
        job.points);
  visit(FieldInfo{"gap", "", "",
                  "Stop when what is proved is this near to what a position of the tool reaches, as a share", kGap},
        job.gap);
  visit_other_faces(job, visit);
}

inline std::string_view command_name(const BoundJob&) { return "bound"; }

/// As for the other jobs (check_fields.h, command_line.h).
void check_fields(const BoundJob& job);
[[nodiscard]] std::string command_line(const BoundJob& job);

}  // namespace flank::internal

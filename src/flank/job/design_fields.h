/// The fields of a design: the part of the table (fields.h) that asks for a set of tools.
#pragma once

#include <string>
#include <string_view>

#include "flank/job/design_job.h"
#include "flank/job/fields.h"

namespace flank::internal::accepted {

inline constexpr Accepted kToolCount{"expected auto or a number from 1 to 100",
                                     [](double x) { return x >= 0.0 && x <= 100.0; }};
inline constexpr Accepted kSource{"must be fit, catalogue or both", nullptr,
                                  [](std::string_view x) { return x == "fit" || x == "catalogue" || x == "both"; }};
inline constexpr Accepted kMinutes{"expected a time >= 0 min", not_negative};

}  // namespace flank::internal::accepted

namespace flank::internal {

template <class Visitor, Is<DesignJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "CAD or mesh file; flank inspect --help names the formats", kAny, Spelling::kFile,
                  "PART", true},
        job.part.file);
  visit(FieldInfo{"unit", "", "", "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in", kUnit},
        job.part.unit);
  visit(FieldInfo{"faces", "", "", "Faces to finish, each by one tool of the set, as F1,F3 or F10-F19", kAny,
                  Spelling::kPlain, "", true},
        job.part.faces);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, job.part.side);
  visit(FieldInfo{"tools", "", "",
                  "Largest number of tools in the set, the fastest such set is taken; or auto: the smallest set that "
                  "finishes everything that can be finished",
                  kToolCount, Spelling::kAutoOrCount},
        job.tools);
  visit(FieldInfo{"source", "", "",
                  "Where tools come from: fit (found for one or several of the faces), catalogue, or both", kSource},
        job.source);
  visit(FieldInfo{"shape", "", "",
                  "Form of fitted tools: free (any profile), or a family with any of its parameters (cone:radius=2)"},
        job.shape);
  visit(FieldInfo{"tolerance", "mm", "", "Allowed deviation of all faces, both ways", kLength}, job.tolerance_mm);
  visit(FieldInfo{"axis_length", "mm", "", "Axis length of a fitted tool. Default: as its faces need", kLength},
        job.axis_length_mm);
  visit(FieldInfo{"tool_change", "min", "", "Time of a tool change, for each tool of the set", kMinutes},
        job.tool_change_min);
  visit_radius(job.radius, visit);
  visit_judge(job.judge, visit);
  visit_choice(job.choice, visit);
  visit_obstacles(job.obstacles, visit);
  visit(FieldInfo{"avoid", "", "Other faces",
                  "on: fits plan around the neighbouring faces; off: tools are fitted without them, which is quick "
                  "(they are checked all the same)",
                  kAny, Spelling::kOnOff},
        job.avoid);
}

inline std::string_view command_name(const DesignJob&) { return "design"; }

/// As for the other jobs (check_fields.h, command_line.h).
void check_fields(const DesignJob& job);
[[nodiscard]] std::string command_line(const DesignJob& job);

}  // namespace flank::internal

/// The fields of a correction: the part of the table (fields.h) that asks for a motion from what was measured.
#pragma once

#include <string>
#include <string_view>

#include "flank/job/correct_job.h"
#include "flank/job/fields.h"

namespace flank::internal::accepted {

inline constexpr Accepted kDatum{"must be fit or keep", nullptr,
                                 [](std::string_view x) { return x == "fit" || x == "keep"; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

template <class Visitor, Is<CorrectJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit or cover", kAny, Spelling::kFile, "DIR", true},
        job.folder);
  visit(FieldInfo{"profile", "", "",
                  "Profile of the tool as ground: a .dxf, or lines z, radius in mm, z along the axis from the centre "
                  "of the tip's sphere",
                  kAny, Spelling::kFile},
        job.profile);
  visit(FieldInfo{"measured", "", "", "Points of the face as cut: lines x, y, z in mm, or the vertices of a mesh", kAny,
                  Spelling::kFile},
        job.measured);
  visit(FieldInfo{"datum", "", "",
                  "fit: first move the measured points onto the face by a best fit; keep: take them where they are",
                  kDatum},
        job.datum);
  visit(FieldInfo{"limit", "mm", "", "Largest correction. Default: 20 times the tolerance", kLength}, job.limit_mm);
}

inline std::string_view command_name(const CorrectJob&) { return "correct"; }

/// As for the other jobs (check_fields.h, command_line.h).
void check_fields(const CorrectJob& job);
[[nodiscard]] std::string command_line(const CorrectJob& job);

}  // namespace flank::internal

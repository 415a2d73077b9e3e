/// The one table of what a user may ask for: every member of the jobs of job.h with its name, unit, range and help text.
/// Each command's part of it is a file: fit_fields.h, cover_fields.h, trochoid_fields.h, post_fields.h, verify_fields.h;
/// what several commands have in common is in part_fields.h, tool_fields.h and program_fields.h.
///
/// visit_fields(job, visit) calls visit(FieldInfo, member) for every field of the job, in the order of the help text.
///
/// A new member of a job is one line in one of these files, and has then an option of the command line, a key of job.json,
/// a check, and a place in the command that the report shows. tests/job changes every member and looks for it in all of
/// these.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/cover_fields.h"
#include "flank/job/field_info.h"
#include "flank/job/fit_fields.h"
#include "flank/job/part_fields.h"
#include "flank/job/post_fields.h"
#include "flank/job/program_fields.h"
#include "flank/job/tool_fields.h"
#include "flank/job/trochoid_fields.h"
#include "flank/job/verify_fields.h"

namespace flank::internal {

/// The word of the command line that asks for such a job.
inline std::string_view command_name(const FitJob&) { return "fit"; }
inline std::string_view command_name(const CoverJob&) { return "cover"; }
inline std::string_view command_name(const TrochoidJob&) { return "trochoid"; }
inline std::string_view command_name(const VerifyJob&) { return "verify"; }
inline std::string_view command_name(const PostJob&) { return "post"; }

}  // namespace flank::internal

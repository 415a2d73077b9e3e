/// Whether the values of a job are among those that the table of fields accepts.
#pragma once

#include "flank/job.h"

namespace flank::internal {

/// Throws UsageError naming the first field that is out of its range. What two fields must not be together is checked by
/// the command that uses them.
void check_fields(const FitJob& job);
void check_fields(const CoverJob& job);
void check_fields(const TrochoidJob& job);
void check_fields(const VerifyJob& job);
void check_fields(const PostJob& job);

}  // namespace flank::internal

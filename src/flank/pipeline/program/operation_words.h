/// What holds for one operation of a program alone: "2:name=finish,tool=7,spindle=12000".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/machine/nc/program.h"
#include "flank/run.h"

namespace flank::internal {

/// Of one operation; what is not given is the program's.
struct OperationWords {
  std::string name = {};
  std::optional<int> tool, flutes;
  std::optional<double> length_mm, spindle_rpm, feed_mm_min;
};

/// Of each of `count` operations (the folders, not their copies). Throws UsageError about the field `operations`.
[[nodiscard]] std::vector<OperationWords> parse_operations(const std::vector<std::string>& texts, std::size_t count);

/// "operation 2 of 6, finish, copy 2: ": what texts about it begin with.
[[nodiscard]] std::string heading(const NcOperation& operation);

/// The reasons and cautions of one operation among those of all, each after its heading.
void add_under(const std::string& heading, const Acceptance& one, Acceptance& all);

/// Throws InputError unless these are the operations of so many folders: each folder in its order with all of its copies. What is
/// missing, or is there twice, is no program of theirs.
void require_operations(const std::string& file, const std::vector<NcProgram>& operations, std::size_t folders);

/// Of each program the folder, from 0: of each folder all of its copies, one after the other, as many as they are. Throws InputError where that is not
/// so, or where there are not so many folders.
[[nodiscard]] std::vector<std::size_t> folders_of(const std::string& file, const std::vector<NcProgram>& operations,
                                                  std::size_t folders);

/// The request for the folder of one operation: what its words give takes the place of the program's own.
[[nodiscard]] PostJob request_of(const PostJob& request, const std::string& folder, const OperationWords& words);

}  // namespace flank::internal

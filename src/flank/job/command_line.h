/// The command line that asks for a job.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"

namespace flank::internal {

/// "flank fit blade.step --face F1 --tolerance 0.1", quoted for a POSIX shell: every field that differs from its default.
/// Given to the command it asks for the same job; only the folder of the results is not in it.
[[nodiscard]] std::string command_line(const FitJob& job);
[[nodiscard]] std::string command_line(const CoverJob& job);
[[nodiscard]] std::string command_line(const TrochoidJob& job);
[[nodiscard]] std::string command_line(const VerifyJob& job);
[[nodiscard]] std::string command_line(const PostJob& job);
[[nodiscard]] std::string command_line(const PlanJob& job);

/// The same as the words of a program's arguments: "fit", "blade.step", "--face", "F1", ...; not quoted.
[[nodiscard]] std::vector<std::string> command_words(const PlanJob& job);

/// The job with its files named without their folders, for showing it to others.
[[nodiscard]] PlanJob without_folders(const PlanJob& job);

/// What was asked for, for people: "tolerance 0.1 mm", "shank length 30 mm", ...: the tool, the tolerance, and every other
/// field that differs from its default but part and faces.
[[nodiscard]] std::vector<std::string> asked_for(const PlanJob& job);

/// A word in single quotes if a POSIX shell needs them.
[[nodiscard]] std::string shell_quoted(const std::string& word);

}  // namespace flank::internal

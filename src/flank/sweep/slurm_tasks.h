/// Tasks as job arrays of Slurm: submitted, watched, collected.
#pragma once

#include <cstddef>
#include <string>

#include "flank/sweep/run_tasks.h"

namespace flank::internal {

/// run_tasks by `sbatch --array` and `squeue`, at most `limits.processes` at a time (0: as many as Slurm lets run). Program,
/// folders and `scratch`, which is made for lists and exit codes and removed at the end, must be the same on all nodes.
/// A task that vanishes from the queue without an exit code counts as killed. While the controller does not answer it is
/// asked again: jobs go on without it. Arrays that an earlier run has left in `scratch` are cancelled first. Throws
/// InternalError where Slurm is missing or refuses a job.
[[nodiscard]] std::vector<ChildOutcome> slurm_tasks(const std::string& program, const std::vector<ChildTask>& tasks,
                                                    const ChildLimits& limits, const std::string& scratch,
                                                    const std::function<void(std::size_t, const ChildOutcome&)>& done,
                                                    const std::function<bool()>& cancelled);

/// The script of an element of an array, for a POSIX shell: works through the `count` lines of the file `list`, from the
/// one that SLURM_ARRAY_TASK_ID plus the first argument name (from 0) and round, and takes each that no other element has
/// taken (LIST.K is made first), until `seconds` have passed when a line ends. A line may use $nl. Told to end, it waits for its task, which is told
/// so, too; a line finds that in $cancelled.
[[nodiscard]] std::string element_script(const std::string& list, std::size_t count, int seconds);

/// The line of a POSIX shell that runs a task and writes "EXIT SECONDS" into the file `result`, whole or not at all.
/// `timeout_s`: after it the task is killed; 0: none. No line's end is in it: $nl stands for one.
[[nodiscard]] std::string task_line(const std::string& program, const ChildTask& task, const std::string& result,
                                    double timeout_s);

}  // namespace flank::internal

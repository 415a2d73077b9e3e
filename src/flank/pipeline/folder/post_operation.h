/// One operation of a program: its path, at one of its turned copies, as the machine runs it.
#pragma once

#include "flank/machine/model/machine.h"
#include "flank/machine/work_setup.h"
#include "flank/pipeline/folder/plan_operation.h"
#include "flank/pipeline/folder/turned_copies.h"

namespace flank::internal {

/// Which copy of an operation.
struct CopyOf {
  CopyAxis axis;
  int copy = 1, copies = 1;
};

/// Links and strips where the copy is, begun and ended upright in a set-up.
[[nodiscard]] Path turned_path(const Machine& machine, const PlannedOperation& plan, const WorkSetup& place,
                               const CopyOf& copy);

/// The program of one copy, and what is to be known of it. `machine` has the tool's length. What holds for every copy (the path's
/// own verdict, its links) is judged for the first. Throws InputError where the machine cannot run it.
[[nodiscard]] PostOutcome post_operation(const Machine& machine, const PlannedOperation& plan, const WorkSetup& place,
                                         const CopyOf& copy, NcProgram& program);

/// From the machine's gauge line to the controlled point: what the request gives, else as the machine's file has it.
[[nodiscard]] Machine with_length(Machine machine, const PlannedOperation& plan);

}  // namespace flank::internal

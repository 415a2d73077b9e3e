// What every command that runs a batch of tasks asks for.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "flank/sweep.h"

namespace flank::cli {

/// Adds --output, --processes, --engine and --resume. What they say, to be asked when the command runs: --threads counts.
std::function<BatchRun()> add_batch_options(CLI::App& app);

}  // namespace flank::cli

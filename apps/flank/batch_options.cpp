#include "batch_options.h"

#include <filesystem>
#include <memory>
#include <string>

#include "flank/threads.h"

namespace flank::cli {

std::function<BatchRun()> add_batch_options(CLI::App& app) {
  auto batch = std::make_shared<BatchRun>();
  auto processes = std::make_shared<int>(0);
  auto engine = std::make_shared<std::string>("local");
  app.add_option("-o,--output", batch->folder, "Folder for all results")->required();
  app.add_option("--processes", *processes,
                 "Number of tasks at a time; 0: one for each core. The results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  app.add_option(
         "--engine", *engine,
         "local: on this machine; slurm: as job arrays of Slurm, --processes at a time (0: as many as it allows)")
      ->capture_default_str()
      ->check(CLI::IsMember({"local", "slurm"}));
  app.add_flag("--resume", batch->resume, "Keep the finished tasks of an earlier run");
  return [batch, processes, engine] {
    BatchRun run = *batch;
    run.program = std::filesystem::read_symlink("/proc/self/exe").string();
    run.engine = *engine == "slurm" ? BatchEngine::kSlurm : BatchEngine::kLocal;
    run.processes = *processes > 0 || *engine == "slurm" ? *processes : thread_count();
    return run;
  };
}

}  // namespace flank::cli

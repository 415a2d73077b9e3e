// Strategy `grow` against `curves` (paper B's own pipeline; docs/algorithms/curves.md): the whole command on the same faces
// with the same tools, side by side, the judge's figures. With arguments: only the faces whose name contains one of them.
// FLANK_THREADS limits the threads (1 unless set). Time is the processor's, so that other programs do not count.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "asked_for.h"
#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/run.h"
#include "flank/threads.h"
#include "flank/tool_file.h"
#include "part_file.h"

namespace {

using namespace flank;
using namespace flank::internal;
using bench::asked_for;

constexpr std::uint64_t kSeeds = 5;

struct Scene {
  std::string name, part, tool;  ///< part: an example's name, or a file of FLANK_DATA
  double axis_length;            ///< 0: the tool is the example's own, its middle `middle_share`
  double tolerance;              ///< mm; < 0: the share of the diagonal
  double middle_share = 1.0;
};

std::vector<Scene> scenes() {
  const std::string cylinder = "cylinder:radius=5";
  return {{"twisted-blade 1e-3", "twisted-blade", cylinder, 20.0, -1e-3},
          {"twisted-blade 1e-4", "twisted-blade", cylinder, 20.0, -1e-4},
          {"elliptic-side cone", "elliptic-side", "cone:radius=4,angle=4", 30.0, 0.04},
          {"envelope-barrel-1 1e-4", "envelope-barrel-1", "", 0.0, -1e-4},
          {"envelope-barrel-1 1e-5", "envelope-barrel-1", "", 0.0, -1e-5},
          {"envelope-hyperbolic-2 middle 1e-4", "envelope-hyperbolic-2", "", 0.0, -1e-4, 0.6},
          {"envelope-hyperbolic-2 middle 1e-5", "envelope-hyperbolic-2", "", 0.0, -1e-5, 0.6},
          {"r37_blade F1 0.05", "r37_blade.step", cylinder, 20.0, 0.05},
          {"r37_blade F1 0.02", "r37_blade.step", cylinder, 20.0, 0.02}};
}

std::string scratch(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "flank_cover_bench";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string real_part(const std::string& name) {
  return bench::part_file(name, std::filesystem::path(scratch(name)).parent_path());
}

/// The middle of an example's own tool, as a file.
std::string own_tool(const Example& example, double share) {
  Tool tool = example.truth->tool;
  tool.radial = RadialFunction(tool.radial.family(), share * tool.radial.axis_length(), tool.radial.parameters());
  if (share == 1.0) tool = example.truth->tool;
  const std::string file = scratch(example.name + ".json");
  write_file(file, tool_to_json(tool));
  return file;
}

CoverJob job_of(const Scene& scene) {
  CoverJob job;
  job.judge.least_coverage = 1e-6;  // whatever comes out is shown
  job.tool.spec = scene.tool;
  if (scene.axis_length > 0.0) job.tool.axis_length_mm = scene.axis_length;
  job.tolerance_mm = scene.tolerance;
  if (scene.part.ends_with(".step")) {
    job.part.file = real_part(scene.part);
    return job;
  }
  const Example example = make_example(scene.part);
  job.part.file = scratch(scene.part + ".step");
  job.part.side = +1;
  write_example(example, job.part.file);
  if (scene.axis_length <= 0.0) job.tool.spec = own_tool(example, scene.middle_share);
  if (scene.tolerance < 0.0) job.tolerance_mm = -scene.tolerance * example.diagonal_mm;
  return job;
}

void row(const Scene& scene, const CoverJob& job, const std::string& label) {
  const std::clock_t start = std::clock();
  const Result outcome = run_cover(job, {});
  const TargetCover cover = std::get<CoverSummary>(outcome.plan).whole();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%-34s %-9s %7.4f %8.1f %8.1f %8.1f %7zu %9.0f %9.4f %8.1f\n", scene.name.c_str(), label.c_str(),
              *job.tolerance_mm, 100.0 * cover.before, 100.0 * cover.after, 100.0 * outcome.verify.coverage,
              outcome.path.strips.size(), 100.0 * cover.overlap, outcome.verify.overcut_mm, seconds);
}

/// Clusters depend on where the clustering starts, and so does what becomes of them: one row a seed shows the scatter.
void rows(const Scene& scene) {
  CoverJob job = job_of(scene);
  row(scene, job, "grow");
  job.strategy = "curves";
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    job.seed = seed;
    row(scene, job, "curves " + std::to_string(seed));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const char* threads = std::getenv("FLANK_THREADS");
  set_thread_count(threads ? std::atoi(threads) : 1);
  std::printf("%-34s %-9s %7s %8s %8s %8s %7s %9s %9s %8s\n", "face and tool", "by", "tol mm", "before %", "after %",
              "judged %", "strips", "overlap %", "overcut", "seconds");
  for (const Scene& scene : scenes()) {
    if (!asked_for(scene.name, argc, argv)) continue;
    try {
      rows(scene);
    } catch (const std::exception& e) {
      std::printf("%-34s not measured: %s\n", scene.name.c_str(), e.what());
    }
  }
  return 0;
}

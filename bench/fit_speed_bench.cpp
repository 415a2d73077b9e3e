// Time of one polish stage of the fit at the size of the papers: m x n = 100 x 30 samples, 24 control points a rail,
// free tool, one thread, from a start that is off by 1e-2 of the diagonal, seeding of the footpoints included.
#include <cstdio>

#include "fit_scenes.h"
#include "flank/fit/polish.h"
#include "flank/threads.h"

namespace {

using namespace flank;
using namespace flank::internal;
using namespace flank::internal::bench;

void time_stage(const char* what, const Target& target, const Scene& scene) {
  FlankFitOptions options;
  options.tolerance_mm = 1e-5 * scene.diagonal;
  const FitDraft draft = make_draft({{&target, scene.start}}, ToolModel{}, options);
  const FitStage stage = polish_stage(robust_scale(target, options));
  ResidualSummary summary;
  std::vector<IterationTrace> trace;
  const double seconds = fastest(5, [&] {
    trace.clear();
    (void)run_stage(draft, options.bounds, stage, &trace, &summary);
  });
  std::printf("%-18s %-12s %d x %d, %2zu steps: %7.2f ms   error %.2e -> %.2e of the diagonal (largest)\n",
              scene.name.c_str(), what, stage.samples_t, stage.samples_s, trace.size() - 1, 1e3 * seconds,
              trace.front().largest_mm / scene.diagonal, summary.largest_mm / scene.diagonal);
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"envelope-barrel-1", "envelope-cone-2", "envelope-hyperbolic-3"};
  for (const std::string& name : names) {
    const Scene scene = make_scene(name);
    time_stage("NURBS face", *scene.face, scene);
    const std::unique_ptr<Target> jets = make_target(scene.mesh);
    time_stage("mesh, jets", *jets, scene);
  }
  return 0;
}

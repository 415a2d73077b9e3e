// Cavities (docs/algorithms/trochoid.md): the strategies of the cycles side by side, `paper` being the published method's
// adjustment stage; a tool made for the cavity against the best cone and a barrel; the thickest tool against thinner ones. The
// whole command, the judge's figures. With arguments: only the tables whose name contains one of them. FLANK_THREADS
// limits the threads (1 unless set). Time is the processor's, so that other programs do not count.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>

#include "asked_for.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/run.h"
#include "flank/threads.h"

namespace {

using namespace flank;
using namespace flank::internal;
using bench::asked_for;

/// Of the free-form cavity that paper C gives the size of, mm.
constexpr double kWidth = 35.0, kDepth = 42.0, kLength = 50.0, kTwist = 16.0, kTolerance = 0.02;

std::string scratch(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "flank_cavity_bench";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

TrochoidJob cavity_job() {
  ExampleOptions options;
  options.cavity = {.width_mm = kWidth, .depth_mm = kDepth, .length_mm = kLength, .twist_deg = kTwist};
  TrochoidJob job;
  job.part.file = scratch("cavity.step");
  write_example(make_example("cavity", options), job.part.file);
  job.tolerance_mm = kTolerance;
  return job;
}

struct Outcome {
  Result result;
  double seconds = 0.0;
};

Outcome timed(const TrochoidJob& job) {
  const std::clock_t start = std::clock();
  Outcome out{run_trochoid(job, {}), 0.0};
  out.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return out;
}

/// Largest of overcut and undercut where the path touches the sides, mm.
double side_error(const Result& result) {
  return std::max(result.verify.overcut_mm, result.verify.undercut_covered_mm);
}

void row(const std::string& label, const TrochoidJob& job) {
  const auto [result, seconds] = timed(job);
  const auto& cavity = std::get<TrochoidSummary>(result.plan);
  double halves_mm = 0.0, volume = 0.0;
  int cycles = 0;
  for (const LayerSummary& layer : cavity.layers) {
    halves_mm += layer.fronts_mm + layer.backs_mm;
    volume += layer.volume_mm3;
    cycles += layer.cycles;
  }
  std::printf("%-26s %6.3f %6d %9.0f %9.2f %8.2f %9.4f %9.2f %8s %8.1f\n", label.c_str(), result.tool.radial.largest(),
              cycles, halves_mm, halves_mm > 0.0 ? volume / halves_mm : 0.0, cavity.largest_deg(), side_error(result),
              100.0 * result.verify.coverage, result.acceptance().pass() ? "yes" : "no", seconds);
}

void heading(const char* title) {
  std::printf("%s\n%-26s %6s %6s %9s %9s %8s %9s %9s %8s %8s\n", title, "", "radius", "cycles", "way mm", "mm^3/mm",
              "degrees", "error mm", "covered %", "verdict", "seconds");
}

void strategies() {
  heading("strategies");
  TrochoidJob job = cavity_job();
  for (const char* strategy : {"volume", "plain", "paper"}) {
    job.cycles.strategy = strategy;
    row(strategy, job);
  }
}

void tools() {
  heading("tools");
  // Whatever comes out is shown: only a tool of its own keeps this tolerance.
  for (const char* spec : {"free", "cone", "barrel:arc=15,radius=6"}) {
    TrochoidJob job = cavity_job();
    job.tool.spec = spec;
    row(spec, job);
  }
}

void thickness() {
  heading("thickness");
  TrochoidJob job = cavity_job();
  const auto [thickest, seconds] = timed(job);
  const double most = thickest.tool.radial.largest();
  for (const double share : {1.0, 0.8, 0.6}) {
    job.radius.max_mm = share * most;
    char label[32];
    std::snprintf(label, sizeof label, "%.0f %% of %.2f mm", 100.0 * share, most);
    row(label, job);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const char* threads = std::getenv("FLANK_THREADS");
  set_thread_count(threads ? std::atoi(threads) : 1);
  if (asked_for("strategies", argc, argv)) strategies();
  if (asked_for("tools", argc, argv)) tools();
  if (asked_for("thickness", argc, argv)) thickness();
  return 0;
}

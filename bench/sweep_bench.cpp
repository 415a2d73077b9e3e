// A sweep of 100,000 tasks whose results are there already (simulated: each a folder with a small summary): time and
// memory of reading and checking its plan, and of collecting it. Every folder must be kept; its figures must arrive.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "flank/base/sha256.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/manifest/manifest.h"
#include "flank/sweep/sweep.h"

namespace {

namespace fs = std::filesystem;
using flank::Progress;
using namespace flank::internal;

constexpr int kFaces = 4, kTools = 125, kVariants = 200;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string plan_text() {
  std::string text = "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"blade.step\"\nfaces = [\"F1\"";
  for (int k = 2; k <= kFaces; ++k) text += fmt::format(", \"F{}\"", k);
  text += "]\ntools = [\"cylinder:radius=2\"";
  for (int k = 1; k < kTools; ++k) text += fmt::format(", \"cylinder:radius={}\"", 2.0 + 0.01 * k);
  text += "]\n";
  for (int k = 0; k < kVariants; ++k)
    text += fmt::format("[variants.v{:03}]\ntolerance_mm = {}\n", k, 0.01 + 0.001 * k);
  return text;
}

/// What a run of this task would have left, but for the size of its files.
void simulate(const SweepPlan& plan, const SweepTask& task, const fs::path& root) {
  const std::string summary =
      R"({"coverage": 0.5, "coverage_reachable": 0.75, "overcut": 0.001, "undercut": 0.002, "strips": 2})";
  const std::string verdict = R"({"pass": false, "reasons": [{"figure": "coverage_reachable", "text": "75 %"}]})";
  static const std::string hash = sha256(summary), verdict_hash = sha256(verdict);
  fs::create_directories(root / task.name);
  write(root / task.name / "summary.json", summary);
  write(root / task.name / "verify.json", verdict);
  Manifest manifest;
  manifest.made_by = "cover";
  manifest.folder = (root / task.name).string();
  manifest.part = manifest.judged = {plan.part, plan.part_sha256};
  manifest.files["summary.json"] = hash;
  manifest.files["verify.json"] = verdict_hash;
  write(root / task.name / kManifestFile, manifest_to_json(manifest));
  const nlohmann::ordered_json record = {{"schema", "openflank/sweep-task/1"},
                                         {"words", task.words},
                                         {"part_sha256", plan.part_sha256},
                                         {"exit_code", 1},
                                         {"message", ""}};
  write(root / (task.name + ".task.json"), record.dump(2) + "\n");
}

}  // namespace

int main() {
  const fs::path root = fs::temp_directory_path() / fmt::format("flank-sweep-bench-{}", static_cast<int>(getpid()));
  fs::create_directories(root);
  (void)write_example(make_example("rotor37"), (root / "blade.step").string());
  write(root / "plan.toml", plan_text());

  auto start = std::chrono::steady_clock::now();
  const SweepPlan plan = read_plan((root / "plan.toml").string());
  const double planning = seconds_since(start), planned = peak_megabytes();
  for (const SweepTask& task : plan.tasks) simulate(plan, task, root / "out");

  start = std::chrono::steady_clock::now();
  // A task that is not kept would be run by this program, and fail.
  const BatchRun run{.program = "/bin/false", .folder = (root / "out").string(), .processes = 1, .resume = true};
  const SweepResult result = run_sweep(plan, run, Progress{});
  const double collecting = seconds_since(start);
  const int kept = result.count(TaskStatus::kFallsShort);
  bool figures = true;
  for (const SweepRow& row : result.rows) figures = figures && row.figures && row.figures->coverage_reachable == 0.75;
  fs::remove_all(root);

  std::printf("plan of %zu tasks: read and checked in %.1f s (%.0f MB), collected in %.1f s, peak %.0f MB\n",
              plan.tasks.size(), planning, planned, collecting, peak_megabytes());
  std::printf("kept %d of %zu, figures %s\n", kept, plan.tasks.size(), figures ? "of all" : "MISSING");
  const bool good = kept == static_cast<int>(plan.tasks.size()) && figures && planning + collecting < 60.0 &&
                    peak_megabytes() < 1024.0;
  std::printf("%s: at most 60 s and 1 GB\n", good ? "met" : "MISSED");
  return good ? 0 : 1;
}

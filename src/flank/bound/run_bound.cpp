#include "flank/bound/run_bound.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "flank/base/atomic_file.h"
#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/job/bound_fields.h"
#include "flank/job/input_files.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/targets.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// The faces that must not be entered, as surfaces.
std::unique_ptr<Target> other_faces(const Setup& setup) {
  if (setup.checks.empty()) return nullptr;
  if (setup.part.is_mesh()) return make_target(extract_mesh(setup.part, setup.checks));
  std::vector<Face> faces;
  for (const int f : setup.checks) faces.push_back(setup.part.faces[static_cast<std::size_t>(f)]);
  return make_target(std::move(faces));
}

}  // namespace

bool BoundResult::complete() const {
  for (const BoundTarget& target : targets)
    if (!target.map.complete) return false;
  return true;
}

bool BoundResult::blocked() const {
  for (const BoundTarget& target : targets)
    if (target.map.blocked_mm2 > 0.0) return true;
  return false;
}

BoundResult run_bound(const BoundJob& request, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  check_fields(request);
  BoundResult result;
  result.job = request;
  result.tool = given_tool(request.tool.spec, request.tool.axis_length_mm,
                           "expected a given tool, as cylinder:radius=5 or a tool file", result.notes);
  progress.step("read", 0.0);
  ObstacleRequest obstacles;
  obstacles.check_faces = request.check_faces;
  obstacles.ignore_faces = request.ignore_faces;
  const Setup setup = read_setup(request.part, obstacles, request.tolerance_mm, result.notes);
  result.part_sha256 = setup.part.sha256;
  result.job.tolerance_mm = setup.tolerance_mm;
  const std::unique_ptr<Target> others = other_faces(setup);
  const std::vector<TargetGroup> groups = make_targets(setup);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Target& target = *groups[k].target;
    ContactMapOptions options;
    options.tolerance_mm = setup.tolerance_mm;
    options.spacing_mm = std::sqrt(target.area() / request.points);
    options.search.gap = request.gap;
    const double share = 1.0 / static_cast<double>(groups.size());
    const Progress part = progress.part(share * static_cast<double>(k), share * static_cast<double>(k + 1));
    std::vector<const Target*> avoid;
    if (others) avoid.push_back(others.get());
    result.targets.push_back(
        {groups[k].faces, target.diagonal(), contact_map(target, avoid, result.tool, options, part)});
    if (progress.stop()) break;
  }
  if (result.targets.front().map.points.empty()) throw Stopped();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void require_inputs_kept(const BoundJob& job, const std::string& folder) {
  const ReadFiles inputs = read_files(job);
  const std::vector<std::string> names = job.map ? std::vector<std::string>{"map.json", "map.txt", "map.html"}
                                                 : std::vector<std::string>{"bound.json", "bound.txt"};
  for (const std::string& name : names) inputs.require_not_written((fs::path(folder) / name).string());
}

void write_bound(const BoundResult& result, const std::string& folder) {
  const ReadFiles inputs = read_files(result.job);
  const Unwritten unwritten(inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) throw InputError(folder + ": is not a folder and cannot be created");
  write_file((fs::path(folder) / "bound.json").string(), bound_json(result));
  write_file((fs::path(folder) / "bound.txt").string(), bound_text(result));
}

}  // namespace flank::internal

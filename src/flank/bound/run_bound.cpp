#include "flank/bound/run_bound.h"

#include <chrono>
#include <cmath>
#include <filesystem>

#include "flank/base/stopping.h"
#include "flank/bound/bound_setup.h"
#include "flank/error.h"
#include "flank/job/bound_fields.h"
#include "flank/job/input_files.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace fs = std::filesystem;

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
  const BoundSetup setup = read_bound_setup(request, result.notes);
  result.part_sha256 = setup.setup.part.sha256;
  result.job.tolerance_mm = setup.setup.tolerance_mm;
  const std::vector<TargetGroup>& groups = setup.groups;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Target& target = *groups[k].target;
    ContactMapOptions options;
    options.tolerance_mm = setup.setup.tolerance_mm;
    options.spacing_mm = std::sqrt(target.area() / request.points);
    options.search.gap = request.gap;
    const double share = 1.0 / static_cast<double>(groups.size());
    const Progress part = progress.part(share * static_cast<double>(k), share * static_cast<double>(k + 1));
    result.targets.push_back(
        {groups[k].faces, target.diagonal(), contact_map(target, setup.avoided(), result.tool, options, part)});
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
  write_bound_files(result.job, folder, bound_json(result), bound_text(result));
}

}  // namespace flank::internal

#include "flank/wheel/perform.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/path_file.h"
#include "flank/results/acceptance.h"

namespace flank::internal {

namespace fs = std::filesystem;

namespace {

/// The first reason against a draft that is not the lack of a proof: the proof is the whole wheel's.
std::optional<Shortfall> found_by_samples(const Acceptance& acceptance) {
  for (const Shortfall& reason : acceptance.reasons)
    if (!is_proof(reason)) return reason;
  return {};
}

}  // namespace

bool is_proof(const Shortfall& reason) {
  return reason.figure == figure_name(Figure::kOvercutBound) || reason.figure == figure_name(Figure::kGougeBound) ||
         reason.figure == figure_name(Figure::kCoverageBound);
}

std::string in_folder(const WheelWork& work, const std::string& name) {
  return (fs::path(work.job.folder) / name).string();
}

std::string tool_file(const WheelWork& work, const std::string& tool) {
  return fs::absolute(in_folder(work, "tools/" + tool + ".json")).lexically_normal().string();
}

void settle(const Result& result, WheelOperation& operation) {
  const std::optional<Shortfall> shortfall = found_by_samples(result.acceptance());
  operation.done = result.complete;
  operation.pass = result.complete && !shortfall;
  if (!result.complete)
    operation.problem = "stopped, or its limit of processor time was reached";
  else
    operation.problem = shortfall ? shortfall->text : std::string();
}

WheelOperation perform(const WheelWork& work, WheelOperation operation, const std::string& decides,
                       const std::function<Result()>& make) {
  operation.folder = "ops/" + operation.id + "-" + operation.kind;
  operation.key = sha256(work.part.sha256 + work.program + decides + fmt::format(" {}", work.most_tilt_deg));
  const auto known = work.finished.find(operation.id);
  if (known != work.finished.end() && known->second.done && known->second.key == operation.key &&
      fs::exists(in_folder(work, operation.folder + "/path.json"))) {
    operation = known->second;
    operation.kept = true;
    return operation;
  }
  if (work.begins) work.begins(operation.id);
  const auto begun = std::chrono::steady_clock::now();
  try {
    const Result result = make();
    if (result.path.pose_count() == 0) throw InputError("no pass was found");
    write_result(result, in_folder(work, operation.folder));
    settle(result, operation);
  } catch (const Error& error) {
    operation.problem = error.what();
  }
  operation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return operation;
}

void take(WheelWork& work, const WheelOperation& operation) {
  if (!operation.done) return;
  const Path path = read_path(in_folder(work, operation.folder + "/path.json"));
  work.finish.strips.insert(work.finish.strips.end(), path.strips.begin(), path.strips.end());
}

}  // namespace flank::internal

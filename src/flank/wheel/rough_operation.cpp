#include "flank/wheel/rough_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "flank/base/atomic_file.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/floor_operation.h"
#include "flank/wheel/guarded.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/point/pass_strips.h"
#include "flank/wheel/rough/bands.h"
#include "flank/wheel/rough/clear_channel.h"
#include "flank/wheel/rough_tool.h"

namespace flank::internal {
namespace {

constexpr double kChordShare = 0.05;  ///< of what is left, by which the path may leave the places that have room
constexpr double kGuardShare = 0.3;   ///< of what is left, by which it is proved to keep off
constexpr double kLayerShare = 3.0;   ///< of the tip's radius, from layer to layer, at most
constexpr double kFreeShare =
    0.95;  ///< of how far a blade may stand free, that the layers take: their floor is not quite the hub's
constexpr int kMostLayers = 1'000'000;  ///< of one operation, where blades may stand free as far as they like
constexpr const char* kId = "10";

/// From layer to layer, mm.
double layer_depth(const WheelWork& work, const Tool& tool) {
  const double depth = kLayerShare * tool.radial.at(0.0).r, free = most_free_mm(work.job, work.roles);
  return free > 0.0 ? std::min(depth, kFreeShare * free) : depth;
}

/// All layers of all channels of a sector, a channel after the other.
Path rough_path(WheelWork& work, const Tool& tool) {
  const PointOptions options = rough_options(work, tool);
  ClearingRequest request{.keep_mm = rough_allowance(work),
                          .most_engagement_rad = work.job.most_engagement_deg * std::numbers::pi / 180.0,
                          .layer_mm = layer_depth(work, tool),
                          .face = face_list(work.roles.hub),
                          .outline = work.blank.outline};
  const double off = kGuardShare * kRoughAllowanceMm + (work.equal() ? 0.0 : work.difference_mm),
               chord = kChordShare * kRoughAllowanceMm;
  request.guard = [&](const Path& around) -> MotionTest {
    const auto guard = std::make_shared<const PathGuard>(work, around, tool, -off - chord);
    return [guard](const Pose& from, const Pose& to) { return guard->is_free(from, to); };
  };
  std::vector<FloorChannel> channels;
  for (const SectorChannel& one : work.sector.channels) channels.push_back(floor_channel(work, one));
  for (const FloorChannel& channel : channels)
    request.layers = std::max(request.layers, layer_count(channel, request.outline, request.layer_mm));
  Path out;
  for (const FloorChannel& channel : channels)
    for (const Strip& strip : clear_channel(channel, tool.radial, options, request))
      out.strips.push_back(thinned(strip, tool.radial.axis_length(), chord));
  return guarded(work, out, tool, -off, Turns::kAny);
}

/// Planning takes minutes: what was found lies in a folder of its own, and is taken from there where the same is asked again.
Path known_rough_path(WheelWork& work, const Tool& tool, const std::string& decides) {
  namespace fs = std::filesystem;
  const fs::path folder = in_folder(work, "fits/rough");
  const std::string mark = (folder / "key.txt").string(), file = (folder / "path.json").string(),
                    key = sha256(work.part.sha256 + work.program + decides);
  if (!fs::exists(mark) || !fs::exists(file) || read_file(mark) != key) {
    const Path path = rough_path(work, tool);
    if (path.strips.empty()) throw InputError("no layer has room between the blades");
    fs::create_directories(folder);
    write_path(path, file);
    write_file(mark, key);
  }
  // As a run that goes on from here has it.
  return read_path(file);
}

/// "10", or of several "10.1", "10.2" and so on, in the order of their names.
std::string id_of(std::size_t band, std::size_t bands) {
  if (bands == 1) return kId;
  return fmt::format("{}.{:0{}}", kId, band + 1, std::to_string(bands).size());
}

std::vector<WheelOperation> perform_bands(WheelWork& work, const WheelOperation& like, const Tool& tool,
                                          const std::string& decides) {
  const auto begun = std::chrono::steady_clock::now();
  const double depth = layer_depth(work, tool), free = most_free_mm(work.job, work.roles);
  const Path path = known_rough_path(work, tool, decides);
  const std::vector<Path> bands =
      bands_of(path, free > 0.0 ? std::max(1, static_cast<int>(free / depth)) : kMostLayers);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  std::vector<WheelOperation> out;
  for (std::size_t k = 0; k < bands.size(); ++k) {
    WheelOperation one = like;
    one.id = id_of(k, bands.size());
    one = perform(work, one, decides, [&] {
      return judged_path(work, work.roles.hub, bands[k], work.job.least_coverage, Care::kDraft, like.tool);
    });
    // Roughing finishes nothing. Its verdict is that of its simulation in the whole blank (judge_roughing).
    if (one.done) one.pass = true, one.problem.clear();
    if (k == 0) one.seconds += seconds;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

double most_free_mm(const WheelRequest& job, const WheelRoles& roles) {
  double thinnest = 0.0;
  for (const WheelBlade& blade : roles.blades)
    if (blade.thickness_mm > 0.0 && (thinnest == 0.0 || blade.thickness_mm < thinnest)) thinnest = blade.thickness_mm;
  return job.balance.value_or(0.0) * thinnest;
}

std::vector<WheelOperation> rough_operations(WheelWork& work) {
  WheelOperation operation{.id = kId, .kind = "rough", .folder = "", .faces = work.roles.hub};
  if (!work.tool || work.roles.outline.empty()) {
    operation.problem = work.tool ? "the tips of the blades are not known, so the blank has no outline"
                                  : "no tool: none was found for the sides of the blades";
    return {operation};
  }
  operation.tool = choose_rough_tool(work);
  operation.copies = work.sector.copies;
  const Tool tool = operation.tool == "T2" ? *work.rough_tool : *work.tool;
  std::string decides = tool_to_json(tool) + fmt::format("{} {} {} {} {}", work.job.tolerance_mm, work.difference_mm,
                                                         work.job.most_engagement_deg, work.job.balance.value_or(0.0),
                                                         work.most_tilt_deg);
  if (work.job.blank) decides += sha256(read_file(*work.job.blank));
  try {
    return perform_bands(work, operation, tool, decides);
  } catch (const Error& error) {
    operation.problem = error.what();
    return {operation};
  }
}

}  // namespace flank::internal

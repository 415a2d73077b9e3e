#include "flank/wheel/rough_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/floor_operation.h"
#include "flank/wheel/guarded.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/point/axis_rod.h"
#include "flank/wheel/point/floor_passes.h"
#include "flank/wheel/point/pass_strips.h"
#include "flank/wheel/rough/channel_section.h"
#include "flank/wheel/rough/clear_channel.h"

namespace flank::internal {
namespace {

constexpr double kAllowanceMm = 0.3;  ///< that roughing leaves
constexpr double kChordShare = 0.05;  ///< of that, by which the path may leave the places that have room
constexpr double kWidthShare =
    0.2;  ///< of a channel's width round the axis, that the tip's radius takes: channels run aslant
constexpr double kTaperDeg = 5.0;
constexpr double kLayerShare = 1.0;  ///< of the tip's radius
constexpr double kApartShare = 1.0;
constexpr double kSmallestGain = 1.2;  ///< a tool that is no larger is not worth a change
constexpr double kGuardShare = 0.3;    ///< of what is left, by which it is proved to keep off
constexpr double kSlotDeg = 180.0;     ///< engagement in a slot

/// T2, where a tool larger than T1 fits; else T1.
std::string choose_tool(WheelWork& work) {
  double width = 1e300, height = 0.0;
  for (const SectorChannel& channel : work.sector.channels)
    width = std::min(width, channel_width(floor_channel(work, channel), work.tool->radial));
  for (const WheelBlade& blade : work.sector.blades) height = std::max(height, blade.height_mm);
  const double radius = std::floor(kWidthShare * width * 20.0) / 20.0;
  if (radius < kSmallestGain * work.tool->radial.at(0.0).r) return "T1";
  Tool tool;
  tool.name = fmt::format("roughing cone, tip {:.2f} mm, {} degrees", radius, kTaperDeg);
  tool.radial = RadialFunction(ToolFamily::kCone, height + radius, Eigen::Vector2d(radius, kTaperDeg * M_PI / 180.0));
  work.rough_tool = tool;
  write_tool(tool, tool_file(work, "T2"));
  return "T2";
}

/// Where material begins: a turned blank is hardly more than the tips' outline.
const std::vector<Vec2>& top_of(const WheelWork& work) {
  return work.job.blank ? work.blank.outline : work.roles.outline;
}

/// The passes of a layer as far apart as the tip's radius, the first one a slot; the highest layer first.
std::vector<Strip> slot_layers(const WheelWork& work, const FloorChannel& channel, const Tool& tool,
                               PointOptions options, double keep) {
  const double tip = tool.radial.at(0.0).r;
  const ChannelSection section(channel, top_of(work));
  options.apart_mm = kApartShare * tip;
  options.is_air = [&section, tip](const Vec3& center) { return section.is_air(center, tip); };
  const int layers = 1 + static_cast<int>(std::ceil(section.height() / (kLayerShare * tip)));
  std::vector<double> heights;
  for (int layer = 0; layer < layers; ++layer) heights.push_back(keep + layer * kLayerShare * tip);
  std::vector<std::vector<Strip>> found =
      layer_passes(channel, tool.radial, options, heights, face_list(work.roles.hub));
  std::vector<Strip> out;
  for (int layer = 1; layer <= layers; ++layer)
    for (Strip& strip : found[static_cast<std::size_t>(layers - layer)]) {
      strip.layer = layer;
      out.push_back(std::move(strip));
    }
  return out;
}

std::vector<Strip> cleared(WheelWork& work, const FloorChannel& channel, const Tool& tool) {
  const double keep = kAllowanceMm + (work.equal() ? 0.0 : work.difference_mm);
  PointOptions options = work.point_options(work.roles.hub);
  options.enter_share = -keep / work.job.tolerance_mm;
  options.shank_mm = shank_radius(tool);
  if (work.job.most_engagement_deg >= kSlotDeg) return slot_layers(work, channel, tool, options, keep);
  return clear_channel(channel, tool.radial, options,
                       {.keep_mm = keep,
                        .most_engagement_rad = work.job.most_engagement_deg * std::numbers::pi / 180.0,
                        .face = face_list(work.roles.hub),
                        .outline = work.blank.outline});
}

Path rough_path(WheelWork& work, const Tool& tool) {
  Path out;
  for (const SectorChannel& one : work.sector.channels)
    for (const Strip& strip : cleared(work, floor_channel(work, one), tool))
      out.strips.push_back(thinned(strip, tool.radial.axis_length(), kChordShare * kAllowanceMm));
  const Turns turns = work.job.most_engagement_deg >= kSlotDeg ? Turns::kHeld : Turns::kAny;
  return guarded(work, out, tool, -kGuardShare * kAllowanceMm - (work.equal() ? 0.0 : work.difference_mm), turns);
}

}  // namespace

WheelOperation rough_operation(WheelWork& work) {
  WheelOperation operation{.id = "10", .kind = "rough", .folder = "", .faces = work.roles.hub};
  if (!work.tool || work.roles.outline.empty()) {
    operation.problem = work.tool ? "the tips of the blades are not known, so the blank has no outline"
                                  : "no tool: none was found for the sides of the blades";
    return operation;
  }
  operation.tool = choose_tool(work);
  operation.copies = work.sector.copies;
  const Tool tool = operation.tool == "T2" ? *work.rough_tool : *work.tool;
  std::string decides = tool_to_json(tool) + fmt::format("{} {} {}", work.job.tolerance_mm, work.difference_mm,
                                                         work.job.most_engagement_deg);
  if (work.job.blank) decides += sha256(read_file(*work.job.blank));
  operation = perform(work, operation, decides, [&] {
    Path path = rough_path(work, tool);
    if (path.strips.empty()) throw InputError("no layer has room between the blades");
    return judged_path(work, work.roles.hub, std::move(path), work.job.least_coverage, Care::kDraft, operation.tool);
  });
  // Roughing finishes nothing. Its verdict is that of its simulation in the whole blank (judge_roughing).
  if (operation.done) operation.pass = true, operation.problem.clear();
  return operation;
}

}  // namespace flank::internal

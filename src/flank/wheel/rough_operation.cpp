#include "flank/wheel/rough_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
#include "flank/wheel/point/floor_map.h"
#include "flank/wheel/point/floor_passes.h"
#include "flank/wheel/point/pass_strips.h"

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
constexpr double kMapStepMm = 0.5;

double distance_to(const std::vector<Vec2>& line, const Vec2& p) {
  double least = 1e300;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 side = line[k + 1] - line[k];
    const double t =
        side.squaredNorm() > 0.0 ? std::clamp((p - line[k]).dot(side) / side.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (p - line[k] - t * side).norm());
  }
  return least;
}

/// Half of the wheel's section between hub and tips, along the axis and away from it.
class Section {
 public:
  Section(const FloorChannel& channel, const std::vector<Vec2>& outline) : axis_(channel.axis), outline_(outline) {
    const FloorMap map(channel.floor, channel.axis);
    for (double way = 0.0; way <= map.length(); way += kMapStepMm) hub_.push_back(flat(map.place(way, 0.0)));
    polygon_ = hub_;
    if (hub_.empty() || outline_.empty()) return;
    const bool same = (hub_.back() - outline_.front()).norm() < (hub_.back() - outline_.back()).norm();
    polygon_.insert(polygon_.end(), outline_.begin(), outline_.end());
    if (!same) std::reverse(polygon_.end() - static_cast<std::ptrdiff_t>(outline_.size()), polygon_.end());
  }
  /// Whether a ball is above the tips, or before or behind the blank.
  [[nodiscard]] bool is_air(const Vec3& center, double radius) const {
    const Vec2 p = flat(center);
    bool inside = false;
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      const Vec2 &a = polygon_[k], &b = polygon_[(k + 1) % polygon_.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
    if (inside) return false;
    std::vector<Vec2> closed = polygon_;
    closed.push_back(polygon_.front());
    return distance_to(closed, p) > radius;
  }
  /// Of the tips over the hub, mm, at most.
  [[nodiscard]] double height() const {
    double most = 0.0;
    for (const Vec2& p : outline_) most = std::max(most, distance_to(hub_, p));
    return most;
  }

 private:
  [[nodiscard]] Vec2 flat(const Vec3& p) const { return {axis_.along(p), axis_.radius(p)}; }
  WheelAxis axis_;
  std::vector<Vec2> outline_, hub_, polygon_;
};

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

Path rough_path(WheelWork& work, const Tool& tool) {
  const RadialFunction& radial = tool.radial;
  const double tip = radial.at(0.0).r, keep = kAllowanceMm + (work.equal() ? 0.0 : work.difference_mm);
  Path out;
  for (const SectorChannel& one : work.sector.channels) {
    const FloorChannel channel = floor_channel(work, one);
    const Section section(channel, top_of(work));
    PointOptions options = work.point_options(work.roles.hub);
    options.enter_share = -keep / work.job.tolerance_mm;
    options.apart_mm = kApartShare * tip;
    options.shank_mm = shank_radius(tool);
    options.is_air = [&section, tip](const Vec3& center) { return section.is_air(center, tip); };
    const int layers = 1 + static_cast<int>(std::ceil(section.height() / (kLayerShare * tip)));
    std::vector<double> heights;
    for (int layer = 0; layer < layers; ++layer) heights.push_back(keep + layer * kLayerShare * tip);
    std::vector<std::vector<Strip>> found = layer_passes(channel, radial, options, heights, face_list(work.roles.hub));
    // The highest is machined first.
    for (int layer = 1; layer <= layers; ++layer)
      for (Strip& strip : found[static_cast<std::size_t>(layers - layer)]) {
        strip.layer = layer;
        out.strips.push_back(thinned(strip, radial.axis_length(), kChordShare * kAllowanceMm));
      }
  }
  return guarded(work, out, tool, -0.5 * kAllowanceMm - (work.equal() ? 0.0 : work.difference_mm));
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
  std::string decides = tool_to_json(tool) + fmt::format("{} {}", work.job.tolerance_mm, work.difference_mm);
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

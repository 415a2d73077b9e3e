#include "flank/pipeline/folder/judge_roughing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "flank/io/mesh/read_stl.h"
#include "flank/io/text/json_input.h"
#include "flank/manifest/result_folder.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/judge_job.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"
#include "flank/verify/program_stock.h"

namespace flank::internal {
namespace {

constexpr double kSlotDeg = 180.0;  ///< engagement in a slot

/// The first few of them, and how many more there are.
std::string some_of(const std::vector<std::string>& faces) {
  constexpr std::size_t kShown = 6;
  const auto last = faces.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, faces.size()));
  const std::string text = fmt::format("{}", fmt::join(faces.begin(), last, ","));
  return faces.size() > kShown ? fmt::format("{} and {} more", text, faces.size() - kShown) : text;
}

}  // namespace

std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup) {
  const WheelStep* step = plan.roughing();
  if (step == nullptr) return {};
  const Path sector = read_path((std::filesystem::path(step->folder) / "path.json").string());
  return judge_roughing(plan, setup, sector, all_copies(sector, plan, step->copies));
}

std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup, const Path& sector,
                                             const Path& all) {
  const WheelStep* step = plan.roughing();
  if (step == nullptr) return {};
  const ResultFolder folder(step->folder, ResultFolder::Use::kRead);
  folder.require_whole({"verify.json", "view.json", "motion.json"});
  JudgedRoughing out;
  out.most_engagement_deg = plan.most_engagement_deg;
  out.tool = read_tool((std::filesystem::path(step->folder) / "tool.json").string());
  out.cuts = judge_cuts(setup, out.tool, all);
  std::vector<std::string> told;
  // One sector stands for its copies.
  measure_bodies(make_clearance_scene(setup, {}, has_body(out.tool), told), out.tool, sector, out.cuts);
  if (!plan.blank.empty())
    out.stock = rough_stock(out.tool, sector, read_stl(plan.blank, read_file(plan.blank)), plan.most_engagement_deg);
  return out;
}

std::string roughing_text(const JudgedRoughing& roughing) {
  const VerifyReport& cuts = roughing.cuts;
  const StockReport& stock = roughing.stock;
  std::string text = fmt::format("roughing: deepest gouge {:.4f} mm, proved to be nowhere deeper than {:.4f} mm",
                                 cuts.gouge_mm, cuts.gouge_bound_mm);
  for (const StockKind& kind : stock.kinds)
    text += fmt::format(
        "; engagement up to {:.1f} degrees (+-{:.1f}, pass {}), {:.0f} of {:.0f} mm3 removed in one sector along "
        "{:.0f} mm of path",
        kind.engagement_deg, stock.resolution_deg, kind.strip + 1, kind.volume_mm3, stock.before_mm3, kind.way_mm);
  return text;
}

void accept_steps(const WheelPlan& plan, const std::optional<JudgedRoughing>& roughing, Acceptance& acceptance) {
  for (const WheelStep& step : plan.steps)
    if (!step.done)
      add_reason(acceptance, Figure::kComplete,
                 fmt::format("operation {} ({}) has no result: {}", step.id, step.kind, step.problem));
  if (!plan.left_out.empty())
    add_caution(acceptance, Figure::kClearance,
                fmt::format("solids that are no part of the wheel were left out, faces {}: nothing was checked against "
                            "them, so they must not be there while it is machined",
                            some_of(plan.left_out)));
  if (!roughing) return;
  JudgeRequest request;
  request.least_coverage = 0.0;
  Acceptance found = accept(roughing->tool, roughing->cuts, request);
  // Shank and holder are a caution of the whole already. Where slots are allowed, so is all that a tool engages as it goes into the blank.
  const double most = roughing->most_engagement_deg < kSlotDeg ? roughing->most_engagement_deg : 2.0 * kSlotDeg;
  accept_stock(roughing->stock, most, roughing->cuts.tolerance_mm, found);
  for (const Shortfall& reason : found.reasons)
    acceptance.reasons.push_back({reason.figure, "roughing: " + reason.text});
}

}  // namespace flank::internal

#include "flank/pipeline/folder/judge_roughing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "flank/error.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/text/json_input.h"
#include "flank/manifest/result_folder.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/free_height.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"
#include "flank/verify/program_stock.h"

namespace flank::internal {
namespace {

/// The first few of them, and how many more there are.
std::string some_of(const std::vector<std::string>& faces) {
  constexpr std::size_t kShown = 6;
  const auto last = faces.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, faces.size()));
  const std::string text = fmt::format("{}", fmt::join(faces.begin(), last, ","));
  return faces.size() > kShown ? fmt::format("{} and {} more", text, faces.size() - kShown) : text;
}

void add_strips(const Path& more, Path& to) {
  to.strips.insert(to.strips.end(), more.strips.begin(), more.strips.end());
}

/// The one tool of all steps that rough.
Tool tool_of(const std::vector<const WheelStep*>& steps) {
  const auto file_of = [](const WheelStep& step) {
    return (std::filesystem::path(step.folder) / "tool.json").string();
  };
  for (const WheelStep* step : steps) {
    const ResultFolder folder(step->folder, ResultFolder::Use::kRead);
    folder.require_whole({"verify.json", "view.json", "motion.json"});
    if (read_file(file_of(*step)) != read_file(file_of(*steps.front())))
      throw InputError(step->folder + ": its tool is not that of " + steps.front()->folder + "; plan the wheel again");
  }
  return read_tool(file_of(*steps.front()));
}

}  // namespace

std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup) {
  std::vector<Path> steps;
  Path sector;
  int copies = 1;
  for (const WheelStep* step : plan.roughing()) {
    steps.push_back(read_path((std::filesystem::path(step->folder) / "path.json").string()));
    add_strips(steps.back(), sector);
    copies = step->copies;
  }
  // A sector after the other, though they are machined in another order: the judge keeps one of equal sectors.
  return judge_roughing(plan, setup, steps, all_copies(sector, plan, copies));
}

std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup, const std::vector<Path>& steps,
                                             const Path& all) {
  if (steps.empty()) return {};
  JudgedRoughing out;
  out.tool = tool_of(plan.roughing());
  out.most_engagement_deg = plan.most_engagement_deg;
  out.cuts = judge_cuts(setup, out.tool, all);
  out.left = left_by_roughing(setup, out.tool, all, kOpenBall * setup.tolerance_mm);
  out.most_free_mm = plan.most_free_mm;
  out.free_mm = free_height(plan, setup, steps, out.tool.radial.at(0.0).r);
  // One sector stands for its copies.
  Path sector;
  for (const Path& step : steps) add_strips(step, sector);
  std::vector<std::string> told;
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
  text += fmt::format("; excess material of {:.2f} mm left on half of the surface, {:.2f} mm on nine tenths, at most",
                      roughing.left.median_mm, roughing.left.nine_tenths_mm);
  if (roughing.free_mm > 0.0)
    text += fmt::format("; a blade stands free on one side by up to {:.2f} mm", roughing.free_mm);
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
  // Shank and holder are a caution of the whole already.
  accept_stock(roughing->stock, roughing->most_engagement_deg, roughing->cuts.tolerance_mm, found);
  if (roughing->most_free_mm > 0.0 && roughing->free_mm > roughing->most_free_mm + roughing->cuts.tolerance_mm)
    add_reason(found, Figure::kStock,
               fmt::format("a blade stands free on one side by {:.2f} mm > {:.2f} mm, while the channel on its other "
                           "side is not cut",
                           roughing->free_mm, roughing->most_free_mm));
  for (const Shortfall& reason : found.reasons)
    acceptance.reasons.push_back({reason.figure, "roughing: " + reason.text});
}

}  // namespace flank::internal

#include "flank/pipeline/catalogue_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/artefact/ranking_json.h"
#include "flank/choose/family_search.h"
#include "flank/error.h"
#include "flank/setup/make_obstacles.h"

namespace flank::internal {
namespace {

/// Targets with all that is in the way of any of the tools, from every side that is asked for.
struct Scene {
  std::vector<std::vector<TargetGroup>> groups;  ///< [target][side]
  std::vector<std::vector<Obstacles>> obstacles;
  std::vector<RankingTarget> targets;
};

Scene make_scene(const CoverJob& job, const Part& part, const std::vector<int>& faces, const ToolExtent& extent) {
  Scene scene;
  const std::vector<Part> fixtures = read_fixtures(job.base.clearance.fixtures, job.base.unit);
  std::vector<TargetGroup> other_side;
  if (!job.base.side) other_side = make_targets(part, faces, -1);
  for (TargetGroup& group : make_targets(part, faces, job.base.side.value_or(+1))) {
    const std::size_t k = scene.groups.size();
    const bool both = !job.base.side && !group.of_solid;
    scene.groups.emplace_back();
    scene.groups.back().push_back(std::move(group));
    if (both) scene.groups.back().push_back(std::move(other_side[k]));
    scene.obstacles.emplace_back();
    for (const TargetGroup& side : scene.groups.back())
      scene.obstacles.back().push_back(obstacles_of(job, part, fixtures, side, extent));
  }
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    scene.targets.emplace_back();
    for (std::size_t i = 0; i < scene.groups[k].size(); ++i)
      scene.targets.back().push_back({scene.groups[k][i].target.get(), &scene.obstacles[k][i]});
  }
  return scene;
}

ToolExtent largest_extent(const std::vector<Tool>& tools) {
  ToolExtent largest;
  for (const Tool& tool : tools) {
    const ToolExtent extent = extent_of(tool);
    largest.reach_mm = std::max(largest.reach_mm, extent.reach_mm);
    largest.above = largest.above || extent.above;
  }
  return largest;
}

RankingOptions ranking_options(const CoverJob& job) {
  RankingOptions options;
  options.cover = options_of(job);
  options.rates = job.rates;
  options.finalists = job.finalists;
  return options;
}

Tool equipped(const CoverJob& job, const RadialFunction& radial) {
  Tool tool;
  tool.radial = radial;
  equip_tool(job.base.clearance, tool);
  return tool;
}

/// Of any tool that the search of a family may try: the part's own size is the limit.
ToolExtent family_extent(const CoverJob& job, const Part& part) {
  const double diagonal = part.box.diagonal(), length = job.base.axis_length_mm.value_or(diagonal);
  const RadialFunction stout(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, 0.15 * diagonal));
  return extent_of(equipped(job, stout));
}

/// The best of the family by quick covers: those are what is ranked.
RankingReport family_report(const CoverJob& job, const ToolChoice& choice, const Scene& scene,
                            const Progress& progress) {
  FamilySearchOptions options;
  options.ranking = ranking_options(job);
  options.axis_length_mm = job.base.axis_length_mm;
  options.kept = static_cast<std::size_t>(job.finalists);
  options.equip = [&](const RadialFunction& radial) { return equipped(job, radial); };
  FamilySearchResult found =
      search_family(scene.targets, *choice.family.family, choice.family.given, options, progress);
  RankingReport report;
  report.options = options.ranking;
  for (const Tool& tool : found.tools)
    report.names.push_back(fmt::format("{} --axis-length {:.4g}", tool.name, tool.radial.axis_length()));
  report.source = fmt::format("{}, searched over {}; {} tools by their meridians, {} of them in place, {} by strips",
                              job.base.tool, found.searched, found.grid, found.screened, found.covered);
  report.tools = std::move(found.tools);
  return report;
}

RankingReport catalogue_report(const CoverJob& job, const ToolChoice& choice) {
  RankingReport report;
  report.options = ranking_options(job);
  report.source = "catalogue " + choice.folder;
  for (const CatalogueTool& entry : choice.tools) {
    report.names.push_back(entry.name);
    report.tools.push_back(entry.tool);
    if (report.tools.back().name.empty()) report.tools.back().name = entry.name;
  }
  return report;
}

/// Strips of the tool that came first, on the sides that it was better on.
std::vector<Covered> taken(Scene& scene, const RankedTool& best, bool side_was_asked) {
  std::vector<Covered> all;
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    const std::size_t side = best.side.empty() ? 0 : best.side[k];
    all.push_back({std::move(scene.groups[k][side]), best.results.empty() ? CoverResult{} : best.results[k]});
    if (!side_was_asked && scene.groups[k].size() > 1)
      all.back().result.notes.push_back(
          fmt::format("{}: open sheet: both sides were tried, side {} covers more; choose with --side",
                      all.back().group.faces, side == 0 ? "+" : "-"));
  }
  return all;
}

void note_none(const RankingReport& report, FitOutcome& outcome) {
  const RankedTool& nearest = report.ranked.front();
  if (nearest.strips > 0) return;
  outcome.notes.push_back(fmt::format("none of {} tools can work here; what is written is the nearest, {}: {}",
                                      report.names.size(), report.names[nearest.tool],
                                      nearest.reason.empty() ? "interrupted before it was tried" : nearest.reason));
}

}  // namespace

std::optional<ToolChoice> tool_choice(const CoverJob& job) {
  ToolChoice choice;
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw UsageError(message);
  };
  const bool catalogue = job.base.tool == "catalogue";
  require(catalogue || !job.catalogue, "--catalogue: goes with --tool catalogue");
  require(job.finalists >= 1 && job.finalists <= 100, "--finalists: a number from 1 to 100 is needed");
  for (const auto& [name, rate] : {std::pair{"--feed", job.rates.feed_mm_min}, {"--rapid", job.rates.rapid_mm_min}})
    require(rate > 0.0 && std::isfinite(rate), fmt::format("{}: a rate > 0 mm/min is needed", name));
  if (catalogue) {
    require(!job.base.axis_length_mm, "--axis-length: the tools of a catalogue have theirs; it goes with a family");
    choice.folder = catalogue_folder(job.catalogue);
    choice.tools = read_catalogue(choice.folder);
    for (CatalogueTool& entry : choice.tools) {
      check_clearance_job(job.base.clearance, &entry.tool);
      equip_tool(job.base.clearance, entry.tool);
    }
    return choice;
  }
  if (job.base.tool.empty()) return std::nullopt;
  choice.family = parse_tool_spec(job.base.tool);
  if (!choice.family.family || !has_open_parameters(choice.family)) return std::nullopt;
  require(!job.base.axis_length_mm || (*job.base.axis_length_mm > 0.0 && std::isfinite(*job.base.axis_length_mm)),
          "--axis-length: a length > 0 mm is needed");
  check_clearance_job(job.base.clearance, nullptr);
  return choice;
}

std::vector<Covered> cover_with_best(const CoverJob& job, const ToolChoice& choice, const Part& part,
                                     const std::vector<int>& faces, FitOutcome& outcome, const Progress& progress) {
  RankingReport report = catalogue_report(job, choice);
  Scene scene =
      make_scene(job, part, faces, choice.folder.empty() ? family_extent(job, part) : largest_extent(report.tools));
  Progress onwards = progress;
  if (choice.folder.empty()) {
    report = family_report(job, choice, scene, progress);
    // The search has had its share.
    onwards.report = [&](std::string_view stage, double share) { progress.step(stage, std::max(share, 0.4)); };
  }
  report.ranked = rank_tools(scene.targets, report.tools, report.options, onwards);
  outcome.tool = report.tools[report.ranked.front().tool];
  outcome.ranking = ranking_to_json(report);
  outcome.ranking_text = ranking_table(report);
  note_none(report, outcome);
  return taken(scene, report.ranked.front(), job.base.side.has_value());
}

}  // namespace flank::internal

#include "flank/pipeline/search/cover_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/error.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_choice/family_search.h"
#include "flank/tool_choice/tool_ranking.h"

namespace flank::internal {
namespace {

/// What was ranked, and how it came out.
struct RankingReport {
  std::string source;              ///< "catalogue FOLDER" or "barrel, searched over ..."
  std::vector<std::string> names;  ///< of the tools, by RankedTool::tool
  std::vector<Tool> tools;
  std::vector<RankedTool> ranked;
  RankingOptions options;
};

/// Targets with all that is in the way of any of the tools.
struct Scene {
  std::vector<TargetGroup> groups;
  std::vector<Obstacles> obstacles;
  std::vector<RankingTarget> targets;
};

Scene make_scene(const CoverJob& job, const Setup& setup, const ToolExtent& extent) {
  Scene scene;
  scene.groups = make_targets(setup);
  for (const TargetGroup& group : scene.groups) scene.obstacles.push_back(obstacles_of(job, setup, group, extent));
  for (std::size_t k = 0; k < scene.groups.size(); ++k)
    scene.targets.push_back({scene.groups[k].target.get(), &scene.obstacles[k]});
  return scene;
}

ToolExtent largest_extent(const std::vector<Tool>& tools) {
  ToolExtent largest;
  for (const Tool& tool : tools) {
    const ToolExtent extent = extent_of(tool);
    largest.reach_mm = std::max(largest.reach_mm, extent.reach_mm);
  }
  return largest;
}

RankingOptions ranking_options(const CoverJob& job) {
  RankingOptions options;
  options.cover = options_of(job);
  options.rates = {job.choice.feed_mm_min, job.choice.rapid_mm_min};
  options.finalists = job.choice.finalists;
  return options;
}

Tool equipped(const CoverJob& job, const RadialFunction& radial) {
  Tool tool;
  tool.radial = radial;
  equip_tool(job.obstacles, tool);
  return tool;
}

/// Of any tool that the search of a family may try: the part's own size is the limit.
ToolExtent family_extent(const CoverJob& job, const Part& part) {
  const double diagonal = part.box.diagonal(), length = job.tool.axis_length_mm.value_or(diagonal);
  const RadialFunction stout(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, 0.15 * diagonal));
  return extent_of(equipped(job, stout));
}

/// The best of the family by quick covers: those are what is ranked.
RankingReport family_report(const CoverJob& job, const ToolChoice& choice, const Scene& scene,
                            const Progress& progress) {
  FamilySearchOptions options;
  options.ranking = ranking_options(job);
  options.axis_length_mm = job.tool.axis_length_mm;
  options.kept = static_cast<std::size_t>(job.choice.finalists);
  options.equip = [&](const RadialFunction& radial) { return equipped(job, radial); };
  FamilySearchResult found =
      search_family(scene.targets, *choice.family.family, choice.family.given, options, progress);
  RankingReport report;
  report.options = options.ranking;
  for (const Tool& tool : found.tools)
    report.names.push_back(fmt::format("{}, axis {:.4g} mm", tool.name, tool.radial.axis_length()));
  report.source = fmt::format(
      "{}, searched over {}; {} tools compared by profile, {} of them placed on the face, {} compared by their passes",
      job.tool.spec, found.searched, found.grid, found.screened, found.covered);
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

/// Strips of the tool that came first.
std::vector<Covered> taken(Scene& scene, const RankedTool& best) {
  std::vector<Covered> all;
  for (std::size_t k = 0; k < scene.groups.size(); ++k)
    all.push_back({std::move(scene.groups[k]), best.results.empty() ? CoverResult{} : best.results[k]});
  return all;
}

const char* stage_name(RankingStage stage) {
  switch (stage) {
    case RankingStage::kScreened:
      return "screened";
    case RankingStage::kQuick:
      return "quick";
    case RankingStage::kThorough:
      return "thorough";
    case RankingStage::kFull:
      return "full";
  }
  return "";
}

Ranking as_ranking(const RankingReport& report) {
  Ranking ranking{report.source,
                  report.options.cover.tolerance_mm,
                  report.options.cover.strip_price,
                  report.options.rates.feed_mm_min,
                  report.options.rates.rapid_mm_min,
                  {}};
  for (const RankedTool& ranked : report.ranked) {
    const Tool& tool = report.tools[ranked.tool];
    RankedChoice& choice = ranking.tools.emplace_back();
    choice.tool = report.names[ranked.tool];
    choice.name = tool.name;
    choice.stage = stage_name(ranked.stage);
    choice.family = tool.radial.family();
    choice.axis_length_mm = tool.radial.axis_length();
    choice.works = ranked.strips > 0;
    choice.reachable_share = choice.works ? ranked.reachable : ranked.screen.reachable;
    choice.coverage_reachable = ranked.coverage;
    choice.coverage = ranked.covered();
    choice.strips = ranked.strips;
    choice.strips_mm = ranked.strips_mm;
    choice.links_mm = ranked.links_mm;
    choice.minutes = ranked.minutes;
    choice.fits = ranked.screen.fits;
    choice.accepted = ranked.screen.accepted;
    choice.open = ranked.screen.open;
    choice.reason = ranked.reason;
  }
  return ranking;
}

void note_none(const RankingReport& report, Result& result) {
  const RankedTool& nearest = report.ranked.front();
  if (nearest.strips > 0) return;
  result.notes.push_back(fmt::format(
      "none of {} tools can machine this face; the closest one is written, {}: {}", report.names.size(),
      report.names[nearest.tool], nearest.reason.empty() ? "interrupted before this tool was tried" : nearest.reason));
}

}  // namespace

std::optional<ToolChoice> tool_choice(const CoverJob& job) {
  ToolChoice choice;
  const auto require = [](bool holds, const char* field, const char* text) {
    if (!holds) throw UsageError(field, text);
  };
  const bool catalogue = job.tool.spec == "catalogue";
  require(catalogue || !job.choice.catalogue, "catalogue", "needs `tool` catalogue");
  if (catalogue) {
    require(!job.tool.axis_length_mm, "axis_length_mm", "the tools of a catalogue have their own; only for a family");
    choice.folder = catalogue_folder(job.choice.catalogue);
    choice.tools = read_catalogue(choice.folder);
    for (CatalogueTool& entry : choice.tools) {
      check_obstacles(job.obstacles, &entry.tool);
      equip_tool(job.obstacles, entry.tool);
    }
    return choice;
  }
  if (job.tool.spec.empty()) return std::nullopt;
  choice.family = parse_tool_spec(job.tool.spec);
  if (!choice.family.family || !has_open_parameters(choice.family)) return std::nullopt;
  check_obstacles(job.obstacles, nullptr);
  return choice;
}

std::vector<Covered> cover_with_best(const CoverJob& job, const ToolChoice& choice, const Setup& setup, Result& result,
                                     const Progress& progress) {
  RankingReport report = catalogue_report(job, choice);
  Scene scene =
      make_scene(job, setup, choice.folder.empty() ? family_extent(job, setup.part) : largest_extent(report.tools));
  Progress onwards = progress;
  if (choice.folder.empty()) {
    report = family_report(job, choice, scene, progress);
    // The search has had its share.
    onwards.report = [&](std::string_view stage, double share) { progress.step(stage, std::max(share, 0.4)); };
  }
  report.ranked = rank_tools(scene.targets, report.tools, report.options, onwards);
  result.tool = report.tools[report.ranked.front().tool];
  result.ranking = as_ranking(report);
  note_none(report, result);
  return taken(scene, report.ranked.front());
}

}  // namespace flank::internal

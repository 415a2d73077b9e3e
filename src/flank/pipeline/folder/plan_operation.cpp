#include "flank/pipeline/folder/plan_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <type_traits>
#include <variant>

#include "flank/error.h"
#include "flank/io/path/engagement_json.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/cutting/materials.h"
#include "flank/machine/links.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/load/known_feeds.h"
#include "flank/pipeline/load/path_loads.h"
#include "flank/setup/read_setup.h"

namespace flank::internal {
namespace {

struct Input {
  Setup setup;
  Tool tool;
  Path path;
  FolderEngagement engagement;
  ObstacleRequest obstacles;
  JudgeRequest judge;
  bool fixed_order = false;  ///< of the path's strips
};

template <class Job>
Input read_input(const PostJob& request, const Job& job, const ResultFolder& folder, std::vector<std::string>& notes) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Input input;
  input.tool = read_and_equip(file("tool.json"), {}, job.obstacles);
  input.path = read_path(file("path.json"));
  if (std::filesystem::exists(file("engagement.json"))) {
    const std::string text = read_file(file("engagement.json"));
    input.engagement.largest = engagement_from_json(text, file("engagement.json"), input.path);
    input.engagement.arcs = arcs_from_json(text, file("engagement.json"), input.path);
  }
  input.setup = read_setup(machined(job), job.obstacles, job.tolerance_mm, notes);
  input.obstacles = job.obstacles;
  input.judge = job.judge;
  input.fixed_order = std::is_same_v<Job, TrochoidJob>;
  if constexpr (std::is_same_v<Job, TrochoidJob>)
    input.engagement.limit_rad = job.cycles.most_engagement_deg * std::numbers::pi / 180.0;
  notes.clear();  // told when the folder was made
  if (folder.manifest() && !request.part && input.setup.part.sha256 != folder.manifest()->part.sha256)
    throw InputError(input.setup.part.file + ": has changed since the result in " + folder.path() +
                     " was made for it; make the result again, or name a part by `part`");
  return input;
}

PostTool post_tool(const Tool& tool) {
  return {.name = tool.name,
          .axis_length = tool.radial.axis_length(),
          .tip_radius = tool.radial.at(0.0).r,
          .largest_radius = tool.radial.largest()};
}

/// Of all that could touch: flank, shank and holder.
double body_radius(const Tool& tool, const PostTool& facts) {
  double radius = facts.largest_radius;
  for (const auto* profile : {&tool.shank, &tool.holder})
    for (const Vec2& p : *profile) radius = std::max(radius, p.y());
  return radius;
}

/// The strips in the order in which they are run. Cycles of a cavity need what the ones before them have cut.
KnownPath in_order(const Input& input, const KnownFeeds& feeds, const Box3& around, const PostJob& request) {
  KnownPath path = joined({input.path, feeds.slowness});
  if (input.fixed_order || request.order == "given") return path;
  KnownPath ordered;
  for (const std::size_t k : short_order(path.path, around)) {
    ordered.path.strips.push_back(std::move(path.path.strips[k]));
    ordered.known.push_back(std::move(path.known[k]));
  }
  return ordered;
}

/// What links keep out of, and of what size.
LinkOptions link_options(const Input& input, const PostTool& facts, const PostJob& request) {
  LinkOptions options;
  options.keep_out = input.setup.part.box;
  for (const Part& fixture : input.setup.fixtures) options.keep_out.add(fixture.box);
  options.tool_radius = body_radius(input.tool, facts);
  options.clearance = request.link_clearance_mm;
  return options;
}

/// The speed of the spindle and the feed that a material gives, where they are not given themselves.
PostJob with_material(PostJob request, const PostTool& facts, std::vector<std::string>& notes) {
  if (!request.material || request.dry) return request;
  const Material material = find_material(*request.material);
  const double diameter = 2.0 * facts.largest_radius;
  const CuttingData data = cutting_data(material, diameter, *request.flutes, 0.0);
  if (!request.spindle_rpm) request.spindle_rpm = std::floor(data.spindle_rpm);
  // The chip stays what it is at any speed of the spindle. "optimal" has no feed of its own.
  if (!request.feed_mm_min && request.speed != "optimal")
    request.feed_mm_min = data.chip_mm * *request.flutes * *request.spindle_rpm;
  notes.push_back(
      fmt::format("{}: {:.0f} to {:.0f} m/min and a chip of {:.4f} mm at a diameter of {:.4g} mm with {} flutes: "
                  "spindle {:g}, feed {:.4g} "
                  "mm/min ({})",
                  material.name, material.speed_low, material.speed_high, data.chip_mm, diameter, *request.flutes,
                  *request.spindle_rpm, request.feed_mm_min.value_or(0.0), material.source));
  return request;
}

}  // namespace

/// A program that cuts with a spindle that stands still, or at a feed that nobody has chosen, is none.
void require_cutting_data(const PostJob& request) {
  if (request.dry) {
    if (request.spindle_rpm)
      throw UsageError("dry", "give `spindle` and `feed_mm_min`, or `dry`; a dry run has no spindle");
    return;
  }
  if (request.material) {
    (void)find_material(*request.material);
    if (!request.flutes) throw UsageError("flutes", "must be given: the feed of a `material` needs it");
    return;
  }
  if (request.flutes) throw UsageError("flutes", "needs a `material`");
  refuse_loads(request);
  if (!request.spindle_rpm || (!request.feed_mm_min && request.speed != "optimal"))
    throw UsageError(
        fmt::format("a program needs spindle speed and feed; give {}{}{}, or `dry` for a dry run",
                    request.spindle_rpm ? "" : "`spindle`, 1/min,",
                    request.spindle_rpm || request.feed_mm_min || request.speed == "optimal" ? "" : " and ",
                    request.feed_mm_min || request.speed == "optimal" ? "" : "`feed_mm_min`"));
}

std::string operation_name(const std::string& folder, const Setup& setup) {
  std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  std::string name = path.filename().string();
  if (name.empty() || name == "." || name == "..") name = std::filesystem::path(setup.part.file).stem().string();
  return name;
}

PlannedOperation plan_operation(const PostJob& asked, const OperationWords& words) {
  require_cutting_data(asked);
  const ResultFolder folder(asked.folder, ResultFolder::Use::kRead);
  VerifyJob wanted;
  wanted.folder = asked.folder;
  wanted.part = asked.part;
  const FolderJob found = read_folder_job(wanted, folder);
  PlannedOperation plan;
  Input input = std::visit([&](const auto& job) { return read_input(asked, job, folder, plan.notes); }, found.job);
  plan.facts = post_tool(input.tool);
  plan.request = with_material(asked, plan.facts, plan.notes);
  plan.judged_in = asked.folder;
  plan.name = words.name.empty() ? operation_name(asked.folder, input.setup) : words.name;
  plan.tool_number = words.tool.value_or(1);
  plan.tool_text = read_file((std::filesystem::path(asked.folder) / "tool.json").string());
  plan.strips = input.path.strips.size();
  const KnownFeeds feeds = known_feeds(plan.request, input.setup, input.tool, input.path, input.engagement);
  plan.feed = feeds.feed;
  plan.notes.insert(plan.notes.end(), feeds.notes.begin(), feeds.notes.end());
  plan.way = link_options(input, plan.facts, plan.request);
  plan.links = judged_links(input.setup, input.judge, input.tool,
                            in_order(input, feeds, plan.way.keep_out, plan.request), plan.way, plan.request.lift_mm);
  plan.setup = std::move(input.setup);
  plan.tool = std::move(input.tool);
  plan.obstacles = std::move(input.obstacles);
  return plan;
}

}  // namespace flank::internal

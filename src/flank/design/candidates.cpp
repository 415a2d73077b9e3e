#include "flank/design/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "flank/base/atomic_file.h"
#include "flank/job/command_line.h"
#include "flank/tool_file.h"
#include "flank/tool_request/catalogue.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Group = std::vector<std::size_t>;

constexpr int kProfilePlaces = 40;

/// Largest difference of radius at the same share of the axis, and of length, mm.
double difference(const Tool& a, const Tool& b) {
  const double la = a.radial.axis_length(), lb = b.radial.axis_length();
  double largest = std::abs(la - lb);
  for (int k = 0; k <= kProfilePlaces; ++k) {
    const double share = static_cast<double>(k) / kProfilePlaces;
    largest = std::max(largest, std::abs(a.radial.at(share * la).r - b.radial.at(share * lb).r));
  }
  return largest;
}

std::string names_of(const DesignResult& result, const Group& group, const char* between) {
  std::string text;
  for (const std::size_t k : group) text += (text.empty() ? "" : between) + result.faces[k];
  return text;
}

PartRequest part_of(const DesignResult& result, const Group& group) {
  PartRequest part = result.job.part;
  part.faces = names_of(result, group, ",");
  return part;
}

JudgeRequest judge_of(const DesignResult& result) {
  JudgeRequest judge = result.job.judge;
  judge.reach_radius_mm = result.reach_radius_mm;
  return judge;
}

BatchTask fit_task(const DesignResult& result, const DesignFolder& folder, const Group& group) {
  FitJob job;
  job.part = part_of(result, group);
  job.tool = {.spec = result.job.shape, .axis_length_mm = result.job.axis_length_mm};
  job.radius = result.job.radius;
  job.obstacles = result.job.obstacles;
  job.judge = judge_of(result);
  job.tolerance_mm = result.job.tolerance_mm;
  job.avoid = result.job.avoid;
  return {short_name("fit-" + names_of(result, group, "+")), command_words(PlanJob(job)), folder.inputs, false};
}

/// The faces that are equal to none before them.
Group first_faces(const DesignResult& result) {
  Group firsts;
  for (std::size_t k = 0; k < result.equal.size(); ++k)
    if (result.equal[k].first == k) firsts.push_back(k);
  return firsts;
}

void add_tool(DesignResult& result, const DesignFolder& folder, DesignTool tool, const std::string& from) {
  tool.name = fmt::format("T{}", result.tools.size() + 1);
  tool.file = "tools/" + tool.name + ".json";
  tool.tool = read_tool(from);
  write_file((fs::path(folder.path) / tool.file).string(), text_of_file(from));
  result.tools.push_back(std::move(tool));
}

/// Fits all groups at once and keeps the tools that came out, whether or not they meet the request: another face may
/// have less to ask for. Element k: whether group k has one.
std::vector<bool> fit_groups(DesignResult& result, const DesignFolder& folder, const std::vector<Group>& groups) {
  std::vector<BatchTask> tasks;
  for (const Group& group : groups) tasks.push_back(fit_task(result, folder, group));
  const std::vector<TaskRow> rows = folder.run(tasks);
  std::vector<bool> found;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    found.push_back(rows[k].has_result());
    if (!found.back()) continue;
    DesignTool tool;
    tool.source = "fit of " + names_of(result, groups[k], ",");
    tool.folder = tasks[k].name;
    tool.fitted = groups[k];
    add_tool(result, folder, std::move(tool), (fs::path(folder.path) / tasks[k].name / "tool.json").string());
  }
  return found;
}

void add_fitted(DesignResult& result, const DesignFolder& folder) {
  const Group firsts = first_faces(result);
  // The only one of a set of one is for all faces.
  if (result.job.tools == 1) {
    (void)fit_groups(result, folder, {firsts});
    return;
  }
  std::vector<Group> groups;
  for (const std::size_t k : firsts) groups.push_back({k});
  const std::vector<bool> found = fit_groups(result, folder, groups);
  std::vector<Tool> tools;
  for (const DesignTool& tool : result.tools) tools.push_back(tool.tool);
  std::vector<const Tool*> alone;
  for (std::size_t k = 0, at = 0; k < firsts.size(); ++k) alone.push_back(found[k] ? &tools[at++] : nullptr);
  groups.clear();
  for (const Group& merged : merge_order(alone)) {
    Group& group = groups.emplace_back();
    for (const std::size_t k : merged) group.push_back(firsts[k]);
  }
  (void)fit_groups(result, folder, groups);
}

/// The tools of a ranking that were covered in full, best first.
std::vector<std::string> finalists(const std::string& file) {
  std::vector<std::string> names;
  const auto json = nlohmann::json::parse(text_of_file(file), nullptr, false);
  if (!json.is_object() || !json.contains("tools")) return names;
  for (const auto& tool : json["tools"])
    if (tool.value("works", false) && tool.value("stage", "") == "full") names.push_back(tool.value("tool", ""));
  return names;
}

void add_catalogue(DesignResult& result, const DesignFolder& folder) {
  const std::string catalogue = catalogue_folder(result.job.choice.catalogue);
  const Group firsts = first_faces(result);
  std::vector<Group> groups;
  for (const std::size_t k : firsts) groups.push_back({k});
  if (firsts.size() > 1) groups.push_back(firsts);
  std::vector<BatchTask> tasks;
  for (const Group& group : groups) {
    CoverJob job;
    job.part = part_of(result, group);
    job.tool.spec = "catalogue";
    job.choice = result.job.choice;
    job.choice.catalogue = catalogue;
    job.obstacles = result.job.obstacles;
    job.judge = judge_of(result);
    job.tolerance_mm = result.job.tolerance_mm;
    tasks.push_back({"catalogue-" + names_of(result, group, "+"), command_words(PlanJob(job)), folder.inputs, false});
  }
  (void)folder.run(tasks);
  std::set<std::string> seen;
  for (const BatchTask& task : tasks)
    for (const std::string& name : finalists((fs::path(folder.path) / task.name / "ranking.json").string())) {
      if (!seen.insert(name).second) continue;
      DesignTool tool;
      tool.source = "catalogue " + name;
      add_tool(result, folder, std::move(tool), (fs::path(catalogue) / (name + ".json")).string());
    }
}

std::size_t finished_faces(const DesignResult& result, std::size_t tool) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < result.faces.size(); ++f) count += result.pair(tool, f).finishes() ? 1 : 0;
  return count;
}

/// The faces of a tool's fit, each replaced by that of its equals at which the tool enters deepest.
Group worst_equals(const DesignResult& result, std::size_t tool) {
  Group group = result.tools[tool].fitted;
  for (std::size_t& planned : group) {
    double deepest = 0.0;
    const std::size_t first = result.equal[planned].first;
    for (std::size_t f = 0; f < result.faces.size(); ++f) {
      const DesignPair& pair = result.pair(tool, f);
      if (result.equal[f].first != first || pair.finishes()) continue;
      const double depth = std::max(pair.overcut_mm, pair.other_faces_overcut_mm);
      if (depth > deepest) deepest = depth, planned = f;
    }
  }
  std::sort(group.begin(), group.end());
  return group;
}

}  // namespace

std::vector<std::size_t> refit_group(const DesignResult& result) {
  std::optional<std::size_t> best;
  for (std::size_t t = 0; t < result.tools.size(); ++t)
    if (!result.tools[t].fitted.empty() && (!best || finished_faces(result, t) > finished_faces(result, *best)))
      best = t;
  if (!best || finished_faces(result, *best) == 0) return {};
  Group group = worst_equals(result, *best);
  if (group == result.tools[*best].fitted) group.clear();
  return group;
}

void add_refitted(DesignResult& result, const DesignFolder& folder) {
  const Group group = refit_group(result);
  if (!group.empty()) (void)fit_groups(result, folder, {group});
}

std::vector<std::vector<std::size_t>> merge_order(const std::vector<const Tool*>& tools) {
  const auto apart = [&](const Group& a, const Group& b) {
    double largest = 0.0;
    for (const std::size_t i : a)
      for (const std::size_t j : b)
        largest = std::max(
            largest, tools[i] && tools[j] ? difference(*tools[i], *tools[j]) : std::numeric_limits<double>::infinity());
    return largest;
  };
  std::vector<Group> groups, merged;
  for (std::size_t k = 0; k < tools.size(); ++k) groups.push_back({k});
  while (groups.size() > 1) {
    std::size_t first = 0, second = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (std::size_t j = i + 1; j < groups.size(); ++j)
        if (const double now = apart(groups[i], groups[j]); now < least) least = now, first = i, second = j;
    Group both = groups[first];
    both.insert(both.end(), groups[second].begin(), groups[second].end());
    std::sort(both.begin(), both.end());
    merged.push_back(both);
    groups[first] = std::move(both);
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(second));
  }
  return merged;
}

void find_candidates(DesignResult& result, const DesignFolder& folder) {
  fs::create_directories(fs::path(folder.path) / "tools");
  if (result.job.source != "catalogue") add_fitted(result, folder);
  if (result.job.source != "fit") add_catalogue(result, folder);
}

}  // namespace flank::internal

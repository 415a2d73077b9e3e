#include "flank/wheel/shanks.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "flank/io/text/json_input.h"
#include "flank/path_file.h"
#include "flank/pipeline/auto_shank.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/shank_reach.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"
#include "flank/tool_request/tool_spec.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"

namespace flank::internal {
namespace {

Path paths_of(const WheelWork& work, const std::vector<WheelOperation>& operations, const std::string& id) {
  Path all;
  for (const WheelOperation& operation : operations) {
    if (!operation.done || operation.tool != id) continue;
    const Path path = read_path(in_folder(work, operation.folder + "/path.json"));
    all.strips.insert(all.strips.end(), path.strips.begin(), path.strips.end());
  }
  return all;
}

/// The tool with a shank for a path.
Tool with_shank(const WheelWork& work, Tool tool, const Path& path, const std::string& id,
                std::vector<std::string>& notes) {
  ObstacleRequest obstacles = obstacle_request(work);
  std::vector<std::string> told;
  const Setup setup = read_setup(part_request(work, work.roles.hub), obstacles, work.job.tolerance_mm, told);
  const ClearanceScene scene = make_clearance_scene(setup, obstacles, true, told);
  choose_clear_shank(scene, path, setup.part.box, kAnySlenderness, tool, obstacles);
  equip_tool(obstacles, tool);
  if (work.job.holder)
    lengthen_for_holder(scene, path, setup.part.box, holder_outline(*work.job.holder), obstacles, tool);
  notes.push_back(id + ": " + chosen_shank_text(tool, obstacles));
  return tool;
}

/// The results of its operations, with the tool as it is now.
void write_again(const WheelWork& work, const Tool& tool, const std::string& id,
                 std::vector<WheelOperation>& operations) {
  const std::string text = tool_to_json(tool);
  for (WheelOperation& operation : operations) {
    const std::string folder = in_folder(work, operation.folder);
    if (!operation.done || operation.tool != id || read_file(folder + "/tool.json") == text) continue;
    const Result result = with_tool(folder, tool);
    write_result(result, folder);
    // Of roughing the whole's judge decides.
    if (operation.kind != "rough") settle(result, operation);
  }
}

}  // namespace

bool brings_body(const std::string& spec) {
  const ToolSpec tool = parse_tool_spec(spec);
  return tool.tool && has_body(*tool.tool);
}

void give_shanks(WheelWork& work, std::vector<WheelOperation>& operations, std::vector<std::string>& notes) {
  for (const std::string id : {"T1", "T2"}) {
    std::optional<Tool>& tool = id == "T1" ? work.tool : work.rough_tool;
    if (!tool || has_body(*tool)) continue;
    const Path path = paths_of(work, operations, id);
    if (path.strips.empty()) continue;
    *tool = with_shank(work, *tool, path, id, notes);
    write_tool(*tool, tool_file(work, id));
    write_again(work, *tool, id, operations);
  }
}

}  // namespace flank::internal

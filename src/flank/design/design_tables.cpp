#include "flank/design/design_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/report.h"
#include "flank/sweep/table_text.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

bool is_chosen(const DesignResult& result, std::size_t tool) {
  const std::vector<int>& tools = result.choice.tools;
  return std::find(tools.begin(), tools.end(), static_cast<int>(tool)) != tools.end();
}

/// Is the face machined by this tool?
bool machines(const DesignResult& result, std::size_t tool, std::size_t face) {
  return result.choice.tool_of_face[face] == static_cast<int>(tool);
}

const std::string& first_of(const DesignResult& result, std::size_t face) {
  return result.faces[result.equal[face].first];
}

Json tool_entry(const DesignResult& result, std::size_t t) {
  const DesignTool& tool = result.tools[t];
  return {{"tool", tool.name},
          {"source", tool.source},
          {"file", tool.file},
          {"chosen", is_chosen(result, t)},
          {"axis_length", tool.tool.radial.axis_length()},
          {"radius_min", tool.tool.radial.smallest()},
          {"radius_max", tool.tool.radial.largest()},
          {"slenderness", stiffness(tool.tool).slenderness}};
}

Json pair_entry(const DesignResult& result, std::size_t t, std::size_t f) {
  const DesignPair& pair = result.pair(t, f);
  Json entry = {{"tool", result.tools[t].name}, {"face", result.faces[f]}, {"status", status_name(pair.row.status)}};
  if (!pair.row.message.empty()) entry["message"] = pair.row.message;
  if (pair.folder.empty()) return entry;
  entry["folder"] = pair.folder;
  entry["way"] = pair.way;
  entry["coverage_reachable"] = pair.coverage_reachable;
  entry["coverage"] = pair.coverage;
  entry["overcut_mm"] = pair.overcut_mm;
  entry["other_faces_overcut_mm"] = pair.other_faces_overcut_mm;
  entry["strips"] = pair.strips;
  entry["minutes"] = pair.minutes;
  return entry;
}

std::string html_cell(const DesignResult& result, std::size_t t, std::size_t f) {
  const DesignPair& pair = result.pair(t, f);
  const char* look = pair.finishes() ? "meets" : pair.folder.empty() ? "none" : "short";
  std::string inside(status_name(pair.row.status));
  if (!pair.folder.empty()) {
    inside = fmt::format("{:.2f} %", 100.0 * pair.coverage_reachable);
    if (pair.row.page) inside = fmt::format("<a href=\"{}/report.html\">{}</a>", html_safe(pair.folder), inside);
    inside += fmt::format("<br><small>{:.2f} % of the whole face, {:.2f} min, passes {}, {}</small>",
                          100.0 * pair.coverage, pair.minutes, pair.strips, pair.way);
  } else if (!pair.row.message.empty()) {
    inside += "<br><small>" + html_safe(pair.row.message) + "</small>";
  }
  return fmt::format("<td class=\"{}{}\">{}</td>", look, machines(result, t, f) ? " chosen" : "", inside);
}

std::string verdict(const DesignResult& result) {
  const ToolSet& choice = result.choice;
  std::string text = fmt::format("{} of {} faces finished by {} {}, {:.2f} min",
                                 result.faces.size() - static_cast<std::size_t>(choice.unfinished), result.faces.size(),
                                 choice.tools.size(), choice.tools.size() == 1 ? "tool" : "tools", choice.minutes);
  return result.complete ? text : text + " (stopped early)";
}

}  // namespace

std::string design_json(const DesignResult& result) {
  const std::filesystem::path part(result.job.part.file);
  Json json = {{"schema", "openflank/design/1"},
               {"units", "mm"},
               {"part", part.filename().string()},
               {"part_sha256", result.part_sha256},
               {"tolerance", result.job.tolerance_mm},
               {"least_coverage", result.job.judge.least_coverage},
               {"reach_radius", result.reach_radius_mm},
               {"feed_mm_min", result.job.choice.feed_mm_min},
               {"rapid_mm_min", result.job.choice.rapid_mm_min},
               {"most_tools", result.job.tools},
               {"tool_change_min", result.job.tool_change_min},
               {"complete", result.complete},
               {"pass", result.pass()},
               {"unfinished", result.choice.unfinished},
               {"minutes", result.choice.minutes}};
  json["faces"] = Json::array();
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    const int tool = result.choice.tool_of_face[f];
    Json entry = {{"face", result.faces[f]}, {"equal_to", first_of(result, f)}};
    entry["tool"] = tool < 0 ? Json(nullptr) : Json(result.tools[static_cast<std::size_t>(tool)].name);
    json["faces"].push_back(std::move(entry));
  }
  json["tools"] = Json::array();
  for (std::size_t t = 0; t < result.tools.size(); ++t) json["tools"].push_back(tool_entry(result, t));
  json["pairs"] = Json::array();
  for (std::size_t t = 0; t < result.tools.size(); ++t)
    for (std::size_t f = 0; f < result.faces.size(); ++f) json["pairs"].push_back(pair_entry(result, t, f));
  return dumped(json, 2) + "\n";
}

std::string design_csv(const DesignResult& result) {
  std::string text =
      "tool,source,face,equal_to,status,way,coverage_reachable,coverage,overcut_mm,other_faces_overcut_mm,strips,"
      "minutes,chosen,"
      "folder,message\n";
  for (std::size_t t = 0; t < result.tools.size(); ++t)
    for (std::size_t f = 0; f < result.faces.size(); ++f) {
      const DesignPair& pair = result.pair(t, f);
      text += fmt::format("{},{},{},{},{},{},", result.tools[t].name, csv_cell(result.tools[t].source), result.faces[f],
                          first_of(result, f), status_name(pair.row.status), pair.way);
      if (pair.folder.empty())
        text += ",,,,,,";
      else
        text += fmt::format("{},{},{},{},{},{},", pair.coverage_reachable, pair.coverage, pair.overcut_mm,
                            pair.other_faces_overcut_mm, pair.strips, pair.minutes);
      text += fmt::format("{},{},{}\n", machines(result, t, f) ? "yes" : "no", csv_cell(pair.folder),
                          csv_cell(pair.row.message));
    }
  return text;
}

std::string design_html(const DesignResult& result) {
  const std::string part = std::filesystem::path(result.job.part.file).filename().string();
  const std::string title = html_safe("flank design: " + part);
  std::string text = html_head(title) + fmt::format("<p>{}. The first percentage is of the accessible area.</p>\n",
                                                    html_safe(verdict(result)));
  text += "<table>\n<tr><th></th>";
  for (std::size_t t = 0; t < result.tools.size(); ++t) {
    const DesignTool& tool = result.tools[t];
    text += fmt::format(
        "<th class=\"{}\">{}<br><small>{}<br>{:.1f} mm long, radius {:.2f} to {:.2f} mm, L:D {:.1f}</small></th>",
        is_chosen(result, t) ? "chosen" : "", tool.name, html_safe(tool.source), tool.tool.radial.axis_length(),
        tool.tool.radial.smallest(), tool.tool.radial.largest(), stiffness(tool.tool).slenderness);
  }
  text += "</tr>\n";
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    text += "<tr><th>" + html_safe(result.faces[f]);
    if (result.equal[f].first != f) text += "<br><small>equal to " + html_safe(first_of(result, f)) + "</small>";
    text += "</th>";
    for (std::size_t t = 0; t < result.tools.size(); ++t) text += html_cell(result, t, f);
    text += "</tr>\n";
  }
  return text + "</table>\n</html>\n";
}

std::string design_text(const DesignResult& result) {
  std::string text;
  for (std::size_t t = 0; t < result.tools.size(); ++t) {
    const auto finished = [&] {
      int count = 0;
      for (std::size_t f = 0; f < result.faces.size(); ++f) count += result.pair(t, f).finishes() ? 1 : 0;
      return count;
    }();
    text += fmt::format("{} {:<4} {:<40} finishes {} of {}, L:D {:.1f}\n", is_chosen(result, t) ? "*" : " ",
                        result.tools[t].name, result.tools[t].source, finished, result.faces.size(),
                        stiffness(result.tools[t].tool).slenderness);
  }
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    const int tool = result.choice.tool_of_face[f];
    if (tool < 0) {
      text += fmt::format("  {:<5} none of the tools finishes it\n", result.faces[f]);
      continue;
    }
    const DesignPair& pair = result.pair(static_cast<std::size_t>(tool), f);
    text += fmt::format(
        "  {:<5} {:<4} {:<8} {:.2f} % of the accessible area, {:.2f} % of the whole face, gouge {:.4f} mm, passes {}, "
        "{:.2f} min\n",
        result.faces[f], result.tools[static_cast<std::size_t>(tool)].name, pair.way, 100.0 * pair.coverage_reachable,
        100.0 * pair.coverage, pair.overcut_mm, pair.strips, pair.minutes);
  }
  return text + verdict(result) + "\n";
}

}  // namespace flank::internal

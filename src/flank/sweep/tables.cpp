#include "flank/sweep/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/report.h"
#include "flank/sweep/table_text.h"

namespace flank::internal {
namespace {

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// A tool as it is shown: a file without its folder.
std::string shown_tool(const std::string& tool) { return tool.find('/') != std::string::npos ? file_name(tool) : tool; }

/// "; no: overcut_mm; caution: shank_and_holder".
std::string verdict_words(const SweepRow::Figures& f) {
  std::string words;
  if (!f.reasons.empty()) words += fmt::format("; no: {}", fmt::join(f.reasons, ", "));
  if (!f.cautions.empty()) words += fmt::format("; caution: {}", fmt::join(f.cautions, ", "));
  return words;
}

std::string html_cell(const SweepTask& task, const SweepRow& row) {
  const bool meets = row.status == TaskStatus::kMeets;
  const char* look = meets ? "meets" : row.status == TaskStatus::kFallsShort ? "short" : "none";
  std::string inside = std::string(status_name(row.status));
  if (row.figures) {
    const SweepRow::Figures& f = *row.figures;
    inside = fmt::format("{:.2f} %", 100.0 * f.coverage_reachable);
    if (row.page) inside = fmt::format("<a href=\"{}/report.html\">{}</a>", html_safe(task.name), inside);
    inside += fmt::format("<br><small>{:.2f} % of the whole face, passes {}, gouge {:.4f} mm</small>",
                          100.0 * f.coverage, f.strips, f.overcut_mm);
    // A reader sees by the colour that it falls short, and here in what.
    if (!f.reasons.empty())
      inside += fmt::format("<br><small>no: {}</small>", html_safe(fmt::format("{}", fmt::join(f.reasons, ", "))));
    if (!f.cautions.empty())
      inside += fmt::format("<br><small class=\"caution\">caution: {}</small>",
                            html_safe(fmt::format("{}", fmt::join(f.cautions, ", "))));
  } else if (!row.message.empty()) {
    inside += "<br><small>" + html_safe(row.message) + "</small>";
  }
  return fmt::format("<td class=\"{}\">{}</td>", look, inside);
}

/// Row k of the tasks with this face and tool.
std::size_t index_of(const SweepPlan& plan, std::size_t face, std::size_t tool, std::size_t variant) {
  const std::size_t variants = std::max<std::size_t>(1, plan.variants.size());
  return (face * plan.tools.size() + tool) * variants + variant;
}

std::string html_table(const SweepResult& result, std::size_t variant) {
  const SweepPlan& plan = result.plan;
  std::string text;
  if (!plan.variants.empty()) text += "<h2>" + html_safe(plan.variants[variant]) + "</h2>\n";
  text += "<table>\n<tr><th></th>";
  for (const std::string& tool : plan.tools) text += "<th>" + html_safe(shown_tool(tool)) + "</th>";
  text += "</tr>\n";
  for (std::size_t face = 0; face < plan.faces.size(); ++face) {
    text += "<tr><th>" + html_safe(plan.faces[face]) + "</th>";
    for (std::size_t tool = 0; tool < plan.tools.size(); ++tool) {
      const std::size_t k = index_of(plan, face, tool, variant);
      text += html_cell(plan.tasks[k], result.rows[k]);
    }
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace

std::string sweep_json(const SweepResult& result) {
  const SweepPlan& plan = result.plan;
  nlohmann::ordered_json json = {{"schema", "openflank/sweep/1"}, {"units", "mm"},
                                 {"plan", file_name(plan.file)},  {"command", plan.command},
                                 {"part", file_name(plan.part)},  {"part_sha256", plan.part_sha256},
                                 {"complete", result.complete()}, {"pass", result.pass()}};
  json["tasks"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < plan.tasks.size(); ++k) {
    const SweepTask& task = plan.tasks[k];
    const SweepRow& row = result.rows[k];
    nlohmann::ordered_json entry = {{"folder", task.name}, {"face", task.face}, {"tool", shown_tool(task.tool)}};
    if (!task.variant.empty()) entry["variant"] = task.variant;
    entry["status"] = status_name(row.status);
    if (!row.message.empty()) entry["message"] = row.message;
    if (row.figures) {
      entry["coverage"] = row.figures->coverage;
      entry["coverage_reachable"] = row.figures->coverage_reachable;
      entry["overcut_mm"] = row.figures->overcut_mm;
      entry["undercut_mm"] = row.figures->undercut_mm;
      entry["other_faces_overcut_mm"] = row.figures->other_faces_overcut_mm;
      entry["strips"] = row.figures->strips;
      entry["slenderness"] = row.figures->slenderness;
      entry["reasons"] = row.figures->reasons;
      entry["cautions"] = row.figures->cautions;
    }
    json["tasks"].push_back(std::move(entry));
  }
  return dumped(json, 2) + "\n";
}

std::string sweep_csv(const SweepResult& result) {
  std::string text =
      "folder,face,tool,variant,status,coverage,coverage_reachable,overcut_mm,undercut_mm,other_faces_overcut_mm,"
      "strips,"
      "slenderness,reasons,cautions,message\n";
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const SweepTask& task = result.plan.tasks[k];
    const SweepRow& row = result.rows[k];
    text += fmt::format("{},{},{},{},{},", csv_cell(task.name), csv_cell(task.face), csv_cell(shown_tool(task.tool)),
                        csv_cell(task.variant), status_name(row.status));
    if (row.figures) {
      const SweepRow::Figures& f = *row.figures;
      text += fmt::format("{},{},{},{},{},{},{},{},{},", f.coverage, f.coverage_reachable, f.overcut_mm, f.undercut_mm,
                          f.other_faces_overcut_mm, f.strips, f.slenderness,
                          csv_cell(fmt::format("{}", fmt::join(f.reasons, " "))),
                          csv_cell(fmt::format("{}", fmt::join(f.cautions, " "))));
    } else {
      text += ",,,,,,,,,";
    }
    text += csv_cell(row.message) + "\n";
  }
  return text;
}

std::string sweep_html(const SweepResult& result) {
  const SweepPlan& plan = result.plan;
  const std::string title = html_safe(fmt::format("flank sweep: {} of {}", file_name(plan.file), file_name(plan.part)));
  std::string text =
      html_head(title) +
      fmt::format("<p>{} of {} tasks meet their request. The first percentage is of the accessible area.</p>\n",
                  result.count(TaskStatus::kMeets), result.rows.size());
  for (std::size_t variant = 0; variant < std::max<std::size_t>(1, plan.variants.size()); ++variant)
    text += html_table(result, variant);
  return text + "</html>\n";
}

std::string sweep_text(const SweepResult& result) {
  std::string text;
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const SweepTask& task = result.plan.tasks[k];
    const SweepRow& row = result.rows[k];
    text += fmt::format("{:<16} {:<8} {:<28} {}", task.name, task.face, shown_tool(task.tool), status_name(row.status));
    if (row.figures)
      text += fmt::format(", {:.2f} % of the accessible area, {:.2f} % of the whole face, passes {}, gouge {:.4f} mm{}",
                          100.0 * row.figures->coverage_reachable, 100.0 * row.figures->coverage, row.figures->strips,
                          row.figures->overcut_mm, verdict_words(*row.figures));
    if (!row.message.empty()) text += ": " + row.message;
    text += "\n";
  }
  return text +
         fmt::format("{} of {} tasks meet their request\n", result.count(TaskStatus::kMeets), result.rows.size());
}

}  // namespace flank::internal

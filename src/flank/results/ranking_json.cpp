#include "flank/results/ranking_json.h"
#include "flank/io/text/json_dump.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace flank::internal {
namespace {

/// One line of the table. Tools that do not work have no rank and no figures: they say why.
std::string row_of(const RankedChoice& tool, std::size_t rank, std::size_t width) {
  if (!tool.works)
    return fmt::format("    -  {:<{}}  {}\n", tool.tool, width, tool.reason.empty() ? "not tried" : tool.reason);
  return fmt::format("  {:>3}  {:<{}}  {:>6.2f} %  {:>6.2f} %  {:>6.2f} %  {:>6}  {:>7.2f}{}\n", rank, tool.tool, width,
                     100.0 * tool.coverage, 100.0 * tool.reachable_share, 100.0 * tool.coverage_reachable, tool.strips,
                     tool.minutes, tool.stage == "full" ? "" : "  quick plan");
}

}  // namespace

nlohmann::ordered_json ranking_entries(const Ranking& ranking) {
  auto entries = nlohmann::ordered_json::array();
  for (const RankedChoice& tool : ranking.tools) {
    nlohmann::ordered_json entry;
    // In the order in which the ranking has them; those that do not work come last.
    entry["rank"] = entries.size() + 1;
    entry["tool"] = tool.tool;
    entry["name"] = tool.name;
    entry["family"] = family_name(tool.family);
    entry["axis_length"] = tool.axis_length_mm;
    entry["works"] = tool.works;
    entry["stage"] = tool.stage;
    entry["reachable_share"] = tool.reachable_share;
    entry["coverage_reachable"] = tool.coverage_reachable;
    entry["coverage"] = tool.coverage;
    entry["strips"] = tool.strips;
    entry["strips_mm"] = tool.strips_mm;
    entry["links_mm"] = tool.links_mm;
    entry["minutes"] = tool.minutes;
    entry["screen"] = {{"fits", tool.fits}, {"accepted", tool.accepted}, {"open", tool.open}};
    if (!tool.reason.empty()) entry["reason"] = tool.reason;
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::string ranking_to_json(const Ranking& ranking) {
  nlohmann::ordered_json json;
  json["schema"] = "openflank/ranking/1";
  json["units"] = "mm";
  json["source"] = ranking.source;
  json["tolerance"] = ranking.tolerance_mm;
  json["strip_price"] = ranking.strip_price;
  json["feed_mm_min"] = ranking.feed_mm_min;
  json["rapid_mm_min"] = ranking.rapid_mm_min;
  json["tools"] = ranking_entries(ranking);
  return dumped(json, 2) + "\n";
}

std::string ranking_table(const Ranking& ranking) {
  // Names in the first column are as long as they are; the head of the column has four letters.
  std::size_t width = 4;
  for (const RankedChoice& tool : ranking.tools) width = std::max(width, tool.tool.size());
  std::string text = fmt::format("  ranking     {} tools: {}\n", ranking.tools.size(), ranking.source);
  text += fmt::format("       {:<{}}  finished accessible  of that  passes  minutes\n", "tool", width);
  for (std::size_t k = 0; k < ranking.tools.size(); ++k) text += row_of(ranking.tools[k], k + 1, width);
  text += fmt::format(
      "              minutes: {:.4g} mm/min along the passes, {:.4g} mm/min between them; quick plan: "
      "passes not smoothed, because other tools were better\n",
      ranking.feed_mm_min, ranking.rapid_mm_min);
  return text;
}

}  // namespace flank::internal

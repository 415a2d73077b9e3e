#include "flank/artefact/ranking_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "flank/choose/family_chart.h"

namespace flank::internal {
namespace {

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

nlohmann::ordered_json entry_of(const RankingReport& report, const RankedTool& ranked, std::size_t rank) {
  const Tool& tool = report.tools[ranked.tool];
  nlohmann::ordered_json entry;
  entry["rank"] = rank;
  entry["tool"] = report.names[ranked.tool];
  entry["name"] = tool.name;
  entry["family"] = family_name(tool.radial.family());
  entry["axis_length"] = tool.radial.axis_length();
  entry["works"] = ranked.strips > 0;
  entry["stage"] = stage_name(ranked.stage);
  entry["reachable_share"] = ranked.strips > 0 ? ranked.reachable : ranked.screen.reachable;
  entry["coverage_reachable"] = ranked.coverage;
  entry["coverage"] = ranked.covered();
  entry["strips"] = ranked.strips;
  entry["strips_mm"] = ranked.strips_mm;
  entry["links_mm"] = ranked.links_mm;
  entry["minutes"] = ranked.minutes;
  entry["screen"] = {{"fits", ranked.screen.fits}, {"accepted", ranked.screen.accepted}, {"open", ranked.screen.open}};
  if (!ranked.reason.empty()) entry["reason"] = ranked.reason;
  return entry;
}

std::string row_of(const RankingReport& report, const RankedTool& ranked, std::size_t rank, std::size_t width) {
  const std::string& name = report.names[ranked.tool];
  if (ranked.strips == 0)
    return fmt::format("    -  {:<{}}  {}\n", name, width, ranked.reason.empty() ? "not tried" : ranked.reason);
  return fmt::format("  {:>3}  {:<{}}  {:>6.2f} %  {:>6.2f} %  {:>6.2f} %  {:>6}  {:>7.2f}{}\n", rank, name, width,
                     100.0 * ranked.covered(), 100.0 * ranked.reachable, 100.0 * ranked.coverage, ranked.strips,
                     ranked.minutes, ranked.stage == RankingStage::kFull ? "" : "  as grown");
}

}  // namespace

std::string ranking_to_json(const RankingReport& report) {
  nlohmann::ordered_json json;
  json["schema"] = "openflank/ranking/1";
  json["units"] = "mm";
  json["source"] = report.source;
  json["tolerance"] = report.options.cover.tolerance_mm;
  json["strip_price"] = report.options.cover.strip_price;
  json["feed_mm_min"] = report.options.rates.feed_mm_min;
  json["rapid_mm_min"] = report.options.rates.rapid_mm_min;
  json["tools"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < report.ranked.size(); ++k)
    json["tools"].push_back(entry_of(report, report.ranked[k], k + 1));
  return json.dump(2) + "\n";
}

std::string ranking_table(const RankingReport& report) {
  std::size_t width = 4;
  for (const std::string& name : report.names) width = std::max(width, name.size());
  std::string text = fmt::format("  ranking     {} tools: {}\n", report.names.size(), report.source);
  text += fmt::format("       {:<{}}   covered  reachable  of that  strips  minutes\n", "tool", width);
  for (std::size_t k = 0; k < report.ranked.size(); ++k) text += row_of(report, report.ranked[k], k + 1, width);
  text += fmt::format(
      "              minutes: {:.4g} mm/min along the strips, {:.4g} mm/min between them; as grown: left behind before "
      "its strips were smoothed\n",
      report.options.rates.feed_mm_min, report.options.rates.rapid_mm_min);
  return text;
}

}  // namespace flank::internal

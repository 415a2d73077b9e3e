#include "flank/results/cavity/stock_json.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

namespace flank::internal {

using Json = nlohmann::ordered_json;

std::string move_words(const std::string& kind) {
  constexpr std::array<std::array<const char*, 2>, 3> kWords{
      {{"front", "cutting move"}, {"back", "return move"}, {"side", "finishing pass"}}};
  for (const auto& [key, words] : kWords)
    if (kind == key) return words;
  return kind;
}

// What the replay of the program has found, kind of move by kind of move: fronts, backs, entries and sides.
std::string stock_text(const StockReport& stock) {
  std::string text = fmt::format(
      "  simulated   {:.1f} of {:.1f} mm3 removed, at most {:.4f} mm left between the sides, faces gouged by at most "
      "{:.4f} mm (cells of {:.3f} mm, {:.1f} degrees)\n",
      stock.before_mm3 - stock.left_mm3, stock.before_mm3, stock.uncut_mm, stock.entered_mm, stock.cell_mm,
      stock.resolution_deg);
  for (const StockKind& kind : stock.kinds)
    text += fmt::format(
        "              {:<14} engagement at most {:.2f} degrees, removed {:.1f} mm3 along {:.1f} mm of path{}\n",
        move_words(kind.kind), kind.engagement_deg, kind.volume_mm3, kind.way_mm,
        kind.cuts_a_slot() ? " (a slot: no limit)" : "");
  return text;
}

Json stock_to_json(const StockReport& stock) {
  Json json{{"cell_mm", stock.cell_mm},
            {"resolution_deg", stock.resolution_deg},
            {"before_mm3", stock.before_mm3},
            {"left_mm3", stock.left_mm3},
            {"engagement_deg", stock.cycles_deg()},
            {"uncut_mm", stock.uncut_mm},
            {"uncut_point", {stock.uncut_point.x(), stock.uncut_point.y(), stock.uncut_point.z()}},
            {"entered_mm", stock.entered_mm},
            {"kinds", Json::array()}};
  for (const StockKind& kind : stock.kinds)
    json["kinds"].push_back({{"kind", kind.kind},
                             {"engagement_deg", kind.engagement_deg},
                             // Counted from 1, as in all files; null where no move of this kind cuts.
                             {"strip", kind.strip < 0 ? Json(nullptr) : Json(kind.strip + 1)},
                             {"pose", kind.pose},
                             {"s_mm", kind.s},
                             {"way_mm", kind.way_mm},
                             {"volume_mm3", kind.volume_mm3}});
  // One number a strip, in the path's order.
  json["strip_engagement_deg"] = stock.strip_deg;
  json["strip_volume_mm3"] = stock.strip_mm3;
  json["strip_way_mm"] = stock.strip_mm;
  return json;
}

StockReport stock_from_json(const Json& json) {
  StockReport out;
  out.cell_mm = json.at("cell_mm").get<double>();
  out.resolution_deg = json.at("resolution_deg").get<double>();
  out.before_mm3 = json.at("before_mm3").get<double>();
  out.left_mm3 = json.at("left_mm3").get<double>();
  out.uncut_mm = json.at("uncut_mm").get<double>();
  const Json& p = json.at("uncut_point");
  out.uncut_point = {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
  out.entered_mm = json.at("entered_mm").get<double>();
  for (const Json& k : json.at("kinds")) {
    StockKind kind;
    kind.kind = k.at("kind").get<std::string>();
    kind.engagement_deg = k.at("engagement_deg").get<double>();
    kind.strip = k.at("strip").is_null() ? -1 : k.at("strip").get<int>() - 1;
    kind.pose = k.at("pose").get<std::size_t>();
    kind.s = k.at("s_mm").get<double>();
    kind.way_mm = k.at("way_mm").get<double>();
    kind.volume_mm3 = k.at("volume_mm3").get<double>();
    out.kinds.push_back(std::move(kind));
  }
  out.strip_deg = json.at("strip_engagement_deg").get<std::vector<double>>();
  out.strip_mm3 = json.at("strip_volume_mm3").get<std::vector<double>>();
  out.strip_mm = json.at("strip_way_mm").get<std::vector<double>>();
  return out;
}

}  // namespace flank::internal

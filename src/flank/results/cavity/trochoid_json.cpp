#include "flank/results/cavity/trochoid_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace flank::internal {

namespace {

// A slot or a hole in full material has an engagement by its nature, which no limit holds.
std::string entry_text(const LayerSummary& layer) {
  const std::string how =
      layer.entry == "ramp"
          ? fmt::format("{:.2f} mm deep per run, slope {:.2f} degrees", layer.entry_depth_mm, layer.entry_slope_deg)
          : fmt::format("{:.2f} mm deep, each after the first cuts a width of {:.2f} mm", layer.entry_depth_mm,
                        layer.entry_width_mm);
  return fmt::format("entry by {}: {}, {:.1f} mm, removed {:.1f} mm3, engagement {:.1f} degrees (no limit)",
                     layer.entry, how, layer.entry_mm, layer.entry_mm3, layer.entry_deg);
}

}  // namespace

std::string trochoid_lines(const TrochoidSummary& cavity) {
  std::string text = fmt::format(
      "  cavity      {:.3f} mm wide at its narrowest, {} layer{}, path {:.1f} mm, {:.2f} min\n", cavity.narrowest_mm,
      cavity.layers.size(), cavity.layers.size() == 1 ? "" : "s", cavity.way_mm(), cavity.minutes);
  // Fronts and backs count for the engagement that was asked for; what sides have is told beside it.
  for (std::size_t k = 0; k < cavity.layers.size(); ++k) {
    const LayerSummary& layer = cavity.layers[k];
    text += fmt::format(
        "  layer {}     {} cycles ({}), cutting moves {:.1f} mm, return moves {:.1f} mm, sides {:.1f} mm, links {:.1f} "
        "mm\n",
        k + 1, layer.cycles, layer.status, layer.fronts_mm, layer.backs_mm, layer.sides_mm, layer.links_mm);
    if (layer.entry != "open") text += fmt::format("              {}\n", entry_text(layer));
    text += fmt::format(
        "              engagement at most {:.2f} degrees (cutting {:.2f}, return {:.2f}), sides {:.2f}; removed {:.1f} "
        "mm3, {:.3f} mm3 per mm of path\n",
        std::max(layer.front_deg, layer.back_deg), layer.front_deg, layer.back_deg, layer.side_deg,
        // A layer without cycles has no way to divide by.
        layer.volume_mm3 + layer.side_volume_mm3, layer.volume_mm3 / std::max(1e-9, layer.fronts_mm + layer.backs_mm));
  }
  return text;
}

nlohmann::ordered_json trochoid_to_json(const TrochoidSummary& cavity) {
  nlohmann::ordered_json json{{"narrowest", cavity.narrowest_mm},
                              {"engagement", cavity.largest_deg()},
                              {"most_engagement", cavity.most_engagement_deg},
                              {"way", cavity.way_mm()},
                              {"minutes", cavity.minutes},
                              {"layers", nlohmann::ordered_json::array()}};
  for (const LayerSummary& layer : cavity.layers)
    json["layers"].push_back({{"status", layer.status},
                              {"cycles", layer.cycles},
                              {"entry", layer.entry},
                              {"entry_way", layer.entry_mm},
                              {"entry_volume", layer.entry_mm3},
                              {"entry_engagement", layer.entry_deg},
                              {"entry_depth", layer.entry_depth_mm},
                              {"entry_slope", layer.entry_slope_deg},
                              {"entry_width", layer.entry_width_mm},
                              {"fronts", layer.fronts_mm},
                              {"backs", layer.backs_mm},
                              {"sides", layer.sides_mm},
                              {"links", layer.links_mm},
                              {"volume", layer.volume_mm3},
                              {"side_volume", layer.side_volume_mm3},
                              {"front_engagement", layer.front_deg},
                              {"back_engagement", layer.back_deg},
                              {"side_engagement", layer.side_deg},
                              {"entered", layer.entered_mm},
                              {"cycle_engagement", layer.cycle_deg},
                              {"cycle_volume", layer.cycle_mm3},
                              {"cycle_way", layer.cycle_mm}});
  return json;
}

}  // namespace flank::internal

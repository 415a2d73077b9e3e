#include "flank/artefact/cavity/trochoid_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace flank::internal {

std::string trochoid_lines(const TrochoidSummary& cavity) {
  std::string text = fmt::format(
      "  cavity      {:.3f} mm wide at its narrowest, {} layer{}, way {:.1f} mm, {:.2f} min\n", cavity.narrowest_mm,
      cavity.layers.size(), cavity.layers.size() == 1 ? "" : "s", cavity.way_mm(), cavity.minutes);
  // Fronts and backs count for the engagement that was asked for; what sides have is told beside it.
  for (std::size_t k = 0; k < cavity.layers.size(); ++k) {
    const LayerSummary& layer = cavity.layers[k];
    text += fmt::format(
        "  layer {}     {} cycles ({}), fronts {:.1f} mm, backs {:.1f} mm, sides {:.1f} mm, links {:.1f} mm\n", k + 1,
        layer.cycles, layer.status, layer.fronts_mm, layer.backs_mm, layer.sides_mm, layer.links_mm);
    text += fmt::format(
        "              engagement at most {:.3f} degrees (fronts {:.3f}, backs {:.3f}), sides {:.3f}; removed {:.1f} "
        "mm3, {:.3f} mm3 a mm\n",
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

#include "flank/feature/wheel_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"

namespace flank::internal {
namespace {

std::string list(const std::vector<std::string>& faces) {
  return faces.empty() ? "-" : fmt::format("{}", fmt::join(faces, ","));
}

std::string fillets_text(const std::vector<RootFillet>& fillets) {
  if (fillets.empty()) return "-";
  std::string text;
  for (const RootFillet& f : fillets)
    text += (text.empty() ? "" : ",") + (f.constant() ? fmt::format("{} r{:.3g}", f.face, f.radius_mm)
                                                      : fmt::format("{} r{:.3g}-{:.3g}", f.face, f.low_mm, f.high_mm));
  return text;
}

std::vector<double> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json blade_json(const WheelBlade& blade) {
  auto fillets = nlohmann::ordered_json::array();
  for (const RootFillet& f : blade.fillets)
    fillets.push_back({{"face", f.face},
                       {"radius", f.radius_mm},
                       {"low", f.low_mm},
                       {"high", f.high_mm},
                       {"constant", f.constant()}});
  return {{"kind", blade.splitter ? "splitter" : "main"},
          {"angle_deg", blade.angle_deg},
          {"area", blade.area_mm2},
          {"height", blade.height_mm},
          {"thickness", blade.thickness_mm},
          {"ahead", blade.ahead},
          {"behind", blade.behind},
          {"edges", blade.edges},
          {"tips", blade.tips},
          {"fillets", fillets},
          {"buried", blade.buried}};
}

}  // namespace

std::string wheel_table(const WheelRoles& w) {
  const Vec3 &p = w.axis.point, &d = w.axis.direction;
  std::string text = fmt::format("{}: a wheel of {} sectors{}, {} main blades and {} splitters{}\n", w.file, w.count,
                                 w.whole ? "" : " (the part is a piece of the wheel)", w.mains(), w.splitters(),
                                 w.whole || w.shroud.empty() ? "" : ", with a shroud");
  text += fmt::format("  axis    through {:.4f} {:.4f} {:.4f}, along {:.5f} {:.5f} {:.5f}\n", p.x(), p.y(), p.z(),
                      d.x(), d.y(), d.z());
  text += fmt::format("  hub     {}\n  shroud  {}\n", list(w.hub), w.shroud.empty() ? "open" : list(w.shroud));
  text +=
      "\nblade     angle  height  thick  ahead / behind           edges            tips             root fillets, "
      "faces inside the hub\n";
  for (const WheelBlade& b : w.blades)
    text += fmt::format("{:<9} {:5.1f} {:7.2f} {:6.3f}  {:<24} {:<16} {:<16} {}{}\n", b.splitter ? "splitter" : "main",
                        b.angle_deg, b.height_mm, b.thickness_mm, list(b.ahead) + " / " + list(b.behind), list(b.edges),
                        list(b.tips), fillets_text(b.fillets), b.buried.empty() ? "" : "; inside " + list(b.buried));
  text += fmt::format("\nwithout a role, not machined: {}\n", list(w.rest));
  if (!w.debris.empty()) text += fmt::format("other solids, ignored: {}\n", list(w.debris));
  return text;
}

std::string wheel_json(const WheelRoles& w) {
  nlohmann::ordered_json json;
  json["schema"] = "openflank/wheel/1";
  json["units"] = "mm";
  json["part"] = {{"file", w.file}, {"sha256", w.part_sha256}};
  json["axis"] = {{"point_mm", numbers(w.axis.point)}, {"direction", numbers(w.axis.direction)}};
  json["sectors"] = w.count;
  json["whole"] = w.whole;
  json["hub"] = w.hub;
  json["shroud"] = w.shroud;
  json["tip_outline"] = nlohmann::ordered_json::array();
  for (const Vec2& q : w.outline) json["tip_outline"].push_back({q.x(), q.y()});
  json["blades"] = nlohmann::ordered_json::array();
  for (const WheelBlade& blade : w.blades) json["blades"].push_back(blade_json(blade));
  json["rest"] = w.rest;
  json["debris"] = w.debris;
  return dumped(json, 2) + "\n";
}

}  // namespace flank::internal

#include "flank/results/view_json.h"

#include "flank/io/text/json_dump.h"
#include "flank/results/verify_json.h"
#include "flank/results/view_body_json.h"
#include "flank/version.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: null stands for it. Seven digits are more than a picture shows.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;  // its logarithm is not finite; and -0 becomes 0
  const double scale = std::pow(10.0, 6.0 - std::floor(std::log10(std::abs(value))));
  // Of numbers at the ends of the range the scale under- or overflows: they stay as they are.
  return std::isfinite(scale) && scale > 0.0 ? std::round(value * scale) / scale : value;
}

Json pairs(const std::vector<Vec2>& points) {
  Json out = Json::array();
  for (const Vec2& p : points) out.push_back({number(p.x()), number(p.y())});
  return out;
}

/// Poses as six numbers each, tip and axis. Single precision is far below a pixel.
Json to_json(const ViewStrip& strip) {
  std::vector<double> poses;
  for (const Pose& p : strip.poses)
    poses.insert(poses.end(), {p.tip.x(), p.tip.y(), p.tip.z(), p.axis.x(), p.axis.y(), p.axis.z()});
  Json j = {{"id", strip.id},
            {"face", strip.face},
            {"pose_count", strip.pose_count},
            {"index", strip.index},
            {"poses", to_base64(as_floats(poses))}};
  Json t = Json::array(), low = Json::array(), high = Json::array(), c = Json::array(), clearance = Json::array();
  bool any_clearance = false;
  for (const ViewPlace& place : strip.places) {
    t.push_back(number(place.t));
    low.push_back(number(place.lowest_f_mm));
    high.push_back(number(place.highest_f_mm));
    c.push_back(number(place.largest_c));
    clearance.push_back(number(place.clearance_mm));
    any_clearance = any_clearance || std::isfinite(place.clearance_mm);
  }
  j["places"] = {{"t", t}, {"lowest_f_mm", low}, {"highest_f_mm", high}, {"largest_c", c}};
  // Without anything to keep clear of, a row of nulls would only say that nobody asked.
  if (any_clearance) j["places"]["clearance_mm"] = clearance;
  return j;
}

Json tool_to_view(const View& view) {
  Json profile = Json::array();
  for (const ProfilePoint& p : view.profile)
    profile.push_back({number(p.s), number(p.z), number(p.rho), number(p.curvature_per_mm)});
  // Asked for here and not taken from a report: a picture of an illegitimate tool must say so, whoever made it.
  const RadialFunction& radial = view.tool.radial;
  const Legitimacy legitimacy = check_legitimacy(radial);
  return {{"name", view.tool.name},
          {"legitimate", legitimacy.legitimate},
          {"reason", legitimacy.reason},
          {"family", family_name(radial.family())},
          {"axis_length_mm", radial.axis_length()},
          {"tip_radius_mm", radial.at(0.0).r},
          {"end_radius_mm", radial.at(radial.axis_length()).r},
          {"profile", profile},
          {"shank", pairs(view.tool.shank)},
          {"holder", pairs(view.tool.holder)}};
}

}  // namespace

std::string view_to_json(const View& view) {
  Json j = {{"schema", "openflank/view/1"},
            {"units", "mm"},
            {"program", std::string("OpenFlank ") + kVersion},
            {"command", view.command},
            {"part", view.part},
            {"faces", view.faces},
            {"tolerance_mm", view.tolerance_mm},
            {"least_coverage", view.least_coverage},
            {"tool", tool_to_view(view)},
            {"strips", Json::array()},
            {"bodies", Json::array()}};
  for (const SheetSide& side : view.sides) j["sides"].push_back(sheet_side_to_json(side));
  for (const ViewStrip& strip : view.strips) j["strips"].push_back(to_json(strip));
  for (const ViewFace& body : view.bodies) j["bodies"].push_back(body_json(body));
  for (const ViewFace& body : view.fixtures) j["fixtures"].push_back(body_json(body));
  return dumped(j) + "\n";
}

}  // namespace flank::internal

#include "flank/bound/bound_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/job/bound_fields.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json point_entry(const MapPoint& point) {
  Json entry = {{"point", triple(point.point)},
                {"normal", triple(point.normal)},
                {"area", point.area_mm2},
                {"may_be_finished", point.may_be_finished},
                {"longest_contact", point.contact.bound_mm},
                {"found", point.contact.found_mm}};
  if (point.contact.found_mm > 0.0) {
    entry["tip"] = triple(point.contact.pose.tip);
    entry["axis"] = triple(point.contact.pose.axis);
  }
  return entry;
}

/// The largest bound that no more than a share of the area stays below, mm.
double quantile(const ContactMap& map, double share) {
  std::vector<std::pair<double, double>> by_bound;
  double area = 0.0;
  for (const MapPoint& point : map.points) {
    by_bound.emplace_back(point.contact.bound_mm, point.area_mm2);
    area += point.area_mm2;
  }
  std::sort(by_bound.begin(), by_bound.end());
  double below = 0.0;
  for (const auto& [bound, size] : by_bound) {
    below += size;
    if (below >= share * area) return bound;
  }
  // Of all of the area; the two sums may differ by their rounding.
  return by_bound.empty() ? 0.0 : by_bound.back().first;
}

Json target_entry(const BoundTarget& target) {
  const ContactMap& map = target.map;
  Json points = Json::array();
  for (const MapPoint& point : map.points) points.push_back(point_entry(point));
  return {{"faces", target.faces},
          {"complete", map.complete},
          {"area", map.area_mm2},
          {"not_finished_area", map.blocked_mm2},
          {"shortest", quantile(map, 0.0)},
          {"median", quantile(map, 0.5)},
          {"longest", quantile(map, 1.0)},
          {"least_way", map.way_mm},
          {"border", map.border_mm},
          {"least_strips", map.strips},
          {"points", points}};
}

}  // namespace

std::string bound_json(const BoundResult& result) {
  Json targets = Json::array();
  for (const BoundTarget& target : result.targets) targets.push_back(target_entry(target));
  const Json document = {{"schema", "openflank/bound/1"},
                         {"units", "mm"},
                         {"command", command_line(result.job)},
                         {"part_sha256", result.part_sha256},
                         {"tool", result.tool.name},
                         {"axis_length", result.tool.radial.axis_length()},
                         {"tolerance", *result.job.tolerance_mm},
                         {"notes", result.notes},
                         {"targets", targets}};
  return dumped(document, 1) + "\n";
}

std::string bound_text(const BoundResult& result) {
  std::string text = fmt::format("Longest contact of {} (length {:.4g} mm) within {:.4g} mm, proved at each sample\n",
                                 result.tool.name.empty() ? "the tool" : result.tool.name,
                                 result.tool.radial.axis_length(), *result.job.tolerance_mm);
  for (const BoundTarget& target : result.targets) {
    const ContactMap& map = target.map;
    text += fmt::format("  {}: {} samples on {:.4g} mm2\n", target.faces, map.points.size(), map.area_mm2);
    text += fmt::format(
        "    length of contact: at most {:.4g} mm anywhere, at most {:.4g} on a tenth of the area, {:.4g} on half\n",
        quantile(map, 1.0), quantile(map, 0.1), quantile(map, 0.5));
    double found = 0.0, sum = 0.0;
    for (const MapPoint& point : map.points)
      if (point.contact.bound_mm > 0.0) {
        found += point.area_mm2 * point.contact.found_mm / point.contact.bound_mm;
        sum += point.area_mm2;
      }
    if (sum > 0.0)
      text += fmt::format("    the contacts found reach {:.1f} % of these limits on average\n", 100.0 * found / sum);
    if (map.blocked_mm2 > 0.0)
      text += fmt::format("    {:.1f} % of the area can be finished from no position of the tool\n",
                          100.0 * map.blocked_mm2 / map.area_mm2);
    text += fmt::format(
        "    finishing it takes at least {:.4g} mm of path: {} pass{} or more, as no pass can be longer than half the "
        "perimeter of the face ({:.4g} mm)\n",
        map.way_mm, map.strips, map.strips == 1 ? "" : "es", 0.5 * map.border_mm);
    if (!map.complete) text += "    stopped early: the other samples were not examined\n";
  }
  for (const std::string& note : result.notes) text += "  note: " + note + "\n";
  return text;
}

}  // namespace flank::internal

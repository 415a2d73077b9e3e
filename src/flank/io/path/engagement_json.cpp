#include "flank/io/path/engagement_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/io/text/json_input.h"

namespace flank::internal {
namespace {

constexpr std::string_view kSchema = "openflank/engagement/1";
constexpr double kDegree = std::numbers::pi / 180.0;
/// Of a degree: far below what a stock of lines can tell.
constexpr double kDigits = 100.0;
/// No circle has more.
constexpr double kMostDegrees = 360.0;
/// Of the ends of arcs: there are a dozen of them at a pose.
constexpr double kArcDigits = 10.0;

/// Three numbers for each arc, in one list: ring, from, to.
std::string arcs_text(const std::vector<EngagedArc>& arcs) {
  std::string text = "[";
  const auto degrees = [](double rad) { return exact_number(std::round(kArcDigits * rad / kDegree) / kArcDigits); };
  for (const EngagedArc& arc : arcs)
    text += fmt::format("{}{},{},{}", text.size() > 1 ? "," : "", arc.ring, degrees(arc.from), degrees(arc.to));
  return text + "]";
}

std::vector<EngagedArc> arcs_of(const JsonInput& in, std::size_t rings) {
  constexpr std::size_t kNumbers = 3;
  if (in.size() % kNumbers != 0) in.refuse("expected three numbers for each arc");
  std::vector<EngagedArc> arcs;
  for (std::size_t k = 0; k < in.size(); k += kNumbers) {
    const double ring = in.element(k).number(), from = in.element(k + 1).number(), to = in.element(k + 2).number();
    const double least = arcs.empty() ? 0.0 : arcs.back().ring;
    if (!(ring >= least && ring < static_cast<double>(rings)) || ring != std::floor(ring))
      in.element(k).refuse("expected the number of a ring, ascending");
    if (!(from >= -kMostDegrees && to >= from && to <= kMostDegrees)) in.element(k + 1).refuse("expected an arc");
    arcs.push_back({static_cast<int>(ring), from * kDegree, to * kDegree});
  }
  return arcs;
}

}  // namespace

std::string engagement_to_json(const PathEngagement& engagement, const PathArcs& arcs) {
  std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"units\": \"degrees\",\n  \"strips\": [", kSchema);
  for (std::size_t k = 0; k < engagement.size(); ++k) {
    text += k == 0 ? "\n    [" : ",\n    [";
    for (std::size_t i = 0; i < engagement[k].size(); ++i) {
      if (i > 0) text += ", ";
      text += exact_number(std::round(kDigits * engagement[k][i] / kDegree) / kDigits);
    }
    text += ']';
  }
  text += "\n  ]";
  if (!arcs.heights.empty()) {
    text += ",\n  \"heights\": [";
    for (std::size_t k = 0; k < arcs.heights.size(); ++k) text += (k > 0 ? ", " : "") + exact_number(arcs.heights[k]);
    text += "],\n  \"arcs\": [";
    for (std::size_t k = 0; k < arcs.strips.size(); ++k) {
      text += k == 0 ? "\n    [" : ",\n    [";
      for (std::size_t i = 0; i < arcs.strips[k].size(); ++i) text += (i > 0 ? "," : "") + arcs_text(arcs.strips[k][i]);
      text += ']';
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

PathEngagement engagement_from_json(std::string_view text, const std::string& file, const Path& path) {
  const JsonInput in(file, text);
  in.allow_keys({"schema", "units", "strips", "heights", "arcs"});
  if (in.member("schema").text() != kSchema) in.member("schema").refuse(fmt::format("expected \"{}\"", kSchema));
  if (in.member("units").text() != "degrees") in.member("units").refuse("expected \"degrees\"");
  const JsonInput strips = in.member("strips");
  if (strips.size() != path.strips.size())
    strips.refuse(fmt::format("has {}, but the path has {}", strips.size(), path.strips.size()));
  PathEngagement engagement;
  for (std::size_t k = 0; k < strips.size(); ++k) {
    const JsonInput strip = strips.element(k);
    const std::size_t poses = path.strips[k].poses.size();
    if (strip.size() != poses)
      strip.refuse(fmt::format("has {} angles, but its pass has {} CL points", strip.size(), poses));
    std::vector<double>& angles = engagement.emplace_back();
    for (std::size_t i = 0; i < poses; ++i) {
      const double degrees = strip.element(i).number();
      if (!(degrees >= 0.0 && degrees <= kMostDegrees)) strip.element(i).refuse("expected an angle from 0 to 360");
      angles.push_back(degrees * kDegree);
    }
  }
  return engagement;
}

PathArcs arcs_from_json(std::string_view text, const std::string& file, const Path& path) {
  const JsonInput in(file, text);
  PathArcs out;
  if (!in.has("heights")) return out;
  const JsonInput heights = in.member("heights"), arcs = in.member("arcs");
  for (std::size_t k = 0; k < heights.size(); ++k) out.heights.push_back(heights.element(k).number());
  if (!std::is_sorted(out.heights.begin(), out.heights.end())) heights.refuse("expected heights that ascend");
  if (arcs.size() != path.strips.size())
    arcs.refuse(fmt::format("has {}, but the path has {}", arcs.size(), path.strips.size()));
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const JsonInput strip = arcs.element(k);
    const std::size_t poses = path.strips[k].poses.size();
    if (strip.size() != poses)
      strip.refuse(fmt::format("has {} lists of arcs, but its pass has {} CL points", strip.size(), poses));
    std::vector<std::vector<EngagedArc>>& of_strip = out.strips.emplace_back();
    for (std::size_t i = 0; i < poses; ++i) of_strip.push_back(arcs_of(strip.element(i), out.heights.size()));
  }
  return out;
}

}  // namespace flank::internal

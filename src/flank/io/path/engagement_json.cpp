#include "flank/io/path/engagement_json.h"

#include <fmt/format.h>

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

}  // namespace

std::string engagement_to_json(const PathEngagement& engagement) {
  std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"units\": \"degrees\",\n  \"strips\": [", kSchema);
  for (std::size_t k = 0; k < engagement.size(); ++k) {
    text += k == 0 ? "\n    [" : ",\n    [";
    for (std::size_t i = 0; i < engagement[k].size(); ++i) {
      if (i > 0) text += ", ";
      text += exact_number(std::round(kDigits * engagement[k][i] / kDegree) / kDigits);
    }
    text += ']';
  }
  return text + "\n  ]\n}\n";
}

PathEngagement engagement_from_json(std::string_view text, const std::string& file, const Path& path) {
  const JsonInput in(file, text);
  in.allow_keys({"schema", "units", "strips"});
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
      strip.refuse(fmt::format("has {} angles, but the strip has {} poses", strip.size(), poses));
    std::vector<double>& angles = engagement.emplace_back();
    for (std::size_t i = 0; i < poses; ++i) {
      const double degrees = strip.element(i).number();
      if (!(degrees >= 0.0 && degrees <= kMostDegrees)) strip.element(i).refuse("expected an angle from 0 to 360");
      angles.push_back(degrees * kDegree);
    }
  }
  return engagement;
}

}  // namespace flank::internal

#include "flank/setup/tool_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/io/tool/read_any_tool.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

/// Words that are too long for the name of a file are none, and no reason to give up.
bool is_there(const std::string& file) {
  std::error_code error;
  return std::filesystem::exists(file, error);
}

/// "30:10,70:12", or lines of "30 10", "30,10" or "30:10" (# starts a comment) when it came from a file.
std::vector<Vec2> pairs_of(std::string text, const std::string& what) {
  std::vector<double> numbers;
  bool comment = false;
  for (char& c : text) {
    if (c == '#') comment = true;
    if (c == '\n') comment = false;
    // All separators are blanks then: pairs may be written as people or spreadsheets write them.
    if (comment || c == ',' || c == ';' || c == ':' || c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  const char *at = text.data(), *end = at + text.size();
  for (;;) {
    while (at < end && *at == ' ') ++at;
    if (at == end) break;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(at, end, value);
    // "10mm" is no number, rather than 10 with something behind it.
    if (error != std::errc() || (stop < end && *stop != ' ') || !std::isfinite(value))
      throw UsageError("holder", what,
                       fmt::format("\"{}\" is not a number; expected z:radius,z:radius,...",
                                   std::string(at, std::find(at, end, ' '))));
    numbers.push_back(value);
    at = stop;
  }
  if (numbers.size() % 2 != 0 || numbers.size() < 4)
    throw UsageError("holder", what,
                     fmt::format("has {} numbers; expected two or more pairs z:radius", numbers.size()));
  std::vector<Vec2> profile;
  for (std::size_t k = 0; k < numbers.size(); k += 2) profile.emplace_back(numbers[k], numbers[k + 1]);
  return profile;
}

/// Heights above the flank's end may not fall: the profile is one of a solid of revolution, from below to above.
/// Equal heights are a step.
void check_profile(const std::vector<Vec2>& profile, const std::string& what) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile[i].x() < 0.0 || profile[i].y() < 0.0)
      throw UsageError("holder", what,
                       fmt::format("{}:{} is negative; expected heights above the flank and radii >= 0", profile[i].x(),
                                   profile[i].y()));
    if (i > 0 && profile[i].x() < profile[i - 1].x())
      throw UsageError("holder", what,
                       fmt::format("z falls from {} to {}; z must not fall from point to point", profile[i - 1].x(),
                                   profile[i].x()));
  }
}

/// From heights above the flank's upper end to the tool's own z, mm.
std::vector<Vec2> lifted(std::vector<Vec2> profile, double by) {
  for (Vec2& p : profile) p.x() += by;
  return profile;
}

}  // namespace

std::vector<Vec2> holder_profile(const std::string& text, double face) {
  // A file whose name has a colon is a file: being there decides.
  const bool inline_text = text.find(':') != std::string::npos && !is_there(text);
  std::vector<Vec2> profile;
  if (inline_text) {
    profile = pairs_of(text, text);
  } else if (const std::optional<std::vector<Vec2>> drawn = read_holder_file(text)) {
    profile = lifted(*drawn, face);
  } else {
    const std::string content = read_file(text);
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    // The reader of JSON takes objects only.
    profile = first != std::string::npos && content[first] == '['
                  ? JsonInput(text, "{\"holder\":" + content + "}").member("holder").pairs()
                  : pairs_of(content, text);
  }
  if (profile.size() < 2) throw UsageError("holder", text, "expected two or more pairs z:radius");
  check_profile(profile, text);
  return profile;
}

std::vector<Vec2> holder_outline(const std::string& text) {
  const std::vector<Vec2> profile = holder_profile(text);
  return lifted(profile, -profile.front().x());
}

void check_obstacles(const ObstacleRequest& request, const Tool* tool) {
  if (request.shank != "given" && request.shank_length_mm)
    throw UsageError("shank", request.shank, "contradicts `shank_length_mm`; give one of them");
  if (request.shank == "auto" && request.holder)
    throw UsageError("holder", "needs a shank of known length; give `shank_length_mm` with it, not `shank` auto");
  if (request.shank_radius_mm && !request.shank_length_mm && request.shank != "auto")
    throw UsageError("shank_radius_mm", "needs `shank_length_mm`: how far the shank reaches above the flank");
  // Read for its errors alone, before minutes are spent on a plan.
  if (request.holder) (void)holder_profile(*request.holder);
  const bool something =
      request.shank == "auto" || request.shank_length_mm || request.holder || !request.fixtures.empty();
  if (request.clearance_mm && !something && (tool == nullptr || !has_body(*tool)))
    throw UsageError("clearance_mm", "needs `shank_length_mm`, `holder`, `fixtures`, or a tool with a shank");
  for (const std::string& file : request.fixtures)
    if (!is_there(file)) throw InputError(file + ": no such fixture file; accepted: " + part_formats());
}

void equip_tool(const ObstacleRequest& request, Tool& tool) {
  // The upper end of the meridian: z and radius there; a shank without a radius of its own goes on as thick as the
  // flank ends.
  const Vec2 top = meridian_point(tool.radial, tool.radial.axis_length());
  if (request.shank == "none") tool.shank.clear();
  if (request.shank_length_mm) {
    const double radius = request.shank_radius_mm.value_or(top.y());
    tool.shank = lifted({{0.0, radius}, {*request.shank_length_mm, radius}}, top.x());
  }
  // A holder of its own file stands where the shank ends, and on the flank of a tool without one.
  const double face = tool.shank.empty() ? 0.0 : std::max(0.0, tool.shank.back().x() - top.x());
  if (request.holder) tool.holder = lifted(holder_profile(*request.holder, face), top.x());
}

}  // namespace flank::internal

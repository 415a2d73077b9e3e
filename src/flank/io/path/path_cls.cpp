#include "flank/io/path/path_cls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flank/error.h"
#include "flank/io/text/json_input.h"

namespace flank::internal {

namespace {

constexpr int kMeridianPoints = 401;
constexpr double kDegrees = 57.29577951308232;
constexpr std::size_t kWidth = 72;  ///< of a line, as on cards; `$` continues it

void require_positive(double value, const char* name) {
  if (!(value > 0.0 && std::isfinite(value)))
    throw UsageError(fmt::format("{}: is {}; must be a finite number > 0", name, value));
}

/// APT text is one line of plain characters.
std::string plain(std::string_view text, std::size_t longest = 50) {
  std::string out(text.substr(0, longest));
  for (char& c : out)
    if (c < ' ' || c > '~' || c == '$') c = '_';
  return out;
}

/// A statement over as many lines as it needs, broken after commas.
std::string statement(const std::string& word, const std::vector<std::string>& values) {
  std::string text, line = word + "/";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string piece = values[i] + (i + 1 < values.size() ? "," : "");
    if (line.size() + piece.size() + 2 > kWidth) {
      text += line + " $\n";
      line = "  ";
    }
    line += piece;
  }
  return text + line + "\n";
}

/// Exact numbers, so that a path read back is the same.
std::string go_to(const Vec3& tip, const Vec3& axis) {
  return statement("GOTO", {exact_decimal(tip.x()), exact_decimal(tip.y()), exact_decimal(tip.z()),
                            exact_decimal(axis.x()), exact_decimal(axis.y()), exact_decimal(axis.z())});
}

/// For people, not for reading back; never "-0.0000".
std::string rounded(double value) { return fmt::format("{:.4f}", std::abs(value) < 5e-5 ? 0.0 : value); }

/// Everything before the first motion.
std::string head(const Tool& tool, const ClsOptions& options) {
  const NearestCutter c = nearest_cutter(tool);
  std::string text = fmt::format("PARTNO {}\n", plain(options.part));
  text += "UNITS/MM\nMULTAX/ON\n";
  text += fmt::format("PPRINT TOOL PROFILE {}\n", plain(options.tool_file));
  text += fmt::format("PPRINT NEAREST CUTTER IS OFF BY UP TO {:.4f} MM\n", c.error_mm);
  text += "PPRINT GOTO IS THE CENTRE OF THE TIP SPHERE\n";
  text += fmt::format("PPRINT THE TOOL ENDS {:.4f} MM BEYOND IT\n", tool.radial.at(0.0).r);
  text += statement("CUTTER", {rounded(c.diameter), rounded(c.corner_radius), "0.0", "0.0", "0.0",
                               rounded(c.side_angle * kDegrees), rounded(c.height)});
  // Nobody has chosen them: a number here would be run.
  if (!options.spindle_rpm) text += "PPRINT NO SPINDLE SPEED IS SET\n";
  if (!options.feed_mm_min) text += "PPRINT NO FEED IS SET\n";
  text += fmt::format("LOADTL/{}\n", options.tool_number);
  if (options.spindle_rpm) text += fmt::format("SPINDL/{},CLW\n", rounded(*options.spindle_rpm));
  return text;
}

/// A rapid move to above the first pose, down along the axis and along the strip at feed, and up again.
std::string strip_text(const Strip& strip, const ClsOptions& options) {
  if (strip.poses.empty()) return {};
  std::string text = fmt::format("PPRINT STRIP {} {} {}\n", strip.id, plain(strip.kind), plain(strip.face, 1000));
  if (strip.kind == "link") {
    for (const Pose& p : strip.poses) text += "RAPID\n" + go_to(p.tip, p.axis);
    return text;
  }
  const Pose &first = strip.poses.front(), &last = strip.poses.back();
  text += "RAPID\n" + go_to(first.at(options.retract_mm), first.axis);
  if (options.feed_mm_min) text += fmt::format("FEDRAT/{},MMPM\n", rounded(*options.feed_mm_min));
  for (const Pose& p : strip.poses) text += go_to(p.tip, p.axis);
  return text + "RAPID\n" + go_to(last.at(options.retract_mm), last.axis);
}

}  // namespace

NearestCutter nearest_cutter(const Tool& tool) {
  const std::vector<Vec2> points = meridian(tool.radial, kMeridianPoints);
  // Least-squares line through the meridian: it is the side of the cutter.
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / kMeridianPoints;
  double zz = 0.0, zr = 0.0;
  for (const Vec2& p : points) {
    zz += (p.x() - mean.x()) * (p.x() - mean.x());
    zr += (p.x() - mean.x()) * (p.y() - mean.y());
  }
  NearestCutter c;
  c.side_angle = std::atan2(zr, zz);
  const Vec2 normal(-std::sin(c.side_angle), std::cos(c.side_angle));
  // Largest distance from the line, not the root mean square: it is a promise.
  for (const Vec2& p : points) c.error_mm = std::max(c.error_mm, std::abs(normal.dot(p - mean)));
  c.corner_radius = tool.radial.at(0.0).r;
  c.diameter = 2.0 * normal.dot(mean) / std::cos(c.side_angle);
  c.height = points.back().x();
  return c;
}

std::string path_to_cls(const Path& path, const Tool& tool, const ClsOptions& options) {
  require_positive(options.spindle_rpm.value_or(1.0), "spindle speed");
  require_positive(options.feed_mm_min.value_or(1.0), "feed");
  require_positive(options.retract_mm, "retract distance");
  std::string text = head(tool, options);
  for (const Strip& strip : path.strips) text += strip_text(strip, options);
  return text + (options.spindle_rpm ? "SPINDL/OFF\nFINI\n" : "FINI\n");
}

}  // namespace flank::internal

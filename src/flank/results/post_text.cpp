#include "flank/results/post_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/results/acceptance.h"
#include "flank/run.h"

namespace flank {
using namespace internal;

std::string internal::minutes_text(double minutes) {
  const double seconds = minutes * 60.0;
  return seconds < 60.0 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.2f} min", minutes);
}

namespace {

/// A line for each: its tool, and how long it takes.
std::string operations_text(const std::vector<PostOperation>& operations) {
  std::string text = fmt::format("{:<9} {:<24} {:>6} {:>9} {:>10} {:>10}\n", "operation", "name", "tool", "spindle",
                                 "time", "cutting");
  int number = 0;
  for (const PostOperation& one : operations)
    text += fmt::format("{:<9} {:<24} {:>6} {:>9g} {:>10} {:>10}\n", ++number,
                        one.copies > 1 ? fmt::format("{}, copy {}", one.name, one.copy) : one.name,
                        fmt::format("T{}", one.tool_number), one.spindle_rpm, minutes_text(one.minutes),
                        minutes_text(one.cutting_minutes));
  return text;
}

nlohmann::ordered_json operations_json(const std::vector<PostOperation>& operations) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PostOperation& one : operations)
    list.push_back({{"name", one.name},
                    {"folder", one.folder},
                    {"tool_number", one.tool_number},
                    {"tool", one.tool},
                    {"copy", one.copy},
                    {"copies", one.copies},
                    {"spindle_rpm", one.spindle_rpm},
                    {"minutes", one.minutes},
                    {"cutting_minutes", one.cutting_minutes}});
  return list;
}

}  // namespace

std::string post_text(const PostOutcome& o) {
  // What the machine is and where the part sits come first: with the part in another place the program is wrong.
  std::string text =
      fmt::format("machine {} ({}), set-up {}{}\n", o.machine, o.nesting, o.setup, o.setup_found ? " (found)" : "");
  text += fmt::format("{} pass{} of {} CL points: {} blocks with links, {} points inserted, {} left out\n", o.strips,
                      o.strips == 1 ? "" : "es", o.poses, o.moves, o.inserted, o.left_out);
  // Both are bounds, and add up: neither is in the judge's verdict on the planned path.
  text += fmt::format("the control's motion leaves the path by at most {:.2g} mm, rounding adds at most {:.1g} mm\n",
                      o.deviation_mm, o.rounding_mm);
  text += fmt::format("{:<6} {:>11} {:>11} {:>11} {:>14}\n", "axis", "from", "to", "largest /s", "largest /s^2");
  for (const JointRange& j : o.joints)
    text += fmt::format("{:<2}{:<4} {:>11.3f} {:>11.3f} {:>11.3f} {:>14.2f}\n", j.joint, j.unit, j.low, j.high, j.speed,
                        j.acceleration);
  if (o.operations.size() > 1) text += operations_text(o.operations);
  text += fmt::format("never nearer to the pole than {:.2f} degrees; time {}, of which cutting {}\n", o.least_tilt_deg,
                      minutes_text(o.minutes), minutes_text(o.cutting_minutes));
  for (const std::string& note : o.notes) text += "note: " + note + "\n";
  text += reason_lines(o.acceptance);
  return text;
}

// As post_text, complete and in full digits, for scripts.
std::string post_json(const PostOutcome& o) {
  nlohmann::ordered_json json = {{"schema", "openflank/post/1"},
                                 {"units", "mm"},
                                 {"pass", o.acceptance.pass()},
                                 {"machine", o.machine},
                                 {"nesting", o.nesting},
                                 {"setup", o.setup},
                                 {"setup_found", o.setup_found},
                                 {"strips", o.strips},
                                 {"poses", o.poses},
                                 {"moves", o.moves},
                                 {"inserted", o.inserted},
                                 {"left_out", o.left_out},
                                 {"deviation_mm", o.deviation_mm},
                                 {"rounding_mm", o.rounding_mm},
                                 {"least_tilt_deg", o.least_tilt_deg},
                                 {"minutes", o.minutes},
                                 {"cutting_minutes", o.cutting_minutes}};
  json["joints"] = nlohmann::ordered_json::array();
  for (const JointRange& j : o.joints)
    json["joints"].push_back({{"joint", j.joint},
                              {"unit", j.unit},
                              {"low", j.low},
                              {"high", j.high},
                              {"speed", j.speed},
                              {"acceleration", j.acceleration}});
  json["operations"] = operations_json(o.operations);
  json["reasons"] = nlohmann::ordered_json::array();
  for (const Shortfall& r : o.acceptance.reasons) json["reasons"].push_back({{"figure", r.figure}, {"text", r.text}});
  json["cautions"] = nlohmann::ordered_json::array();
  for (const Shortfall& c : o.acceptance.cautions) json["cautions"].push_back({{"figure", c.figure}, {"text", c.text}});
  json["notes"] = o.notes;
  return dumped(json, 2) + "\n";
}

}  // namespace flank

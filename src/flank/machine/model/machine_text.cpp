#include "flank/machine/model/machine_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/languages.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

const char* unit_of(const Joint& joint) { return joint.kind == JointKind::kRotary ? "deg" : "mm"; }

/// A joint has both ends of its travel or none (machine_file.cpp).
std::string travel_text(const Joint& joint) {
  if (!std::isfinite(joint.low)) return "endless";
  return fmt::format("{:g} to {:g} {}", in_units(joint, joint.low), in_units(joint, joint.high), unit_of(joint));
}

/// The words of a machine's file (docs/schema/machine.md), here and below.
std::string positions_word(NcPositions positions) {
  return positions == NcPositions::kJoint       ? "joint"
         : positions == NcPositions::kTipVector ? "tip-vector"
                                                : "tip-rotary";
}

std::string join_word(NcJoin join) { return join == NcJoin::kAxes ? "axes" : "great-circle"; }
std::string feed_word(NcFeedMode mode) { return mode == NcFeedMode::kPerMinute ? "per-minute" : "inverse-time"; }

std::string moves_with(const Machine& machine, const MachineBody& body) {
  const std::size_t bed = machine.table_joints();
  if (body.link == bed) return "on the bed";
  return "on " + machine.joints[body.link < bed ? body.link : body.link - 1].name;
}

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string machine_to_text(const Machine& machine) {
  std::string text = fmt::format("{}: {}, {}\n", machine.name, machine.nesting(), machine.description);
  text += fmt::format("{:<6} {:<6} {:<7} {:>24} {:<24} {:>9} {:>12}\n", "axis", "moves", "kind", "direction",
                      "  travel", "speed /s", "acc. /s^2");
  for (const Joint& j : machine.joints) {
    const Vec3& d = j.direction;
    text += fmt::format("{:<6} {:<6} {:<7} {:>24}   {:<22} {:>9.4g} {:>12.4g}{}{}\n", j.name, j.table ? "work" : "tool",
                        j.kind == JointKind::kRotary ? "rotary" : "linear",
                        // Adding zero turns -0 into 0.
                        fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x() + 0.0, d.y() + 0.0, d.z() + 0.0), travel_text(j),
                        in_units(j, j.speed), in_units(j, j.acceleration),
                        std::isfinite(j.jerk) ? fmt::format("  jerk {:.4g} /s^3", in_units(j, j.jerk)) : "",
                        j.reversed ? "  reversed" : "");
  }
  text += fmt::format("control {}: positions {}, join {}, feed {}, rotary axes {}{}\n",
                      nc_language_name(machine.dialect.language), positions_word(machine.positions),
                      join_word(machine.join), feed_word(machine.feed_mode), machine.rotary_joint(0).name,
                      machine.rotary_joint(1).name);
  if (machine.block_time > 0.0) text += fmt::format("a block takes at least {:g} ms\n", 1e3 * machine.block_time);
  text += fmt::format("tool length {:g} mm to {}\n", machine.tool_length,
                      machine.controlled == ControlledPoint::kLowest ? "its lowest point" : "the centre of its tip");
  for (const MachineBody& body : machine.bodies)
    text += fmt::format("outline of {}: {}, {}\n", body.name,
                        body.shape == MachineBody::Shape::kBox ? "a box" : "a cylinder", moves_with(machine, body));
  return text;
}

std::string machine_to_json(const Machine& machine) {
  Json json = {{"schema", "openflank/machine-summary/1"},
               {"name", machine.name},
               {"description", machine.description},
               {"nesting", machine.nesting()},
               {"language", nc_language_name(machine.dialect.language)},
               {"positions", positions_word(machine.positions)},
               {"join", join_word(machine.join)},
               {"feed", feed_word(machine.feed_mode)},
               {"rotary", machine.rotary_joint(0).name + machine.rotary_joint(1).name},
               {"tool_length_mm", machine.tool_length}};
  if (machine.block_time > 0.0) json["block_time_ms"] = 1e3 * machine.block_time;
  json["joints"] = Json::array();
  for (const Joint& j : machine.joints) {
    Json joint = {{"name", j.name},
                  {"kind", j.kind == JointKind::kRotary ? "rotary" : "linear"},
                  {"moves", j.table ? "work" : "tool"},
                  {"unit", unit_of(j)},
                  {"direction", triple(j.direction)}};
    if (j.kind == JointKind::kRotary) joint["point_mm"] = triple(j.point);
    if (std::isfinite(j.low)) joint["travel"] = {in_units(j, j.low), in_units(j, j.high)};
    joint["speed"] = in_units(j, j.speed);
    joint["acceleration"] = in_units(j, j.acceleration);
    if (std::isfinite(j.jerk)) joint["jerk"] = in_units(j, j.jerk);
    json["joints"].push_back(std::move(joint));
  }
  json["bodies"] = Json::array();
  for (const MachineBody& body : machine.bodies) {
    const bool box = body.shape == MachineBody::Shape::kBox;
    Json one = {{"name", body.name}, {"moves", moves_with(machine, body)}};
    Json ends = triple(body.from);
    for (const Json& x : triple(body.to)) ends.push_back(x);
    one[box ? "box_mm" : "cylinder_mm"] = ends;
    if (!box) one["radius_mm"] = body.radius;
    json["bodies"].push_back(std::move(one));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string machine_list_text() {
  std::string text;
  for (const std::string& name : machine_names()) {
    const Machine machine = read_machine(name);
    text += fmt::format("{:<26} {:<12} {}\n", name, machine.nesting(), machine.description);
  }
  return text;
}

std::string machine_list_json() {
  Json json = {{"schema", "openflank/machine-list/1"}, {"folder", machine_folder()}, {"machines", Json::array()}};
  for (const std::string& name : machine_names()) {
    const Machine machine = read_machine(name);
    json["machines"].push_back({{"name", name}, {"nesting", machine.nesting()}, {"description", machine.description}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace flank::internal

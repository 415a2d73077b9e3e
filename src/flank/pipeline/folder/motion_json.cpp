#include "flank/pipeline/folder/motion_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"

namespace flank::internal {
namespace {

constexpr std::size_t kMostTimes = 10000;

/// What is shown needs six digits, and a page of them stays small.
double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 5.0);
  return std::round(value / unit) * unit;
}

nlohmann::ordered_json or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(rounded(value)) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json triple(const Vec3& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

/// As in the machine's file, but for the link instead of the joint's name.
nlohmann::ordered_json bodies_of(const Machine& machine) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MachineBody& body : machine.bodies) {
    nlohmann::ordered_json one = {{"name", body.name}, {"link", body.link}};
    const bool box = body.shape == MachineBody::Shape::kBox;
    nlohmann::ordered_json& ends = one[box ? "box_mm" : "cylinder_mm"] = triple(body.from);
    for (const nlohmann::ordered_json& x : triple(body.to)) ends.push_back(x);
    if (!box) one["radius_mm"] = rounded(body.radius);
    list.push_back(std::move(one));
  }
  return list;
}

/// The corners of the part's box, where the part sits.
nlohmann::ordered_json corners_of(const Box3& part, const WorkSetup& setup) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (part.empty()) return list;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) != 0 ? part.high.x() : part.low.x(), (k & 2) != 0 ? part.high.y() : part.low.y(),
                      (k & 4) != 0 ? part.high.z() : part.low.z());
    list.push_back(triple(setup.rotation() * corner + setup.translation));
  }
  return list;
}

/// The largest share of a joint's speed limit on the way to the i-th point of the trace.
double load_of(const Machine& machine, const std::vector<TracePoint>& trace, std::size_t i) {
  const double seconds = i > 0 ? trace[i].time_s - trace[i - 1].time_s : 0.0;
  double load = 0.0;
  if (seconds > 0.0)
    for (std::size_t k = 0; k < kJointCount; ++k)
      load = std::max(load, std::abs(trace[i].joints[k] - trace[i - 1].joints[k]) / seconds / machine.joints[k].speed);
  return load;
}

nlohmann::ordered_json texts_of(const std::vector<Shortfall>& shortfalls) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Shortfall& one : shortfalls) list.push_back({{"figure", one.figure}, {"text", one.text}});
  return list;
}

}  // namespace

std::string motion_json(const Machine& machine, const Post& post, const Box3& part, const WorkSetup& setup,
                        const Acceptance& acceptance) {
  using Json = nlohmann::ordered_json;
  const std::vector<TracePoint>& trace = post.trace;
  const std::size_t count = trace.empty() ? 0 : std::min(kMostTimes, std::max<std::size_t>(2, trace.size()));
  std::array<Json, kJointCount> values;
  values.fill(Json::array());
  Json times = Json::array(), feeds = Json::array(), loads = Json::array(), cutting = Json::array(),
       off = Json::array();
  std::size_t next = 0, seen = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double t = post.time_s * static_cast<double>(n) / static_cast<double>(count - 1);
    while (next + 1 < trace.size() && trace[next].time_s < t) ++next;
    const TracePoint &to = trace[next], &from = trace[next > 0 ? next - 1 : 0];
    const double way = to.time_s - from.time_s, share = way > 0.0 ? std::clamp((t - from.time_s) / way, 0.0, 1.0) : 1.0;
    for (std::size_t k = 0; k < kJointCount; ++k)
      values[k].push_back(
          rounded(in_units(machine.joints[k], from.joints[k] + share * (to.joints[k] - from.joints[k]))));
    // Between two times the largest counts: what is near a limit for a moment must not be lost.
    double load = 0.0, farthest = 0.0;
    for (; seen <= next; ++seen) {
      load = std::max(load, load_of(machine, trace, seen));
      farthest = std::max(farthest, trace[seen].off_path_mm);
    }
    seen = next;
    times.push_back(rounded(t));
    feeds.push_back(rounded(60.0 * to.feed_mm_s));
    loads.push_back(rounded(load));
    cutting.push_back(to.cutting ? 1 : 0);
    off.push_back(farthest);
  }
  Json joints = Json::array();
  for (std::size_t k = 0; k < kJointCount; ++k) {
    const Joint& joint = machine.joints[k];
    joints.push_back({{"name", joint.name},
                      {"unit", joint.kind == JointKind::kRotary ? "deg" : "mm"},
                      {"table", joint.table},
                      // With the sign that formulas need: of the tool relative to the work.
                      {"direction", triple(joint.reversed ? Vec3(-joint.direction) : joint.direction)},
                      {"point_mm", triple(joint.point)},
                      {"low", or_null(in_units(joint, joint.low))},
                      {"high", or_null(in_units(joint, joint.high))},
                      {"values", std::move(values[k])}});
  }
  const Json json = {{"schema", "openflank/motion/1"},
                     {"units", "mm, degrees, s"},
                     {"machine", machine.name},
                     {"pass", acceptance.pass()},
                     {"reasons", texts_of(acceptance.reasons)},
                     {"cautions", texts_of(acceptance.cautions)},
                     {"duration_s", rounded(post.time_s)},
                     {"cutting_s", rounded(post.cutting_s)},
                     {"spindle",
                      {{"gauge_mm", triple(machine.gauge)},
                       {"axis", triple(machine.tool_axis)},
                       {"tool_length_mm", rounded(machine.tool_length)}}},
                     {"bodies", bodies_of(machine)},
                     {"part_corners_mm", corners_of(part, setup)},
                     {"joints", std::move(joints)},
                     {"time_s", std::move(times)},
                     {"feed_mm_min", std::move(feeds)},
                     {"speed_share", std::move(loads)},
                     {"cutting", std::move(cutting)},
                     {"off_path_mm", std::move(off)},
                     {"off_path_bound_mm", post.deviation_mm}};
  return dumped(json) + "\n";
}

}  // namespace flank::internal

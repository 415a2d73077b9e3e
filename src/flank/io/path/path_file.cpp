#include "flank/path_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exception>
#include <set>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"

namespace flank {
using namespace internal;

namespace {

constexpr std::string_view kSchema = "openflank/path/1";

/// [x, y, z, i, j, k]. An axis with rounded digits is normalised; one that is no unit vector at all is refused.
Pose pose_from(const JsonInput& poses, std::size_t k) {
  std::array<double, 6> v{};
  poses.numbers_of(k, v);  // no element(k): its name would be formatted a million times for a long path
  Pose pose{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  const double length = pose.axis.norm();
  if (!(std::abs(length - 1.0) <= kAxisLengthRounded))
    poses.element(k).refuse(fmt::format("the axis vector (i, j, k) has length {}; must be 1", length));
  if (std::abs(length - 1.0) > kAxisLengthExact) pose.axis /= length;
  return pose;
}

/// "kind", "face" and "layer" may be left out.
Strip strip_from(const JsonInput& in) {
  in.allow_keys({"id", "kind", "face", "layer", "poses"});
  Strip strip;
  strip.id = in.member("id").integer();
  if (in.has("kind")) strip.kind = in.member("kind").text();
  if (in.has("face")) strip.face = in.member("face").text();
  if (in.has("layer")) {
    strip.layer = in.member("layer").integer();
    if (strip.layer < 1) in.member("layer").refuse("must be 1 or more");
  }
  const JsonInput poses = in.member("poses");
  if (poses.size() == 0) poses.refuse("expected at least one pose [x, y, z, i, j, k]");
  strip.poses.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) strip.poses.push_back(pose_from(poses, i));
  return strip;
}

}  // namespace

std::string path_to_json(const Path& path) {
  std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"units\": \"mm\",\n  \"strips\": [", kSchema);
  for (std::size_t k = 0; k < path.strips.size(); ++k) {
    const Strip& strip = path.strips[k];
    const std::string layer = strip.layer > 0 ? fmt::format("\"layer\": {}, ", strip.layer) : "";
    text += fmt::format("{}\n    {{\"id\": {}, \"kind\": {}, \"face\": {}, {}\"poses\": [", k == 0 ? "" : ",", strip.id,
                        json_string(strip.kind), json_string(strip.face), layer);
    for (std::size_t i = 0; i < strip.poses.size(); ++i) {
      const Pose& p = strip.poses[i];
      text += fmt::format("{}\n      [{}, {}, {}, {}, {}, {}]", i == 0 ? "" : ",", exact_number(p.tip.x()),
                          exact_number(p.tip.y()), exact_number(p.tip.z()), exact_number(p.axis.x()),
                          exact_number(p.axis.y()), exact_number(p.axis.z()));
    }
    text += "\n    ]}";
  }
  return text + "\n  ]\n}\n";
}

Path path_from_json(std::string_view text, const std::string& file) {
  Path path;
  std::set<int> ids;
  std::exception_ptr refused;  // what else is wrong with the file is told first
  const auto take = [&](const JsonInput& in) {
    path.strips.push_back(strip_from(in));
    if (!ids.insert(path.strips.back().id).second) in.refuse(fmt::format("id {} is used twice", path.strips.back().id));
  };
  const JsonInput in(file, text, "strips", [&](const JsonInput& strip) {
    if (refused) return;
    try {
      take(strip);
    } catch (const InputError&) {
      refused = std::current_exception();
    }
  });
  in.require_schema(kSchema);
  in.allow_keys({"schema", "units", "strips"});
  if (refused) std::rethrow_exception(refused);
  // What is left in the list is no object; how many were before it is not known any more.
  const JsonInput left = in.member("strips");
  if (left.size() > 0 && path.strips.empty()) static_cast<void>(strip_from(left.element(0)));
  if (left.size() > 0) left.refuse("every strip must be an object {...}");
  return path;
}

Path read_path(const std::string& file) { return path_from_json(read_file(file), file); }

void write_path(const Path& path, const std::string& file) { write_file(file, path_to_json(path)); }

}  // namespace flank

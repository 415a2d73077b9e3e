#include "flank/pipeline/folder/wheel_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/io/face_names.h"
#include "flank/io/text/json_input.h"
#include "flank/path_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

Vec3 vector_of(const JsonInput& json) {
  const std::vector<double> v = json.numbers(3);
  return {v[0], v[1], v[2]};
}

int count_of(const JsonInput& json) {
  const int count = json.integer();
  if (count < 1) json.refuse("must be at least 1");
  return count;
}

bool truth_of(const JsonInput& object, const nlohmann::json& raw, const char* key) {
  const JsonInput member = object.member(key);
  if (!raw.at(key).is_boolean()) member.refuse("must be true or false");
  return raw.at(key).get<bool>();
}

/// A file that the plan names stays in its folder.
std::string inside(const std::string& folder, const JsonInput& name) {
  const fs::path path = fs::path(name.text()).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == "..")
    name.refuse("must be a place within the folder of the plan, as \"ops/10-rough\"");
  return (fs::path(folder) / path).string();
}

std::vector<std::string> names_of(const JsonInput& json) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < json.size(); ++k) out.push_back(json.element(k).text());
  return out;
}

WheelStep step_of(const std::string& folder, const JsonInput& json, const nlohmann::json& raw) {
  WheelStep step;
  step.id = json.member("id").text(), step.kind = json.member("kind").text();
  step.done = truth_of(json, raw, "done");
  if (step.done) step.folder = inside(folder, json.member("folder"));
  step.copies = count_of(json.member("copies"));
  if (json.has("faces")) step.faces = names_of(json.member("faces"));
  if (json.has("problem")) step.problem = json.member("problem").text();
  return step;
}

LackingBlade lacking_of(const JsonInput& json) {
  LackingBlade blade;
  blade.faces = names_of(json.member("faces"));
  blade.turns = json.member("turns").integer();
  return blade;
}

/// The faces of the part that a list of names means; of a piece the whole face, whichever pieces the part is told apart into.
std::set<int> faces_named(const Part& part, const std::vector<std::string>& names) {
  std::set<int> out;
  for (const std::string& name : names)
    for (const int face : parse_face_list(part, fmt::format("F{}", parse_face_name(name).number))) out.insert(face);
  return out;
}

}  // namespace

std::vector<const WheelStep*> WheelPlan::roughing() const {
  std::vector<const WheelStep*> out;
  for (const WheelStep& step : steps)
    if (step.done && step.kind == "rough") out.push_back(&step);
  return out;
}

std::optional<WheelPlan> read_wheel_plan(const std::string& folder) {
  const std::string file = (fs::path(folder) / "plan.json").string();
  if (!fs::exists(file)) return {};
  const std::string text = read_file(file);
  const JsonInput json(file, text);
  const auto raw = nlohmann::json::parse(text);
  json.require_schema("openflank/plan/1");
  WheelPlan plan;
  const JsonInput axis = json.member("axis"), direction = axis.member("direction");
  plan.axis.point = vector_of(axis.member("point_mm"));
  plan.axis.direction = vector_of(direction);
  if (!(plan.axis.direction.norm() > 0.0)) direction.refuse("must not be zero");
  plan.axis.direction.normalize();
  if (json.has("up")) plan.up = vector_of(json.member("up")).normalized();
  plan.sectors = count_of(json.member("sectors"));
  plan.whole = truth_of(json, raw, "whole");
  if (json.has("blank")) plan.blank = inside(folder, json.member("blank").member("file"));
  plan.most_engagement_deg = json.member("most_engagement_deg").positive();
  if (json.has("most_free_mm")) plan.most_free_mm = json.member("most_free_mm").positive();
  if (json.has("lacking")) {
    const JsonInput lacking = json.member("lacking");
    for (std::size_t k = 0; k < lacking.size(); ++k) plan.lacking.push_back(lacking_of(lacking.element(k)));
  }
  if (json.has("left_out")) {
    plan.left_out = names_of(json.member("left_out"));
  }
  const JsonInput steps = json.member("operations");
  for (std::size_t k = 0; k < steps.size(); ++k)
    plan.steps.push_back(step_of(folder, steps.element(k), raw.at("operations").at(k)));
  return plan;
}

void stand_whole(const WheelPlan& plan, Setup& setup) {
  constexpr double kChordShare = 0.1;  ///< of the tolerance
  const Part& part = setup.part;
  for (const WheelStep& step : plan.steps)
    if (plan.whole && (step.kind == "side" || step.kind == "edge" || step.kind == "fillet"))
      for (const int target : setup.targets)
        if (std::count(step.faces.begin(), step.faces.end(), part.face_id(target)) > 0)
          setup.copies[target] = step.copies;
  for (const LackingBlade& blade : plan.lacking) {
    TriangleMesh body;
    for (const int face : faces_named(part, blade.faces))
      append(body, part.is_mesh() ? extract_mesh(part, {face})
                                  : tessellate(part.faces[static_cast<std::size_t>(face)],
                                               {.chord_mm = kChordShare * setup.tolerance_mm})
                                        .mesh);
    const Eigen::Isometry3d turn = copy_turn(plan.axis, blade.turns + 1, plan.sectors);
    for (Vec3& p : body.vertices) p = turn * p;
    setup.standing.push_back(std::move(body));
  }
}

void require_steps_make(const WheelPlan& plan, const Path& path, const std::string& file) {
  constexpr double kSame = 1e-6;
  Path sector;
  int copies = 1;
  for (const WheelStep& step : plan.steps) {
    if (!step.done || step.kind == "rough") continue;
    copies = step.copies;
    const Path own = read_path((fs::path(step.folder) / "path.json").string());
    sector.strips.insert(sector.strips.end(), own.strips.begin(), own.strips.end());
  }
  const auto same = [](const Pose& a, const Pose& b) {
    return (a.tip - b.tip).norm() <= kSame && (a.axis - b.axis).norm() <= kSame;
  };
  const Path made = all_copies(sector, plan, copies);
  for (std::size_t k = 0; k < std::max(made.strips.size(), path.strips.size()); ++k)
    if (k >= std::min(made.strips.size(), path.strips.size()) ||
        !std::equal(made.strips[k].poses.begin(), made.strips[k].poses.end(), path.strips[k].poses.begin(),
                    path.strips[k].poses.end(), same))
      throw InputError(
          fmt::format("{}: pass {} is not that of the operations in plan.json; plan the wheel again", file, k + 1));
}

Path all_copies(const Path& sector, const WheelPlan& plan, int copies) {
  Path out;
  for (int k = 0; k < copies; ++k) {
    // Copy 1 is the path itself, and so is what is turned by nothing.
    const Path path = k == 0 ? sector : turned(sector, copy_turn(plan.axis, k + 1, plan.sectors));
    out.strips.insert(out.strips.end(), path.strips.begin(), path.strips.end());
  }
  for (std::size_t k = 0; k < out.strips.size(); ++k) out.strips[k].id = static_cast<int>(k) + 1;
  return out;
}

}  // namespace flank::internal

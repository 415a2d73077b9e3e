#include "flank/machine/model/body_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace flank::internal {
namespace {

constexpr double kFarMm = 1e5;           ///< no machine is larger
constexpr std::size_t kMostBodies = 64;  ///< an outline, not a drawing
constexpr double kLeastLength = 1e-6;    ///< mm, of a cylinder
constexpr NumberRange kPlace{-kFarMm, kFarMm}, kRadius{1e-6, kFarMm};

/// How many joints lie between the work and what a joint moves, or the bed: tables carry the work, heads the tool.
std::size_t link_of(const TomlTable& table, const Machine& machine) {
  std::vector<std::string> words{"bed"};
  for (const Joint& joint : machine.joints) words.push_back(joint.name);
  const std::string word = table.word("on", words);
  for (std::size_t k = 0; k < kJointCount; ++k)
    if (machine.joints[k].name == word) return machine.joints[k].table ? k : k + 1;
  return machine.table_joints();
}

void read_box(const TomlTable& table, MachineBody& body) {
  const std::vector<double> v = table.numbers("box_mm", 6, kPlace);
  body.shape = MachineBody::Shape::kBox;
  body.from = {v[0], v[1], v[2]};
  body.to = {v[3], v[4], v[5]};
  if (!((body.to - body.from).array() > 0.0).all())
    table.refuse("box_mm", "expected [x, y, z, x, y, z]: the lower corner, then the upper one");
}

void read_cylinder(const TomlTable& table, MachineBody& body) {
  const std::vector<double> v = table.numbers("cylinder_mm", 6, kPlace);
  body.shape = MachineBody::Shape::kCylinder;
  body.from = {v[0], v[1], v[2]};
  body.to = {v[3], v[4], v[5]};
  if (!((body.to - body.from).norm() > kLeastLength))
    table.refuse("cylinder_mm", "expected [x, y, z, x, y, z]: the two ends of its axis, which differ");
  body.radius = table.number("radius_mm", kRadius);
}

}  // namespace

std::vector<MachineBody> read_bodies(const TomlTable& file, const Machine& machine) {
  std::vector<MachineBody> bodies;
  if (!file.has("body")) return bodies;
  for (const TomlTable& table : file.tables("body")) {
    if (bodies.size() == kMostBodies) table.refuse("name", fmt::format("at most {} bodies are read", kMostBodies));
    MachineBody body;
    body.name = table.text("name");
    body.link = link_of(table, machine);
    if (table.has("box_mm") == table.has("cylinder_mm"))
      table.refuse("name", "expected either box_mm or cylinder_mm with radius_mm");
    table.has("box_mm") ? read_box(table, body) : read_cylinder(table, body);
    table.require_all_known();
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace flank::internal

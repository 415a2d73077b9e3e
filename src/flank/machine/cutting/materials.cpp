#include "flank/machine/cutting/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "flank/base/rest_of.h"
#include "flank/base/shared_folder.h"
#include "flank/error.h"
#include "flank/io/text/toml_table.h"

namespace flank::internal {
namespace {

constexpr const char* kMaterialSchema = "openflank/materials/1";
constexpr const char* kMaterialFile = "materials.toml";

Material material_of(const TomlTable& row) {
  Material m;
  m.name = row.text("name");
  m.description = row.text("description");
  m.source = row.text("source");
  (void)row.whole("group", 1, 41);  // of VDI 3323, for people
  const std::vector<double> speed = row.numbers("speed_m_min", 2, {1.0, 5000.0}),
                            chip = row.numbers("chip_per_diameter", 2, {1e-5, 0.1});
  if (speed[1] < speed[0]) row.refuse("speed_m_min", "the upper speed is below the lower one");
  if (chip[1] < chip[0]) row.refuse("chip_per_diameter", "the upper chip load is below the lower one");
  m.speed_low = speed[0], m.speed_high = speed[1];
  m.chip_low = chip[0], m.chip_high = chip[1];
  m.kc1 = row.number("kc1_n_mm2", {50.0, 10000.0});
  m.mc = row.number("mc", {0.0, 0.9});
  if (m.name.empty()) row.refuse("name", "expected a name");
  if (m.source.empty()) row.refuse("source", "expected the source of the numbers");
  return m;
}

}  // namespace

std::vector<Material> materials_from_toml(std::string_view text, const std::string& file) {
  const TomlTable document = TomlTable::parse(text, file);
  (void)document.word("schema", {kMaterialSchema});
  std::vector<Material> materials;
  for (const TomlTable& row : document.tables("material")) {
    materials.push_back(material_of(row));
    const auto same = [&](const Material& m) { return m.name == materials.back().name; };
    if (std::any_of(materials.begin(), materials.end() - 1, same)) row.refuse("name", "occurs twice");
  }
  document.require_all_known();
  if (materials.empty()) throw InputError(file + ": has no [[material]]");
  return materials;
}

std::vector<Material> read_materials() {
  const std::string folder = find_shared_folder({.name = "materials",
                                                 .variable = "FLANK_MATERIALS",
                                                 .installed = FLANK_MATERIALS_INSTALLED,
                                                 .content = "materials.toml",
                                                 .things = "materials",
                                                 .advice = "name their folder by FLANK_MATERIALS"});
  const std::string file = folder + "/" + kMaterialFile;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be read");
  return materials_from_toml(rest_of(in), file);
}

Material find_material(const std::string& name) {
  std::string names;
  for (const Material& m : read_materials()) {
    if (m.name == name) return m;
    names += (names.empty() ? "" : ", ") + m.name;
  }
  throw UsageError("material", name, "no such material; expected " + names);
}

CuttingData cutting_data(const Material& material, double diameter_mm, int teeth, double largest_rpm) {
  CuttingData data;
  const double speed = 0.5 * (material.speed_low + material.speed_high);
  data.spindle_rpm = 1000.0 * speed / (std::numbers::pi * diameter_mm);
  data.limited = largest_rpm > 0.0 && data.spindle_rpm > largest_rpm;
  if (data.limited) data.spindle_rpm = largest_rpm;
  data.chip_mm = material.chip_low * diameter_mm;
  data.feed_mm_min = data.chip_mm * teeth * data.spindle_rpm;
  return data;
}

ForceCoefficients force_coefficients(const Material& material, double chip_mm) {
  ForceCoefficients k;
  const double kc = material.kc1 * std::pow(chip_mm, -material.mc);
  k.tangential = kc * (1.0 - material.mc);
  k.tangential_edge = kc * material.mc * chip_mm;
  k.normal = kNormalShare * k.tangential;
  k.normal_edge = kNormalShare * k.tangential_edge;
  return k;
}

}  // namespace flank::internal

/// What is cut: cutting data to start with, and specific forces (share/materials).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/cutting/cutting_force.h"

namespace flank::internal {

struct Material {
  std::string name, description, source;
  double speed_low = 0.0, speed_high = 0.0;  ///< of the cutting edge, m/min
  double chip_low = 0.0, chip_high = 0.0;    ///< feed per tooth over the cutter's diameter
  double kc1 = 0.0, mc = 0.0;                ///< kc = kc1 / h^mc, N/mm^2 with h in mm
};

/// The rows of a file. Throws InputError with file, line and column: ranges that fall, numbers that no metal has, a row without
/// its source, a name twice.
[[nodiscard]] std::vector<Material> materials_from_toml(std::string_view text, const std::string& file);

/// The rows that come with the program, or those of the folder that FLANK_MATERIALS names.
[[nodiscard]] std::vector<Material> read_materials();

/// The row of this name. Throws UsageError of the field `material` that lists all names.
[[nodiscard]] Material find_material(const std::string& name);

/// Spindle and feed: the middle of the material's speed at the largest diameter, the lower end of its chip, for what finishes.
struct CuttingData {
  double spindle_rpm = 0.0, feed_mm_min = 0.0, chip_mm = 0.0;
  bool limited = false;  ///< the spindle of the machine is the limit, not the material
};
/// `largest_rpm`: of the machine; 0: not known.
[[nodiscard]] CuttingData cutting_data(const Material& material, double diameter_mm, int teeth, double largest_rpm);

/// Mechanistic coefficients about chips of h mm: the tangential force is kc h there and grows with kc (1 - mc) about it, so that
/// its edge part is mc kc h. Normal forces are kNormalShare of it, binormal ones left out.
inline constexpr double kNormalShare = 0.4;
[[nodiscard]] ForceCoefficients force_coefficients(const Material& material, double chip_mm);

}  // namespace flank::internal

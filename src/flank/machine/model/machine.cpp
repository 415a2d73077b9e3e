#include "flank/machine/model/machine.h"

#include <numbers>

namespace flank::internal {

double in_units(const Joint& joint, double value) {
  return joint.kind == JointKind::kRotary ? value * 180.0 / std::numbers::pi : value;
}

std::size_t Machine::table_joints() const {
  std::size_t count = 0;
  while (count < kJointCount && joints[count].table) ++count;
  return count;
}

std::string Machine::nesting() const {
  int tables = 0;
  for (const std::size_t k : rotary) tables += joints[k].table ? 1 : 0;
  return tables == 2 ? "table-table" : tables == 1 ? "head-table" : "head-head";
}

}  // namespace flank::internal

#include "flank/feature/wheel_roles.h"

#include <algorithm>

namespace flank::internal {

std::vector<std::string> WheelBlade::sides() const {
  std::vector<std::string> out = ahead;
  if (!round()) out.insert(out.end(), behind.begin(), behind.end());
  return out;
}

std::vector<std::string> WheelBlade::flow() const {
  std::vector<std::string> out = sides();
  out.insert(out.end(), edges.begin(), edges.end());
  for (const RootFillet& fillet : fillets) out.push_back(fillet.face);
  return out;
}

std::vector<std::string> WheelBlade::all() const {
  std::vector<std::string> out = flow();
  for (const auto* more : {&tips, &buried}) out.insert(out.end(), more->begin(), more->end());
  return out;
}

int WheelRoles::mains() const {
  return static_cast<int>(std::count_if(blades.begin(), blades.end(), [](const WheelBlade& b) { return !b.splitter; }));
}

}  // namespace flank::internal

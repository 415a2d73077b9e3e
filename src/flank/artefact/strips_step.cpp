#include "flank/artefact/strips_step.h"

#include "flank/face.h"
#include "flank/io/cad/write_step.h"

namespace flank::internal {

std::string strips_to_step(const std::vector<StripSurface>& strips) {
  std::vector<NamedFaces> objects;
  const auto add = [&](const std::string& name, const BSplineSurface& surface, bool reversed) {
    Face face;
    face.id = name;
    face.surface = surface;
    face.reversed = reversed;
    objects.push_back({name, {face}});
  };
  for (const StripSurface& strip : strips) add(strip.name, strip.envelope, !strip.towards_tool);
  for (const StripSurface& strip : strips) add(strip.name + " axis", strip.axis, false);
  return faces_to_step("strips", objects);
}

}  // namespace flank::internal

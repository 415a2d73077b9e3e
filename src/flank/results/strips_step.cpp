#include "flank/results/strips_step.h"

#include "flank/face.h"
#include "flank/io/cad/write_step.h"

namespace flank::internal {

std::string strips_to_step(const std::vector<StripSurface>& strips, double axis_length) {
  std::vector<NamedFaces> objects;
  const auto add = [&](const std::string& name, const BSplineSurface& surface, bool reversed) {
    Face face;
    face.id = name;
    face.surface = surface;
    face.reversed = reversed;
    objects.push_back({name, {face}});
  };
  for (const StripSurface& strip : strips)
    if (strip.has_envelope()) add(strip.title(axis_length), strip.envelope, !strip.towards_tool);
  for (const StripSurface& strip : strips) add(strip.name + " axis", strip.axis, false);
  std::string title = "strips";
  for (const StripSurface& strip : strips)
    if (!strip.has_envelope()) title += ", without " + strip.name;
  return faces_to_step(title, objects);
}

}  // namespace flank::internal

#include "flank/strip/strip_record.h"

#include "flank/error.h"
#include "flank/motion/motion_record.h"

namespace flank::internal {

void code(StepCodec& codec, SweptContact& contact) {
  code(codec, contact.motion);
  for (double* value : {&contact.t, &contact.s, &contact.f}) codec.finite(*value);
  for (double& coordinate : contact.to_axis) codec.finite(coordinate);
}

void code(StepCodec& codec, CoverStrip& strip) {
  code(codec, strip.motion);
  code(codec, strip.cells);
  codec.finite(strip.area);
  code(codec, strip.depths);
  codec.number(strip.overcut_mm);
  code(codec, strip.deep);
}

void require_cells(const std::vector<CoverStrip>& strips, const CoverSamples& samples) {
  for (const CoverStrip& strip : strips)
    for (const int cell : strip.cells)
      if (cell < 0 || static_cast<std::size_t>(cell) >= samples.cells.size())
        throw InputError(
            "resume.json does not fit this run; start without --resume: a step belongs to other samples than "
            "those of this run");
}

}  // namespace flank::internal

#include "flank/cover/cover_record.h"

#include "flank/motion/motion_record.h"

namespace flank::internal {

void code(StepCodec& codec, std::pair<std::string, double>& lap) {
  codec.text(lap.first);
  codec.number(lap.second);
}

void code(StepCodec& codec, CoverResult& cover) {
  code_choice(codec, cover.status, 4);
  code(codec, cover.message);
  code(codec, cover.motions);
  for (double* value : {&cover.reachable, &cover.coverage_before, &cover.coverage, &cover.overlap, &cover.overcut_mm})
    codec.number(*value);
  for (int* value : {&cover.seeds, &cover.lines, &cover.grown}) code(codec, *value);
  code(codec, cover.notes);
  code(codec, cover.seconds);
}

void code(StepCodec& codec, CoverOptions& options) {
  for (int* value : {&options.seed_places, &options.seed_directions, &options.seed_spheres, &options.most_strips})
    code(codec, *value);
  for (double* value : {&options.tolerance_mm, &options.strip_price, &options.sample_share, &options.dense_share,
                        &options.enough_coverage, &options.most_turn_rad, &options.turn_window_mm})
    codec.number(*value);
  code(codec, options.smooth);
}

}  // namespace flank::internal

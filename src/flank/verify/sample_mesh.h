/// The judge's samples of a mesh (flank/judge.h: sample_mesh), tile by tile.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "flank/triangle_mesh.h"
#include "flank/verify/sampler.h"

namespace flank::internal::verify {

/// Whole triangles or rows of the parts of one, as many in a tile as hold about `most_samples` (at least one row). `id` is
/// the face's name in the samples. The mesh must outlive the sampler. Throws as sample_mesh.
[[nodiscard]] std::unique_ptr<Sampler> make_sampler(const std::string& id, const TriangleMesh& mesh, double spacing_mm,
                                                    bool target, std::size_t most_samples);

/// The same surface with its long and narrow triangles cut across: parts that are as small as the longest side of one asks lie far
/// closer across it than they need to. Such a triangle is cut into slices about as long as it is wide, but no shorter than `spacing_mm`, if parts
/// with sides of that length are then clearly fewer.
[[nodiscard]] TriangleMesh with_slivers_sliced(TriangleMesh mesh, double spacing_mm);

}  // namespace flank::internal::verify

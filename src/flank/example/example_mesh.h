/// Exact envelopes as triangle meshes, and what spoils them.
#pragma once

#include "flank/base/random.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// A mesh of count_t x count_s vertices exactly on the envelope (contact side +1), vertex (i, j) at i * count_s + j,
/// triangles counter-clockwise seen from the axis. Throws InternalError where the envelope does not exist.
[[nodiscard]] TriangleMesh envelope_mesh(const RuledMotion& motion, const RadialFunction& radial, int count_t,
                                         int count_s);

/// Every vertex moved by `length_mm` in a random direction, all directions alike.
[[nodiscard]] TriangleMesh with_noise(TriangleMesh mesh, double length_mm, Random& random);

/// The mesh of envelope_mesh without the triangles in two round holes of 0.16 and 0.12 of the size in t and 1.5 times
/// that in s; vertices that no triangle uses are dropped.
[[nodiscard]] TriangleMesh with_two_holes(const TriangleMesh& mesh, int count_t, int count_s);

}  // namespace flank::internal

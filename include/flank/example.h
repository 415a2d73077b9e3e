/// Parts that the project generates itself: what tests, benchmarks and `flank example` use. Deterministic.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/path.h"
#include "flank/ruled_motion.h"
#include "flank/tool.h"
#include "flank/triangle_mesh.h"

namespace flank {

/// The tool and the motions whose envelopes the faces (or the mesh) are, contact side +1 each.
struct ExampleTruth {
  Tool tool;
  std::vector<RuledMotion> motions;  ///< one a face, in the order of the faces
  Path path;                         ///< the motions sampled, strip k for face "F" + k
  double path_bound_mm = 0.0;        ///< between the motions and the joined poses
  /// Largest distance found between a face at (u, v) and the exact contact point of t = u, s = v L, on a grid 3 times
  /// denser than the interpolated one. Deformed, noisy: how far the part is from the envelope on purpose.
  double face_error_mm = 0.0;
};

struct Example {
  std::string name;
  std::string description;  ///< one line
  /// Open sheets, the machining side is the outward normal (reversed = false); or the faces of one solid.
  std::vector<Face> faces;
  std::string step;                  ///< of a solid: the text of its file; empty for sheets
  std::optional<TriangleMesh> mesh;  ///< instead of faces
  std::optional<ExampleTruth> truth;
  double diagonal_mm = 0.0;  ///< of the bounding box of faces or mesh, from dense points
};

/// A channel along x, open at the top (+z), and at both ends unless one has a wall.
struct CavityShape {
  double width_mm = 35.0;   ///< across (y), of the bounding box of both walls
  double depth_mm = 42.0;   ///< along a wall, from its bottom to its top
  double length_mm = 50.0;  ///< along the channel
  double twist_deg = 16.0;  ///< of both walls about x, from one end to the other
  double lean_deg = 4.0;    ///< of a wall, outwards towards the top: deep cavities have less, or their walls meet
  /// How deep a wall is hollow between its bottom and its top, mm. A cone leaves about half of it.
  double hollow_mm = 1.0;
  bool end_wall = false;    ///< a plane across its end at +x: then it is open at the other end alone
  bool start_wall = false;  ///< the same at -x
};

struct ExampleOptions {
  double relative_accuracy = 1e-9;  ///< of exact faces, share of the diagonal
  int mesh_vertices = 13000;        ///< about; of mesh examples
  double noise = 1e-4;              ///< length of the noise vectors of envelope-noisy, share of the diagonal
  double bump = 0.01;               ///< height of the bump of deformed-envelope, share of the diagonal
  std::uint64_t seed = 1;           ///< of the noise
  CavityShape cavity = {};          ///< of the example `cavity`
  int blades = 2;                   ///< of rotor37-blisk: 2 to 33, or 36, the whole wheel
};

/// Every name that make_example knows, in the order of the documentation.
[[nodiscard]] std::vector<std::string> example_names();

/// Throws UsageError for an unknown name (listing the known ones) and for options that make no sense.
[[nodiscard]] Example make_example(const std::string& name, const ExampleOptions& options = {});

/// Writes the part as `file`: faces as .step or .stp, a mesh as .stl or under another ending of meshes (millimetres). Where the truth
/// is known, FILE.truth.json (rails, error), FILE.tool.json and FILE.path.json are written beside it, FILE without its ending.
/// Returns the names of the files written, the part first. Throws UsageError for an ending that does not suit, InputError if
/// writing fails.
std::vector<std::string> write_example(const Example& example, const std::string& file);
/// What was written, for scripts: schema "openflank/example/1".
[[nodiscard]] std::string example_json(const Example& example, const std::vector<std::string>& files);

}  // namespace flank

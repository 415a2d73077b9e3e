#include "flank/example.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "flank/error.h"
#include "flank/example/example_blades.h"
#include "flank/example/example_cavity.h"
#include "flank/example/example_envelope.h"
#include "flank/example/example_mesh.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_rotor37.h"
#include "flank/example/example_tools.h"
#include "flank/example/example_write.h"
#include "flank/example/wheel/impeller.h"

namespace flank {
using namespace internal;
namespace {

/// Of the poses beside an exact part: a tenth of a micrometre's tenth, below what a judge of 1e-6 relative sees.
constexpr double kPathChordMm = 1e-5;
/// The tool and motion behind the meshes and the deformed face.
constexpr std::string_view kBaseTool = "barrel";
constexpr int kBaseMotion = 1;

/// One example by its name: it is made only when it is asked for, and a list of names costs nothing.
struct Recipe {
  std::string name, description;
  std::function<Example(const ExampleOptions&)> make;
};

/// mm, of the box of points on all faces: an error in shares of it needs no better.
double diagonal(const std::vector<Face>& faces) {
  constexpr int kCount = 41;
  Box3 box;
  for (const Face& face : faces) {
    const BSplineSurface& f = face.surface;
    for (int i = 0; i < kCount; ++i)
      for (int j = 0; j < kCount; ++j)
        box.add(f.value(std::lerp(f.u_first(), f.u_last(), i / (kCount - 1.0)),
                        std::lerp(f.v_first(), f.v_last(), j / (kCount - 1.0))));
  }
  return box.diagonal();
}

/// Tool and motions with the path that samples them, strip k for face F k: what a perfect planner would have found.
ExampleTruth truth_of(Tool tool, std::vector<RuledMotion> motions, double face_error_mm) {
  ExampleTruth truth{std::move(tool), std::move(motions), {}, 0.0, face_error_mm};
  for (std::size_t k = 0; k < truth.motions.size(); ++k) {
    const SampledMotion sampled = sample_motion(truth.motions[k], {.chord_tolerance_mm = kPathChordMm});
    truth.path_bound_mm = std::max(truth.path_bound_mm, sampled.chord_bound_mm);
    Strip& strip = truth.path.strips.emplace_back();
    strip.id = static_cast<int>(k) + 1;
    strip.face = "F" + std::to_string(k + 1);
    strip.poses = sampled.poses;
  }
  return truth;
}

/// Exact envelopes of one tool under several motions, one face each.
Example envelopes(std::string_view tool_name, std::vector<RuledMotion> motions, const ExampleOptions& options) {
  Example example;
  Tool tool = example_tool(tool_name);
  double error_mm = 0.0;
  for (const RuledMotion& motion : motions) {
    EnvelopeFace made = envelope_face(motion, tool.radial, options.relative_accuracy);
    made.face.id = "F" + std::to_string(example.faces.size() + 1);
    error_mm = std::max(error_mm, made.error_mm);
    example.faces.push_back(std::move(made.face));
  }
  example.diagonal_mm = diagonal(example.faces);
  example.truth = truth_of(std::move(tool), std::move(motions), error_mm);
  return example;
}

/// One face: the envelope of a named tool along a numbered motion.
Example single(std::string_view tool, int motion, const ExampleOptions& options) {
  const double length = example_tool(tool).radial.axis_length();
  return envelopes(tool, {example_motion(motion, length)}, options);
}

/// Two faces that look at each other, by the same tool: of such a cavity the exact answer of a two-sided fit is
/// known.
Example cavity(std::string_view tool, const ExampleOptions& options) {
  const double length = example_tool(tool).radial.axis_length();
  return envelopes(tool, {example_motion(1, length), facing_motion(length)}, options);
}

/// A face given by a formula: no tool fits it exactly, so there is no truth.
Example blade(Face face) {
  Example example;
  example.faces.push_back(std::move(face));
  example.diagonal_mm = diagonal(example.faces);
  return example;
}

/// Two walls by a formula, of any size.
Example channel(const CavityShape& shape) {
  Example example;
  example.faces = cavity_walls(shape);
  example.diagonal_mm = diagonal(example.faces);
  return example;
}

/// Several faces with the text of their file: what is a solid must be written as one, which faces alone cannot say.
Example solid(SolidModel model) {
  Example example;
  example.faces = std::move(model.faces);
  example.step = std::move(model.step);
  example.diagonal_mm = diagonal(example.faces);
  return example;
}

/// An exact envelope with a smooth bump towards the axis over the middle.
Example deformed(const ExampleOptions& options) {
  Example example = single(kBaseTool, kBaseMotion, options);
  const double height_mm = options.bump * example.diagonal_mm;
  example.faces[0].surface = with_bump(example.faces[0].surface, height_mm);
  // The true motion leaves the undeformed face: it is off by the bump.
  example.truth->face_error_mm = height_mm;
  return example;
}

struct MeshSize {
  int count_t, count_s;
};

/// Twice as many vertices along the travel as along the axis: about square cells.
MeshSize mesh_size(int vertices) {
  const int count_s = std::max(4, static_cast<int>(std::lround(std::sqrt(0.5 * vertices))));
  return {2 * count_s, count_s};
}

enum class MeshFault { kNone, kNoise, kHoles };

/// The exact envelope as triangles, sound or spoiled in one way.
Example mesh(MeshFault fault, const ExampleOptions& options) {
  Tool tool = example_tool(kBaseTool);
  const RuledMotion motion = example_motion(kBaseMotion, tool.radial.axis_length());
  const MeshSize size = mesh_size(options.mesh_vertices);
  Example example;
  example.mesh = envelope_mesh(motion, tool.radial, size.count_t, size.count_s);
  example.diagonal_mm = example.mesh->box().diagonal();
  double error_mm = 0.0;
  if (fault == MeshFault::kNoise) {
    Random random(options.seed);
    // The length of the noise vectors: what a fit of the truth would find as its error, at most.
    error_mm = options.noise * example.diagonal_mm;
    example.mesh = with_noise(std::move(*example.mesh), error_mm, random);
  }
  if (fault == MeshFault::kHoles) example.mesh = with_two_holes(*example.mesh, size.count_t, size.count_s);
  example.truth = truth_of(std::move(tool), {motion}, error_mm);
  return example;
}

std::vector<Recipe> envelope_recipes() {
  std::vector<Recipe> recipes;
  for (const std::string_view tool : kExampleTools) {
    for (int k = 1; k <= kExampleMotions; ++k)
      recipes.push_back(
          {"envelope-" + std::string(tool) + "-" + std::to_string(k),
           "surface that can be milled exactly by a " + std::string(tool) + " tool, motion " + std::to_string(k),
           [tool, k](const ExampleOptions& options) { return single(tool, k, options); }});
  }
  for (const std::string_view tool : kExampleTools)
    recipes.push_back({"cavity-" + std::string(tool),
                       "two facing walls that can be milled exactly by one " + std::string(tool) + " tool",
                       [tool](const ExampleOptions& options) { return cavity(tool, options); }});
  return recipes;
}

std::vector<Recipe> all_recipes() {
  using Options = const ExampleOptions&;
  std::vector<Recipe> recipes = envelope_recipes();
  const Recipe others[] = {
      {"ruled-blade", "ruled impeller blade, 50 degrees of twist along its rulings",
       [](Options) { return blade(ruled_blade()); }},
      {"twisted-blade", "free-form compressor blade side, 30 degrees of twist",
       [](Options) { return blade(twisted_blade()); }},
      {"elliptic-side", "slightly elliptic side, almost a cone", [](Options) { return blade(elliptic_side()); }},
      {"rotor37", "blade of NASA Rotor 37, a solid: sides F1 and F3", [](Options) { return solid(rotor37_blade()); }},
      {"rotor37-blisk", "two blades of NASA Rotor 37 on a piece of the hub, a solid: cavity between F9 and F11",
       [](Options options) { return solid(rotor37_blisk(options.blades)); }},
      {"impeller",
       "two main blades and two splitters of an impeller on a sector of the hub, a solid: sides F9, F7, F13, F11, F17, "
       "F15, F21, F19",
       [](Options) { return solid(impeller()); }},
      {"cavity", "two facing free-form walls of a twisted channel, of any size: F1 and F2",
       [](Options options) { return channel(options.cavity); }},
      {"deformed-envelope", "surface that can be milled exactly by a barrel tool, with a smooth bump", deformed},
      {"envelope-mesh", "surface that can be milled exactly by a barrel tool, as a mesh",
       [](Options options) { return mesh(MeshFault::kNone, options); }},
      {"envelope-noisy", "the same mesh with noise", [](Options options) { return mesh(MeshFault::kNoise, options); }},
      {"envelope-holes", "the same mesh with two holes",
       [](Options options) { return mesh(MeshFault::kHoles, options); }}};
  recipes.insert(recipes.end(), std::begin(others), std::end(others));
  return recipes;
}

/// Below 1e-11 rounding shows; beyond the other limits the part is no example of its kind any more.
void check(const ExampleOptions& options) {
  if (!(options.relative_accuracy >= 1e-11 && options.relative_accuracy <= 1e-2))
    throw UsageError("the accuracy of an example must lie between 1e-11 and 1e-2 of its diagonal");
  if (options.mesh_vertices < 100 || options.mesh_vertices > 4000000)
    throw UsageError("an example mesh has 100 to 4000000 vertices, got " + std::to_string(options.mesh_vertices));
  if (!(options.noise >= 0.0 && options.noise <= 0.01) || !(std::abs(options.bump) <= 0.1))
    throw UsageError("the noise of an example must lie in [0, 0.01] and its bump in [-0.1, 0.1] of the diagonal");
  if (options.blades != kRotor37Blades && (options.blades < 2 || options.blades > kRotor37MostOfPiece))
    throw UsageError("the blisk of an example has 2 to " + std::to_string(kRotor37MostOfPiece) + " blades or all " +
                     std::to_string(kRotor37Blades) + ", got " + std::to_string(options.blades));
}

}  // namespace

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const Recipe& recipe : all_recipes()) names.push_back(recipe.name);
  return names;
}

Example make_example(const std::string& name, const ExampleOptions& options) {
  check(options);
  for (const Recipe& recipe : all_recipes()) {
    if (recipe.name != name) continue;
    Example example = recipe.make(options);
    example.name = name;
    example.description = recipe.description;
    return example;
  }
  std::string known;
  for (const std::string& other : example_names()) known += (known.empty() ? "" : ", ") + other;
  throw UsageError("no example is called \"" + name + "\"; known are " + known);
}

std::vector<std::string> write_example(const Example& example, const std::string& file) {
  return write_example_files(example, file);
}

std::string example_json(const Example& example, const std::vector<std::string>& files) {
  return example_files_json(example, files);
}

}  // namespace flank

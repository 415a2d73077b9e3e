// fit_a_tool PART FACE: optimises a free tool and one motion for a face, writes tool.json and path.json.
#include <flank/flank.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: fit_a_tool PART FACE\n";
    return EXIT_FAILURE;
  }
  const flank::Part part = flank::read_part(argv[1]);
  const int face = flank::parse_face_list(part, argv[2]).front();
  // Machined from the outside of the solid; a mesh has triangles in place of surfaces.
  const auto target =
      part.is_mesh() ? flank::make_target(flank::extract_mesh(part, {face})) : flank::make_target({part.faces[face]});

  flank::FlankFitOptions options;
  options.tolerance_mm = 0.05;
  options.bounds.smallest = 2.0;  // radii of the tool in mm: the face alone does not determine them
  options.bounds.largest = 8.0;
  const flank::ToolModel free_tool;  // any radial function within the bounds
  const flank::FlankFitResult fit = flank::fit_automatic(*target, free_tool, options, flank::Progress());
  std::cout << fit.message << '\n';
  if (fit.status == flank::FitStatus::kNoStart) return EXIT_FAILURE;

  flank::Tool tool;
  tool.radial = fit.tool;
  flank::write_tool(tool, "tool.json");

  flank::SamplingOptions sampling;
  sampling.chord_tolerance_mm = 0.02 * options.tolerance_mm;  // error of joining the poses by straight moves
  flank::Path path;
  flank::Strip& strip = path.strips.emplace_back();
  strip.face = argv[2];
  strip.poses = flank::sample_motion(fit.motions.front(), sampling).poses;
  flank::write_path(path, "path.json");
  return EXIT_SUCCESS;
} catch (const flank::Error& error) {  // the message names the file, line or face
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

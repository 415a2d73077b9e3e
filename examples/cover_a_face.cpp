// cover_a_face PART FACE: finds the strips with which a cylinder of radius 5 mm finishes a face, writes path.json.
#include <flank/flank.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: cover_a_face PART FACE\n";
    return EXIT_FAILURE;
  }
  const flank::Part part = flank::read_part(argv[1]);
  const int face = flank::parse_face_list(part, argv[2]).front();
  // Machined from the outside of the solid; a mesh has triangles in place of surfaces.
  const auto target =
      part.is_mesh() ? flank::make_target(flank::extract_mesh(part, {face})) : flank::make_target({part.faces[face]});

  flank::Tool tool;
  const double axis_length_mm = 20.0, radius_mm = 5.0;
  tool.radial =
      flank::RadialFunction(flank::ToolFamily::kCylinder, axis_length_mm, Eigen::VectorXd::Constant(1, radius_mm));

  flank::CoverOptions options;
  options.tolerance_mm = 0.05;
  // {}: no obstacles. The other faces of the part are ignored here.
  const flank::CoverResult cover = flank::cover(*target, tool, {}, options, flank::Progress());
  std::cout << cover.motions.size() << " strips cover " << 100.0 * cover.coverage << " %. " << cover.message << '\n';

  flank::Path path;
  for (const flank::RuledMotion& motion : cover.motions) {
    flank::Strip& strip = path.strips.emplace_back();
    strip.id = static_cast<int>(path.strips.size());
    strip.face = argv[2];
    strip.poses = flank::sample_motion(motion, {}).poses;
  }
  flank::write_tool(tool, "tool.json");
  flank::write_path(path, "path.json");
  return cover.status == flank::CoverStatus::kCovered ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const flank::Error& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

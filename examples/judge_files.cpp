// judge_files PART FACE TOOL PATH: reads a tool and a path, judges what they leave on a face and on all other faces.
#include <flank/flank.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::cerr << "usage: judge_files PART FACE TOOL PATH\n";
    return EXIT_FAILURE;
  }
  const flank::Part part = flank::read_part(argv[1]);
  const int target = flank::parse_face_list(part, argv[2]).front();
  const flank::Tool tool = flank::read_tool(argv[3]);
  const flank::Path path = flank::read_path(argv[4]);

  std::vector<flank::FaceSamples> samples;
  std::vector<flank::FaceShape> shapes;  // what is proved, is proved of these
  std::vector<flank::TriangleMesh> meshes(part.is_mesh() ? part.face_count() : 0);
  const double spacing_mm = 0.25;
  for (int k = 0; k < part.face_count(); ++k) {  // all faces but the target must not be entered
    if (part.is_mesh()) {
      meshes[k] = flank::extract_mesh(part, {k});
      samples.push_back(flank::sample_mesh("F" + std::to_string(k + 1), meshes[k], spacing_mm, k == target));
      shapes.emplace_back(&meshes[k]);
    } else {
      samples.push_back(flank::sample_face(part.faces[k], spacing_mm, k == target));
      shapes.emplace_back(&part.faces[k]);
    }
  }

  flank::JudgeOptions options;
  options.tolerance_mm = 0.05;
  const flank::VerifyReport report = flank::judge(tool, path, samples, shapes, options);
  std::cout << "coverage " << 100.0 * report.coverage << " % (" << 100.0 * report.coverage_bound.value_or(0.0)
            << " % proved), overcut " << report.overcut_mm << " mm (surely at most " << report.overcut_bound_mm
            << " mm), deepest in another face " << report.gouge_mm << " mm\n";
  return report.verdict == flank::Verdict::kPass ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const flank::Error& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

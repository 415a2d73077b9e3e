// fit_a_tool PART FACE: a free tool and its motion for a face, judged; writes tool.json and path.json.
#include <flank/flank.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: fit_a_tool PART FACE\n";
    return EXIT_FAILURE;
  }
  flank::FitJob job;
  job.part.file = argv[1];
  job.part.faces = argv[2];
  job.tolerance_mm = 0.05;
  const flank::Result result = flank::run_fit(job);
  for (const flank::Shortfall& reason : result.acceptance().reasons) std::cout << reason.text << '\n';
  std::cout << result.path.strips.size() << " strips, finished " << 100.0 * result.verify.coverage
            << " % of the face\n";
  flank::write_tool(result.tool, "tool.json");
  flank::write_path(result.path, "path.json");
  return EXIT_SUCCESS;
} catch (const flank::Error& error) {  // the message names the file, line or face
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

// The whole of `flank fit`: a job in, a folder of results out.
#include <flank/flank.h>

#include <iostream>

int main() {
  flank::FitJob job;
  job.part.file = "blade.step";
  job.part.faces = "F1";
  job.tolerance_mm = 0.1;
  const flank::Result result = flank::run_fit(job);
  flank::write_result(result, "out");
  std::cout << flank::summary_text(result);
  return result.acceptance().pass() ? 0 : 1;  // as the command: 1 if the request is not met
}

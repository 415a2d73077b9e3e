#include "flank/bound/bound_setup.h"

#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/job/bound_fields.h"
#include "flank/job/input_files.h"
#include "flank/setup/read_setup.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Target> other_faces(const Setup& setup) {
  if (setup.checks.empty()) return nullptr;
  if (setup.part.is_mesh()) return make_target(extract_mesh(setup.part, setup.checks));
  std::vector<Face> faces;
  for (const int f : setup.checks) faces.push_back(setup.part.faces[static_cast<std::size_t>(f)]);
  return make_target(std::move(faces));
}

}  // namespace

BoundSetup read_bound_setup(const BoundJob& job, std::vector<std::string>& notes) {
  ObstacleRequest obstacles;
  obstacles.check_faces = job.check_faces;
  obstacles.ignore_faces = job.ignore_faces;
  BoundSetup bound;
  bound.setup = read_setup(job.part, obstacles, job.tolerance_mm, notes);
  bound.groups = make_targets(bound.setup);
  bound.others = other_faces(bound.setup);
  return bound;
}

void write_bound_files(const BoundJob& job, const std::string& folder, const std::string& json,
                       const std::string& text) {
  const ReadFiles inputs = read_files(job);
  const Unwritten unwritten(inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) throw InputError(folder + ": is not a folder and cannot be created");
  write_file((fs::path(folder) / "bound.json").string(), json);
  write_file((fs::path(folder) / "bound.txt").string(), text);
}

}  // namespace flank::internal

#include "flank/setup/setup.h"

#include "flank/setup/check_faces.h"
#include "flank/setup/make_obstacles.h"

namespace flank::internal {

Setup read_setup(const PartRequest& part, const ObstacleRequest& obstacles, double tolerance_mm,
                 std::vector<std::string>& notes) {
  Setup setup;
  setup.part = read_part(part.file, part.unit);
  setup.targets = parse_face_list(setup.part, part.faces);
  setup.checks = faces_to_check(setup.part, setup.targets, obstacles);
  setup.tolerance_mm = tolerance_mm;
  setup.fixtures = read_fixtures(obstacles.fixtures, part.unit);
  notes.insert(notes.end(), setup.part.repairs.begin(), setup.part.repairs.end());
  if (const std::string note = unchecked_note(setup.part, setup.targets, setup.checks); !note.empty())
    notes.push_back(note);
  return setup;
}

}  // namespace flank::internal

#include "flank/setup/read_setup.h"

#include <fmt/format.h>

#include <utility>

#include "flank/error.h"
#include "flank/io/face_groups.h"
#include "flank/setup/check_faces.h"
#include "flank/setup/default_tolerance.h"
#include "flank/setup/machined_side.h"
#include "flank/setup/make_obstacles.h"
#include "flank/setup/skin.h"
#include "flank/setup/targets.h"
#include "flank/setup/wrapped_note.h"

namespace flank::internal {
namespace {

/// A wrong face is a wrong request here, not a wrong part.
void split_checks(Part& part, const std::string& field, const std::optional<std::string>& list) {
  if (!list) return;
  try {
    split_faces(part, *list);
  } catch (const InputError& e) {
    throw UsageError(field, *list, e.what());
  }
}

std::vector<int> targets_of(const Part& part, const PartRequest& request) {
  if (!request.skin) return parse_face_list(part, request.faces);
  if (request.faces != PartRequest().faces) throw UsageError("skin", *request.skin, "cannot be combined with `faces`");
  return smooth_skin(part, parse_face_list(part, *request.skin));
}

/// The tolerance where none is asked for, which is said.
double followed_size(const Setup& setup, std::vector<std::string>& notes) {
  Box3 box;
  for (const TargetGroup& group : make_targets(setup)) box.add(group.target->box());
  const double tolerance = default_tolerance(box.diagonal());
  notes.push_back(
      fmt::format("no tolerance given: {} mm is used, a thousandth of the size of the faces ({:.4g} mm) rounded down",
                  tolerance, box.diagonal()));
  return tolerance;
}

}  // namespace

Setup read_setup(const PartRequest& part, const ObstacleRequest& obstacles, std::optional<double> tolerance_mm,
                 std::vector<std::string>& notes) {
  Setup setup;
  setup.part = read_part(part.file, part.unit);
  setup.allowance_mm = part.allowance_mm.value_or(0.0);
  split_faces(setup.part, part.skin.value_or(part.faces));
  if (!part.skin) split_two_sided(setup.part, part.faces);
  split_checks(setup.part, "check_faces", obstacles.check_faces);
  split_checks(setup.part, "ignore_faces", obstacles.ignore_faces);
  setup.targets = targets_of(setup.part, part);
  setup.checks = faces_to_check(setup.part, setup.targets, obstacles);
  setup.unread = faces_unread(setup.part, setup.targets, obstacles);
  setup.sides = turn_to_machined_side(part, setup.targets, setup.part);
  setup.fixtures = read_fixtures(obstacles.fixtures, obstacles.fixture_unit ? obstacles.fixture_unit : part.unit);
  notes.insert(notes.end(), setup.part.repairs.begin(), setup.part.repairs.end());
  setup.tolerance_mm = tolerance_mm ? *tolerance_mm : followed_size(setup, notes);
  for (std::string note :
       {wrapped_note(setup.part, setup.targets), unchecked_note(setup.part, setup.targets, setup.checks, setup.unread),
        other_solids_note(setup.part, setup.targets, setup.checks)})
    if (!note.empty()) notes.push_back(std::move(note));
  return setup;
}

}  // namespace flank::internal

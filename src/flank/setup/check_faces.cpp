#include "flank/setup/check_faces.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/error.h"

namespace flank::internal {
namespace {

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// The faces of an option's list. A wrong face is a wrong option here, not a wrong part.
std::vector<int> named_faces(const Part& part, const std::vector<int>& targets, const std::string& option,
                             const std::string& list) {
  std::vector<int> faces;
  try {
    faces = parse_face_list(part, list);
  } catch (const InputError& e) {
    throw UsageError(fmt::format("{} {}: {}", option, list, e.what()));
  }
  for (int face : faces)
    if (holds(targets, face))
      throw UsageError(fmt::format("{} {}: F{} is a target; other faces of F1 to F{} are accepted", option, list,
                                   face + 1, part.face_count()));
  return faces;
}

}  // namespace

std::vector<int> faces_to_check(const Part& part, const std::vector<int>& targets, const CheckFaceChoice& choice) {
  std::vector<int> only, ignored, checks;
  if (choice.only) only = named_faces(part, targets, "--check-faces", *choice.only);
  if (choice.ignored) ignored = named_faces(part, targets, "--ignore-faces", *choice.ignored);
  for (int face : only)
    if (holds(ignored, face))
      throw UsageError(
          fmt::format("--check-faces and --ignore-faces both name F{}; one of them is accepted", face + 1));
  for (int face = 0; face < part.face_count(); ++face)
    if (!holds(targets, face) && !holds(ignored, face) && (!choice.only || holds(only, face))) checks.push_back(face);
  return checks;
}

std::string unchecked_note(const Part& part, const std::vector<int>& targets, const std::vector<int>& checks) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (int face = 0; face < part.face_count(); ++face)
    if (!holds(targets, face) && !holds(checks, face)) names.push_back("F" + std::to_string(face + 1));
  if (names.empty()) return {};
  const std::size_t count = names.size();
  names.resize(std::min(count, kNamed));
  return fmt::format("not checked, as asked: {}{}", fmt::join(names, ", "),
                     count > kNamed ? fmt::format(" and {} more faces", count - kNamed) : "");
}

}  // namespace flank::internal

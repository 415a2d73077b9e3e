#include "flank/setup/check_faces.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/error.h"
#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// The faces of a field's list. A wrong face is a wrong request here, not a wrong part.
std::vector<int> named_faces(const Part& part, const std::vector<int>& targets, const std::string& field,
                             const std::string& list) {
  std::vector<int> faces;
  try {
    faces = parse_face_list(part, list);
    // Of a range, or of a face in pieces, the rest is meant.
    for (const std::string& item : face_list_items(list)) {
      const std::vector<int> members = parse_face_item(part, item);
      if (std::all_of(members.begin(), members.end(), [&](int face) { return holds(targets, face); }))
        throw UsageError(field, list,
                         fmt::format("{} is a target; other faces of F1 to F{} are accepted", item,
                                     parse_face_name(part.face_id(part.face_count() - 1)).number));
    }
  } catch (const InputError& e) {
    throw UsageError(field, list, e.what());
  }
  std::erase_if(faces, [&](int face) { return holds(targets, face); });
  return faces;
}

}  // namespace

std::vector<int> faces_to_check(const Part& part, const std::vector<int>& targets, const ObstacleRequest& request) {
  std::vector<int> only, ignored, checks;
  if (request.check_faces) only = named_faces(part, targets, "check_faces", *request.check_faces);
  if (request.ignore_faces) ignored = named_faces(part, targets, "ignore_faces", *request.ignore_faces);
  for (int face : only)
    if (holds(ignored, face))
      throw UsageError("check_faces",
                       fmt::format("`ignore_faces` names {}, too; it may be in one of them", part.face_id(face)));
  for (int face = 0; face < part.face_count(); ++face)
    if (!part.is_left_out(face) && !holds(targets, face) && !holds(ignored, face) &&
        (!request.check_faces || holds(only, face)))
      checks.push_back(face);
  return checks;
}

std::string unchecked_note(const Part& part, const std::vector<int>& targets, const std::vector<int>& checks) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (int face = 0; face < part.face_count(); ++face)
    if (!part.is_left_out(face) && !holds(targets, face) && !holds(checks, face)) names.push_back(part.face_id(face));
  if (names.empty()) return {};
  const std::size_t count = names.size();
  names.resize(std::min(count, kNamed));
  return fmt::format("not checked, as asked: {}{}", fmt::join(names, ", "),
                     count > kNamed ? fmt::format(" and {} more faces", count - kNamed) : "");
}

}  // namespace flank::internal

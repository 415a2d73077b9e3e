#include "flank/setup/check_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "flank/error.h"
#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// The faces of a field's list. A wrong face is a wrong request here, not a wrong part.
std::vector<int> named_faces(const Part& part, const std::vector<int>& targets, const std::string& field,
                             const std::string& list, Unread unread) {
  std::vector<int> faces;
  try {
    faces = parse_faces(part, list, unread);
    // Of a range, or of a face in pieces, the rest is meant.
    for (const std::string& item : face_list_items(list)) {
      const std::vector<int> members = parse_face_item(part, item, unread);
      if (!members.empty() &&
          std::all_of(members.begin(), members.end(), [&](int face) { return holds(targets, face); }))
        throw UsageError(field, list,
                         fmt::format("{} is machined already; name other faces, from F1 to F{}", item,
                                     parse_face_name(part.face_id(part.face_count() - 1)).number));
    }
  } catch (const InputError& e) {
    throw UsageError(field, list, e.what());
  }
  std::erase_if(faces, [&](int face) { return holds(targets, face); });
  return faces;
}

/// "S1", "S3-S5", ... of 0-based solids, ascending.
std::vector<std::string> names_of_solids(const std::set<int>& solids) {
  std::vector<std::string> names;
  for (auto at = solids.begin(); at != solids.end();) {
    const int first = *at;
    int last = first;
    for (++at; at != solids.end() && *at == last + 1; ++at) last = *at;
    names.push_back(first == last ? fmt::format("S{}", first + 1) : fmt::format("S{}-S{}", first + 1, last + 1));
  }
  return names;
}

}  // namespace

std::vector<int> faces_to_check(const Part& part, const std::vector<int>& targets, const ObstacleRequest& request) {
  std::vector<int> only, ignored, checks;
  if (request.check_faces) only = named_faces(part, targets, "check_faces", *request.check_faces, Unread::kRefused);
  if (request.ignore_faces) ignored = named_faces(part, targets, "ignore_faces", *request.ignore_faces, Unread::kTaken);
  for (int face : only)
    if (holds(ignored, face))
      throw UsageError("check_faces",
                       fmt::format("`ignore_faces` names {}, too; name it in one of them", part.face_id(face)));
  for (int face = 0; face < part.face_count(); ++face)
    if (!part.is_left_out(face) && !holds(targets, face) && !holds(ignored, face) &&
        (!request.check_faces || holds(only, face)))
      checks.push_back(face);
  return checks;
}

std::vector<int> faces_unread(const Part& part, const std::vector<int>& targets, const ObstacleRequest& request) {
  std::vector<int> ignored, unread;
  if (request.ignore_faces) ignored = named_faces(part, targets, "ignore_faces", *request.ignore_faces, Unread::kTaken);
  for (const auto& [face, why] : part.left_out)
    if (!holds(ignored, face)) unread.push_back(face);
  return unread;
}

std::string unchecked_note(const Part& part, const std::vector<int>& targets, const std::vector<int>& checks,
                           const std::vector<int>& unread) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (int face = 0; face < part.face_count(); ++face)
    if (!holds(targets, face) && !holds(checks, face) && !holds(unread, face)) names.push_back(part.face_id(face));
  if (names.empty()) return {};
  const std::size_t count = names.size();
  names.resize(std::min(count, kNamed));
  return fmt::format("not checked, by --ignore-faces: {}{}", fmt::join(names, ", "),
                     count > kNamed ? fmt::format(" and {} more faces", count - kNamed) : "");
}

std::string other_solids_note(const Part& part, const std::vector<int>& targets, const std::vector<int>& checks) {
  if (part.is_mesh()) return {};
  std::set<int> own, others;
  for (const int face : targets)
    if (const Face& target = part.faces[static_cast<std::size_t>(face)]; target.of_solid) own.insert(target.solid);
  if (own.empty()) return {};
  for (const int face : checks)
    if (const Face& check = part.faces[static_cast<std::size_t>(face)]; check.of_solid && own.count(check.solid) == 0)
      others.insert(check.solid);
  if (others.empty()) return {};
  return fmt::format(
      "the tool also keeps clear of {} other solid{}; if the part is machined without {}: --ignore-faces {}",
      others.size(), others.size() == 1 ? "" : "s", others.size() == 1 ? "it" : "them",
      fmt::join(names_of_solids(others), ","));
}

}  // namespace flank::internal

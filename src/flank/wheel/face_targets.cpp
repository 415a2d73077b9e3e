#include "flank/wheel/face_targets.h"

#include <utility>

#include "flank/io/face_groups.h"
#include "flank/io/face_names.h"

namespace flank::internal {

std::optional<Face> FaceTargets::face(const std::string& name) const {
  if (part_.is_mesh()) return {};
  const FaceName asked = parse_face_name(name);
  if (!asked.piece.empty())
    for (const NamedPiece& piece : pieces_of_face(part_, asked.number - 1))
      if (piece.face.id == name) return piece.face;
  return part_.faces[static_cast<std::size_t>(parse_face_list(part_, name).front())];
}

std::vector<const Target*> FaceTargets::of(const std::vector<std::string>& faces) {
  std::vector<const Target*> out;
  for (const std::string& name : faces) {
    std::unique_ptr<Target>& target = known_[name];
    if (!target) {
      std::optional<Face> own = face(name);
      target =
          own ? make_target({std::move(*own)}, +1) : make_target(extract_mesh(part_, parse_face_list(part_, name)));
    }
    out.push_back(target.get());
  }
  return out;
}

}  // namespace flank::internal

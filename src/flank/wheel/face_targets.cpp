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

std::unique_ptr<Target> FaceTargets::make(const std::string& name, const Eigen::Isometry3d& turn) const {
  if (std::optional<Face> own = face(name)) {
    for (Vec3& pole : own->surface.poles) pole = turn * pole;
    return make_target({std::move(*own)}, +1);
  }
  TriangleMesh mesh = extract_mesh(part_, parse_face_list(part_, name));
  for (Vec3& vertex : mesh.vertices) vertex = turn * vertex;
  return make_target(std::move(mesh));
}

std::vector<const Target*> FaceTargets::of(const std::vector<std::string>& faces) {
  return turned(faces, WheelAxis(), 0.0, 0);
}

std::vector<const Target*> FaceTargets::turned(const std::vector<std::string>& faces, const WheelAxis& axis,
                                               double pitch_rad, int turns) {
  const Eigen::Isometry3d turn = turns != 0 ? axis.turn(turns * pitch_rad) : Eigen::Isometry3d::Identity();
  std::vector<const Target*> out;
  for (const std::string& name : faces) {
    std::unique_ptr<Target>& target = known_[{name, turns}];
    if (!target) target = make(name, turn);
    out.push_back(target.get());
  }
  return out;
}

}  // namespace flank::internal

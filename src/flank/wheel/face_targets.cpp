#include "flank/wheel/face_targets.h"

#include "flank/wheel/sector.h"

namespace flank::internal {

std::vector<const Target*> FaceTargets::of(const std::vector<std::string>& faces) {
  std::vector<const Target*> out;
  for (const std::string& name : faces) {
    std::unique_ptr<Target>& target = known_[name];
    if (!target) {
      Part part = part_;
      if (!part.is_mesh()) split_faces(part, name);
      const int face = parse_face_list(part, name).front();
      target = part.is_mesh() ? make_target(extract_mesh(part, {face}))
                              : make_target({part.faces[static_cast<std::size_t>(face)]}, +1);
    }
    out.push_back(target.get());
  }
  return out;
}

}  // namespace flank::internal

#include "flank/setup/skin.h"

#include <algorithm>
#include <set>
#include <utility>

#include "flank/geom/pieces/face_section.h"
#include "flank/setup/joints.h"

namespace flank::internal {
namespace {

/// A skin that grows.
struct Skin {
  std::set<int> faces;
  double area = 0.0;
  Box3 box;

  void add(int face, const Target& target) {
    if (!faces.insert(face).second) return;
    area += target.area();
    box.add(target.box().low);
    box.add(target.box().high);
  }
  /// Its mean width across its longest extent, mm.
  [[nodiscard]] double width() const { return area / std::max(box.diagonal(), 1e-9); }
};

}  // namespace

std::vector<int> smooth_skin(const Part& part, const std::vector<int>& faces) {
  if (part.is_mesh()) {
    const std::set<int> all(faces.begin(), faces.end());
    return {all.begin(), all.end()};
  }
  Joints joints(part);
  Skin skin;
  // What is joined to the skin, by how strongly it bends: the calm ones first, so that the skin is as wide as it can be
  // when the edges are looked at.
  std::set<std::pair<double, int>> open;
  std::set<int> known(faces.begin(), faces.end());
  const auto look_around = [&](int face) {
    for (const int other : joints.joined_to(face, known)) {
      known.insert(other);
      open.insert({joints.bend(other), other});
    }
  };
  for (const int face : faces) skin.add(face, joints.target(face));
  for (const int face : faces) look_around(face);
  while (!open.empty()) {
    const auto [bend, face] = *open.begin();
    open.erase(open.begin());
    if (bend * skin.width() > kEdgeBend) break;
    skin.add(face, joints.target(face));
    look_around(face);
  }
  return {skin.faces.begin(), skin.faces.end()};
}

}  // namespace flank::internal

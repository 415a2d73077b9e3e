/// A path with awkward numbers for the round trips of path files.
#pragma once

#include "flank/base/random.h"
#include "flank/path.h"

namespace flank::internal {

inline Path awkward_path() {
  Random random(3);
  Path path;
  for (const auto& [id, kind, face] :
       {std::tuple(1, "flank", "F1,F3"), std::tuple(7, "link", "F1"), std::tuple(3, "side", "F2")}) {
    Strip strip{id, kind, face, {}};
    for (int i = 0; i < 20; ++i) {
      const Vec3 tip(random.uniform(-100, 100), 1e-7 * random.normal(), i == 0 ? 0.0 : 1e5 * random.normal());
      strip.poses.push_back({tip, Vec3(random.normal(), random.normal(), random.normal()).normalized()});
    }
    path.strips.push_back(strip);
  }
  path.strips[0].poses[3] = {Vec3(-0.0, 1.0 / 3.0, 2.0), Vec3(0, 0, 1)};
  path.strips[0].poses[4] = {Vec3(1e-29, -3.3e-30, 1e22), Vec3(0, -1, 0)};
  return path;
}

inline bool same(const Path& a, const Path& b) {
  if (a.strips.size() != b.strips.size()) return false;
  for (std::size_t k = 0; k < a.strips.size(); ++k) {
    const Strip &p = a.strips[k], &q = b.strips[k];
    if (p.id != q.id || p.kind != q.kind || p.face != q.face || p.poses.size() != q.poses.size()) return false;
    for (std::size_t i = 0; i < p.poses.size(); ++i)
      if (p.poses[i].tip != q.poses[i].tip || p.poses[i].axis != q.poses[i].axis) return false;
  }
  return true;
}

}  // namespace flank::internal

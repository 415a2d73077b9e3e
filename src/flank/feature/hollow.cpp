#include "flank/feature/hollow.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kOneWay = 0.3;    ///< mean of the normals of faces that do not close round anything
constexpr double kSmooth = 0.87;   ///< cosine of 30 degrees: faces that meet more sharply do not go on into each other
constexpr int kTouching = 3;       ///< points of a border on another face
constexpr std::size_t kEach = 23;  ///< of the samples, at which balls are fitted in
constexpr int kHalvings = 14;      ///< of the search for a ball that fits in

/// By the normals on both sides of their joint: of triangles that are longer than a face is wide, nothing else tells.
bool go_on(const WheelFace& a, const WheelFace& b, double near_mm) {
  int points = 0;
  double same = 0.0;
  for (const Vec3& p : a.border) {
    if (b.box.squared_distance(p) > near_mm * near_mm) continue;
    const NearFace there = nearest({&b}, p);
    if (std::abs(there.height) > near_mm) continue;
    ++points, same += there.normal.dot(nearest({&a}, p).normal);
  }
  return points >= kTouching && same > kSmooth * points;
}

/// The faces that go on smoothly into the first one, itself among them; they are taken out of `left`.
std::vector<const WheelFace*> take_skin(std::vector<const WheelFace*>& left, double near_mm) {
  std::vector<const WheelFace*> skin{left.front()};
  left.erase(left.begin());
  for (std::size_t k = 0; k < skin.size(); ++k)
    for (auto at = left.begin(); at != left.end();) {
      if (!go_on(*skin[k], **at, near_mm) && !go_on(**at, *skin[k], near_mm)) {
        ++at;
        continue;
      }
      skin.push_back(*at);
      at = left.erase(at);
    }
  return skin;
}

}  // namespace

double girth(const std::vector<const WheelFace*>& faces, Girth where, double near_mm) {
  std::vector<double> found;
  Box3 box;
  for (const WheelFace* face : faces) box.add(face->box);
  const double way = where == Girth::kOfMaterial ? -1.0 : 1.0;
  for (const WheelFace* face : faces)
    for (std::size_t k = 0; k < face->samples.size(); k += kEach) {
      const FaceSample& s = face->samples[k];
      double fits = 0.0, enters = 0.5 * box.diagonal();
      for (int n = 0; n < kHalvings; ++n) {
        const double radius = 0.5 * (fits + enters);
        const double near = std::abs(nearest(faces, s.point + way * radius * s.normal).height);
        (near < radius - near_mm ? enters : fits) = radius;
      }
      found.push_back(2.0 * fits);
    }
  if (found.empty()) return 0.0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

Closing closing(const std::vector<const WheelFace*>& faces, double near_mm) {
  Vec3 normals = Vec3::Zero();
  double area = 0.0;
  for (const WheelFace* face : faces)
    for (const FaceSample& s : face->samples) normals += s.area * s.normal, area += s.area;
  if (!(area > 0.0) || normals.norm() > kOneWay * area) return Closing::kOpen;
  return girth(faces, Girth::kOfAir, near_mm) < girth(faces, Girth::kOfMaterial, near_mm) ? Closing::kHollow
                                                                                          : Closing::kRound;
}

std::vector<const WheelFace*> hollow_faces(const std::vector<const WheelFace*>& faces, double near_mm) {
  std::vector<const WheelFace*> left = faces, out;
  while (!left.empty()) {
    const std::vector<const WheelFace*> skin = take_skin(left, near_mm);
    if (closing(skin, near_mm) == Closing::kHollow) out.insert(out.end(), skin.begin(), skin.end());
  }
  return out;
}

}  // namespace flank::internal

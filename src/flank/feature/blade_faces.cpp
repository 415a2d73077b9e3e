#include "flank/feature/blade_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/feature/hollow.h"

namespace flank::internal {
namespace {

constexpr int kTouching = 3;          ///< points of a border on another face, for the two to be joined
constexpr double kConvex = -0.17;     ///< sine of 10 degrees: a sharper joint is convex
constexpr double kOneWay = 0.2;       ///< a blade has at least this share of its area looking either way
constexpr double kLeastShare = 0.05;  ///< of the largest candidate: less is no blade

double area_looking(const BladeFaces& blade, const WheelAxis& axis, double sign) {
  double sum = 0.0;
  for (const WheelFace* face : blade.faces)
    for (const FaceSample& s : face->samples)
      if (sign * s.normal.dot(axis.around(s.point)) > 0.05) sum += s.area;
  return sum;
}

struct Groups {
  std::vector<std::size_t> of;
  explicit Groups(std::size_t count) : of(count) { std::iota(of.begin(), of.end(), std::size_t{0}); }
  void join(std::size_t a, std::size_t b) {
    const std::size_t from = std::max(of[a], of[b]), to = std::min(of[a], of[b]);
    std::replace(of.begin(), of.end(), from, to);
  }
};

bool joined(const WheelFace& a, const WheelFace& b, double near_mm) {
  return contact(a, b, near_mm).points >= kTouching || contact(b, a, near_mm).points >= kTouching;
}

/// Of a face of revolution: where what it touches falls off from it, by the length of the joints, it is the tip of a blade, or an end cut by turning.
bool is_cap(const WheelFace& face, const std::vector<const WheelFace*>& others, double near_mm) {
  int points = 0;
  double bend = 0.0;
  for (const WheelFace* other : others) {
    const FaceContact there = contact(face, *other, near_mm);
    if (there.points < kTouching) continue;
    points += there.points;
    bend += there.bend * there.points;
  }
  return points > 0 && bend < kConvex * points;
}

/// A plane through the axis: a sector is cut out of the wheel there.
bool is_sector_cut(const WheelFace& face, const WheelAxis& axis, double size_mm) {
  if (face.type != "plane") return false;
  const Vec3& n = face.samples.front().normal;
  return std::abs(n.dot(axis.direction)) < 1e-3 &&
         std::abs(n.dot(face.samples.front().point - axis.point)) < 1e-3 * size_mm;
}

}  // namespace

void leave_out_hollows(BladeFaces& blade, double near_mm) {
  for (const WheelFace* face : hollow_faces(blade.faces, near_mm))
    blade.faces.erase(std::remove(blade.faces.begin(), blade.faces.end(), face), blade.faces.end());
  blade.area = 0.0;
  for (const WheelFace* face : blade.faces) blade.area += face->area;
}

std::vector<BladeFaces> blade_candidates(const std::vector<WheelFace>& faces, const WheelAxis& axis, double size_mm) {
  const double near_mm = touch_mm(size_mm);
  std::vector<const WheelFace*> free, turned;
  for (const WheelFace& face : faces) {
    if (is_turned(face, axis, size_mm))
      turned.push_back(&face);
    else if (!is_sector_cut(face, axis, size_mm))
      free.push_back(&face);
  }
  // Turned faces last: they join one blade, and never two.
  std::vector<const WheelFace*> all = free;
  for (const WheelFace* face : turned)
    if (is_cap(*face, free, near_mm)) all.push_back(face);
  Groups groups(all.size());
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = i + 1; j < free.size(); ++j)
      if (groups.of[i] != groups.of[j] && joined(*free[i], *free[j], near_mm)) groups.join(i, j);
  for (std::size_t i = free.size(); i < all.size(); ++i) {
    std::vector<std::size_t> met;
    for (std::size_t j = 0; j < free.size(); ++j)
      if (joined(*all[i], *all[j], near_mm) && std::find(met.begin(), met.end(), groups.of[j]) == met.end())
        met.push_back(groups.of[j]);
    if (met.size() == 1) groups.of[i] = met.front();
  }
  std::vector<BladeFaces> out;
  for (std::size_t g = 0; g < all.size(); ++g) {
    BladeFaces blade;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (groups.of[i] == g) blade.faces.push_back(all[i]);
    leave_out_hollows(blade, near_mm);
    if (blade.faces.empty()) continue;
    const double ahead = area_looking(blade, axis, 1.0), behind = area_looking(blade, axis, -1.0);
    if (std::min(ahead, behind) > kOneWay * blade.area) out.push_back(std::move(blade));
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  while (!out.empty() && out.back().area < kLeastShare * out.front().area) out.pop_back();
  return out;
}

namespace {

/// How a blade lies to a face of revolution: touching or entering it, and how much of it is outside.
struct Standing {
  bool meets = false;
  double outside = 0.0;
};

Standing standing(const BladeFaces& blade, const WheelFace& face, double near_mm) {
  Standing out;
  double area = 0.0, above = 0.0;
  bool over = false, under = false;
  for (const WheelFace* part : blade.faces) {
    out.meets = out.meets || contact(*part, face, near_mm).points >= kTouching ||
                contact(face, *part, near_mm).points >= kTouching;
    for (std::size_t k = 0; k < part->samples.size(); k += 3) {
      const FaceSample& s = part->samples[k];
      const NearFace at = nearest({&face}, s.point);
      area += s.area;
      // Right over the face, not beside it.
      const bool facing = std::abs(at.normal.dot(s.point - at.point)) > 0.9 * (s.point - at.point).norm();
      if (at.height > 0.0) above += s.area;
      over = over || (facing && at.height > near_mm);
      under = under || (facing && at.height < -near_mm);
    }
  }
  out.meets = out.meets || (over && under);
  out.outside = area > 0.0 ? above / area : 0.0;
  return out;
}

/// Mean of the normals' share away from the axis.
double outward(const WheelFace& face, const WheelAxis& axis) {
  double sum = 0.0;
  for (const FaceSample& s : face.samples) {
    const Vec3 from = s.point - axis.point - axis.along(s.point) * axis.direction;
    if (from.norm() > 0.0) sum += s.area * s.normal.dot(from.normalized());
  }
  return sum / face.area;
}

}  // namespace

TurnedRoles turned_roles(const std::vector<WheelFace>& faces, const std::vector<BladeFaces>& blades,
                         const WheelAxis& axis, double size_mm) {
  constexpr double kMostly = 0.5, kAway = -0.3;
  TurnedRoles out;
  for (const WheelFace& face : faces) {
    if (!is_turned(face, axis, size_mm)) continue;
    const bool of_blade = std::any_of(blades.begin(), blades.end(), [&](const BladeFaces& blade) {
      return std::find(blade.faces.begin(), blade.faces.end(), &face) != blade.faces.end();
    });
    if (of_blade) continue;
    for (const BladeFaces& blade : blades) {
      const Standing there = standing(blade, face, touch_mm(size_mm));
      if (!there.meets || there.outside < kMostly) continue;
      (outward(face, axis) > kAway ? out.hub : out.shroud).push_back(&face);
      break;
    }
  }
  return out;
}

}  // namespace flank::internal

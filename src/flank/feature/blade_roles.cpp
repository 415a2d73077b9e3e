#include "flank/feature/blade_roles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/feature/hollow.h"

namespace flank::internal {
namespace {

constexpr double kSideWidth = 0.45;  ///< of the widest face: sides are as wide
constexpr double kTipUp = 0.65;      ///< mean cosine between a tip's normal and the way up from the hub
constexpr double kOffHub = 0.08,
                 kSomeUp = 0.25;  ///< a face that begins so far above the hub, of the blade's height, is no edge
constexpr double kRoot = 0.3;     ///< of the blade's height: fillets end below
constexpr double kConcave = 0.5;  ///< share of a fillet's samples that bend towards the tool
constexpr int kAtHub = 3;
constexpr double kFacesHub = -0.9;  ///< mean cosine between the normals of a foot and the hub's
constexpr double kEitherWay = 0.2;  ///< of its area, that a side which goes all round has looking either way

/// A face by its place over the hub.
struct Placed {
  const WheelFace* face;
  double low = 0.0, high = 0.0;  ///< heights of a twentieth and nineteen twentieths of its area
  double up = 0.0;               ///< mean cosine of its normals to the way up
  double ahead = 0.0;            ///< mean of its normals' share round the axis
  double least_way = 0.0;        ///< share of the area that looks the way round the axis that less of it does
  double facing = 0.0;           ///< mean cosine between its normals and the hub's
  double concave = 0.0;          ///< share that bends towards the tool, with a radius below the blade's height
  double above = 0.0;            ///< share of the area over the hub
  Closing closing = Closing::kOpen;
  bool at_hub = false;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Placed place(const WheelFace& face, const std::vector<const WheelFace*>& hub, const WheelAxis& axis, double near_mm) {
  Placed out{&face};
  std::vector<double> heights;
  double one_way = 0.0, other_way = 0.0;
  for (const FaceSample& s : face.samples) {
    const NearFace at = nearest(hub, s.point);
    heights.push_back(at.height);
    const Vec3 to = s.point - at.point;
    const Vec3 up = to.norm() > near_mm ? Vec3(std::copysign(1.0, at.height) * to.normalized()) : at.normal;
    out.up += s.area * s.normal.dot(up) / face.area;
    const double ahead = s.normal.dot(axis.around(s.point));
    out.ahead += s.area * ahead / face.area;
    (ahead > 0.0 ? one_way : other_way) += s.area / face.area;
    out.facing += s.area * s.normal.dot(at.normal) / face.area;
    out.above += at.height > -near_mm ? s.area / face.area : 0.0;
  }
  out.least_way = std::min(one_way, other_way);
  if (out.least_way > kEitherWay) out.closing = closing({&face}, near_mm);
  out.low = quantile(heights, 0.05), out.high = quantile(heights, 0.95);
  out.at_hub = std::any_of(hub.begin(), hub.end(), [&](const WheelFace* below) {
    return contact(face, *below, near_mm).points >= kAtHub || contact(*below, face, near_mm).points >= kAtHub;
  });
  return out;
}

double concave_share(const WheelFace& face, double largest_mm) {
  double sum = 0.0;
  for (const FaceSample& s : face.samples)
    if (s.high > 1.0 / largest_mm) sum += s.area;
  return sum / face.area;
}

RootFillet fillet_of(const WheelFace& face) {
  std::vector<double> radii;
  for (const FaceSample& s : face.samples)
    if (s.high > 0.0) radii.push_back(1.0 / s.high);
  return {face.id, quantile(radii, 0.5), quantile(radii, 0.1), quantile(radii, 0.9)};
}

/// Of places in the middle of a side, how far the other side is: the median.
double thickness_of(const std::vector<const WheelFace*>& one, const std::vector<const WheelFace*>& other,
                    double near_mm) {
  std::vector<double> found;
  if (one == other) return girth(one, Girth::kOfMaterial, near_mm);
  if (one.empty() || other.empty()) return 0.0;
  for (const WheelFace* face : one)
    for (std::size_t k = 0; k < face->samples.size(); k += 7)
      found.push_back(std::abs(nearest(other, face->samples[k].point).height));
  return quantile(found, 0.5);
}

/// Where the blade's middle is, round the axis, degrees from 0 to 360. Areas weigh; a blade that winds has its own mean, too.
double middle_deg(const BladeFaces& blade, const WheelAxis& axis) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const WheelFace* face : blade.faces)
    for (const FaceSample& s : face->samples) sum += s.area * s.point, area += s.area;
  const double deg = axis.angle(sum / area) * 180.0 / std::numbers::pi;
  return deg < 0.0 ? deg + 360.0 : deg;
}

/// Of the face that a piece is a piece of.
std::string whole_id(const WheelFace& face) { return "F" + std::to_string(face.index + 1); }

void add_role(const Placed& p, bool wide, WheelBlade& out) {
  const std::string& id = p.face->id;
  const double height = out.height_mm;
  const bool root = p.high < kRoot * height, whole = id == whole_id(*p.face);
  // What stands on the hub without a joint lies on it with its foot.
  const bool foot = p.at_hub && p.facing < kFacesHub && p.high < kOffHub * height;
  if (p.above < 0.05 || foot) {
    out.buried.push_back(id);
  } else if (wide && p.closing == Closing::kRound) {
    out.ahead.push_back(id), out.behind.push_back(id);
  } else if (wide && !(p.at_hub && root)) {
    (p.ahead > 0.0 ? out.ahead : out.behind).push_back(id);
  } else if (const RootFillet fillet = fillet_of(*p.face); root && (p.at_hub || p.concave > kConcave) &&
                                                           fillet.radius_mm > 0.0 &&
                                                           fillet.radius_mm < kRoot * height) {
    out.fillets.push_back(fillet);
  } else if (p.up > kTipUp || (whole && p.up > kSomeUp && !p.at_hub && p.low > kOffHub * height)) {
    out.tips.push_back(id);
  } else {
    out.edges.push_back(id);
  }
}

/// A face all of whose pieces are edges is one itself, under its own name.
void join_pieces(const BladeFaces& blade, std::vector<std::string>& edges) {
  const auto named = [&](const std::string& id) { return std::find(edges.begin(), edges.end(), id) != edges.end(); };
  for (const WheelFace* face : blade.faces) {
    const std::string whole = whole_id(*face);
    if (face->id == whole || !named(face->id)) continue;
    const auto is_piece = [&](const WheelFace* other) { return other->index == face->index; };
    const bool all = std::all_of(blade.faces.begin(), blade.faces.end(),
                                 [&](const WheelFace* other) { return !is_piece(other) || named(other->id); });
    if (!all) continue;
    std::replace(edges.begin(), edges.end(), face->id, whole);
    for (const WheelFace* other : blade.faces)
      if (is_piece(other)) edges.erase(std::remove(edges.begin(), edges.end(), other->id), edges.end());
  }
}

}  // namespace

WheelBlade blade_roles(const BladeFaces& blade, const std::vector<const WheelFace*>& hub, const WheelAxis& axis,
                       double size_mm) {
  WheelBlade out;
  out.area_mm2 = blade.area;
  out.angle_deg = middle_deg(blade, axis);
  std::vector<Placed> placed;
  double widest = 0.0;
  for (const WheelFace* face : blade.faces) {
    placed.push_back(place(*face, hub, axis, touch_mm(size_mm)));
    widest = std::max(widest, face->width());
    out.height_mm = std::max(out.height_mm, placed.back().high);
  }
  std::vector<const WheelFace*> ahead, behind;
  for (Placed& p : placed) {
    p.concave = concave_share(*p.face, 0.5 * std::max(out.height_mm, 1e-9));
    const bool wide = !p.face->edge && p.face->width() > kSideWidth * widest;
    add_role(p, wide, out);
    if (!out.ahead.empty() && out.ahead.back() == p.face->id && wide) ahead.push_back(p.face);
    if (!out.behind.empty() && out.behind.back() == p.face->id && wide) behind.push_back(p.face);
  }
  join_pieces(blade, out.edges);
  out.thickness_mm = thickness_of(ahead, behind, touch_mm(size_mm));
  return out;
}

}  // namespace flank::internal

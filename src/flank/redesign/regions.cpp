#include "flank/redesign/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "flank/envelope/swept_estimate.h"
#include "flank/error.h"
#include "flank/geom/face_box.h"

namespace flank::internal {
namespace {

constexpr double kBorderShare = 1.0 / 150.0;  ///< spacing of border points, of the diagonal
constexpr double kTouchShare = 2e-4;          ///< borders that are nearer than this share of the diagonal are one
constexpr double kWidthShare = 0.1;  ///< of the square root of the area: how far from a border its factor holds
constexpr double kAlike = 0.1;       ///< of their radius: edges that differ by less are alike
constexpr int kPoses = 160;

/// Shares of the way and of the axis at which the motion touches a place of the face, 0 to 1 over the face.
struct Place {
  Vec3 point;
  double t = 0.0, s = 0.0;
};

std::vector<Place> places_of(const std::vector<Vec3>& border, const RuledMotion& motion, const RadialFunction& radial) {
  const SweptEstimate swept({motion}, radial, kPoses);
  std::vector<Place> all;
  for (const Vec3& p : border) {
    const SweptContact contact = swept.refine(p, swept.nearest(p));
    all.push_back({p, contact.t, contact.s});
  }
  const auto scale = [&](double Place::*member) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Place& place : all) low = std::min(low, place.*member), high = std::max(high, place.*member);
    for (Place& place : all) place.*member = high > low ? (place.*member - low) / (high - low) : 0.5;
  };
  scale(&Place::t);
  scale(&Place::s);
  return all;
}

/// 0: root, 1: tip, 2: begin of the motion, 3: its end.
std::size_t side_of(const Place& place) {
  const double along = place.t - 0.5, up = place.s - 0.5;
  if (std::abs(up) > std::abs(along)) return up < 0.0 ? 0 : 1;
  return along < 0.0 ? 2 : 3;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

bool near_box(const Face& face, const Box3& box, double margin) { return near(box_of(face), box, margin); }

}  // namespace

std::vector<WeightRequest> parse_weights(const std::string& text) {
  constexpr std::string_view kExpected =
      "expected borders with their factors, as le=10,root=0.2: le, te, root, tip or a neighbouring face, and a number "
      "from 0.001 to 1000";
  std::vector<WeightRequest> all;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) throw UsageError("weight", text, std::string(kExpected));
    WeightRequest request{word.substr(0, equals), 0.0};
    const std::string number = word.substr(equals + 1);
    std::size_t used = 0;
    try {
      request.factor = std::stod(number, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    const bool good = used > 0 && used == number.size() && request.factor >= 1e-3 && request.factor <= 1e3;
    if (!good) throw UsageError("weight", text, std::string(kExpected));
    all.push_back(request);
  }
  if (all.empty()) throw UsageError("weight", text, std::string(kExpected));
  return all;
}

FaceBorders find_borders(const Part& part, int face, const Target& target, const RuledMotion& motion,
                         const RadialFunction& radial) {
  const double near = kTouchShare * target.diagonal() + 1e-3;
  const std::vector<Place> places = places_of(target.border_points(kBorderShare * target.diagonal()), motion, radial);
  std::array<BorderSide, 4> sides;
  std::array<std::vector<double>, 4> radii;
  for (const Place& place : places) sides[side_of(place)].points.push_back(place.point);
  FaceBorders borders;
  for (int k = 0; k < part.face_count(); ++k) {
    if (k == face || part.is_left_out(k)) continue;
    const Face& other = part.faces[static_cast<std::size_t>(k)];
    if (!near_box(other, target.box(), near)) continue;
    const std::unique_ptr<Target> neighbour = make_target({other});
    std::vector<Vec3> shared;
    for (const Place& place : places) {
      const Footpoint foot = neighbour->closest_within(place.point, near);
      if (foot.patch < 0) continue;
      shared.push_back(place.point);
      BorderSide& side = sides[side_of(place)];
      if (side.faces.empty() || side.faces.back() != other.id) side.faces.push_back(other.id);
      const double bend = std::max(std::abs(foot.k1), std::abs(foot.k2));
      radii[side_of(place)].push_back(bend > 1e-9 ? 1.0 / bend : 0.0);
    }
    if (!shared.empty()) borders.neighbours.emplace_back(other.id, std::move(shared));
  }
  for (std::size_t k = 0; k < sides.size(); ++k) sides[k].radius_mm = median(radii[k]);
  const bool begins = sides[2].radius_mm >= sides[3].radius_mm;
  borders.edges_alike =
      std::abs(sides[2].radius_mm - sides[3].radius_mm) <= kAlike * std::max(sides[2].radius_mm, sides[3].radius_mm);
  borders.root = std::move(sides[0]);
  borders.tip = std::move(sides[1]);
  borders.leading = std::move(sides[begins ? 2 : 3]);
  borders.trailing = std::move(sides[begins ? 3 : 2]);
  return borders;
}

FaceWeights::FaceWeights(const std::vector<WeightRequest>& requests, const FaceBorders& borders, double size_mm)
    : width_mm_(kWidthShare * size_mm) {
  for (const WeightRequest& request : requests) {
    const std::vector<Vec3>* points = nullptr;
    if (request.border == "root") points = &borders.root.points;
    if (request.border == "tip") points = &borders.tip.points;
    const bool edge = request.border == "le" || request.border == "te";
    if (edge && borders.edges_alike)
      throw UsageError("weight", request.border,
                       "leading and trailing edge are equally sharp; name the neighbouring face instead, as F2=10");
    if (request.border == "le") points = &borders.leading.points;
    if (request.border == "te") points = &borders.trailing.points;
    std::string known = "le, te, root, tip";
    for (const auto& [id, shared] : borders.neighbours) {
      if (id == request.border) points = &shared;
      known += ", " + id;
    }
    if (points == nullptr || points->empty())
      throw UsageError("weight", request.border, "is no border of the face; expected one of " + known);
    near_.push_back({*points, request.factor});
  }
}

double FaceWeights::at(const Vec3& p) const {
  double weight = 1.0;
  for (const Near& border : near_) {
    double squared = std::numeric_limits<double>::infinity();
    for (const Vec3& q : border.points) squared = std::min(squared, (p - q).squaredNorm());
    weight *= std::pow(border.factor, std::exp(-squared / (width_mm_ * width_mm_)));
  }
  return weight;
}

}  // namespace flank::internal

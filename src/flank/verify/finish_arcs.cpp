#include "flank/verify/finish_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/verify/stock/front_circle.h"

namespace flank::internal {
namespace {

/// Of the front, from its end inwards: what lies between two looks is found by the slope between them.
constexpr double kArcStep = 1.0 * std::numbers::pi / 180.0;

/// The samples of the targets in cells as large as one may be away that counts.
class FinishStock {
 public:
  FinishStock(const std::vector<FaceSamples>& faces, double thickness) : thickness_(thickness) {
    double spacing = 0.0;
    for (const FaceSamples& face : faces)
      if (face.target) spacing = std::max(spacing, face.spacing_mm);
    spacing_ = spacing;
    cell_ = std::hypot(spacing, thickness);
    if (!(thickness > 0.0) || !(cell_ > 0.0)) throw UsageError("finish_stock", "expected a thickness > 0 mm");
    for (const FaceSamples& face : faces) {
      if (!face.target || face.normals.size() != face.points.size()) continue;
      for (std::size_t k = 0; k < face.points.size(); ++k) {
        cells_[key(place(face.points[k]))].push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(face.points[k]);
        normals_.push_back(face.normals[k]);
      }
    }
  }

  /// How far a place is above the target's surface, mm; none where no target is opposite.
  [[nodiscard]] std::optional<double> height(const Vec3& x) const {
    double least = cell_ * cell_;
    std::optional<std::uint32_t> nearest;
    const std::array<std::int64_t, 3> at = place(x);
    for (std::int64_t i = at[0] - 1; i <= at[0] + 1; ++i)
      for (std::int64_t j = at[1] - 1; j <= at[1] + 1; ++j)
        for (std::int64_t k = at[2] - 1; k <= at[2] + 1; ++k) {
          const auto cell = cells_.find(key({i, j, k}));
          if (cell == cells_.end()) continue;
          for (const std::uint32_t n : cell->second)
            if (const double d = (x - points_[n]).squaredNorm(); d < least) least = d, nearest = n;
        }
    if (!nearest) return {};
    const Vec3 to = x - points_[*nearest];
    const double above = normals_[*nearest].dot(to);
    if ((to - above * normals_[*nearest]).norm() > spacing_) return {};
    return above;
  }
  [[nodiscard]] double thickness() const { return thickness_; }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> place(const Vec3& x) const {
    std::array<std::int64_t, 3> at{};
    for (int k = 0; k < 3; ++k) at[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(x[k] / cell_));
    return at;
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& at) {
    constexpr std::uint64_t kBits = 21, kMask = (std::uint64_t{1} << kBits) - 1;
    std::uint64_t out = 0;
    for (const std::int64_t k : at) out = (out << kBits) | (static_cast<std::uint64_t>(k) & kMask);
    return out;
  }

  double thickness_, spacing_ = 0.0, cell_ = 0.0;
  std::vector<Vec3> points_, normals_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// From an end of the front inwards, as far as it lies in the stock; 0: it does not begin in it.
double from_end(const FinishStock& stock, const verify::FrontCircle& circle, double sign) {
  double before = 0.0;
  for (int k = 0; k * kArcStep <= 2.0 * circle.half; ++k) {
    const double inwards = k * kArcStep;
    const std::optional<double> above = stock.height(circle.point(sign * (circle.half - inwards)));
    // What the judge lets a tool cut into the face is far less than a stock.
    const bool in = above && std::abs(*above) < stock.thickness();
    if (!in && k == 0) return 0.0;
    if (!in) {
      const double slope = above ? *above - before : 0.0;
      return inwards - kArcStep + (slope > 0.0 ? kArcStep * std::min(1.0, (stock.thickness() - before) / slope) : 0.0);
    }
    before = *above;
  }
  return 2.0 * circle.half;
}

std::vector<EngagedArc> arcs_at(const FinishStock& stock, const RadialFunction& radial, const Pose& pose,
                                const PoseVelocity& velocity, const std::vector<double>& heights) {
  std::vector<EngagedArc> arcs;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const verify::FrontCircle circle = verify::front_circle(radial, pose, velocity, heights[k]);
    if (!(circle.half > 0.0)) continue;
    const double right = from_end(stock, circle, -1.0), left = from_end(stock, circle, +1.0);
    const int ring = static_cast<int>(k);
    if (right + left >= 2.0 * circle.half) {
      arcs.push_back({ring, -circle.half, circle.half});
      continue;
    }
    if (right > 0.0) arcs.push_back({ring, -circle.half, -circle.half + right});
    if (left > 0.0) arcs.push_back({ring, circle.half - left, circle.half});
  }
  return arcs;
}

}  // namespace

PathArcs finish_arcs(const RadialFunction& radial, const Path& path, const std::vector<FaceSamples>& targets,
                     double thickness_mm, int rings) {
  const FinishStock stock(targets, thickness_mm);
  const double length = radial.axis_length();
  PathArcs out;
  for (int k = 0; k < rings; ++k) out.heights.push_back(length * k / (rings - 1));
  for (const Strip& strip : path.strips) {
    std::vector<std::vector<EngagedArc>>& arcs = out.strips.emplace_back(strip.poses.size());
    parallel_for(strip.poses.size(), [&](std::size_t k) {
      arcs[k] = arcs_at(stock, radial, strip.poses[k], velocity_at(strip.poses, k, length), out.heights);
    });
  }
  return out;
}

}  // namespace flank::internal

#include "flank/results/view_gaps.h"

#include <algorithm>
#include <limits>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

/// Places times poses: a third of a second on one processor.
constexpr std::size_t kMostLooks = 20'000'000;
constexpr int kFlankPoints = 65;

/// A body of revolution by its profile (z, radius), z never falling.
class Revolved {
 public:
  explicit Revolved(std::vector<Vec2> profile) : profile_(std::move(profile)) {}

  [[nodiscard]] double gap(double z, double rho) const {
    const double low = profile_.front().x(), high = profile_.back().x();
    return std::max({rho - radius(std::clamp(z, low, high)), low - z, z - high});
  }

 private:
  /// At a jump the wider of both.
  [[nodiscard]] double radius(double z) const {
    const auto after =
        std::lower_bound(profile_.begin(), profile_.end(), z, [](const Vec2& p, double at) { return p.x() < at; });
    if (after == profile_.begin()) return after->y();
    const Vec2& a = *(after - 1);
    const Vec2& b = *after;
    const double width = b.x() - a.x();
    return width > 0.0 ? a.y() + (z - a.x()) / width * (b.y() - a.y()) : std::max(a.y(), b.y());
  }

  std::vector<Vec2> profile_;
};

std::vector<Revolved> bodies_of(const Tool& tool, ToolBodies which) {
  std::vector<Revolved> bodies;
  if (which == ToolBodies::kAll) {
    std::vector<Vec2> flank = meridian(tool.radial, kFlankPoints);
    // Of a tool that is not legitimate the meridian turns back.
    if (std::is_sorted(flank.begin(), flank.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); }))
      bodies.emplace_back(std::move(flank));
  }
  for (const std::vector<Vec2>* profile : {&tool.shank, &tool.holder})
    if (!profile->empty()) bodies.emplace_back(*profile);
  return bodies;
}

std::vector<Pose> some_of(const std::vector<Pose>& all, std::size_t places) {
  std::vector<Pose> some;
  const std::size_t stride = all.size() * std::max<std::size_t>(1, places) / kMostLooks + 1;
  for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
  return some;
}

}  // namespace

void measure_gaps(const Tool& tool, const std::vector<Pose>& all_poses, ToolBodies bodies,
                  const std::vector<ViewFace*>& faces) {
  std::size_t places = 0;
  for (const ViewFace* face : faces) places += face->mesh.vertices.size();
  const std::vector<Revolved> solids = bodies_of(tool, bodies);
  const std::vector<Pose> poses = some_of(all_poses, places);
  if (solids.empty() || poses.empty()) return;
  const double tip_mm = tool.radial.at(0.0).r;
  for (ViewFace* face : faces) {
    face->gap_mm.assign(face->mesh.vertices.size(), std::numeric_limits<double>::max());
    parallel_for(face->gap_mm.size(), [&](std::size_t i) {
      double& least = face->gap_mm[i];
      for (const Pose& pose : poses) {
        const Vec3 from = face->mesh.vertices[i] - pose.tip;
        const double z = from.dot(pose.axis), rho = (from - z * pose.axis).norm();
        for (const Revolved& solid : solids) least = std::min(least, solid.gap(z, rho));
        // The ball of the tip, which ends the flank.
        if (bodies == ToolBodies::kAll) least = std::min(least, from.norm() - tip_mm);
      }
    });
  }
}

}  // namespace flank::internal

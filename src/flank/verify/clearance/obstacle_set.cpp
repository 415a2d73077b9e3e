#include "flank/verify/clearance/obstacle_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/tessellate.h"

namespace flank {
using namespace internal;
namespace internal::verify {
namespace {

/// Of a long path and a slender body: more boxes tell no more.
constexpr std::size_t kMostBlocks = 1024, kMostPieces = 8;

double squared_distance(const Box3& a, const Box3& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).squaredNorm();
}

/// Where a body is along the axis, and how wide.
struct Extent {
  double low = 1e300, high = -1e300, radius = 0.0;

  explicit Extent(const std::vector<Revolved>& body) {
    for (const Revolved& part : body)
      for (const Vec2& c : part.corners()) {
        low = std::min(low, c.x() - part.rounding());
        high = std::max(high, c.x() + part.rounding());
        radius = std::max(radius, c.y() + part.rounding());
      }
  }
};

/// The arc of the axis between two poses bulges out of the chord by no more than this, for each mm from the tip.
double bulge_of(const Segment& segment) {
  const double cosine = std::clamp(segment.at(0.0).axis.dot(segment.at(1.0).axis), -1.0, 1.0);
  return 1.0 - std::sqrt(0.5 * (1.0 + cosine));
}

void add_piece(Box3& box, const Segment& segment, double low, double high, double radius) {
  const double around = radius + bulge_of(segment) * std::max(std::abs(low), std::abs(high));
  for (const double tau : {0.0, 1.0}) {
    const Pose pose = segment.at(tau);
    for (const double z : {low, high}) {
      box.add(pose.at(z) - Vec3::Constant(around));
      box.add(pose.at(z) + Vec3::Constant(around));
    }
  }
}

ObstacleScene scene_of(const ObstacleStore& store, const std::vector<int>& which) {
  ObstacleScene scene;
  TriangleMesh all;
  for (const int k : which) {
    const Obstacle& obstacle = store.made(k);
    append(all, obstacle.mesh);
    scene.obstacle_of.resize(all.triangles.size(), k);
    scene.deviation_mm = std::max(scene.deviation_mm, obstacle.deviation_mm);
  }
  scene.tree = ObstacleTree(all);
  return scene;
}

}  // namespace

BodyWay way_of(const std::vector<Revolved>& body, const std::vector<Segment>& segments) {
  if (body.empty() || segments.empty()) return {};
  const Extent extent(body);
  const std::size_t block = 1 + (segments.size() - 1) / kMostBlocks;
  const double wide = (extent.high - extent.low) / std::max(2.0 * extent.radius, 1e-300);
  const std::size_t pieces = std::clamp(static_cast<std::size_t>(std::min(wide, 1e6)), std::size_t{1}, kMostPieces);
  BodyWay way{{}, extent.radius};
  for (std::size_t first = 0; first < segments.size(); first += block)
    for (std::size_t p = 0; p < pieces; ++p) {
      const double step = (extent.high - extent.low) / static_cast<double>(pieces);
      const double low = extent.low + static_cast<double>(p) * step;
      Box3& box = way.boxes.emplace_back();
      for (std::size_t k = first; k < std::min(segments.size(), first + block); ++k)
        add_piece(box, segments[k], low, low + step, extent.radius);
    }
  return way;
}

}  // namespace internal::verify

using namespace internal::verify;

struct ObstacleSet::Data : ObstacleStore {
  using ObstacleStore::ObstacleStore;
};

const ObstacleStore& internal::verify::store_of(const ObstacleSet& obstacles) { return obstacles.data(); }

ObstacleStore::ObstacleStore(std::vector<DistantObstacle> given)
    : obstacles(std::move(given)), once_(obstacles.size()), made_(obstacles.size()) {}

bool ObstacleStore::has(ObstacleRole role) const {
  return std::any_of(obstacles.begin(), obstacles.end(),
                     [&](const DistantObstacle& o) { return o.role == role && !o.box.empty(); });
}

const Obstacle& ObstacleStore::made(int obstacle) const {
  const auto k = static_cast<std::size_t>(obstacle);
  std::call_once(once_[k], [&] { made_[k] = obstacles[k].make(); });
  return made_[k];
}

std::shared_ptr<const ObstacleScene> ObstacleStore::near(ObstacleRole role, const BodyWay& way, double reach_mm) const {
  Box3 all;
  for (const Box3& box : way.boxes) all.add(box);
  const double limit = reach_mm * reach_mm;
  const auto is_near = [&](const Box3& box) {
    return squared_distance(all, box) <= limit &&
           std::any_of(way.boxes.begin(), way.boxes.end(),
                       [&](const Box3& swept) { return squared_distance(swept, box) <= limit; });
  };
  std::vector<int> which;
  bool whole = true;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const DistantObstacle& o = obstacles[k];
    if (o.role != role || o.box.empty()) continue;
    if (is_near(o.box))
      which.push_back(static_cast<int>(k));
    else
      whole = false;
  }
  parallel_for(which.size(), [&](std::size_t i) { static_cast<void>(made(which[i])); });
  const std::scoped_lock lock(mutex_);
  Last& last = last_[role];
  if (!last.scene || last.of != which) {
    auto scene = std::make_shared<ObstacleScene>(scene_of(*this, which));
    scene->whole = whole;
    last = {std::move(which), std::move(scene)};
  }
  return last.scene;
}

namespace {

std::vector<DistantObstacle> made_already(std::vector<Obstacle> obstacles) {
  std::vector<DistantObstacle> all;
  for (Obstacle& o : obstacles) {
    const auto shared = std::make_shared<const Obstacle>(std::move(o));
    all.push_back({shared->name, shared->role, shared->mesh.box(), [shared] { return *shared; }});
  }
  return all;
}

}  // namespace

ObstacleSet::ObstacleSet(std::vector<DistantObstacle> obstacles)
    : data_(std::make_shared<const Data>(std::move(obstacles))) {}

ObstacleSet::ObstacleSet(std::vector<Obstacle> obstacles) : ObstacleSet(made_already(std::move(obstacles))) {}

const std::vector<DistantObstacle>& ObstacleSet::obstacles() const { return data_->obstacles; }

const Obstacle& ObstacleSet::made(std::size_t index) const { return data_->made(static_cast<int>(index)); }

ObstacleSet ObstacleSet::as_fixtures() const {
  std::vector<DistantObstacle> all;
  for (std::size_t k = 0; k < obstacles().size(); ++k) {
    const DistantObstacle& o = obstacles()[k];
    all.push_back({o.name, ObstacleRole::kFixture, o.box, [data = data_, k] {
                     Obstacle made = data->made(static_cast<int>(k));
                     made.role = ObstacleRole::kFixture;
                     return made;
                   }});
  }
  return ObstacleSet(std::move(all));
}

}  // namespace flank

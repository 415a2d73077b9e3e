/// Which triangles of a set of obstacles a question of the judge needs: those of the obstacles that the body comes near.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "flank/clearance.h"
#include "flank/verify/clearance/obstacle_tree.h"
#include "flank/verify/clearance/revolved.h"
#include "flank/verify/swept/segment.h"

namespace flank::internal::verify {

/// Where a body is on its whole way, roughly.
struct BodyWay {
  std::vector<Box3> boxes;  ///< hold it; none of a body that is nowhere
  double radius_mm = 0.0;   ///< of the body where it is thickest
};

[[nodiscard]] BodyWay way_of(const std::vector<Revolved>& body, const std::vector<Segment>& segments);

/// Obstacles of one role as one mesh that remembers where its triangles come from.
struct ObstacleScene {
  ObstacleTree tree;
  std::vector<int> obstacle_of;  ///< of each triangle
  double deviation_mm = 0.0;     ///< the largest of them
  bool whole = true;             ///< no obstacle of the role is left out
};

/// What a set of obstacles holds. Many threads may ask.
class ObstacleStore {
 public:
  explicit ObstacleStore(std::vector<DistantObstacle> given);

  [[nodiscard]] bool has(ObstacleRole role) const;
  /// All obstacles of a role that may be nearer than `reach_mm` >= 0 to the body on its way; some that are not. The same for the same question,
  /// whatever was asked before.
  [[nodiscard]] std::shared_ptr<const ObstacleScene> near(ObstacleRole role, const BodyWay& way, double reach_mm) const;
  [[nodiscard]] const Obstacle& made(int obstacle) const;

  const std::vector<DistantObstacle> obstacles;

 private:
  struct Last {
    std::vector<int> of;
    std::shared_ptr<const ObstacleScene> scene;
  };
  mutable std::vector<std::once_flag> once_;
  mutable std::vector<Obstacle> made_;
  mutable std::mutex mutex_;
  mutable std::map<ObstacleRole, Last> last_;  ///< most questions are about the same few as the one before
};

[[nodiscard]] const ObstacleStore& store_of(const ObstacleSet& obstacles);

}  // namespace flank::internal::verify

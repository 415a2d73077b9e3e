/// Faces of a part as targets, made once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/part.h"
#include "flank/target.h"

namespace flank::internal {

class FaceTargets {
 public:
  explicit FaceTargets(const Part& part) : part_(part) {}
  /// One target a face, in their order; pieces of faces count. They live as long as this, or until forget(). Throws UsageError for names that the part
  /// does not have.
  [[nodiscard]] std::vector<const Target*> of(const std::vector<std::string>& faces);
  /// The same, turned about an axis by some pitches; `turns` 0: as they are.
  [[nodiscard]] std::vector<const Target*> turned(const std::vector<std::string>& faces, const WheelAxis& axis,
                                                  double pitch_rad, int turns);
  /// A face or a piece of one as the part has it; none of a mesh. Throws UsageError as of() does.
  [[nodiscard]] std::optional<Face> face(const std::string& name) const;
  /// Gives their memory back.
  void forget() { known_.clear(); }

 private:
  [[nodiscard]] std::unique_ptr<Target> make(const std::string& name, const Eigen::Isometry3d& turn) const;
  const Part& part_;
  std::map<std::pair<std::string, int>, std::unique_ptr<Target>> known_;  ///< by name and turns
};

}  // namespace flank::internal

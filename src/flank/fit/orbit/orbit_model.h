/// What a tool sweeps that goes with a motion along a target which that motion moves into itself. All places of an orbit
/// are alike, so one place of each tells all, and a strip is not a motion but a line: five unknowns instead of hundreds.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flank/fit.h"
#include "flank/seed/self_motion.h"

namespace flank::internal {

/// An orbit, by one of its points.
struct OrbitPlace {
  Vec3 point = Vec3::Zero();
  double share = 0.0;  ///< of the target, in [0, 1]; all together 1
  bool touch = true;   ///< to be touched; false: out of reach, and only not to be cut
};

/// Where the tool on one of the lines is nearest to an orbit.
struct OrbitContact {
  int line = -1;
  double time = 0.0, s = 0.0;    ///< of the place's motion; mm along the axis
  double f = 0.0;                ///< swept distance, mm; negative: cut
  Vec3 to_axis = Vec3::UnitZ();  ///< unit vector from the moved place to the axis
};

struct OrbitState {
  std::vector<Pose> lines;  ///< where each strip's axis is at time 0
  RadialFunction tool;
  std::vector<OrbitContact> contacts;  ///< of each place, by the last locate
};

/// One pass, in numbers; see FitStage for what they mean.
struct OrbitPass {
  double robust_scale_mm = 0.0, dead_zone_mm = 0.0, overcut_weight = 1.0;
  int iterations = 20;
};

/// Of the tool: what may change, between which bounds, its length, and how far from its place on an orbit it may touch that.
struct OrbitTool {
  std::vector<int> free_parameters;
  RadiusBounds bounds;
  double axis_length_mm = 0.0;
  double reach_mm = 0.0;
};

/// Immutable after construction; obstacles are not owned.
class OrbitModel {
 public:
  /// Obstacles (null: none) are asked at these times of the lines.
  OrbitModel(const SelfMotion& motion, std::vector<OrbitPlace> places, const OrbitTool& tool,
             const ObstacleField* obstacles, std::vector<double> times);
  ~OrbitModel();

  void locate(OrbitState& state) const;
  [[nodiscard]] std::vector<double> weights(const OrbitState& state, const OrbitPass& pass) const;
  [[nodiscard]] double cost(const OrbitState& state, const OrbitPass& pass, const std::vector<double>& weights) const;
  /// The unknowns: of each line its shifts along e1, e2 and the axis and its turns by e1, e2, all in mm at the ends, then
  /// the tool's. Gauss-Newton's matrix and gradient of half the cost.
  struct System {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd gradient;
  };
  [[nodiscard]] System assemble(const OrbitState& state, const OrbitPass& pass,
                                const std::vector<double>& weights) const;
  [[nodiscard]] OrbitState moved(const OrbitState& state, const Eigen::VectorXd& step) const;
  [[nodiscard]] const std::vector<OrbitPlace>& places() const { return places_; }

 private:
  static constexpr int kTimes = 25;  ///< of an orbit, to find where it is nearest to a line
  struct Orbit;
  struct Row;
  /// The nearest place of one line's tool, from one nearby.
  [[nodiscard]] OrbitContact contact_on(const OrbitState& state, int line, std::size_t place, double time,
                                        double s) const;
  [[nodiscard]] Row row(const OrbitState& state, int line, double s, const Vec3& normal) const;
  void add(const Row& row, double weight, double pull, System& system) const;
  void add_tool_terms(const RadialFunction& tool, System& system) const;
  template <class Visit>
  void visit_obstacles(const OrbitState& state, const Visit& visit) const;

  SelfMotion motion_;
  std::vector<OrbitPlace> places_;
  std::vector<int> free_;
  RadiusBounds bounds_;
  const ObstacleField* obstacles_;
  std::vector<double> times_;
  std::vector<double> along_;  ///< places along the axis at which bounds and obstacles are asked, mm
  std::vector<Orbit> orbits_;  ///< of each place
};

/// Levenberg-Marquardt on the model, reweighted at every step; never worse than the start under the weights of each.
[[nodiscard]] OrbitState minimised(const OrbitModel& model, OrbitState start, const OrbitPass& pass);

}  // namespace flank::internal

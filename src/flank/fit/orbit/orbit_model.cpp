#include "flank/fit/orbit/orbit_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "flank/base/stopping.h"
#include "flank/fit/model/tool_excess.h"

namespace flank::internal {
namespace {

/// Places along the axis at which bounds and obstacles are asked.
constexpr int kPlaces = 31;
/// Weights against 1 for the residuals: as in the passes that follow (tool_terms.cpp, FitStage::clear_weight).
constexpr double kBoundWeight = 10.0, kClearWeight = 30.0, kToolFairness = 1e-4;
constexpr int kLineUnknowns = 5;

std::vector<double> places_along(double length) {
  std::vector<double> s;
  for (int j = 0; j < kPlaces; ++j) s.push_back(length * j / (kPlaces - 1.0));
  return s;
}

/// A sphere of the tool, and how far a point is from it.
struct NearSphere {
  double s = 0.0, f = 0.0;
};

/// A point as a line sees it: where its foot is on the axis, and the square of how far it is from there.
struct Seen {
  double s0 = 0.0, square = 0.0;
  Seen(const Pose& line, const Vec3& p)
      : s0((p - line.tip).dot(line.axis)), square(std::max(0.0, (p - line.tip).squaredNorm() - s0 * s0)) {}
  [[nodiscard]] double distance(double s) const { return std::sqrt(square + (s - s0) * (s - s0)); }
};

/// The sphere that is nearest to p, by Newton's method on (s - s0) / d = r' from a sphere nearby.
NearSphere near_sphere(const Pose& line, const RadialFunction& tool, const Vec3& p, double s, int steps) {
  const double length = tool.axis_length();
  const Seen seen(line, p);
  for (int k = 0; k < steps; ++k) {
    const RadialJet jet = tool.at(s);
    const double d = seen.distance(s);
    if (d == 0.0) break;
    const double slope = (s - seen.s0) / d - jet.d1, bend = seen.square / (d * d * d) - jet.d2;
    // Where it is not convex, no step is too long that leads downhill.
    const double step = bend > 0.0 ? slope / bend : std::copysign(0.1 * length, slope);
    const double next = std::clamp(s - step, 0.0, length);
    if (std::abs(next - s) < 1e-9 * length) break;
    s = next;
  }
  return {s, seen.distance(s) - tool.at(s).r};
}

/// The tool's cones at equal steps of the axis: near enough to tell in which part of the motion a place meets the tool.
class Cones {
 public:
  explicit Cones(const RadialFunction& tool) : step_(tool.axis_length() / kCells) {
    for (int j = 0; j <= kCells; ++j) {
      const RadialJet jet = tool.at(j * step_);
      const double slope = std::clamp(jet.d1, -kSteepest, kSteepest);
      cones_[static_cast<std::size_t>(j)] = {jet.r, slope / std::sqrt(1.0 - slope * slope)};
    }
  }
  [[nodiscard]] NearSphere near(const Pose& line, const Vec3& p) const {
    const Seen seen(line, p);
    const double s = clamped(seen.s0 + std::sqrt(seen.square) * at(clamped(seen.s0)).tangent);
    return {s, seen.distance(s) - at(s).radius};
  }

 private:
  static constexpr int kCells = 64;
  static constexpr double kSteepest = 0.95;
  struct Cone {
    double radius = 0.0, tangent = 0.0;
  };
  [[nodiscard]] double clamped(double s) const { return std::clamp(s, 0.0, kCells * step_); }
  [[nodiscard]] Cone at(double s) const {
    const double x = s / step_;
    const auto j = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kCells - 1));
    const double f = x - static_cast<double>(j);
    const Cone &a = cones_[j], &b = cones_[j + 1];
    return {(1.0 - f) * a.radius + f * b.radius, (1.0 - f) * a.tangent + f * b.tangent};
  }

  double step_;
  std::array<Cone, kCells + 1> cones_;
};

/// The residual with its dead zone cut out.
double cut(double f, double dead_zone) { return f > 0.0 ? std::max(0.0, f - dead_zone) : std::min(0.0, f + dead_zone); }

double residual(const OrbitPlace& place, double f, const OrbitPass& pass) {
  return place.touch || f < 0.0 ? cut(f, pass.dead_zone_mm) : 0.0;
}

}  // namespace

/// A derivative: five of one line's coordinates, and the tool's.
struct OrbitModel::Row {
  int line = 0;
  Eigen::Matrix<double, kLineUnknowns, 1> pose;
  Eigen::VectorXd tool;
};

/// Moved places of one orbit, at equal steps of time.
struct OrbitModel::Orbit {
  double first = 0.0, step = 0.0;
  std::array<Vec3, kTimes> points;
};

OrbitModel::OrbitModel(const SelfMotion& motion, std::vector<OrbitPlace> places, const OrbitTool& tool,
                       const ObstacleField* obstacles, std::vector<double> times)
    : motion_(motion),
      places_(std::move(places)),
      free_(tool.free_parameters),
      bounds_(tool.bounds),
      obstacles_(obstacles),
      times_(std::move(times)),
      along_(places_along(tool.axis_length_mm)) {
  for (const OrbitPlace& place : places_) {
    const double speed = motion_.velocity(place.point).norm(), turn = motion_.turn.norm();
    double window = tool.reach_mm / speed;
    if (turn > 0.0) window = std::min(window, 0.9 * std::numbers::pi / turn);
    Orbit orbit{-window, 2.0 * window / (kTimes - 1), {}};
    for (int m = 0; m < kTimes; ++m)
      orbit.points[static_cast<std::size_t>(m)] = motion_.moved(place.point, orbit.first + m * orbit.step);
    orbits_.push_back(orbit);
  }
}

OrbitModel::~OrbitModel() = default;

OrbitContact OrbitModel::contact_on(const OrbitState& state, int line, std::size_t place, double time, double s) const {
  constexpr int kBisections = 12, kSteps = 3, kLastSteps = 6;
  const Pose& axis = state.lines[static_cast<std::size_t>(line)];
  // Nearer as long as the place moves towards the sphere: the sign of the speed tells on which side the nearest is.
  double low = time - orbits_[place].step, high = time + orbits_[place].step;
  double speed_low = 0.0, speed_high = 0.0;
  for (int k = 0; k < kBisections; ++k) {
    // Once both ends are known the secant is nearer than the middle, which keeps it from an end that stays.
    const bool secant = k % 3 != 2 && speed_low > 0.0 && speed_high < 0.0;
    time = secant ? low + (high - low) * speed_low / (speed_low - speed_high) : 0.5 * (low + high);
    const Vec3 p = motion_.moved(places_[place].point, time);
    s = near_sphere(axis, state.tool, p, s, kSteps).s;
    const Vec3 to_axis = axis.at(s) - p;
    const double speed = to_axis.dot(motion_.velocity(p)) / to_axis.norm();
    (speed > 0.0 ? low : high) = time;
    (speed > 0.0 ? speed_low : speed_high) = speed;
  }
  const Vec3 p = motion_.moved(places_[place].point, time);
  const NearSphere sphere = near_sphere(axis, state.tool, p, s, kLastSteps);
  return {line, time, sphere.s, sphere.f, (axis.at(sphere.s) - p).normalized()};
}

void OrbitModel::locate(OrbitState& state) const {
  constexpr double kClose =
      0.1;  // of the axis: whose cone is farther than the nearest line's by more is not the nearest
  const Cones cones(state.tool);
  state.contacts.resize(places_.size());
  std::vector<OrbitContact> rough(state.lines.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < state.lines.size(); ++i) {
      rough[i].f = std::numeric_limits<double>::infinity();
      for (int m = 0; m < kTimes; ++m) {
        const NearSphere sphere = cones.near(state.lines[i], orbits_[k].points[static_cast<std::size_t>(m)]);
        if (sphere.f < rough[i].f)
          rough[i] = {static_cast<int>(i), orbits_[k].first + m * orbits_[k].step, sphere.s, sphere.f, Vec3::UnitZ()};
      }
      least = std::min(least, rough[i].f);
    }
    OrbitContact best;
    for (std::size_t i = 0; i < state.lines.size(); ++i) {
      if (!(rough[i].f <= least + kClose * state.tool.axis_length())) continue;
      const OrbitContact contact = contact_on(state, static_cast<int>(i), k, rough[i].time, rough[i].s);
      if (best.line < 0 || contact.f < best.f) best = contact;
    }
    state.contacts[k] = best;
  }
}

std::vector<double> OrbitModel::weights(const OrbitState& state, const OrbitPass& pass) const {
  std::vector<double> weights(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double f = state.contacts[k].f, scale = pass.robust_scale_mm;
    weights[k] = places_[k].share;
    if (f < 0.0) weights[k] *= pass.overcut_weight;
    // Geman-McClure, on material left alone: deep overcut must never become an outlier.
    if (f > 0.0 && scale > 0.0) weights[k] /= std::pow(1.0 + f * f / (scale * scale), 2);
  }
  return weights;
}

template <class Visit>
void OrbitModel::visit_obstacles(const OrbitState& state, const Visit& visit) const {
  if (obstacles_ == nullptr) return;
  const double share = kClearWeight / static_cast<double>(kPlaces * times_.size() * state.lines.size());
  for (std::size_t i = 0; i < state.lines.size(); ++i)
    for (double time : times_)
      for (double s : along_) {
        const double r = state.tool.at(s).r;
        const ObstacleDistance to = obstacles_->interpolated(motion_.moved(state.lines[i].at(s), time), 2.0 * r);
        const double deep = r - to.distance_mm - obstacles_->allowance_mm();
        if (deep > 0.0) visit(static_cast<int>(i), s, motion_.turned(to.gradient, -time), deep, share);
      }
}

double OrbitModel::cost(const OrbitState& state, const OrbitPass& pass, const std::vector<double>& weights) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double e = residual(places_[k], state.contacts[k].f, pass);
    sum += weights[k] * e * e;
  }
  visit_obstacles(state, [&](int, double, const Vec3&, double deep, double share) { sum += share * deep * deep; });
  if (free_.empty()) return sum;
  sum += kBoundWeight * tool_excess_square(state.tool, bounds_, along_);
  if (state.tool.family() != ToolFamily::kSpline) return sum;
  const Eigen::VectorXd& r = state.tool.parameters();
  for (int k = 1; k + 1 < r.size(); ++k) sum += kToolFairness * std::pow(r[k - 1] - 2.0 * r[k] + r[k + 1], 2);
  return sum;
}

OrbitModel::Row OrbitModel::row(const OrbitState& state, int line, double s, const Vec3& normal) const {
  const Pose& pose = state.lines[static_cast<std::size_t>(line)];
  const Vec3 e1 = pose.axis.unitOrthogonal(), e2 = pose.axis.cross(e1);
  const double length = state.tool.axis_length(), rho = 2.0 * s / length - 1.0;
  Row row;
  row.line = line;
  row.pose << normal.dot(e1), normal.dot(e2), normal.dot(pose.axis), rho * normal.dot(e1), rho * normal.dot(e2);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(state.tool.parameter_count());
  state.tool.gradient(s, all.data());
  row.tool = -all(free_);
  return row;
}

void OrbitModel::add(const Row& row, double weight, double pull, System& system) const {
  const auto at = static_cast<Eigen::Index>(kLineUnknowns * row.line), count = row.tool.size();
  const Eigen::Index tool = system.gradient.size() - count;
  system.matrix.block<kLineUnknowns, kLineUnknowns>(at, at) += weight * row.pose * row.pose.transpose();
  system.matrix.block(tool, at, count, kLineUnknowns) += weight * row.tool * row.pose.transpose();
  system.matrix.block(tool, tool, count, count) += weight * row.tool * row.tool.transpose();
  system.gradient.segment<kLineUnknowns>(at) += pull * row.pose;
  system.gradient.tail(count) += pull * row.tool;
}

void OrbitModel::add_tool_terms(const RadialFunction& tool, System& system) const {
  if (free_.empty()) return;
  const auto count = static_cast<Eigen::Index>(free_.size());
  auto matrix = system.matrix.bottomRightCorner(count, count);
  auto gradient = system.gradient.tail(count);
  for (const ToolExcess& excess : tool_excesses(tool, bounds_, along_)) {
    const Eigen::VectorXd row = excess.gradient(free_);
    matrix += (kBoundWeight * excess.share) * row * row.transpose();
    gradient += (kBoundWeight * excess.share * excess.mm) * row;
  }
  if (tool.family() != ToolFamily::kSpline) return;
  const Eigen::VectorXd& r = tool.parameters();
  const Eigen::Vector3d second(1.0, -2.0, 1.0);
  for (Eigen::Index k = 1; k + 1 < count; ++k) {
    matrix.block<3, 3>(k - 1, k - 1) += kToolFairness * second * second.transpose();
    gradient.segment<3>(k - 1) += kToolFairness * second.dot(r.segment<3>(k - 1)) * second;
  }
}

OrbitModel::System OrbitModel::assemble(const OrbitState& state, const OrbitPass& pass,
                                        const std::vector<double>& weights) const {
  /// A place in its dead zone holds the step by this share of its weight, and pulls nowhere.
  constexpr double kDeadZoneDamping = 0.02;
  const auto unknowns = static_cast<Eigen::Index>(kLineUnknowns * state.lines.size() + free_.size());
  System system{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const OrbitContact& contact = state.contacts[k];
    const double e = residual(places_[k], contact.f, pass);
    if (e == 0.0 && !places_[k].touch) continue;
    add(row(state, contact.line, contact.s, contact.to_axis), e == 0.0 ? kDeadZoneDamping * weights[k] : weights[k],
        weights[k] * e, system);
  }
  visit_obstacles(state, [&](int line, double s, const Vec3& away, double deep, double share) {
    // Less deep as the axis goes away, deeper as the ball grows: the residual's derivative with its sign turned.
    add(row(state, line, s, away), share, -share * deep, system);
  });
  add_tool_terms(state.tool, system);
  system.matrix.triangularView<Eigen::StrictlyUpper>() = system.matrix.transpose();
  return system;
}

OrbitState OrbitModel::moved(const OrbitState& state, const Eigen::VectorXd& step) const {
  OrbitState next = state;
  const double half = 0.5 * state.tool.axis_length();
  for (std::size_t i = 0; i < next.lines.size(); ++i) {
    const auto x = step.segment<kLineUnknowns>(static_cast<Eigen::Index>(kLineUnknowns * i));
    Pose& line = next.lines[i];
    const Vec3 e1 = line.axis.unitOrthogonal(), e2 = line.axis.cross(e1);
    const Vec3 middle = line.at(half) + x[0] * e1 + x[1] * e2 + x[2] * line.axis;
    line.axis = (line.axis + (x[3] * e1 + x[4] * e2) / half).normalized();
    line.tip = middle - half * line.axis;
  }
  Eigen::VectorXd parameters = state.tool.parameters();
  for (std::size_t j = 0; j < free_.size(); ++j)
    parameters[free_[j]] += step[static_cast<Eigen::Index>(kLineUnknowns * state.lines.size() + j)];
  next.tool = state.tool.with_parameters(parameters);
  return next;
}

OrbitState minimised(const OrbitModel& model, OrbitState state, const OrbitPass& pass) {
  constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-9, kMostDamping = 1e6, kMore = 10.0, kLess = 0.2;
  constexpr double kOpen = 1e-6;  // of the mean diagonal: what nothing determines stays where it is
  constexpr double kEnd = 1e-4;   // of the cost: a pass that gains less is over
  model.locate(state);
  double damping = kFirstDamping;
  for (int iteration = 0; iteration < pass.iterations && !stopping(); ++iteration) {
    const std::vector<double> weights = model.weights(state, pass);
    const double cost = model.cost(state, pass, weights);
    if (!std::isfinite(cost) || cost == 0.0) break;
    const OrbitModel::System system = model.assemble(state, pass, weights);
    const Eigen::VectorXd diagonal = system.matrix.diagonal();
    double gained = 0.0;
    for (; damping <= kMostDamping; damping *= kMore) {
      Eigen::MatrixXd damped = system.matrix;
      damped.diagonal() += damping * diagonal + Eigen::VectorXd::Constant(diagonal.size(), kOpen * diagonal.mean());
      OrbitState trial = model.moved(state, -damped.ldlt().solve(system.gradient));
      model.locate(trial);
      const double next = model.cost(trial, pass, weights);
      if (!(next < cost)) continue;
      gained = cost - next;
      state = std::move(trial);
      damping = std::max(kLess * damping, kLeastDamping);
      break;
    }
    if (gained < kEnd * cost) break;
  }
  return state;
}

}  // namespace flank::internal

#include "flank/fit/model/swept_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/work_count.h"
#include "flank/bspline_basis.h"

namespace flank::internal {
namespace {

/// Poses tabulated for each control point of a rail to find the nearest place, which is then refined continuously:
/// enough to see every wave that the rails can make.
constexpr int kPosesPerControlPoint = 4;
/// Points that one task of the parallel search takes: a point costs microseconds, a task must not.
constexpr std::size_t kChunk = 64;
/// What a point costs, in footpoints (work_count.h).
constexpr std::uint64_t kLooks = 4;

/// The residual with its dead zone cut out. Not a number stays what it is: a state without a value must not be cheap.
double cut(double e, double dead_zone) {
  if (std::isnan(e)) return e;
  return e > 0.0 ? std::max(0.0, e - dead_zone) : std::min(0.0, e + dead_zone);
}

/// Where nothing of the swept tool has a distance.
SweptContact no_contact() {
  SweptContact contact;
  contact.f = std::numeric_limits<double>::quiet_NaN();
  return contact;
}

}  // namespace

SweptModel::SweptModel(std::vector<FacePoint> points, std::vector<const Target*> targets, const FitState& start,
                       std::vector<int> free_parameters, const RadiusBounds& bounds, const FitStage& stage,
                       std::vector<const ObstacleField*> obstacles)
    : points_(std::move(points)),
      base_(std::move(targets), start, free_parameters, bounds, stage, std::move(obstacles)),
      free_(std::move(free_parameters)),
      axis_length_(start.motions.front().axis_length) {}

void SweptModel::locate(FitState& state) const {
  base_.locate_obstacles(state);  // of the base model only this: it has no residuals here, so it needs no footpoints
  const SweptEstimate swept(state.motions, state.tool, kPosesPerControlPoint * stage().control_points);
  state.contacts.resize(points_.size());
  count_work(points_.size() * kLooks);
  parallel_blocks(points_.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<SweptContact> places;
    for (std::size_t k = begin; k < end; ++k) {
      SweptContact& contact = state.contacts[k];
      swept.places(points_[k].point, contact, places);
      // Rails or radii without a value are near to nothing: then f has no value, and neither has the cost. To keep the
      // last contact would be to look up the place of another state, or of none.
      if (places.empty()) contact = no_contact();
      for (std::size_t i = 0; i < places.size(); ++i) {
        // f is the least over all places: every one that might be it is refined before they are compared.
        const SweptContact refined = swept.refine(points_[k].point, places[i]);
        if (i == 0 || refined.f < contact.f) contact = refined;
      }
    }
  });
}

double SweptModel::residual(const FitState& state, std::size_t k) const {
  const double f = state.contacts[k].f;
  if (points_[k].one_sided() && !std::isnan(f)) return std::min(0.0, f - points_[k].margin_mm);
  return cut(f, stage().dead_zone_mm);
}

std::vector<double> SweptModel::sample_weights(const FitState& state) const {
  std::vector<double> weights(points_.size());
  const double scale = stage().robust_scale_mm;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    double w = points_[k].share;
    const double f = state.contacts[k].f;
    if (!points_[k].one_sided()) {
      if (f < 0.0) w *= stage().overcut_weight;
      // Geman-McClure, on material left alone: deep overcut must never become an outlier.
      if (f > 0.0 && scale > 0.0) w /= std::pow(1.0 + f * f / (scale * scale), 2);
    }
    weights[k] = w;
  }
  return weights;
}

double SweptModel::cost(const FitState& state, const std::vector<double>& weights) const {
  FLANK_ASSERT(weights.size() == points_.size() && state.contacts.size() == points_.size());
  double sum = base_.regulariser_cost(state);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double e = residual(state, k);
    sum += weights[k] * e * e;
  }
  return sum;
}

ResidualRow SweptModel::row(const FitState& state, std::size_t k) const {
  FLANK_ASSERT(k < state.contacts.size());
  const SweptContact& contact = state.contacts[k];
  FLANK_ASSERT(contact.motion >= 0 && std::isfinite(contact.t) && std::isfinite(contact.s));
  const RuledMotion& motion = state.motions[static_cast<std::size_t>(contact.motion)];
  ResidualRow row;
  row.motion = contact.motion;
  const int span = find_span(3, motion.tip.knots, contact.t);
  row.first = span - 3;
  basis_derivatives(3, motion.tip.knots, span, contact.t, 0, row.basis.data());
  Vec3 w = Vec3::Zero();
  for (int j = 0; j < 4; ++j) w += row.basis[j] * motion.direction.poles.col(row.first + j);
  const double length = w.norm();
  const Vec3 u = w / length, n = contact.to_axis;
  row.pose << n, (contact.s / (axis_length_ * length)) * (n - n.dot(u) * u);
  if (free_.empty()) return row;
  // A spline: its four active coefficients. A family: its free parameters, of at most four.
  if (state.tool.family() == ToolFamily::kSpline) {
    row.tool_first = state.tool.first_active(contact.s);
    row.tool_count = 4;
    state.tool.active_gradient(contact.s, row.tool.data());
  } else {
    std::array<double, 4> all{};
    state.tool.gradient(contact.s, all.data());
    row.tool_count = static_cast<int>(free_.size());
    for (int j = 0; j < row.tool_count; ++j) row.tool[j] = all[free_[static_cast<std::size_t>(j)]];
  }
  for (double& x : row.tool) x = -x;  // f = |x - R| - r
  return row;
}

void SweptModel::assemble(const FitState& state, const std::vector<double>& weights, ArrowSystem& system) const {
  FLANK_ASSERT(weights.size() == points_.size() && state.contacts.size() == points_.size());
  /// Share of its weight that a point inside the dead zone keeps in the matrix: it holds the step, and pulls nowhere.
  constexpr double kDeadZoneDamping = 0.02;
  system.clear();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double e = residual(state, k);
    // A limit that holds is none: it must not even damp. A point in its dead zone does.
    if (e == 0.0 && points_[k].one_sided()) continue;
    system.add_row(row(state, k), e == 0.0 ? kDeadZoneDamping * weights[k] : weights[k], weights[k] * e);
  }
  base_.assemble_regularisers(state, system);
}

ResidualSummary summarise_residuals(const SweptModel& model, const FitState& state) {
  ResidualSummary summary;
  double squares = 0.0, shares = 0.0;
  for (std::size_t k = 0; k < model.points().size(); ++k) {
    const FacePoint& point = model.points()[k];
    if (point.one_sided()) continue;
    const double f = state.contacts[k].f;
    squares += point.share * f * f;
    shares += point.share;
    summary.largest_mm = std::max(summary.largest_mm, std::abs(f));
    summary.largest_overcut_mm = std::max(summary.largest_overcut_mm, -f);
  }
  if (shares > 0.0) summary.rms_mm = std::sqrt(squares / shares);
  summary.inside_share = 1.0;
  return summary;
}

}  // namespace flank::internal

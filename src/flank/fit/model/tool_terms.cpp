#include "flank/fit/model/tool_terms.h"

#include <array>

#include "flank/fit/model/tool_excess.h"

namespace flank::internal {
namespace {

/// Weight of the one-sided terms (tool_excess.h) that keep the tool inside its bounds, against 1 for the residuals: a
/// bound is broken by a tenth of the error that breaking it would save. Radii that are left out of bounds are clamped at
/// the end (clamp_tool); slenderness and neck are held a little inside theirs.
constexpr double kBoundWeight = 10.0;

}  // namespace

ToolTerms::ToolTerms(const RadialFunction& start, std::vector<int> free_parameters, const RadiusBounds& bounds,
                     const FitStage& stage, const std::vector<double>& s)
    : free_(std::move(free_parameters)),
      bounds_(bounds),
      stage_(stage),
      s_(s),
      bound_places_(stage.bounds_at_knots ? bound_places(start, s) : s) {
  for (const double place : s_) start_radius_.push_back(start.at(place).r);
}

Eigen::VectorXd ToolTerms::gradient(const RadialFunction& tool, double s) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(tool.parameter_count());
  tool.gradient(s, all.data());
  return all(free_);
}

Eigen::MatrixXd ToolTerms::gradients(const RadialFunction& tool) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(free_count(), static_cast<Eigen::Index>(s_.size()));
  if (free_.empty()) return all;
  for (std::size_t j = 0; j < s_.size(); ++j) all.col(static_cast<Eigen::Index>(j)) = gradient(tool, s_[j]);
  return all;
}

void ToolTerms::assemble(const RadialFunction& tool, ArrowSystem& system) const {
  if (free_.empty()) return;
  const int n = stage_.samples_s;
  const Eigen::MatrixXd b = gradients(tool);
  auto tail = system.gradient.tail(free_count());
  for (int j = 0; j < n; ++j) {
    const double drift = tool.at(s_[j]).r - start_radius_[j];
    system.tool_matrix += (stage_.radius_pin / n) * b.col(j) * b.col(j).transpose();
    tail += (stage_.radius_pin / n) * drift * b.col(j);
  }
  for (const ToolExcess& excess : tool_excesses(tool, bounds_, bound_places_)) {
    const Eigen::VectorXd row = excess.gradient(free_);
    system.tool_matrix += (kBoundWeight * excess.share) * row * row.transpose();
    tail += (kBoundWeight * excess.share * excess.mm) * row;
  }
  // Second differences of a spline's coefficients; a family has nothing that could wave.
  if (tool.family() != ToolFamily::kSpline) return;
  const Eigen::VectorXd& r = tool.parameters();
  for (int k = 1; k + 1 < free_count(); ++k) {
    const double e = r[k - 1] - 2.0 * r[k] + r[k + 1];
    const std::array<double, 3> d = {1.0, -2.0, 1.0};
    for (int p = 0; p < 3; ++p) {
      tail[k - 1 + p] += stage_.tool_fairness * e * d[p];
      for (int q = 0; q < 3; ++q) system.tool_matrix(k - 1 + p, k - 1 + q) += stage_.tool_fairness * d[p] * d[q];
    }
  }
}

double ToolTerms::cost(const RadialFunction& tool) const {
  if (free_.empty()) return 0.0;
  double sum = kBoundWeight * tool_excess_square(tool, bounds_, bound_places_);
  for (std::size_t j = 0; j < s_.size(); ++j) {
    const double drift = tool.at(s_[j]).r - start_radius_[j];
    sum += stage_.radius_pin * drift * drift / stage_.samples_s;
  }
  if (tool.family() != ToolFamily::kSpline) return sum;
  const Eigen::VectorXd& r = tool.parameters();
  for (int k = 1; k + 1 < free_count(); ++k) {
    const double e = r[k - 1] - 2.0 * r[k] + r[k + 1];
    sum += stage_.tool_fairness * e * e;
  }
  return sum;
}

}  // namespace flank::internal

#include "flank/fit/solver/arrow_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {

ArrowSystem::ArrowSystem(const std::vector<int>& control_counts, int tool_parameters)
    : tool_parameters_(tool_parameters) {
  FLANK_ASSERT(tool_parameters >= 0);
  int offset = 0;
  for (int count : control_counts) {
    offsets_.push_back(offset);
    offset += 6 * count;  // tip and scaled direction
  }
  offsets_.push_back(offset);
  clear();
}

void ArrowSystem::clear() {
  const int motions = offsets_.back();
  band_.assign(static_cast<std::size_t>(motions * kBand), 0.0);
  border_.setZero(motions, tool_parameters_);
  tool_matrix.setZero(tool_parameters_, tool_parameters_);
  gradient.setZero(size());
}

void ArrowSystem::add_pose(int motion, int first, const double* basis, const PoseTerms& terms, bool couples_tool) {
  FLANK_ASSERT(motion >= 0 && static_cast<std::size_t>(motion) + 1 < offsets_.size());
  FLANK_ASSERT(first >= 0 && motion_offset(motion) + 6 * (first + 4) <= motion_offset(motion + 1));
  FLANK_ASSERT(!couples_tool || terms.coupling.cols() == tool_parameters_);
  const int base = motion_offset(motion) + 6 * first;
  // Block (k, l) of the lower triangle is basis[k] basis[l] times the 6 x 6 matrix; of diagonal blocks the lower half.
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l <= k; ++l) {
      const double weight = basis[k] * basis[l];
      for (int c = 0; c < 6; ++c) {
        const int column = base + 6 * l + c;
        // Row r of a column is at its start + (r - column): columns are stored from their diagonal down.
        double* to = band_.data() + column * kBand - column + base + 6 * k;
        for (int r = k == l ? c : 0; r < 6; ++r) to[r] += weight * terms.matrix(r, c);
      }
    }
    gradient.segment<6>(base + 6 * k) += basis[k] * terms.gradient;
    if (couples_tool) border_.middleRows<6>(base + 6 * k) += basis[k] * terms.coupling;
  }
}

bool ArrowSystem::fits(const ResidualRow& row) const {
  if (row.motion < 0 || static_cast<std::size_t>(row.motion) + 1 >= offsets_.size() || row.first < 0) return false;
  return motion_offset(row.motion) + 6 * (row.first + 4) <= motion_offset(row.motion + 1) && row.tool_first >= 0 &&
         row.tool_count >= 0 && row.tool_count <= 4 && row.tool_first + row.tool_count <= tool_parameters_;
}

void ArrowSystem::add_row(const ResidualRow& row, double weight, double factor) {
  FLANK_ASSERT(fits(row));
  // The row is (basis[0] pose, ..., basis[3] pose | tool): 24 entries in the band, tool_count in the border. This is
  // the inner loop of the swept passes, hence the outer product written out.
  const int base = motion_offset(row.motion) + 6 * row.first;
  const int tool = tool_offset() + row.tool_first;
  for (int l = 0; l < 4; ++l) {
    for (int c = 0; c < 6; ++c) {
      const int column = base + 6 * l + c;
      const double value = row.basis[l] * row.pose[c], weighted = weight * value;
      gradient[column] += factor * value;
      for (int k = 0; k < row.tool_count; ++k) border_(column, row.tool_first + k) += weighted * row.tool[k];
      double* to = band_.data() + column * kBand - column + base;
      for (int r = 6 * l + c; r < 6 * (l + 1); ++r) to[r] += weighted * row.basis[l] * row.pose[r - 6 * l];
      for (int k = l + 1; k < 4; ++k)
        for (int r = 0; r < 6; ++r) to[6 * k + r] += weighted * row.basis[k] * row.pose[r];
    }
  }
  for (int k = 0; k < row.tool_count; ++k) {
    gradient[tool + k] += factor * row.tool[k];
    for (int l = 0; l < row.tool_count; ++l)
      tool_matrix(row.tool_first + k, row.tool_first + l) += weight * row.tool[k] * row.tool[l];
  }
}

double ArrowSystem::product(const ResidualRow& row, const Eigen::VectorXd& x) const {
  FLANK_ASSERT(fits(row) && x.size() == size());
  const int base = motion_offset(row.motion) + 6 * row.first;
  double sum = 0.0;
  for (int l = 0; l < 4; ++l) sum += row.basis[l] * row.pose.dot(x.segment<6>(base + 6 * l));
  for (int k = 0; k < row.tool_count; ++k) sum += row.tool[k] * x[tool_offset() + row.tool_first + k];
  return sum;
}

double ArrowSystem::mean_diagonal(int first, int last) const {
  double trace = 0.0;
  for (int c = first; c < last; ++c) trace += band_[static_cast<std::size_t>(c * kBand)];
  return trace / std::max(1, last - first);
}

void ArrowSystem::add_damping(double damping) {
  FLANK_ASSERT(damping >= 0.0);
  for (std::size_t m = 0; m + 1 < offsets_.size(); ++m) {
    const double added = damping * mean_diagonal(offsets_[m], offsets_[m + 1]);
    for (int c = offsets_[m]; c < offsets_[m + 1]; ++c) band_[static_cast<std::size_t>(c * kBand)] += added;
  }
  tool_matrix.diagonal() *= 1.0 + damping;
}

bool ArrowSystem::solve(double damping, Eigen::VectorXd& step) const {
  FLANK_ASSERT(damping >= 0.0);
  const int n = offsets_.back();
  std::vector<double> factor = band_;
  for (std::size_t m = 0; m + 1 < offsets_.size(); ++m) {
    const double added = damping * mean_diagonal(offsets_[m], offsets_[m + 1]);
    for (int c = offsets_[m]; c < offsets_[m + 1]; ++c) factor[static_cast<std::size_t>(c * kBand)] += added;
  }
  // Banded Cholesky, column by column. Motions need no loop of their own: entries that would couple the last control
  // points of one with the first of the next are zero and stay zero.
  for (int c = 0; c < n; ++c) {
    double* column = factor.data() + c * kBand;
    if (!(column[0] > 0.0)) return false;
    const int rows = std::min(kBand, n - c);
    const double inverse = 1.0 / std::sqrt(column[0]);
    for (int r = 0; r < rows; ++r) column[r] *= inverse;
    for (int k = 1; k < rows; ++k) {
      const double value = column[k];
      if (value == 0.0) continue;  // as beyond the end of a motion
      double* to = factor.data() + (c + k) * kBand;
      for (int r = k; r < rows; ++r) to[r - k] -= value * column[r];
    }
  }
  // Forward substitution of the gradient and the border together: y = L^-1 [C, g]. By rows, so that one pass over the
  // factor serves all columns.
  const int k = tool_parameters_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> y(n, k + 1);
  y.leftCols(k) = border_;
  y.col(k) = gradient.head(n);
  for (int c = 0; c < n; ++c) {
    const double* column = factor.data() + c * kBand;
    y.row(c) /= column[0];
    const int rows = std::min(kBand, n - c);
    for (int r = 1; r < rows; ++r)
      if (column[r] != 0.0) y.row(c + r) -= column[r] * y.row(c);
  }
  // Schur complement of the tool: (T - C' H^-1 C) tool_step = -(g_tool - C' H^-1 g).
  step.resize(size());
  Eigen::VectorXd tool_step(k);
  if (k > 0) {
    Eigen::MatrixXd schur = tool_matrix - y.leftCols(k).transpose() * y.leftCols(k);
    // A parameter that no residual sees (a coefficient past the last footpoint that counts) has a zero row: kTiny keeps
    // it at a zero step instead of a failed factorisation.
    constexpr double kTiny = 1e-300;
    for (int i = 0; i < k; ++i) schur(i, i) += damping * tool_matrix(i, i) + kTiny;
    const Eigen::VectorXd rhs = gradient.tail(k) - y.leftCols(k).transpose() * y.col(k);
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(schur);
    if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return false;
    tool_step = -ldlt.solve(rhs);
    step.tail(k) = tool_step;
  }
  // Backward substitution with what the tool has taken: L' x = -(y_g + y_C tool_step).
  Eigen::VectorXd x = -y.col(k);
  if (k > 0) x -= y.leftCols(k) * tool_step;
  for (int c = n - 1; c >= 0; --c) {
    const double* column = factor.data() + c * kBand;
    const int rows = std::min(kBand, n - c);
    double sum = x[c];
    for (int r = 1; r < rows; ++r) sum -= column[r] * x[c + r];
    x[c] = sum / column[0];
  }
  step.head(n) = x;
  return step.allFinite();
}

Eigen::VectorXd ArrowSystem::multiply(const Eigen::VectorXd& x) const {
  FLANK_ASSERT(x.size() == size());
  // The lower triangle stands for both: every entry below the diagonal acts twice.
  const int n = offsets_.back();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  for (int c = 0; c < n; ++c) {
    const double* column = band_.data() + c * kBand;
    y[c] += column[0] * x[c];
    for (int r = 1; r < std::min(kBand, n - c); ++r) {
      y[c + r] += column[r] * x[c];
      y[c] += column[r] * x[c + r];
    }
  }
  y.head(n) += border_ * x.tail(tool_parameters_);
  y.tail(tool_parameters_) = border_.transpose() * x.head(n) + tool_matrix * x.tail(tool_parameters_);
  return y;
}

}  // namespace flank::internal

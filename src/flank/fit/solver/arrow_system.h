/// The normal equations of the fit, as an arrow: one band per motion, and the tool that all motions share as a border.
///
/// A cubic rail lets four control points act at a time, six unknowns each (tip, scaled direction), so a motion of n
/// control points costs O(n) to factor instead of O(n^3); the tool's few parameters are eliminated by a Schur
/// complement.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace flank::internal {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// What one axis position adds to the normal equations, before its six coordinates (tip, scaled direction) are spread
/// over the four control points that act at its time: sums over the residuals e of that position, w their weights,
/// g = de/dpose and b = de/dtool.
struct PoseTerms {
  Mat6 matrix = Mat6::Zero();    ///< sum of w g g'
  Vec6 gradient = Vec6::Zero();  ///< sum of w e g
  Mat6X coupling;                ///< sum of w g b', 6 x tool parameters; read only if the pose couples to the tool
};

/// The derivative of one residual: by the pose at its time, and by at most four consecutive parameters of the tool.
struct ResidualRow {
  int motion = 0, first = 0;           ///< of this motion, control points first .. first + 3 act
  std::array<double, 4> basis{};       ///< their basis functions at the residual's time
  Vec6 pose = Vec6::Zero();            ///< by tip and scaled direction (direction times axis length): all in mm per mm
  int tool_first = 0, tool_count = 0;  ///< free parameters tool_first .. tool_first + tool_count - 1 act
  std::array<double, 4> tool{};        ///< by these parameters
};

/// Symmetric positive system (H + damping D) step = -gradient. Unknowns: motion 0 (six per control point), motion 1,
/// ..., the tool's parameters. Four control points act at a time, so H has a diagonal and 23 sub-diagonals per motion.
/// A value: copying it copies the matrix. Nothing checks indices; the models that fill it know the counts.
class ArrowSystem {
 public:
  /// An empty system: control points of each motion, free parameters of the tool (0 if the tool is given).
  ArrowSystem(const std::vector<int>& control_counts, int tool_parameters);

  /// H = 0, gradient = 0; the sizes stay.
  void clear();
  /// Spreads the terms of a pose over control points first .. first + 3 with the weights basis[0..3]. The tool's own
  /// block is not touched: the caller adds to tool_matrix and to the tail of `gradient` itself.
  void add_pose(int motion, int first, const double* basis, const PoseTerms& terms, bool couples_tool);

  /// Adds weight J'J of one residual to the matrix and factor J to the gradient; factor is weight times residual, or
  /// zero for a residual inside its dead zone, whose weight only damps the step.
  void add_row(const ResidualRow& row, double weight, double factor);
  /// J x of one residual.
  [[nodiscard]] double product(const ResidualRow& row, const Eigen::VectorXd& x) const;

  /// Adds damping times D (see solve) to H for good. Damping has no unit.
  void add_damping(double damping);

  /// step = -(H + damping D)^-1 gradient by banded Cholesky. D is the mean diagonal of each motion (its unknowns are
  /// all lengths) and the diagonal of the tool (whose parameters may differ in unit). False, with `step` undefined, if
  /// the matrix is not positive definite or the step is not finite: the caller raises the damping.
  [[nodiscard]] bool solve(double damping, Eigen::VectorXd& step) const;

  [[nodiscard]] int size() const { return offsets_.back() + tool_parameters_; }
  [[nodiscard]] int motion_offset(int motion) const { return offsets_[static_cast<std::size_t>(motion)]; }
  [[nodiscard]] int tool_offset() const { return offsets_.back(); }
  /// H x, without damping. O(band).
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;

  Eigen::VectorXd gradient;     ///< in the order of the unknowns
  Eigen::MatrixXd tool_matrix;  ///< the tool's own block of H: tool parameters x tool parameters

 private:
  [[nodiscard]] double mean_diagonal(int first, int last) const;
  /// Whether the control points and the tool parameters of the row are there.
  [[nodiscard]] bool fits(const ResidualRow& row) const;

  static constexpr int kBand = 24;  ///< diagonal and 23 sub-diagonals: 4 control points x 6 unknowns

  std::vector<int> offsets_;  ///< first unknown of each motion, then of the tool
  int tool_parameters_;
  std::vector<double> band_;  ///< column c: band_[c * kBand + (r - c)], lower triangle
  Eigen::MatrixXd border_;    ///< motion unknowns x tool parameters
};

}  // namespace flank::internal

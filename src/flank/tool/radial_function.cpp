#include "flank/radial_function.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/error.h"
#include "flank/tool/families.h"
#include "flank/tool/uniform_cubic.h"

namespace flank {
using namespace internal;

namespace {

/// Coefficients of a cubic with one knot span.
constexpr int kSmallestSpline = 4;

/// Where coefficient i sits along the axis, in knot spans: the mean of its three inner knots.
double greville(int count, int i) {
  double sum = 0.0;
  for (int k = i - 2; k <= i; ++k) sum += std::clamp(k, 0, count - 3);
  return sum / 3.0;
}

void require_length(double axis_length) {
  if (!(axis_length > 0.0 && std::isfinite(axis_length)))
    throw InternalError("a tool profile needs a finite axis length > 0");
}

/// Least and largest of the values added.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  /// A value that is not a number stays, so that it is not lost among the others.
  void add(double value) {
    if (value < low || std::isnan(value)) low = value;
    if (value > high || std::isnan(value)) high = value;
  }
};

/// One polynomial piece of a spline.
struct Span {
  double start, length;
  RadialJet left, right;  ///< at its ends; r'' is continuous, so that neither end's piece matters
};

/// The spans in order; each end is evaluated once.
template <class Visit>
void each_span(const RadialFunction& spline, Visit&& visit) {
  const int spans = spline.parameter_count() - 3;
  const double length = spline.axis_length() / spans;
  RadialJet left = spline.at(0.0);
  for (int i = 0; i < spans; ++i) {
    const RadialJet right = spline.at(i + 1 < spans ? length * (i + 1) : spline.axis_length());
    visit(Span{length * i, length, left, right});
    left = right;
  }
}

/// Zeros of r' within a span as shares of its length: r' is quadratic there. Not numbers, or outside (0, 1), if there
/// are none; near a double zero, where round-off decides, r does not turn.
std::array<double, 2> turns(const Span& span) {
  const double a = 0.5 * (span.right.d2 - span.left.d2) * span.length, b = span.left.d2 * span.length, c = span.left.d1;
  // Without the difference of nearly equal numbers that the textbook formula has.
  const double q = -0.5 * (b + std::copysign(std::sqrt(b * b - 4.0 * a * c), b));
  return {q / a, c / q};
}

/// r turns only where r' = 0; beside the ends and these places there is nothing to look at.
Range radius_range(const RadialFunction& radial) {
  Range radii;
  if (radial.family() != ToolFamily::kSpline) {
    const double length = radial.axis_length();
    for (const double s : {0.0, length}) radii.add(radial.at(s).r);
    const auto turning_point = row_of(radial.family()).turning_point;
    const double turn = turning_point != nullptr ? turning_point(length, radial.parameters().data()) : -1.0;
    if (turn > 0.0 && turn < length) radii.add(radial.at(turn).r);
    return radii;
  }
  each_span(radial, [&](const Span& span) {
    radii.add(span.left.r);
    radii.add(span.right.r);
    for (const double t : turns(span))
      if (t > 0.0 && t < 1.0) radii.add(radial.at(span.start + t * span.length).r);
  });
  return radii;
}

}  // namespace

std::string_view family_name(ToolFamily family) { return row_of(family).name; }

std::optional<ToolFamily> family_from_name(std::string_view name) {
  for (const ToolFamily family : kToolFamilies)
    if (row_of(family).name == name) return family;
  return std::nullopt;
}

std::string tool_families() {
  std::string names;
  for (const Family& row : kFamilies)
    if (row.count > 0) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

std::span<const std::string_view> parameter_names(ToolFamily family) {
  return std::span(row_of(family).parameters).first(row_of(family).count);
}

bool parameter_is_angle(ToolFamily family, int index) { return index >= 0 && row_of(family).angle == index; }

RadialFunction::RadialFunction(ToolFamily family, double axis_length, Eigen::VectorXd parameters)
    : family_(family), axis_length_(axis_length), parameters_(std::move(parameters)) {
  require_length(axis_length);
  if (family == ToolFamily::kSpline) {
    if (parameters_.size() < kSmallestSpline)
      throw InternalError("a spline radial function needs at least 4 coefficients");
  } else if (parameters_.size() != static_cast<Eigen::Index>(row_of(family).count)) {
    throw InternalError("wrong number of parameters for a " + std::string(family_name(family)));
  }
}

RadialFunction RadialFunction::spline(double axis_length, Eigen::VectorXd coefficients) {
  return {ToolFamily::kSpline, axis_length, std::move(coefficients)};
}

RadialFunction RadialFunction::spline_through(double axis_length, std::span<const Vec2> samples, int count) {
  require_length(axis_length);
  if (count < kSmallestSpline || samples.empty())
    throw InternalError("a least-squares spline needs samples and at least 4 coefficients");
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  for (const Vec2& p : samples) {
    const UniformCubic b = UniformCubic::at(axis_length, count, p.x());
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) normal(b.first + i, b.first + j) += b.n3[i] * b.n3[j];
  }
  // Bends of the control polygon hold coefficients that no sample reaches; the refinement below takes their bias out of
  // the others.
  const double mu = 1e-10 * normal.trace() / count;
  for (int i = 1; i + 1 < count; ++i) {
    const double left = 1.0 / (greville(count, i) - greville(count, i - 1));
    const double right = 1.0 / (greville(count, i + 1) - greville(count, i));
    const Eigen::Vector3d d(left, -left - right, right);
    normal.block<3, 3>(i - 1, i - 1) += mu * d * d.transpose();
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  RadialFunction f = spline(axis_length, Eigen::VectorXd::Zero(count));
  for (int step = 0; step < 4; ++step) {
    // Residuals of the samples alone: the weak term above is in the matrix, but not in what is solved for.
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(count);
    for (const Vec2& p : samples) {
      const UniformCubic b = UniformCubic::at(axis_length, count, p.x());
      const double residual = p.y() - f.at(p.x()).r;
      for (int i = 0; i < 4; ++i) gradient[b.first + i] += b.n3[i] * residual;
    }
    f.parameters_ += solver.solve(gradient);
  }
  return f;
}

RadialJet RadialFunction::at(double s) const {
  if (family_ != ToolFamily::kSpline) return row_of(family_).jet(axis_length_, parameters_.data(), s);
  const UniformCubic b = UniformCubic::at(axis_length_, parameter_count(), s);
  const double* c = parameters_.data() + b.first;
  // Differences of the coefficients over their knots: control points of r', then of r''.
  const std::array<double, 3> d = {3.0 * b.inverse_gap3[0] * (c[1] - c[0]), 3.0 * b.inverse_gap3[1] * (c[2] - c[1]),
                                   3.0 * b.inverse_gap3[2] * (c[3] - c[2])};
  const double e0 = 2.0 * b.inverse_gap2[0] * (d[1] - d[0]), e1 = 2.0 * b.inverse_gap2[1] * (d[2] - d[1]);
  RadialJet jet;
  jet.r = b.n3[0] * c[0] + b.n3[1] * c[1] + b.n3[2] * c[2] + b.n3[3] * c[3];
  jet.d1 = (b.n2[0] * d[0] + b.n2[1] * d[1] + b.n2[2] * d[2]) * b.inverse_h;
  jet.d2 = (b.n1[0] * e0 + b.n1[1] * e1) * b.inverse_h * b.inverse_h;
  return jet;
}

void RadialFunction::active_gradient(double s, double* out) const {
  FLANK_ASSERT(out != nullptr);
  if (family_ != ToolFamily::kSpline) return row_of(family_).gradient(axis_length_, parameters_.data(), s, out);
  const UniformCubic b = UniformCubic::at(axis_length_, parameter_count(), s);
  std::copy(b.n3.begin(), b.n3.end(), out);
}

void RadialFunction::gradient(double s, double* out) const {
  if (family_ != ToolFamily::kSpline) return active_gradient(s, out);
  std::fill_n(out, parameter_count(), 0.0);
  active_gradient(s, out + first_active(s));
}

int RadialFunction::first_active(double s) const {
  if (family_ != ToolFamily::kSpline) return 0;
  return UniformCubic::at(axis_length_, parameter_count(), s).first;
}

int RadialFunction::active_count() const { return family_ == ToolFamily::kSpline ? 4 : parameter_count(); }

double RadialFunction::smallest() const { return radius_range(*this).low; }

double RadialFunction::largest() const { return radius_range(*this).high; }

double RadialFunction::steepest() const {
  Range slopes;
  if (family_ != ToolFamily::kSpline) {
    for (const double s : {0.0, axis_length_}) slopes.add(std::abs(at(s).d1));
    return slopes.high;
  }
  each_span(*this, [&](const Span& span) {
    slopes.add(std::abs(span.left.d1));
    slopes.add(std::abs(span.right.d1));
    // r'' is linear between the knots.
    const double t = span.left.d2 / (span.left.d2 - span.right.d2);
    if (t > 0.0 && t < 1.0) slopes.add(std::abs(at(span.start + t * span.length).d1));
  });
  return slopes.high;
}

RadialFunction RadialFunction::with_parameters(const Eigen::VectorXd& parameters) const {
  return {family_, axis_length_, parameters};
}

}  // namespace flank

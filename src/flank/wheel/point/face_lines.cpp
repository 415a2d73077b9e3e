#include "flank/wheel/point/face_lines.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace flank::internal {
namespace {

constexpr int kFine = 240, kCoarse = 24;  ///< places in the direction that is divided, and in the other one
constexpr double kInset = 1e-6;           ///< of the range: the outermost lines run so far inside of the border
constexpr int kGrid = 64;                 ///< places either way, that tell how a trimmed face lies in its parameters
constexpr double kFull = 0.6;             ///< of the grid: a face that fills more lies along its parameters
constexpr std::size_t kMost = 2048;       ///< lines, and places along each

/// Values at which a running sum, one entry for each even step of [from, to], passes even shares of its end.
std::vector<double> even(const std::vector<double>& sums, double from, double to, std::size_t count) {
  std::vector<double> out;
  std::size_t k = 0;
  for (std::size_t n = 0; n <= count; ++n) {
    const double wanted = sums.back() * static_cast<double>(n) / static_cast<double>(count);
    while (k + 2 < sums.size() && sums[k + 1] < wanted) ++k;
    const double width = sums[k + 1] - sums[k],
                 share = width > 0.0 ? std::clamp((wanted - sums[k]) / width, 0.0, 1.0) : 0.0;
    out.push_back(from + (to - from) * (static_cast<double>(k) + share) / (static_cast<double>(sums.size()) - 1.0));
  }
  return out;
}

std::size_t number_of(double sum) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(sum)), 1, kMost);
}

}  // namespace

FaceLines::FaceLines(const Face& face, double tip_mm, double scallop_mm, double step_mm)
    : face_(face),
      region_(face.loops,
              {face.surface.u_first(), face.surface.u_last(), face.surface.v_first(), face.surface.v_last()}) {
  const std::vector<Vec2> places = inside();
  const bool full = region_.whole() || static_cast<double>(places.size()) > kFull * kGrid * kGrid;
  if (full || places.size() < 3)
    lay_along_parameters();
  else
    lay_aslant(places);
  place_lines(tip_mm, scallop_mm);
  place_steps(step_mm);
}

/// Of a grid over the box of the trimmed region.
std::vector<Vec2> FaceLines::inside() const {
  const ParameterRectangle& box = region_.box();
  std::vector<Vec2> out;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const Vec2 p(box.u0 + (box.u1 - box.u0) * (i + 0.5) / kGrid, box.v0 + (box.v1 - box.v0) * (j + 0.5) / kGrid);
      if (region_.inside(p.x(), p.y())) out.push_back(p);
    }
  return out;
}

void FaceLines::lay_along_parameters() {
  const ParameterRectangle& box = region_.box();
  double u = 0.0, v = 0.0;
  for (int i = 0; i <= kCoarse; ++i)
    for (int j = 0; j <= kCoarse; ++j) {
      const SurfaceJet jet =
          face_.surface.jet(box.u0 + (box.u1 - box.u0) * i / kCoarse, box.v0 + (box.v1 - box.v0) * j / kCoarse);
      u += jet.du.norm() * (box.u1 - box.u0), v += jet.dv.norm() * (box.v1 - box.v0);
    }
  if (u < v) std::swap(along_way_, across_way_);
  const auto inset = [](double from, double to) {
    return std::pair(from + kInset * (to - from), to - kInset * (to - from));
  };
  std::tie(a0_, a1_) = u < v ? inset(box.v0, box.v1) : inset(box.u0, box.u1);
  std::tie(c0_, c1_) = u < v ? inset(box.u0, box.u1) : inset(box.v0, box.v1);
}

/// Along the longest extent of the places, by the lengths on the surface in their middle.
void FaceLines::lay_aslant(const std::vector<Vec2>& places) {
  for (const Vec2& p : places) origin_ += p / static_cast<double>(places.size());
  const SurfaceJet jet = face_.surface.jet(origin_.x(), origin_.y());
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << jet.du, jet.dv;
  // In lengths the parameter plane is sheared; its root of the metric straightens it.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> metric(tangents.transpose() * tangents);
  const Eigen::Matrix2d root = metric.operatorSqrt(), back = metric.operatorInverseSqrt();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Vec2& p : places) spread += (root * (p - origin_)) * (root * (p - origin_)).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  along_way_ = back * axes.eigenvectors().col(1), across_way_ = back * axes.eigenvectors().col(0);
  a0_ = c0_ = 1e300, a1_ = c1_ = -1e300;
  for (const Vec2& p : places) {
    const Vec2 x = axes.eigenvectors().transpose() * root * (p - origin_);
    a0_ = std::min(a0_, x.y()), a1_ = std::max(a1_, x.y()), c0_ = std::min(c0_, x.x()), c1_ = std::max(c1_, x.x());
  }
  // The border is between the places: half a cell of the grid more.
  const ParameterRectangle& box = region_.box();
  const double cell = (root * Vec2((box.u1 - box.u0) / kGrid, (box.v1 - box.v0) / kGrid)).norm();
  a0_ -= 0.5 * cell, a1_ += 0.5 * cell, c0_ -= 0.25 * cell, c1_ += 0.25 * cell;
}

std::optional<FaceLines::Frame> FaceLines::frame(double along, double across) const {
  const Vec2 p = parameters(along, across), &a = along_way_, &c = across_way_;
  const SurfaceJet jet = face_.surface.jet(p.x(), p.y());
  const Vec3 cross = jet.du.cross(jet.dv);
  const double length = cross.norm();
  if (!(length > 1e-12 * std::max(jet.du.squaredNorm(), jet.dv.squaredNorm()))) return {};
  Frame out{jet.p, (face_.reversed ? -1.0 : 1.0) / length * cross, a.x() * jet.du + a.y() * jet.dv,
            c.x() * jet.du + c.y() * jet.dv};
  const Vec3 second = c.x() * c.x() * jet.duu + 2.0 * c.x() * c.y() * jet.duv + c.y() * c.y() * jet.dvv;
  out.bend = second.dot(out.normal) / out.across.squaredNorm();
  return out;
}

void FaceLines::place_lines(double tip_mm, double scallop_mm) {
  std::vector<double> sums{0.0};
  for (int k = 0; k < kFine; ++k) {
    double most = 0.0;
    for (int j = 0; j <= kCoarse; ++j) {
      const auto here = frame(a0_ + (a1_ - a0_) * j / kCoarse, c0_ + (c1_ - c0_) * (k + 0.5) / kFine);
      if (!here) continue;
      const double open = std::max(1.0 / tip_mm - here->bend, 0.1 / tip_mm), apart = std::sqrt(8.0 * scallop_mm / open);
      // Across the lines: what runs along them is no way between them.
      const Vec3 t = here->along.normalized(), across = here->across - here->across.dot(t) * t;
      most = std::max(most, across.norm() * (c1_ - c0_) / kFine / apart);
    }
    sums.push_back(sums.back() + most);
  }
  across_ = even(sums, c0_, c1_, number_of(sums.back()));
}

void FaceLines::place_steps(double step_mm) {
  std::vector<double> sums{0.0};
  for (int k = 0; k < kFine; ++k) {
    double most = 0.0;
    for (int j = 0; j <= kCoarse; ++j) {
      const auto here = frame(a0_ + (a1_ - a0_) * (k + 0.5) / kFine, c0_ + (c1_ - c0_) * j / kCoarse);
      if (here) most = std::max(most, here->along.norm() * (a1_ - a0_) / kFine / step_mm);
    }
    sums.push_back(sums.back() + most);
  }
  along_ = even(sums, a0_, a1_, number_of(sums.back()));
}

std::optional<FaceLines::Place> FaceLines::at(std::size_t line, double place) const {
  const double last = static_cast<double>(along_.size()) - 1.0, p = std::clamp(place, 0.0, last);
  const auto k = static_cast<std::size_t>(std::min(p, std::max(0.0, last - 1.0)));
  const double a = along_[k] + (p - static_cast<double>(k)) * (along_[std::min(k + 1, along_.size() - 1)] - along_[k]);
  const double c = across_[line];
  const Vec2 at = parameters(a, c);
  if (!region_.whole() && !region_.inside(at.x(), at.y())) return {};
  const std::optional<Frame> here = frame(a, c);
  if (!here) return {};
  return Place{here->point, here->normal};
}

}  // namespace flank::internal

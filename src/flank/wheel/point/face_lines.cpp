#include "flank/wheel/point/face_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flank::internal {
namespace {

constexpr int kFine = 240, kCoarse = 24;  ///< places in the direction that is divided, and in the other one
constexpr double kInset = 1e-6;           ///< of the range: the outermost lines run so far inside of the border
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
  along_u_ = long_in_u();
  const ParameterRectangle& box = region_.box();
  const auto inset = [](double from, double to) {
    return std::pair(from + kInset * (to - from), to - kInset * (to - from));
  };
  std::tie(a0_, a1_) = along_u_ ? inset(box.u0, box.u1) : inset(box.v0, box.v1);
  std::tie(c0_, c1_) = along_u_ ? inset(box.v0, box.v1) : inset(box.u0, box.u1);
  place_lines(tip_mm, scallop_mm);
  place_steps(step_mm);
}

bool FaceLines::long_in_u() const {
  const ParameterRectangle& box = region_.box();
  double u = 0.0, v = 0.0;
  for (int i = 0; i <= kCoarse; ++i)
    for (int j = 0; j <= kCoarse; ++j) {
      const SurfaceJet jet =
          face_.surface.jet(box.u0 + (box.u1 - box.u0) * i / kCoarse, box.v0 + (box.v1 - box.v0) * j / kCoarse);
      u += jet.du.norm() * (box.u1 - box.u0), v += jet.dv.norm() * (box.v1 - box.v0);
    }
  return u >= v;
}

std::optional<FaceLines::Frame> FaceLines::frame(double along, double across) const {
  const SurfaceJet jet = along_u_ ? face_.surface.jet(along, across) : face_.surface.jet(across, along);
  const Vec3 cross = jet.du.cross(jet.dv);
  const double length = cross.norm();
  if (!(length > 1e-12 * std::max(jet.du.squaredNorm(), jet.dv.squaredNorm()))) return {};
  Frame out{jet.p, (face_.reversed ? -1.0 : 1.0) / length * cross, along_u_ ? jet.du : jet.dv,
            along_u_ ? jet.dv : jet.du};
  out.bend = (along_u_ ? jet.dvv : jet.duu).dot(out.normal) / out.across.squaredNorm();
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
  if (!region_.whole() && !(along_u_ ? region_.inside(a, c) : region_.inside(c, a))) return {};
  const std::optional<Frame> here = frame(a, c);
  if (!here) return {};
  return Place{here->point, here->normal};
}

}  // namespace flank::internal

#include "flank/verify/sample_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flank/error.h"
#include "flank/judge.h"
#include "flank/verify/proof/border.h"
#include "flank/verify/trim.h"

namespace flank {
namespace {

using namespace internal::verify;

constexpr int kProbes = 8;               ///< per knot span and direction at most, to measure how the parameters stretch
constexpr int kMostProbes = 192;         ///< per direction, but one a knot span
constexpr int kMaxCellsPerSide = 20000;  ///< bounds memory if the spacing is absurdly small for the face
/// Of |S_u|^2 + |S_v|^2: a tangent parallelogram with less area is degenerate (a pole), and has no curvature to
/// compute.
constexpr double kDegenerate = 1e-12;
constexpr int kSubRows = 6;              ///< a cell on the trim is measured along this many lines of constant v
constexpr double kFlatCell = 0.01;       ///< bend by size up to which the middle of a cell gives its area
constexpr double kBorderShare = 1e-6;    ///< of the parameter range: chords that tell how far the loops reach
constexpr double kProofShare = 1e-5;     ///< of the parameter range: chords that tell which cells the border meets
constexpr std::size_t kSizePlaces = 32;  ///< per direction, about, to measure the size of the face
constexpr double kTrimShare = 1e-3;      ///< trim chords stay within this share of a cell

struct Range {
  double low = 0.0, high = 0.0;
};

/// Places inside the range: kProbes a knot span, away from the knots themselves.
std::vector<double> probes(const std::vector<double>& knots, int degree, int count, Range range) {
  std::vector<double> out;
  const int per_span = std::clamp(kMostProbes / std::max(1, count - degree), 1, kProbes);
  for (int k = degree; k < count; ++k) {
    const double a = std::max(range.low, knots[static_cast<std::size_t>(k)]);
    const double b = std::min(range.high, knots[static_cast<std::size_t>(k + 1)]);
    if (!(b > a)) continue;
    for (int i = 0; i < per_span; ++i) out.push_back(a + (b - a) * (i + 0.5) / per_span);
  }
  return out;
}

/// Borders of cells along one parameter, such that the longest iso-line piece in a cell is about the spacing: equal
/// steps of the integral of the largest speed across the other parameter.
template <class Speed>
std::vector<double> cell_borders(const std::vector<double>& along, Range range, double spacing, const Speed& speed) {
  std::vector<double> borders{range.low}, lengths{0.0};
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double end = i + 1 < along.size() ? 0.5 * (along[i] + along[i + 1]) : range.high;
    lengths.push_back(lengths.back() + (end - borders.back()) * speed(along[i]));
    borders.push_back(end);
  }
  // Held in bounds as a real number: beyond them it need not fit into an integer.
  const int cells = static_cast<int>(std::clamp(std::ceil(lengths.back() / spacing), 1.0, 1.0 * kMaxCellsPerSide));
  std::vector<double> out{range.low};
  std::size_t k = 1;
  for (int i = 1; i < cells; ++i) {
    const double wanted = lengths.back() * i / cells;
    while (lengths[k] < wanted) ++k;
    const double share = (wanted - lengths[k - 1]) / (lengths[k] - lengths[k - 1]);
    out.push_back(borders[k - 1] + share * (borders[k] - borders[k - 1]));
  }
  out.push_back(range.high);
  return out;
}

/// The part of a cell that lies inside the trim: its share, and a place in it (the middle of the cell if that is
/// inside).
struct CellPart {
  double share = 0.0;
  double u = 0.0, v = 0.0;
};

/// Crossings of the lines through the sub-cells of one row of cells, and of its middle line.
struct RowCrossings {
  std::array<std::vector<double>, kSubRows> sub;
  std::vector<double> middle;
};

/// Length of [low, high] inside the crossings of its line, and the middle of the longest piece inside.
double inside_length(const std::vector<double>& crossings, Range u, double& middle) {
  double length = 0.0, longest = 0.0;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const double a = std::max(u.low, crossings[k]), b = std::min(u.high, crossings[k + 1]);
    if (!(b > a)) continue;
    length += b - a;
    if (b - a > longest) longest = b - a, middle = 0.5 * (a + b);
  }
  return length;
}

CellPart inside_part(const Trim& trim, const RowCrossings& row, Range u, Range v) {
  CellPart part{1.0, 0.5 * (u.low + u.high), 0.5 * (v.low + v.high)};
  if (trim.everything()) return part;
  const bool middle_inside = trim.inside(row.middle, part.u);
  double inside = 0.0, nearest = 1e300;
  for (int j = 0; j < kSubRows; ++j) {
    double middle = part.u;
    const double length = inside_length(row.sub[static_cast<std::size_t>(j)], u, middle);
    inside += length;
    const double away = std::abs(j + 0.5 - 0.5 * kSubRows);
    if (middle_inside || !(length > 0.0) || away >= nearest) continue;
    nearest = away;
    part.u = middle;
    part.v = v.low + (v.high - v.low) * (j + 0.5) / kSubRows;
  }
  part.share = inside / (kSubRows * (u.high - u.low));
  return part;
}

RowCrossings row_crossings(const Trim& trim, Range v) {
  RowCrossings row;
  if (trim.everything()) return row;
  for (int j = 0; j < kSubRows; ++j)
    row.sub[static_cast<std::size_t>(j)] = trim.crossings(v.low + (v.high - v.low) * (j + 0.5) / kSubRows);
  row.middle = trim.crossings(0.5 * (v.low + v.high));
  return row;
}

/// Largest |normal curvature| at a point, by the second fundamental form in an orthonormal tangent frame; 0 where the
/// face is degenerate.
double largest_curvature(const SurfaceJet& j) {
  const Vec3 cross = j.du.cross(j.dv);
  const double area = cross.norm();
  if (!(area > kDegenerate * (j.du.squaredNorm() + j.dv.squaredNorm()))) return 0.0;
  const Vec3 n = cross / area;
  const double e = j.du.squaredNorm(), f = j.du.dot(j.dv), g = j.dv.squaredNorm();
  const double l = n.dot(j.duu), m = n.dot(j.duv), k = n.dot(j.dvv);
  const double mean = 0.5 * (e * k - 2.0 * f * m + g * l) / (area * area);
  const double gauss = (l * k - m * m) / (area * area);
  return std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
}

/// Mean of |S_u x S_v| over a cell, by Gauss's rule of two by two places.
double mean_stretch(const BSplineSurface& s, Range u, Range v) {
  constexpr double kGauss =
      0.28867513459481287;  // 1 / (2 sqrt(3)): places of the rule, from the middle, over the width
  const double uc = 0.5 * (u.low + u.high), vc = 0.5 * (v.low + v.high);
  const double du = kGauss * (u.high - u.low), dv = kGauss * (v.high - v.low);
  double sum = 0.0;
  for (double x : {uc - du, uc + du}) {
    for (double y : {vc - dv, vc + dv}) {
      const SurfaceJet jet = s.jet(x, y);
      sum += jet.du.cross(jet.dv).norm();
    }
  }
  return 0.25 * sum;
}

/// Unit normal, away from the material of the face's solid; zero where the face is degenerate.
Vec3 normal_at(const SurfaceJet& jet, bool reversed) {
  const Vec3 cross = jet.du.cross(jet.dv);
  const double length = cross.norm();
  return length > 0.0 ? Vec3((reversed ? -1.0 : 1.0) / length * cross) : Vec3(Vec3::Zero());
}

/// Adds the sample of a cell, and what it says about the spacing and the curvature.
void add_cell(FaceSamples& out, const BSplineSurface& s, const CellPart& part, Range u, Range v, bool reversed) {
  const double du = u.high - u.low, dv = v.high - v.low;
  const SurfaceJet jet = s.jet(part.u, part.v);
  const Vec3 a = 0.5 * du * jet.du, b = 0.5 * dv * jet.dv;
  const double half_diagonal = std::max((a + b).norm(), (a - b).norm());
  // Taylor's second-order term at the corners of the cell, half a side away in u and in v.
  const double bend = 0.125 * (jet.duu.norm() * du * du + 2.0 * jet.duv.norm() * du * dv + jet.dvv.norm() * dv * dv);
  const double stretch = bend < kFlatCell * half_diagonal ? jet.du.cross(jet.dv).norm() : mean_stretch(s, u, v);
  out.points.push_back(jet.p);
  out.areas.push_back(part.share * du * dv * stretch);
  out.spacing_mm = std::max(out.spacing_mm, half_diagonal + bend);
  out.reaches_mm.push_back(half_diagonal + bend);
  out.curvatures_per_mm.push_back(largest_curvature(jet));
  out.normals.push_back(normal_at(jet, reversed));
}

void require_usable(const Face& face, double spacing_mm) {
  if (!(spacing_mm > 0.0)) throw UsageError("sample spacing " + std::to_string(spacing_mm) + " mm: must be > 0");
  for (const Vec3& p : face.surface.poles)
    if (!p.allFinite()) throw InputError("face " + face.id + " has a control point that is not finite");
}

/// The face as rows of cells.
class FaceSampler final : public Sampler {
 public:
  FaceSampler(const Face& face, double spacing_mm, bool target, std::size_t most_samples)
      : face_(face), target_(target) {
    const BSplineSurface& s = face.surface;
    lay_out(spacing_mm);
    trim_ =
        std::make_unique<Trim>(face.loops, kTrimShare * (us_.back() - us_.front()) / static_cast<double>(us_.size()),
                               kTrimShare * (vs_.back() - vs_.front()) / static_cast<double>(vs_.size()));
    border_ = std::make_unique<Border>(border_curves(face),
                                       kProofShare * Vec2(s.u_last() - s.u_first(), s.v_last() - s.v_first()));
    kinks_u_ = kinks(s.knots_u, s.degree_u, s.u_first(), s.u_last());
    kinks_v_ = kinks(s.knots_v, s.degree_v, s.v_first(), s.v_last());
    rows_ = std::clamp<std::size_t>(most_samples / (us_.size() - 1), 1, vs_.size() - 1);
  }

  [[nodiscard]] std::size_t tiles() const override { return (vs_.size() - 2 + rows_) / rows_; }
  [[nodiscard]] double count() const override {
    return static_cast<double>(us_.size() - 1) * static_cast<double>(vs_.size() - 1);
  }
  /// Of a box about the cells whose middle is inside the trim: the rectangle of the parameters may be much larger.
  [[nodiscard]] double size_mm() const override {
    const std::size_t step_u = step(us_.size()), step_v = step(vs_.size());
    Box3 inside, all;
    for (std::size_t j = 0; j + 1 < vs_.size(); j += step_v) {
      const double v0 = vs_[j], v1 = vs_[std::min(j + step_v, vs_.size() - 1)];
      const std::vector<double> row = trim_->crossings(0.5 * (v0 + v1));
      for (std::size_t i = 0; i + 1 < us_.size(); i += step_u) {
        const double u0 = us_[i], u1 = us_[std::min(i + step_u, us_.size() - 1)];
        const bool in = trim_->everything() || trim_->inside(row, 0.5 * (u0 + u1));
        for (const double v : {v0, v1})
          for (const double u : {u0, u1}) {
            const Vec3 p = face_.surface.value(u, v);
            all.add(p);
            if (in) inside.add(p);
          }
      }
    }
    return inside.empty() ? all.diagonal() : inside.diagonal();
  }

  [[nodiscard]] FaceSamples tile(std::size_t k) const override {
    FaceSamples out = begin();
    for (std::size_t j = k * rows_; j < std::min((k + 1) * rows_, vs_.size() - 1); ++j)
      add_row(out, us_, {vs_[j], vs_[j + 1]});
    return out;
  }

  [[nodiscard]] FaceSamples cut(const FaceSamples& samples, std::span<const std::size_t> which) const override {
    FaceSamples out = begin();
    std::vector<double> us(kCut + 1), vs(kCut + 1);
    for (const std::size_t i : which) {
      const auto& [u_low, u_high, v_low, v_high] = samples.cells[i];
      for (int k = 0; k <= kCut; ++k) {
        us[static_cast<std::size_t>(k)] = u_low + (u_high - u_low) * k / kCut;
        vs[static_cast<std::size_t>(k)] = v_low + (v_high - v_low) * k / kCut;
      }
      for (std::size_t j = 0; j < kCut; ++j) add_row(out, us, {vs[j], vs[j + 1]});
    }
    return out;
  }

 private:
  [[nodiscard]] FaceSamples begin() const {
    FaceSamples out;
    out.face = face_.id;
    out.target = target_;
    out.of_solid = face_.of_solid;
    return out;
  }

  /// The samples of a row of cells between these borders.
  void add_row(FaceSamples& out, const std::vector<double>& us, Range v) const {
    const RowCrossings row = row_crossings(*trim_, v);
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const Range u{us[i], us[i + 1]};
      const CellPart part = inside_part(*trim_, row, u, v);
      if (!(part.share > 0.0)) continue;
      add_cell(out, face_.surface, part, u, v, face_.reversed);
      out.cells.push_back({u.low, u.high, v.low, v.high});
      out.smooth.push_back(smooth(u, v) ? 1 : 0);
    }
  }

  void lay_out(double spacing_mm) {
    const BSplineSurface& s = face_.surface;
    Range u{s.u_first(), s.u_last()}, v{s.v_first(), s.v_last()};
    const Trim border(face_.loops, kBorderShare * (u.high - u.low), kBorderShare * (v.high - v.low));
    if (!border.everything()) {
      // Cells end where the loops end, so that a trim along an iso-line cuts none of them.
      u = {std::max(u.low, border.low().x()), std::min(u.high, border.high().x())};
      v = {std::max(v.low, border.low().y()), std::min(v.high, border.high().y())};
    }
    const std::vector<double> at_u = probes(s.knots_u, s.degree_u, s.count_u, u);
    const std::vector<double> at_v = probes(s.knots_v, s.degree_v, s.count_v, v);
    const auto speed_u = [&](double x) {
      double largest = 0.0;
      for (double y : at_v) largest = std::max(largest, s.jet(x, y).du.norm());
      return largest;
    };
    const auto speed_v = [&](double y) {
      double largest = 0.0;
      for (double x : at_u) largest = std::max(largest, s.jet(x, y).dv.norm());
      return largest;
    };
    us_ = cell_borders(at_u, u, spacing_mm, speed_u);
    vs_ = cell_borders(at_v, v, spacing_mm, speed_v);
  }

  /// Whether neither border nor kink comes into the cell or touches it.
  [[nodiscard]] bool smooth(Range u, Range v) const {
    const auto meets = [](const std::vector<double>& at, Range r) {
      return std::any_of(at.begin(), at.end(), [&](double k) { return k >= r.low && k <= r.high; });
    };
    if (meets(kinks_u_, u) || meets(kinks_v_, v)) return false;
    if (trim_->everything())
      return u.low > us_.front() && u.high < us_.back() && v.low > vs_.front() && v.high < vs_.back();
    return border_->side({{u.low, v.low}, {u.high, v.high}}) == Side::kInside;
  }

  static std::size_t step(std::size_t count) { return std::max<std::size_t>(1, count / kSizePlaces); }

  const Face& face_;
  bool target_;
  std::vector<double> us_, vs_;  ///< borders of the cells
  std::unique_ptr<Trim> trim_;
  std::unique_ptr<Border> border_;
  std::vector<double> kinks_u_, kinks_v_;
  std::size_t rows_ = 1;  ///< of a tile
};

}  // namespace

namespace internal::verify {

std::unique_ptr<Sampler> make_sampler(const Face& face, double spacing_mm, bool target, std::size_t most_samples) {
  require_usable(face, spacing_mm);
  return std::make_unique<FaceSampler>(face, spacing_mm, target, most_samples);
}

}  // namespace internal::verify

FaceSamples sample_face(const Face& face, double spacing_mm, bool target) {
  return make_sampler(face, spacing_mm, target, std::numeric_limits<std::size_t>::max())->tile(0);
}

}  // namespace flank

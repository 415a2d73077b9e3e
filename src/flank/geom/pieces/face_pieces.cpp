#include "flank/geom/pieces/face_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/geom/face_cut.h"
#include "flank/geom/pieces/face_section.h"
#include "flank/geom/spline_segment.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

constexpr int kSections = 33;                         ///< lines across the face that are looked at
constexpr double kSectionShare = 0.8;                 ///< of them have to agree about the number of edges
constexpr double kFadedTurnDeg = 0.5 * kEdgeTurnDeg;  ///< what is left of an edge where it fades along the face
constexpr double kSharp = 1e-4;                       ///< an edge that is shorter is a cut and no piece

/// The stretches of all sections together: what any of them calls the k-th edge, matched by their middles.
class Edges {
 public:
  Edges(std::vector<SectionStretch> first, double period) : edges_(std::move(first)), period_(period) {}

  /// False if the edges lie elsewhere.
  bool add(const std::vector<SectionStretch>& others) {
    std::vector<SectionStretch> grown = edges_;
    std::vector<char> met(edges_.size(), 0);
    for (SectionStretch other : others) {
      std::size_t best = 0;
      double nearest = 1e300, shift = 0.0;
      for (std::size_t k = 0; k < edges_.size(); ++k) {
        for (const double turn : {-period_, 0.0, period_}) {
          const double off = std::abs(other.middle() + turn - edges_[k].middle());
          if (off < nearest) nearest = off, best = k, shift = turn;
        }
      }
      if (met[best] != 0) return false;
      met[best] = 1;
      grown[best].first = std::min(grown[best].first, other.first + shift);
      grown[best].last = std::max(grown[best].last, other.last + shift);
    }
    edges_ = std::move(grown);
    return true;
  }

  /// Whether each of the others lies in an edge of its own.
  [[nodiscard]] bool hold(const std::vector<SectionStretch>& others) const {
    if (others.size() != edges_.size()) return false;
    return std::all_of(edges_.begin(), edges_.end(), [&](const SectionStretch& edge) {
      return std::any_of(others.begin(), others.end(), [&](const SectionStretch& other) {
        const double turns = std::floor((other.middle() - edge.first) / period_);
        return other.middle() - turns * period_ <= edge.last;
      });
    });
  }

  [[nodiscard]] const std::vector<SectionStretch>& edges() const { return edges_; }

 private:
  std::vector<SectionStretch> edges_;
  double period_;
};

struct Division {
  bool along_u = true;
  bool closed = false;  ///< the surface closes upon itself, whatever the trims leave of it
  std::vector<SectionStretch> edges;
  double width = 0.0;  ///< of the widest section, mm
};

/// The sections across the face; none if it wraps round nothing, as most do: a few of them tell.
std::vector<FaceSection> sections_of(const SectionView& view, double low, double high, bool closed) {
  const std::array<double, 3> shares = {0.2, 0.5, 0.8};
  if (std::none_of(shares.begin(), shares.end(), [&](double share) {
        return !edges_of(section_at(view, low + (high - low) * share, closed), closed, kEdgeTurnDeg).empty();
      }))
    return {};
  std::vector<FaceSection> sections;
  for (int k = 0; k < kSections; ++k) {
    // Not on the borders themselves, where a tip may have shrunk to a point.
    FaceSection section = section_at(view, low + (high - low) * (k + 0.5) / kSections, closed);
    if (!section.samples.empty()) sections.push_back(std::move(section));
  }
  return sections;
}

/// The edges that most sections agree about. One in which an edge turns less than elsewhere agrees if what is left of it lies there: the
/// half of a nose that one of two faces has may turn by 80 degrees at its tip and 40 at its root.
std::optional<Edges> common_edges(const std::vector<FaceSection>& sections, bool closed, double period) {
  std::vector<std::vector<SectionStretch>> all;
  std::vector<int> count_of(16, 0);
  for (const FaceSection& section : sections) {
    all.push_back(edges_of(section, closed, kEdgeTurnDeg));
    ++count_of[std::min(all.back().size(), count_of.size() - 1)];
  }
  const auto most = static_cast<std::size_t>(std::max_element(count_of.begin(), count_of.end()) - count_of.begin());
  if (most == 0 || most + 1 == count_of.size()) return std::nullopt;
  std::vector<std::size_t> full, faded;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].size() <= most) (all[k].size() == most ? full : faded).push_back(k);
  Edges edges(all[full[full.size() / 2]], closed ? period : 1e300);
  for (const std::size_t k : full)
    if (!edges.add(all[k])) return std::nullopt;
  const auto agreeing =
      full.size() + static_cast<std::size_t>(std::count_if(faded.begin(), faded.end(), [&](std::size_t k) {
        return edges.hold(edges_of(sections[k], closed, kFadedTurnDeg));
      }));
  if (static_cast<double>(agreeing) < kSectionShare * static_cast<double>(sections.size())) return std::nullopt;
  return edges;
}

/// None: it is not to be divided in this direction.
std::optional<Division> division_along(const Face& face, const ParameterRectangle& box, bool along_u) {
  const SectionView view{face.surface, along_u};
  Division division{along_u, is_closed(face.surface, along_u), {}, 0.0};
  const double low = along_u ? box.v0 : box.u0, high = along_u ? box.v1 : box.u1;
  const std::vector<FaceSection> sections = sections_of(view, low, high, division.closed);
  if (sections.empty()) return std::nullopt;
  const std::optional<Edges> edges = common_edges(sections, division.closed, view.last() - view.first());
  if (!edges) return std::nullopt;
  division.edges = edges->edges();
  for (const FaceSection& section : sections) division.width = std::max(division.width, section.width);
  return division;
}

/// The stretches between the edges.
std::vector<SectionStretch> sides_between(const Division& division, double first, double last) {
  std::vector<SectionStretch> sides;
  const std::vector<SectionStretch>& edges = division.edges;
  if (!division.closed) {
    sides.push_back({first, edges.front().first});
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) sides.push_back({edges[k].last, edges[k + 1].first});
    sides.push_back({edges.back().last, last});
  } else {
    for (std::size_t k = 0; k < edges.size(); ++k)
      sides.push_back({edges[k].last, k + 1 < edges.size() ? edges[k + 1].first : edges[0].first + (last - first)});
  }
  return sides;
}

/// A stretch of a closed surface that begins within it.
SectionStretch unwound(SectionStretch stretch, double first, double last) {
  const double period = last - first, tiny = 1e-9 * period;
  const double shift = std::floor((stretch.first - first + tiny) / period) * period;
  return {std::max(stretch.first - shift, first), stretch.last - shift};
}

/// A trimmed face is not cut across its seam: what goes across it is two stretches.
void cut_at_seam(double first, double last, std::vector<SectionStretch>& stretches) {
  const std::size_t count = stretches.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (stretches[k].last <= last) continue;
    stretches.push_back({first, stretches[k].last - (last - first)});
    stretches[k].last = last;
  }
}

/// Length across the middle of the face, mm.
double length_of(const SectionView& view, const SectionStretch& stretch, double w) {
  constexpr int kSteps = 64;
  double length = 0.0;
  Vec3 before = Vec3::Zero();
  for (int i = 0; i <= kSteps; ++i) {
    double t = stretch.first + (stretch.last - stretch.first) * i / kSteps;
    if (t > view.last()) t -= view.last() - view.first();
    const Vec3 p = view.along_u ? view.s.value(t, w) : view.s.value(w, t);
    if (i > 0) length += (p - before).norm();
    before = p;
  }
  return length;
}

/// An edge beside which no side worth the name is left goes up to the border. Edges that are a mere cut have no width;
/// at the border (the apex of a cone that a surface passes by a rounding error) such an edge is none at all.
void tidy(const SectionView& view, double w, double width, Division& division) {
  const double first = view.first(), last = view.last();
  if (!division.closed) {
    SectionStretch &low = division.edges.front(), &high = division.edges.back();
    if (length_of(view, {first, low.first}, w) < kLeastSide * width) low.first = first;
    if (length_of(view, {high.last, last}, w) < kLeastSide * width) high.last = last;
  }
  for (SectionStretch& edge : division.edges) {
    if (length_of(view, edge, w) >= kSharp * width) continue;
    if (!division.closed && edge.first == first)
      edge.last = first;
    else if (!division.closed && edge.last == last)
      edge.first = last;
    else
      edge.first = edge.last = edge.middle();
  }
}

bool is_outside(const TrimRegion& region, const Division& division, const SectionStretch& stretch) {
  ParameterRectangle part = region.box();
  (division.along_u ? part.u0 : part.v0) = stretch.first;
  (division.along_u ? part.u1 : part.v1) = stretch.last;
  return !region.whole() && region.classify(part) == TrimRegion::Side::kOutside;
}

std::vector<FacePiece> pieces_of(const Face& face, const TrimRegion& region, Division division) {
  const SectionView view{face.surface, division.along_u};
  const ParameterRectangle& box = region.box();
  const double first = view.first(), last = view.last();
  const double w = division.along_u ? 0.5 * (box.v0 + box.v1) : 0.5 * (box.u0 + box.u1);
  std::sort(division.edges.begin(), division.edges.end(),
            [](const SectionStretch& a, const SectionStretch& b) { return a.first < b.first; });
  // The section in the middle may run through a place without a normal, and says nothing then.
  const double width = section_at(view, w, division.closed).width;
  tidy(view, w, width > 0.0 ? width : division.width, division);
  std::vector<FacePiece> pieces;
  const auto add = [&](std::vector<SectionStretch> stretches, bool edge) {
    // Samples beside a border are inset by rounding: what is left there is too short to be cut out, and nothing.
    const double least = 2.0 * kSameKnot * (last - first);
    const auto tidy_away = [&] {
      std::erase_if(stretches, [&](const SectionStretch& x) { return !(x.last - x.first > least); });
    };
    tidy_away();
    for (SectionStretch& stretch : stretches)
      if (division.closed) stretch = unwound(stretch, first, last);
    if (!region.whole()) cut_at_seam(first, last, stretches), tidy_away();
    std::sort(stretches.begin(), stretches.end(),
              [](const SectionStretch& a, const SectionStretch& b) { return a.first < b.first; });
    // A surface may go on past the trims.
    std::erase_if(stretches, [&](const SectionStretch& x) { return is_outside(region, division, x); });
    for (const SectionStretch& stretch : stretches)
      pieces.push_back({cut_face(face, division.along_u, stretch.first, stretch.last), edge});
  };
  add(sides_between(division, first, last), false);
  if (pieces.empty()) return {};
  add(division.edges, true);
  return pieces.size() > 1 ? pieces : std::vector<FacePiece>();
}

}  // namespace

std::vector<FacePiece> face_pieces(const Face& of) {
  const BSplineSurface& s = of.surface;
  const TrimRegion region(of.loops, {s.u_first(), s.u_last(), s.v_first(), s.v_last()});
  Face face = of;
  if (region.whole()) face.loops.clear();  // they follow the surface's border, and would bind the pieces to the seam
  std::optional<Division> best;
  for (const bool along_u : {true, false}) {
    std::optional<Division> division = division_along(face, region.box(), along_u);
    if (division && (!best || division->edges.size() > best->edges.size())) best = std::move(division);
  }
  return best ? pieces_of(face, region, *best) : std::vector<FacePiece>();
}

bool goes_all_round(const Face& face, const std::vector<FacePiece>& pieces) {
  constexpr double kOpen = 0.35;  // between a section's ends, of its length: a half circle has 0.64, an aerofoil 0
  constexpr int kLines = 9, kSteps = 64;
  const auto sides = std::count_if(pieces.begin(), pieces.end(), [](const FacePiece& piece) { return !piece.edge; });
  if (sides < 2) return false;
  const BSplineSurface &whole = face.surface, &first = pieces.front().face.surface;
  const bool along_u = first.u_last() - first.u_first() < whole.u_last() - whole.u_first();
  std::vector<double> openings;
  for (int k = 1; k <= kLines; ++k) {
    const double along = k / (kLines + 1.0);
    const auto point = [&](int step) {
      const double across = static_cast<double>(step) / kSteps, u = along_u ? across : along,
                   v = along_u ? along : across;
      return whole.value(whole.u_first() + u * (whole.u_last() - whole.u_first()),
                         whole.v_first() + v * (whole.v_last() - whole.v_first()));
    };
    double length = 0.0;
    for (int step = 0; step < kSteps; ++step) length += (point(step + 1) - point(step)).norm();
    openings.push_back(length > 0.0 ? (point(kSteps) - point(0)).norm() / length : 1.0);
  }
  std::nth_element(openings.begin(), openings.begin() + kLines / 2, openings.end());
  return openings[kLines / 2] < kOpen;
}

}  // namespace flank::internal

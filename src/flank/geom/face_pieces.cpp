#include "flank/geom/face_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "flank/geom/face_cut.h"
#include "flank/geom/spline_segment.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kSections = 33;                  ///< lines across the face that are looked at
constexpr double kSectionShare = 0.8;          ///< of them have to agree about the number of edges
constexpr double kFinestTurn = 4.0 * kDegree;  ///< between neighbouring samples of a section
constexpr int kHalvings = 14;                  ///< of a knot span, towards that
constexpr double kLeastSide = 0.1;  ///< shorter sides, as a share of the width, belong to the edges about them
constexpr double kGap = 0.03;       ///< shorter calm stretches within an edge are part of it
constexpr double kSharp = 1e-4;     ///< an edge that is shorter is a cut and no piece

struct Sample {
  double t;
  Vec3 point, normal;
};

/// A stretch of a section; `last` may lie past the end of a closed one.
struct Stretch {
  double first = 0.0, last = 0.0;
  [[nodiscard]] double middle() const { return 0.5 * (first + last); }
};

/// One line across the face.
struct Section {
  std::vector<Sample> samples;
  double width = 0.0;  ///< largest distance between two of its points, mm
  double turn = 0.0;   ///< largest angle between two of its normals
};

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The surface as seen from one of its two directions: t goes across the edges, w along them.
struct View {
  const BSplineSurface& s;
  bool along_u;  ///< t is u

  [[nodiscard]] double first() const { return along_u ? s.u_first() : s.v_first(); }
  [[nodiscard]] double last() const { return along_u ? s.u_last() : s.v_last(); }
  [[nodiscard]] std::optional<Sample> at(double t, double w) const {
    const SurfaceJet jet = along_u ? s.jet(t, w) : s.jet(w, t);
    const Vec3 cross = jet.du.cross(jet.dv);
    const double length = cross.norm();
    if (!(length > 1e-12 * std::max(jet.du.squaredNorm(), jet.dv.squaredNorm()))) return std::nullopt;
    return Sample{t, jet.p, cross / length};
  }
};

/// Appends samples up to `b`, so near that the normal turns little from one to the next.
bool sample(const View& view, double w, const Sample& b, int halvings, std::vector<Sample>& samples) {
  const Sample a = samples.back();
  if (halvings > 0 && angle(a.normal, b.normal) > kFinestTurn) {
    const std::optional<Sample> middle = view.at(0.5 * (a.t + b.t), w);
    if (!middle || !sample(view, w, *middle, halvings - 1, samples)) return false;
    return sample(view, w, b, halvings - 1, samples);
  }
  samples.push_back(b);
  return true;
}

/// Empty where the surface has no normal. `closed`: ends with its start, so that a kink at the seam is seen.
Section section_at(const View& view, double w, bool closed) {
  Section section;
  const std::vector<double>& knots = view.along_u ? view.s.knots_u : view.s.knots_v;
  const int degree = view.along_u ? view.s.degree_u : view.s.degree_v;
  const int steps = 2 * degree + 2;
  const std::optional<Sample> start = view.at(view.first(), w);
  if (!start) return section;
  section.samples.push_back(*start);
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double a = std::max(knots[k], view.first()), b = std::min(knots[k + 1], view.last());
    // Inside of its span: at a crease the normal is that of this side. The jump is between the last of one span and the
    // first of the next.
    for (int i = 0; i <= steps && b > a; ++i) {
      const double inset = 1e-9 * (b - a);
      const std::optional<Sample> next = view.at(std::clamp(a + (b - a) * i / steps, a + inset, b - inset), w);
      if (!next || !sample(view, w, *next, i == 0 ? 0 : kHalvings, section.samples)) return {};
    }
  }
  if (closed) section.samples.push_back({view.last(), start->point, start->normal});
  const std::size_t stride = std::max<std::size_t>(1, section.samples.size() / 64);
  for (std::size_t i = 0; i < section.samples.size(); i += stride) {
    for (std::size_t j = 0; j < i; j += stride) {
      section.width = std::max(section.width, (section.samples[i].point - section.samples[j].point).norm());
      section.turn = std::max(section.turn, angle(section.samples[i].normal, section.samples[j].normal));
    }
  }
  return section;
}

/// Lengths along the section at its samples.
std::vector<double> lengths_of(const Section& section) {
  std::vector<double> lengths{0.0};
  for (std::size_t i = 1; i < section.samples.size(); ++i)
    lengths.push_back(lengths.back() + (section.samples[i].point - section.samples[i - 1].point).norm());
  return lengths;
}

/// A stretch in samples: from one to another, past the end of a closed section by its count.
struct Run {
  std::size_t first, last;
  double turn;
};

/// The stretches that bend like an edge, with calm gaps closed, that turn enough. `closed`: the end goes on at the start.
std::vector<Run> edge_runs(const Section& section, const std::vector<double>& lengths, bool closed) {
  const std::size_t count = section.samples.size() - 1;
  const auto turn_of = [&](std::size_t i) {
    return angle(section.samples[i % count].normal, section.samples[i % count + 1].normal);
  };
  const auto length_of = [&](std::size_t i) { return lengths[i % count + 1] - lengths[i % count]; };
  const auto bent = [&](std::size_t i) {
    const double turn = turn_of(i), length = length_of(i);
    return turn > 1e-6 && turn * section.width > kEdgeBend * length;
  };
  // A closed section is looked at from the end of its longest calm stretch on.
  std::size_t begin = 0;
  double calm = 0.0, longest = 0.0;
  for (std::size_t i = 0; closed && i < 2 * count; ++i) {
    calm = bent(i) ? 0.0 : calm + length_of(i);
    if (calm > longest) longest = calm, begin = (i + 1) % count;
  }
  std::vector<Run> runs;
  double gap = 0.0;
  for (std::size_t i = begin; i < begin + count; ++i) {
    if (!bent(i)) {
      gap += length_of(i);
      continue;
    }
    if (runs.empty() || gap > kGap * section.width) runs.push_back({i, i + 1, 0.0});
    runs.back().last = i + 1;
    runs.back().turn += turn_of(i);
    gap = 0.0;
  }
  std::erase_if(runs, [](const Run& run) { return run.turn < kEdgeTurnDeg * kDegree; });
  return runs;
}

/// Joins edges between which there is no side worth the name.
std::vector<Run> with_sides(std::vector<Run> runs, const Section& section, const std::vector<double>& lengths) {
  const std::size_t count = section.samples.size() - 1;
  const auto length_at = [&](std::size_t i) { return lengths[i % count] + (i >= count ? lengths.back() : 0.0); };
  std::vector<Run> joined;
  for (const Run& run : runs) {
    if (!joined.empty() && length_at(run.first) - length_at(joined.back().last) < kLeastSide * section.width) {
      joined.back().last = run.last;
      joined.back().turn += run.turn;
    } else {
      joined.push_back(run);
    }
  }
  return joined;
}

/// Where a section's edges are.
std::vector<Stretch> edges_of(const Section& section, bool closed) {
  if (section.samples.size() < 3 || section.turn < kWrapTurnDeg * kDegree) return {};
  const std::vector<double> lengths = lengths_of(section);
  const std::size_t count = section.samples.size() - 1;
  const double period = section.samples.back().t - section.samples.front().t;
  const auto parameter = [&](std::size_t i) {
    return i <= count ? section.samples[i].t : section.samples[i - count].t + period;
  };
  std::vector<Stretch> edges;
  for (const Run& run : with_sides(edge_runs(section, lengths, closed), section, lengths))
    edges.push_back({parameter(run.first), parameter(run.last)});
  return edges;
}

/// The stretches of all sections together: what any of them calls the k-th edge, matched by their middles.
class Edges {
 public:
  Edges(std::vector<Stretch> first, double period) : edges_(std::move(first)), period_(period) {}

  /// False if the edges lie elsewhere.
  bool add(const std::vector<Stretch>& others) {
    std::vector<Stretch> grown = edges_;
    std::vector<char> met(edges_.size(), 0);
    for (Stretch other : others) {
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

  [[nodiscard]] const std::vector<Stretch>& edges() const { return edges_; }

 private:
  std::vector<Stretch> edges_;
  double period_;
};

struct Division {
  bool along_u = true;
  bool closed = false;  ///< the surface closes upon itself, whatever the trims leave of it
  std::vector<Stretch> edges;
  double width = 0.0;  ///< of the widest section, mm
};

/// The edges that most sections across the face agree about; none: it is not to be divided in this direction.
std::optional<Division> division_along(const Face& face, const ParameterRectangle& box, bool along_u) {
  const View view{face.surface, along_u};
  Division division{along_u, is_closed(face.surface, along_u), {}, 0.0};
  const double low = along_u ? box.v0 : box.u0, high = along_u ? box.v1 : box.u1;
  // Most faces wrap round nothing: a few sections tell.
  bool wraps = false;
  for (const double share : {0.2, 0.5, 0.8}) {
    const Section section = section_at(view, low + (high - low) * share, division.closed);
    wraps = wraps || !edges_of(section, division.closed).empty();
  }
  if (!wraps) return std::nullopt;
  std::vector<std::vector<Stretch>> all;
  std::vector<int> count_of(16, 0);
  int sections = 0;
  for (int k = 0; k < kSections; ++k) {
    // Not on the borders themselves, where a tip may have shrunk to a point.
    const Section section = section_at(view, low + (high - low) * (k + 0.5) / kSections, division.closed);
    if (section.samples.empty()) continue;
    ++sections;
    all.push_back(edges_of(section, division.closed));
    division.width = std::max(division.width, section.width);
    ++count_of[std::min(all.back().size(), count_of.size() - 1)];
  }
  const auto most = static_cast<std::size_t>(std::max_element(count_of.begin(), count_of.end()) - count_of.begin());
  if (most == 0 || most + 1 == count_of.size() || count_of[most] < kSectionShare * sections) return std::nullopt;
  std::erase_if(all, [&](const std::vector<Stretch>& edges) { return edges.size() != most; });
  const double period = view.last() - view.first();
  Edges edges(all[all.size() / 2], division.closed ? period : 1e300);
  for (const std::vector<Stretch>& section : all)
    if (!edges.add(section)) return std::nullopt;
  division.edges = edges.edges();
  return division;
}

/// The stretches between the edges.
std::vector<Stretch> sides_between(const Division& division, double first, double last) {
  std::vector<Stretch> sides;
  const std::vector<Stretch>& edges = division.edges;
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
Stretch unwound(Stretch stretch, double first, double last) {
  const double period = last - first, tiny = 1e-9 * period;
  const double shift = std::floor((stretch.first - first + tiny) / period) * period;
  return {std::max(stretch.first - shift, first), stretch.last - shift};
}

/// A trimmed face is not cut across its seam: what goes across it is two stretches.
void cut_at_seam(double first, double last, std::vector<Stretch>& stretches) {
  const std::size_t count = stretches.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (stretches[k].last <= last) continue;
    stretches.push_back({first, stretches[k].last - (last - first)});
    stretches[k].last = last;
  }
}

/// Length across the middle of the face, mm.
double length_of(const View& view, const Stretch& stretch, double w) {
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
void tidy(const View& view, double w, double width, Division& division) {
  const double first = view.first(), last = view.last();
  if (!division.closed) {
    Stretch &low = division.edges.front(), &high = division.edges.back();
    if (length_of(view, {first, low.first}, w) < kLeastSide * width) low.first = first;
    if (length_of(view, {high.last, last}, w) < kLeastSide * width) high.last = last;
  }
  for (Stretch& edge : division.edges) {
    if (length_of(view, edge, w) >= kSharp * width) continue;
    if (!division.closed && edge.first == first)
      edge.last = first;
    else if (!division.closed && edge.last == last)
      edge.first = last;
    else
      edge.first = edge.last = edge.middle();
  }
}

bool is_outside(const TrimRegion& region, const Division& division, const Stretch& stretch) {
  ParameterRectangle part = region.box();
  (division.along_u ? part.u0 : part.v0) = stretch.first;
  (division.along_u ? part.u1 : part.v1) = stretch.last;
  return !region.whole() && region.classify(part) == TrimRegion::Side::kOutside;
}

std::vector<FacePiece> pieces_of(const Face& face, const TrimRegion& region, Division division) {
  const View view{face.surface, division.along_u};
  const ParameterRectangle& box = region.box();
  const double first = view.first(), last = view.last();
  const double w = division.along_u ? 0.5 * (box.v0 + box.v1) : 0.5 * (box.u0 + box.u1);
  std::sort(division.edges.begin(), division.edges.end(),
            [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
  // The section in the middle may run through a place without a normal, and says nothing then.
  const double width = section_at(view, w, division.closed).width;
  tidy(view, w, width > 0.0 ? width : division.width, division);
  std::vector<FacePiece> pieces;
  const auto add = [&](std::vector<Stretch> stretches, bool edge) {
    // Samples beside a border are inset by rounding: what is left there is too short to be cut out, and nothing.
    const double least = 2.0 * kSameKnot * (last - first);
    const auto tidy_away = [&] {
      std::erase_if(stretches, [&](const Stretch& x) { return !(x.last - x.first > least); });
    };
    tidy_away();
    for (Stretch& stretch : stretches)
      if (division.closed) stretch = unwound(stretch, first, last);
    if (!region.whole()) cut_at_seam(first, last, stretches), tidy_away();
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    // A surface may go on past the trims.
    std::erase_if(stretches, [&](const Stretch& x) { return is_outside(region, division, x); });
    for (const Stretch& stretch : stretches)
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

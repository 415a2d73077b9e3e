#include "flank/geom/pieces/face_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFinestTurn = 4.0 * kDegree;  ///< between neighbouring samples of a section
constexpr int kHalvings = 14;                  ///< of a knot span, towards that
constexpr double kGap = 0.03;                  ///< shorter calm stretches within an edge are part of it

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Appends samples up to `b`, so near that the normal turns little from one to the next.
bool sample(const SectionView& view, double w, const SectionSample& b, int halvings,
            std::vector<SectionSample>& samples) {
  const SectionSample a = samples.back();
  if (halvings > 0 && angle(a.normal, b.normal) > kFinestTurn) {
    const std::optional<SectionSample> middle = view.at(0.5 * (a.t + b.t), w);
    if (!middle || !sample(view, w, *middle, halvings - 1, samples)) return false;
    return sample(view, w, b, halvings - 1, samples);
  }
  samples.push_back(b);
  return true;
}

/// Lengths along the section at its samples.
std::vector<double> lengths_of(const FaceSection& section) {
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

/// The stretches that bend like an edge, with calm gaps closed, that turn by at least `turn_deg`. `closed`: the end goes on at the start.
std::vector<Run> edge_runs(const FaceSection& section, const std::vector<double>& lengths, bool closed,
                           double turn_deg) {
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
  std::erase_if(runs, [&](const Run& run) { return run.turn < turn_deg * kDegree; });
  return runs;
}

/// Joins edges between which there is no side worth the name.
std::vector<Run> with_sides(std::vector<Run> runs, const FaceSection& section, const std::vector<double>& lengths) {
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

}  // namespace

FaceSection section_at(const SectionView& view, double w, bool closed) {
  FaceSection section;
  const std::vector<double>& knots = view.along_u ? view.s.knots_u : view.s.knots_v;
  const int degree = view.along_u ? view.s.degree_u : view.s.degree_v;
  const int steps = 2 * degree + 2;
  const std::optional<SectionSample> start = view.at(view.first(), w);
  if (!start) return section;
  section.samples.push_back(*start);
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double a = std::max(knots[k], view.first()), b = std::min(knots[k + 1], view.last());
    // Inside of its span: at a crease the normal is that of this side. The jump is between the last of one span and the
    // first of the next.
    for (int i = 0; i <= steps && b > a; ++i) {
      const double inset = 1e-9 * (b - a);
      const std::optional<SectionSample> next = view.at(std::clamp(a + (b - a) * i / steps, a + inset, b - inset), w);
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

std::vector<SectionStretch> edges_of(const FaceSection& section, bool closed, double turn_deg) {
  if (section.samples.size() < 3 || section.turn < kWrapTurnDeg * kDegree) return {};
  const std::vector<double> lengths = lengths_of(section);
  const std::size_t count = section.samples.size() - 1;
  const double period = section.samples.back().t - section.samples.front().t;
  const auto parameter = [&](std::size_t i) {
    return i <= count ? section.samples[i].t : section.samples[i - count].t + period;
  };
  std::vector<SectionStretch> edges;
  for (const Run& run : with_sides(edge_runs(section, lengths, closed, turn_deg), section, lengths))
    edges.push_back({parameter(run.first), parameter(run.last)});
  return edges;
}

}  // namespace flank::internal

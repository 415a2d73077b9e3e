#include "flank/cover/curves/line_clusters.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// Lines per task: each costs a distance to every centre, some hundred of them.
constexpr std::size_t kGrain = 64;
/// Mean of (s - L/2)^2 over [0, L], over L^2: what a difference of the axes weighs against one of the middles.
constexpr double kTurnVariance = 12.0;

/// A mean of lines: its axis is not of unit length.
struct Centre {
  Vec3 middle = Vec3::Zero(), axis = Vec3::Zero();
};

class Clustering {
 public:
  Clustering(const std::vector<Pose>& lines, double axis_length, const LineClusterOptions& options)
      : weight_(axis_length * axis_length / kTurnVariance), ends_alike_(options.ends_alike) {
    for (const Pose& line : lines) lines_.push_back({line.at(0.5 * axis_length), line.axis});
    cluster_.assign(lines.size(), -1);
    distance_.assign(lines.size(), 1e300);
  }

  void spread(int count, Random& random);
  bool assign();
  void update();
  [[nodiscard]] LineClusters result() const;

 private:
  [[nodiscard]] bool turned(const Centre& line, const Centre& centre) const {
    return ends_alike_ && line.axis.dot(centre.axis) < 0.0;
  }
  [[nodiscard]] double distance(const Centre& line, const Centre& centre) const {
    const Vec3 turn = turned(line, centre) ? Vec3(line.axis + centre.axis) : Vec3(line.axis - centre.axis);
    return (line.middle - centre.middle).squaredNorm() + weight_ * turn.squaredNorm();
  }

  double weight_;
  bool ends_alike_;
  std::vector<Centre> lines_, centres_;
  std::vector<int> cluster_;
  std::vector<double> distance_;  ///< of each line to its cluster's centre, squared
};

/// First centres, each line drawn with a chance proportional to its squared distance from those before (k-means++).
void Clustering::spread(int count, Random& random) {
  std::size_t next = static_cast<std::size_t>(random.uniform() * static_cast<double>(lines_.size()));
  while (static_cast<int>(centres_.size()) < count) {
    centres_.push_back(lines_[next]);
    double sum = 0.0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      distance_[k] = std::min(distance_[k], distance(lines_[k], centres_.back()));
      sum += distance_[k];
    }
    if (!(sum > 0.0)) break;  // every line is a centre
    double left = random.uniform() * sum;
    for (next = 0; next + 1 < lines_.size() && (left -= distance_[next]) >= 0.0;) ++next;
  }
}

/// Every line to its nearest centre, the first of equals; returns whether anything changed.
bool Clustering::assign() {
  std::vector<int> nearest(lines_.size());
  parallel_blocks(lines_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      distance_[k] = 1e300;
      for (std::size_t c = 0; c < centres_.size(); ++c) {
        const double d = distance(lines_[k], centres_[c]);
        if (d >= distance_[k]) continue;
        distance_[k] = d;
        nearest[k] = static_cast<int>(c);
      }
    }
  });
  const bool changed = nearest != cluster_;
  cluster_ = std::move(nearest);
  return changed;
}

/// Means of the clusters. A mean axis is shorter than 1 if the axes differ: as a point of the six-dimensional space it
/// is right like that, and normalising it would make Lloyd's rounds lose their descent.
void Clustering::update() {
  std::vector<Centre> sums(centres_.size());
  std::vector<int> counts(centres_.size(), 0);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto c = static_cast<std::size_t>(cluster_[k]);
    sums[c].middle += lines_[k].middle;
    sums[c].axis += turned(lines_[k], centres_[c]) ? Vec3(-lines_[k].axis) : lines_[k].axis;
    ++counts[c];
  }
  for (std::size_t c = 0; c < centres_.size(); ++c)
    if (counts[c] > 0) centres_[c] = {sums[c].middle / counts[c], sums[c].axis / counts[c]};
}

/// Clusters numbered without the empty ones. Of lines equally near to their mean the first stands for them.
LineClusters Clustering::result() const {
  std::vector<int> best(centres_.size(), -1), number(centres_.size(), -1);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    int& of_cluster = best[static_cast<std::size_t>(cluster_[k])];
    if (of_cluster < 0 || distance_[k] < distance_[static_cast<std::size_t>(of_cluster)])
      of_cluster = static_cast<int>(k);
  }
  LineClusters out;
  for (std::size_t c = 0; c < best.size(); ++c) {
    if (best[c] < 0) continue;
    number[c] = static_cast<int>(out.representatives.size());
    out.representatives.push_back(best[c]);
  }
  for (const int c : cluster_) out.cluster.push_back(number[static_cast<std::size_t>(c)]);
  return out;
}

}  // namespace

double squared_line_distance(const Pose& a, const Pose& b, double axis_length) {
  return (a.at(0.5 * axis_length) - b.at(0.5 * axis_length)).squaredNorm() +
         axis_length * axis_length / kTurnVariance * (a.axis - b.axis).squaredNorm();
}

Pose turned_round(const Pose& pose, double axis_length) { return {pose.at(axis_length), -pose.axis}; }

LineClusters cluster_lines(const std::vector<Pose>& lines, double axis_length, const LineClusterOptions& options) {
  FLANK_ASSERT(options.clusters >= 1 && axis_length > 0.0);
  if (lines.empty()) return {};
  Clustering clustering(lines, axis_length, options);
  Random random(options.seed);
  clustering.spread(options.clusters, random);
  int rounds = 0;
  while (rounds < options.rounds && clustering.assign()) {
    clustering.update();
    ++rounds;
  }
  (void)clustering.assign();
  LineClusters out = clustering.result();
  out.rounds = rounds;
  return out;
}

}  // namespace flank::internal

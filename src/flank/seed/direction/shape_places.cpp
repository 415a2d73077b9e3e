#include "flank/seed/direction/shape_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_map>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Samples of the target per place: a region of 40 is about six across, enough to have a shape of its own.
constexpr int kSamplesPerPlace = 40;
/// Rounds of Lloyd's iteration after the last region was added. Not run to the end: the places are seeds, and nothing
/// depends on where exactly they lie.
constexpr int kRounds = 12;
/// Spacings: samples that are closer than this count as connected. Between sqrt(2) and 2: on a square grid the eight
/// neighbours around a sample, and none of the next ring.
constexpr double kNeighbours = 1.7;
/// Lattice numbers are packed into 63 bits, 21 for each coordinate; farther places wrap round, which costs time only,
/// as distances are compared all the same.
constexpr int kLatticeBits = 21;
constexpr std::int64_t kLatticeMask = (std::int64_t{1} << kLatticeBits) - 1;
/// What a place counts against a normal, over the size of a region: ties of flat targets are broken by distance.
constexpr double kPlaceShare = 1e-3;

using Neighbours = std::vector<std::vector<int>>;

/// The cube of a lattice that holds p, or its k-th neighbour; k = 13: itself. Whole numbers are added, not lengths: a
/// place on the wall between two cubes would skip one.
std::int64_t bucket_of(const Vec3& p, double width, int k = 13) {
  const auto index = [&](double x, int shift) {
    return (static_cast<std::int64_t>(std::floor(x / width)) + shift) & kLatticeMask;
  };
  return index(p.x(), k % 3 - 1) | index(p.y(), k / 3 % 3 - 1) << kLatticeBits |
         index(p.z(), k / 9 - 1) << 2 * kLatticeBits;
}

/// Samples that are near and look the same way: not those of the other side of a thin blade.
Neighbours neighbours_of(const std::vector<SurfaceSample>& samples, double reach) {
  std::unordered_map<std::int64_t, std::vector<int>> buckets;
  for (std::size_t k = 0; k < samples.size(); ++k)
    buckets[bucket_of(samples[k].point, reach)].push_back(static_cast<int>(k));
  Neighbours near(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    for (int i = 0; i < 27; ++i) {
      const auto found = buckets.find(bucket_of(samples[k].point, reach, i));
      if (found == buckets.end()) continue;
      for (const int other : found->second) {
        const SurfaceSample& o = samples[static_cast<std::size_t>(other)];
        if (static_cast<std::size_t>(other) != k && (o.point - samples[k].point).norm() <= reach &&
            o.normal.dot(samples[k].normal) > 0.0)
          near[k].push_back(other);
      }
    }
    std::sort(near[k].begin(), near[k].end());  // the order of a hash map is nobody's promise
  }
  return near;
}

/// A region's plane, and the middle of it.
struct Proxy {
  Vec3 normal = Vec3::UnitZ(), middle = Vec3::Zero();
};

class Regions {
 public:
  Regions(const std::vector<SurfaceSample>& samples, const Neighbours& near, double size)
      : samples_(samples), near_(near), size_(size), region_(samples.size()) {}

  std::vector<int> best_samples(int count);

 private:
  [[nodiscard]] double error(const Proxy& proxy, int k) const {
    const SurfaceSample& sample = samples_[static_cast<std::size_t>(k)];
    const double off = (sample.point - proxy.middle).norm() / size_;
    return (sample.normal - proxy.normal).squaredNorm() + kPlaceShare * off * off;
  }
  void flood(const std::vector<int>& seeds, const std::vector<Proxy>& proxies);
  [[nodiscard]] std::vector<Proxy> proxies_of(std::vector<Proxy> proxies) const;
  void settle(std::vector<int>& seeds, std::vector<Proxy>& proxies);
  [[nodiscard]] int worst_sample(const std::vector<Proxy>& proxies) const;

  const std::vector<SurfaceSample>& samples_;
  const Neighbours& near_;
  double size_;
  std::vector<int> region_;  ///< of each sample; -1: not reached
};

/// Every region takes the sample with the least error that touches any; ties go to the lower index.
void Regions::flood(const std::vector<int>& seeds, const std::vector<Proxy>& proxies) {
  struct Offer {
    double error;
    int sample, region;
    bool operator<(const Offer& o) const {
      return error != o.error ? error > o.error : sample != o.sample ? sample > o.sample : region > o.region;
    }
  };
  std::priority_queue<Offer> offers;
  std::fill(region_.begin(), region_.end(), -1);
  const auto take = [&](int k, int region) {
    region_[static_cast<std::size_t>(k)] = region;
    for (const int n : near_[static_cast<std::size_t>(k)])
      if (region_[static_cast<std::size_t>(n)] < 0)
        offers.push({error(proxies[static_cast<std::size_t>(region)], n), n, region});
  };
  for (std::size_t r = 0; r < seeds.size(); ++r) region_[static_cast<std::size_t>(seeds[r])] = static_cast<int>(r);
  for (std::size_t r = 0; r < seeds.size(); ++r) take(seeds[r], static_cast<int>(r));
  while (!offers.empty()) {
    const Offer best = offers.top();
    offers.pop();
    if (region_[static_cast<std::size_t>(best.sample)] < 0) take(best.sample, best.region);
  }
}

/// Area-weighted mean normals: for the metric L^{2,1} they are the best planes (Cohen-Steiner et al. 2004). A
/// region without samples keeps what it had.
std::vector<Proxy> Regions::proxies_of(std::vector<Proxy> proxies) const {
  std::vector<Proxy> sums(proxies.size(), {Vec3::Zero(), Vec3::Zero()});
  std::vector<double> areas(proxies.size(), 0.0);
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    if (region_[k] < 0) continue;
    const auto r = static_cast<std::size_t>(region_[k]);
    sums[r].normal += samples_[k].area * samples_[k].normal;
    sums[r].middle += samples_[k].area * samples_[k].point;
    areas[r] += samples_[k].area;
  }
  for (std::size_t r = 0; r < proxies.size(); ++r)
    if (areas[r] > 0.0) proxies[r] = {sums[r].normal.normalized(), sums[r].middle / areas[r]};
  return proxies;
}

/// One round of Lloyd: regions from proxies, proxies from regions, and the best sample of each region as its next seed.
void Regions::settle(std::vector<int>& seeds, std::vector<Proxy>& proxies) {
  flood(seeds, proxies);
  proxies = proxies_of(std::move(proxies));
  std::vector<double> least(seeds.size(), 1e300);
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    if (region_[k] < 0) continue;
    const auto r = static_cast<std::size_t>(region_[k]);
    const double e = error(proxies[r], static_cast<int>(k));
    if (e >= least[r]) continue;
    least[r] = e;
    seeds[r] = static_cast<int>(k);
  }
}

/// The sample that its region serves worst, or that none has reached.
int Regions::worst_sample(const std::vector<Proxy>& proxies) const {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const double e = region_[k] < 0 ? 1e300 : error(proxies[static_cast<std::size_t>(region_[k])], static_cast<int>(k));
    if (e <= most) continue;
    most = e;
    worst = k;
  }
  return static_cast<int>(worst);
}

/// Regions are added one by one where they are missed most: spread evenly at first they would stay where nothing bends.
std::vector<int> Regions::best_samples(int count) {
  std::vector<int> seeds;
  std::vector<Proxy> proxies;
  for (int r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(r == 0 ? 0 : worst_sample(proxies));
    seeds.push_back(static_cast<int>(k));
    proxies.push_back({samples_[k].normal, samples_[k].point});
    settle(seeds, proxies);
  }
  for (int round = 0; round < kRounds; ++round) settle(seeds, proxies);
  return seeds;
}

}  // namespace

std::vector<SurfaceSample> shape_places(const Target& target, int count) {
  FLANK_ASSERT(count >= 1);
  const double spacing = std::sqrt(target.area() / (kSamplesPerPlace * count));
  const std::vector<SurfaceSample> samples = target.samples(spacing);
  const Neighbours near = neighbours_of(samples, kNeighbours * spacing);
  Regions regions(samples, near, std::sqrt(target.area() / count));
  std::vector<SurfaceSample> places;
  for (const int k : regions.best_samples(std::min(count, static_cast<int>(samples.size()))))
    places.push_back(samples[static_cast<std::size_t>(k)]);
  return places;
}

}  // namespace flank::internal

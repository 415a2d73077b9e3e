#include "flank/limit/ball_bound.h"

#include <algorithm>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr std::size_t kBlock = 64;      ///< sites between two looks at whether the run is to stop
constexpr std::size_t kMostOpen = 12;   ///< sites with neighbours in the next net
constexpr double kCoarseGap = 0.2;      ///< of all sites but the best of each net
constexpr double kBorderSpacing = 0.5;  ///< of the sites on the border, to those of the face
constexpr double kNoError = 1e-6;       ///< of the radius: less is rounding

struct Site {
  Vec3 point, normal;
  double area_mm2 = 0.0;
  LeastError error = {};
};

class Nets {
 public:
  Nets(const Target& face, const BallScene& scene, const BallBoundOptions& options, const Progress& progress)
      : face_(face), scene_(scene), options_(options), progress_(progress) {}

  BallBound run() {
    double spacing = options_.spacing_mm;
    std::vector<Site> sites = net(spacing);
    // A site that is out of reach is proved so; what lies above the tolerance is asked for all of them.
    look_at(sites, options_.tolerance_mm, 0.0, 1.0 / options_.levels);
    for (const Site& site : sites) {
      result_.area_mm2 += site.area_mm2;
      if (site.error.bound_mm > options_.tolerance_mm) result_.out_of_reach_mm2 += site.area_mm2;
    }
    for (int level = 1; level < options_.levels; ++level) {
      // What is due to the distance of two sites is all that a finer net can add.
      if (spacing < options_.gap * best_mm_) break;
      if (progress_.stop()) {
        result_.complete = false;
        break;
      }
      spacing *= 0.5;
      sites = finer(std::move(sites), spacing);
      if (sites.empty()) break;
      const double share = 1.0 / options_.levels;
      look_at(sites, best_mm_, share * level, share * (level + 1));
    }
    return finished();
  }

 private:
  /// Sites of the face and of its border.
  [[nodiscard]] std::vector<Site> net(double spacing) const {
    std::vector<Site> sites;
    for (const SurfaceSample& sample : face_.samples(spacing))
      sites.push_back({.point = sample.point, .normal = sample.normal, .area_mm2 = sample.area});
    for (const Vec3& point : face_.border_points(kBorderSpacing * spacing))
      sites.push_back({.point = point, .normal = Vec3::Zero()});
    lay(sites);
    return sites;
  }

  /// Onto the face.
  void lay(std::vector<Site>& sites) const {
    parallel_for(sites.size(), [&](std::size_t k) {
      const Footpoint foot = face_.closest(sites[k].point);
      sites[k].point = foot.point;
      sites[k].normal = foot.normal;
    });
  }

  /// Sites all round those with the largest errors. An error changes by no more than its site moves.
  [[nodiscard]] std::vector<Site> finer(std::vector<Site> before, double spacing) const {
    std::erase_if(before, [&](const Site& site) {
      return site.error.found_mm <= kNoError * options_.radius_mm ||
             site.error.found_mm + std::numbers::sqrt2 * spacing <= best_mm_ * (1.0 + options_.gap);
    });
    std::stable_sort(before.begin(), before.end(),
                     [](const Site& a, const Site& b) { return a.error.found_mm > b.error.found_mm; });
    if (before.size() > kMostOpen) before.resize(kMostOpen);
    std::vector<Site> sites;
    for (const Site& site : before) {
      const Vec3 across = site.normal.unitOrthogonal(), along = site.normal.cross(across);
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1})
          if (i != 0 || j != 0)
            sites.push_back({.point = site.point + spacing * (i * across + j * along), .normal = site.normal});
    }
    lay(sites);
    // What was open stays so: the next net is laid round the best of both.
    sites.insert(sites.end(), before.begin(), before.end());
    return sites;
  }

  void look_at(std::vector<Site>& sites, double enough_mm, double from, double to) {
    std::size_t done = 0;
    while (done < sites.size() && !progress_.stop()) {
      const std::size_t count = std::min(kBlock, sites.size() - done);
      const BallSearch search = {.gap = kCoarseGap, .enough_mm = enough_mm, .cubes = options_.cubes};
      parallel_for(count, [&](std::size_t k) {
        Site& site = sites[done + k];
        if (site.error.cubes > 0) return;
        site.error = least_error(site.point, site.normal, scene_, options_.radius_mm, search);
      });
      done += count;
      progress_.step("bound", from + (to - from) * static_cast<double>(done) / static_cast<double>(sites.size()));
    }
    result_.sites += static_cast<int>(done);
    result_.complete = result_.complete && done == sites.size();
    sites.resize(done);
    keep_best(sites);
  }

  /// The best site of each net, by what is proved, counts.
  void keep_best(const std::vector<Site>& sites) {
    const auto best = std::max_element(
        sites.begin(), sites.end(), [](const Site& a, const Site& b) { return a.error.bound_mm < b.error.bound_mm; });
    if (best == sites.end() || best->error.bound_mm <= 0.0) return;
    leaders_.push_back(*best);
    best_mm_ = std::max(best_mm_, best->error.bound_mm);
  }

  /// The best sites of the nets once more, closely. A further net only adds to them, so it never lowers the bound.
  BallBound finished() {
    for (const Site& site : leaders_) {
      LeastError close;
      if (site.error.found_mm > std::max(result_.bound_mm, best_mm_))
        close = least_error(site.point, site.normal, scene_, options_.radius_mm,
                            {.gap = options_.gap, .enough_mm = result_.bound_mm, .cubes = options_.cubes});
      const LeastError& error = close.bound_mm > site.error.bound_mm ? close : site.error;
      if (error.bound_mm <= result_.bound_mm) continue;
      result_.bound_mm = error.bound_mm;
      result_.found_mm = error.found_mm;
      result_.point = site.point;
      result_.normal = site.normal;
      result_.centre = error.centre;
    }
    return result_;
  }

  const Target& face_;
  const BallScene& scene_;
  const BallBoundOptions options_;
  const Progress& progress_;
  std::vector<Site> leaders_;
  double best_mm_ = 0.0;  ///< that is proved at one of them
  BallBound result_;
};

}  // namespace

BallBound ball_bound(const Target& face, const BallScene& scene, const BallBoundOptions& options,
                     const Progress& progress) {
  return Nets(face, scene, options, progress).run();
}

}  // namespace flank::internal

/// What the samples of one face add up to, tile by tile.
#pragma once

#include <span>
#include <vector>

#include "flank/judge.h"

namespace flank::internal::verify {

/// Sums over the samples of a face, in their order, so that the same bits come out every time. Areas in mm^2.
struct Sums {
  double area = 0.0, covered = 0.0, reachable = 0.0, covered_reachable = 0.0, touched = 0.0, squares = 0.0;
  /// Of the area that is proved not to be left: of all of it, of what is reachable.
  double proved = 0.0, proved_reachable = 0.0;
  /// So often as there are copies of the face.
  void add(const Sums& face, int copies);
};

double share_of(double part, double whole);

/// Puts a place first that is at least as deep as all others, and takes out those near it.
void add_place(const WorstPlace& deepest, double separation, int count, std::vector<WorstPlace>& worst);

/// Of the face's size: how far worst places keep from one another. Else all of them would lie in one scratch.
inline constexpr double kWorstSeparation = 0.05;

class FaceTally {
 public:
  /// `size_mm`: about the diagonal of the face. Tool and path must outlive the tally.
  FaceTally(const Tool& tool, const Path& path, const std::string& face, bool target, double size_mm,
            const JudgeOptions& options);

  /// `open_mm2`: of each sample, the area that is not proved to be finished (ProvedCover); empty: all of it.
  void add(const FaceSamples& samples, std::span<const SweptDistance> distances, std::span<const double> open_mm2);
  /// Histogram of f over the samples, in the bins of the report, area in mm^2.
  void add_histogram(VerifyReport& report, const FaceSamples& samples, std::span<const SweptDistance> distances) const;

  /// The figures of the samples alone; the bound is that of the samples.
  [[nodiscard]] FaceVerdict verdict() const;
  [[nodiscard]] const Sums& sums() const { return sums_; }
  [[nodiscard]] const std::vector<WorstPlace>& worst() const { return worst_; }
  [[nodiscard]] double separation() const { return separation_; }

 private:
  void add_sample(const FaceSamples& samples, std::size_t i, const SweptDistance& d, double open);
  void add_worst(const FaceSamples& samples, std::span<const SweptDistance> distances);
  [[nodiscard]] bool swept_past(const SweptDistance& d) const;

  const Tool& tool_;
  const Path& path_;
  double separation_, tolerance_, least_radius_;
  int places_;
  FaceVerdict verdict_;
  Sums sums_;
  double deepest_between_ = -1e300;    ///< a cell may be cut so deep
  Vec3 between_point_ = Vec3::Zero();  ///< its sample
  double largest_open_ = 0.0;
  std::vector<WorstPlace> worst_;
};

}  // namespace flank::internal::verify

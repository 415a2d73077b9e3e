/// Whether one more strip is worth a search.
#pragma once

#include "flank/fit.h"

namespace flank::internal {

/// Follows the best result of a search that takes more and more strips.
class StripGain {
 public:
  /// `wanted`: the covered share that is asked for. `facets_limit`: the triangles of a coarse mesh keep every motion from it.
  explicit StripGain(double tolerance_mm, double wanted, bool facets_limit = false)
      : tolerance_mm_(tolerance_mm), wanted_(wanted), facets_limit_(facets_limit) {}

  /// Takes the best result of all numbers of strips so far. False after two in a row (four where nearly all is covered, one where all that
  /// is wanted is, so that something else is amiss, or where facets limit what can be) that neither cover more, nor promise to: only what
  /// is not far from being clean counts, because more strips may make it clean.
  [[nodiscard]] bool goes_on(const FlankFitResult& best);

 private:
  double tolerance_mm_, wanted_;
  bool facets_limit_;
  double covered_ = 0.0, promised_ = 0.0;  ///< shares of the face, so far
  int without_gain_ = 0;
};

}  // namespace flank::internal

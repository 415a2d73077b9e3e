/// The tools that a set is chosen from.
#pragma once

#include <functional>
#include <vector>

#include "flank/design/design_result.h"

namespace flank::internal {

/// Runs tasks in the folder of the design.
using RunTasks = std::function<std::vector<TaskRow>(const std::vector<BatchTask>&)>;

/// What tasks of a design share.
struct DesignFolder {
  std::string path;    ///< absolute
  std::string inputs;  ///< SHA-256 of the files that every task reads beside the part
  RunTasks run;
};

/// Fits a tool to each face that is equal to none before it, then to ever more of them together: those whose tools are
/// most alike first, until one tool is for all; for a set of one tool that one alone. And of the catalogue the finalists for each of these faces and for all
/// of them. Needs `job`, `faces`, `equal` and `reach_radius_mm` of the result; appends to its `tools`, and writes their
/// files.
void find_candidates(DesignResult& result, const DesignFolder& folder);

/// Faces to fit a tool to where none finishes all: those of the fit whose tool finishes most faces, each replaced by that
/// of its equals at which the tool enters deepest, because what stands around it leaves the least room. Empty: there is no
/// such fit, or nothing would be replaced. Needs `pairs`.
[[nodiscard]] std::vector<std::size_t> refit_group(const DesignResult& result);

/// Fits a tool to refit_group and appends it to `tools`.
void add_refitted(DesignResult& result, const DesignFolder& folder);

/// In which order tools are put together: groups of faces (indices into `tools`), of at least two, each the union of two
/// earlier ones or of single faces; the last holds all. By the largest difference of radius and length (mm) between any
/// two of their tools. Null: there is no tool for this face, and it comes last.
[[nodiscard]] std::vector<std::vector<std::size_t>> merge_order(const std::vector<const Tool*>& tools);

}  // namespace flank::internal

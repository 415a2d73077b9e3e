/// The judge's work for fit, cover and verify: samples, reachable share and figures.
#pragma once

#include <optional>
#include <vector>

#include "flank/judge.h"
#include "flank/setup/setup.h"
#include "flank/verify/program_stock.h"

namespace flank::internal {

/// The tool as the judge measures it against the part's own faces: thicker by what is left on them. Where its flank touches a face, the
/// tool's touches the face moved out; so f of the one is f of the other, at the same place of the path.
[[nodiscard]] Tool judged_tool(const Setup& setup, const Tool& tool);

/// Judges tool and path on the targets and check faces. Shank, holder and fixtures are not in it (clearance_scene.h).
/// `depth`: kSampled leaves out the proofs: of the depth, as a spacing in the request does, and of the coverage.
[[nodiscard]] VerifyReport judge_job(const Setup& setup, const JudgeRequest& request, const Tool& tool,
                                     const Path& path, DepthProof depth = DepthProof::kProved);

/// What a path that finishes nothing cuts: every judged face is one that must not be cut, and that is proved; and whether the path runs
/// inside the material.
[[nodiscard]] VerifyReport judge_cuts(const Setup& setup, const Tool& tool, const Path& path);

/// Replays the program of a cavity in the judge's stock. `most_triangles`: of the mesh of what is left; 0: none.
[[nodiscard]] ProgramStock judge_stock(const Setup& setup, const TrochoidJob& job, const Tool& tool, const Path& path,
                                       const std::vector<HalfSpace>& blank, double most_triangles);

/// Spacing of the judge's samples on the target if none is given, mm; finer on one that is small in a large part.
[[nodiscard]] double default_spacing(double diagonal_mm);

/// The spacing, no finer than that, of about so many samples on all faces together, as far as a target can do with them; finer
/// for a target that is small in a large part.
[[nodiscard]] double coarse_spacing(const Setup& setup, double most_samples);

}  // namespace flank::internal

// What the benchmarks of the fit share: an exact envelope as a NURBS face and as a mesh, a start that is off, and the
// real error of a result.
#pragma once

#include <algorithm>
#include <ctime>
#include <memory>
#include <string>

#include "flank/base/random.h"
#include "flank/example.h"
#include "flank/example/example_mesh.h"
#include "flank/example/example_perturb.h"
#include "flank/target.h"

namespace flank::internal::bench {

struct Scene {
  std::string name;
  RuledMotion truth, start;  // start: off by 1e-2 of the diagonal
  TriangleMesh mesh;         // about 13,000 vertices, exactly on the envelope
  std::unique_ptr<Target> face;
  double diagonal = 0.0;
};

inline Scene make_scene(const std::string& name) {
  const Example example = make_example(name);
  Scene scene;
  scene.name = name;
  scene.truth = example.truth->motions.front();
  scene.diagonal = example.diagonal_mm;
  scene.mesh = envelope_mesh(scene.truth, example.truth->tool.radial, 145, 90);
  scene.face = make_target({example.faces.front()});
  Random random(5);
  scene.start = perturb(scene.truth, 0.01, scene.diagonal, random);
  return scene;
}

// CPU time of this process. With one thread it is the wall time of a machine that has nothing else to do, so that a
// busy one does not decide a race.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// CPU time of the fastest of `repeats` calls.
template <class F>
double fastest(int repeats, F&& f) {
  double best = 1e300;
  for (int k = 0; k < repeats; ++k) {
    const double begin = cpu_seconds();
    f();
    best = std::min(best, cpu_seconds() - begin);
  }
  return best;
}

}  // namespace flank::internal::bench

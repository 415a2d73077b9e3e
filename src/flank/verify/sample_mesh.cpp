#include "flank/verify/sample_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/error.h"
#include "flank/judge.h"

namespace flank {
namespace {

using namespace internal::verify;

/// Of a triangle's sides: bounds the number of samples if the spacing is absurdly small.
constexpr double kMostParts = 20000.0;
constexpr double kMostSamples = 1e9;  ///< of a mesh: bounds the number of tiles

// A triangle is cut into n^2 similar ones, each as large as the spacing allows; a centroid is farthest from its own
// corners. Rows of them lie along the second side.
class MeshSampler final : public Sampler {
 public:
  MeshSampler(const std::string& id, const TriangleMesh& mesh, double spacing_mm, bool target, std::size_t most)
      : id_(id), mesh_(mesh), spacing_(spacing_mm), target_(target) {
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) count_ += std::pow(parts_of(k), 2);
    if (count_ > kMostSamples)
      throw UsageError(fmt::format("a sample spacing of {} mm gives {:.3g} samples on {}; {:.3g} are accepted",
                                   spacing_mm, count_, id, kMostSamples));
    std::size_t filled = most;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto n = static_cast<std::size_t>(parts_of(k));
      const std::size_t rows = n * n <= most ? n : std::max<std::size_t>(1, most / (2 * n));
      for (std::size_t i = 0; i < n; i += rows) {
        if (filled >= most) {
          starts_.push_back({k, static_cast<int>(i)});
          filled = 0;
        }
        filled += std::min(rows, n - i) * n;
      }
    }
    starts_.push_back({mesh.triangles.size(), 0});
  }

  [[nodiscard]] std::size_t tiles() const override { return std::max<std::size_t>(1, starts_.size() - 1); }
  [[nodiscard]] double count() const override { return count_; }
  [[nodiscard]] double size_mm() const override { return mesh_.box().diagonal(); }

  [[nodiscard]] FaceSamples tile(std::size_t k) const override {
    FaceSamples out;
    out.face = id_;
    out.target = target_;
    if (k + 1 >= starts_.size()) return out;
    const Start from = starts_[k], to = starts_[k + 1];
    for (std::size_t t = from.triangle; t < mesh_.triangles.size() && t <= to.triangle; ++t) {
      const int end = t == to.triangle ? to.row : std::numeric_limits<int>::max();
      add_rows(out, t, t == from.triangle ? from.row : 0, end);
    }
    return out;
  }

 private:
  /// Where a tile begins.
  struct Start {
    std::size_t triangle = 0;
    int row = 0;
  };

  [[nodiscard]] Vec3 corner(std::size_t triangle, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[triangle][k])];
  }

  [[nodiscard]] int parts_of(std::size_t k) const {
    const Vec3 a = corner(k, 0), ab = corner(k, 1) - a, ac = corner(k, 2) - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    return static_cast<int>(std::clamp(std::ceil(longest / spacing_), 1.0, kMostParts));
  }

  void add_rows(FaceSamples& out, std::size_t t, int first, int end) const {
    const int n = parts_of(t);
    if (first >= std::min(n, end)) return;
    const Vec3 a = corner(t, 0), ab = corner(t, 1) - a, ac = corner(t, 2) - a;
    const double area = 0.5 * ab.cross(ac).norm() / n / n;
    const Vec3 normal = area > 0.0 ? ab.cross(ac).normalized() : Vec3(Vec3::Zero());
    const Vec3 centroid = (ab + ac) / 3.0;
    out.spacing_mm =
        std::max({out.spacing_mm, centroid.norm() / n, (centroid - ab).norm() / n, (centroid - ac).norm() / n});
    const auto add = [&](double u, double v, double size) {
      out.points.push_back(a + (u + size / 3.0) / n * ab + (v + size / 3.0) / n * ac);
      out.areas.push_back(area);
      out.normals.push_back(normal);
      out.cells.push_back({static_cast<double>(t), u / n, v / n, size / n});
    };
    for (int i = first; i < std::min(n, end); ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(i, j, 1.0);
        if (i + j + 1 < n) add(i + 1, j + 1, -1.0);
      }
    }
  }

  std::string id_;
  const TriangleMesh& mesh_;
  double spacing_;
  bool target_;
  double count_ = 0.0;
  std::vector<Start> starts_;  ///< of the tiles, and the end
};

}  // namespace

namespace internal::verify {

std::unique_ptr<Sampler> make_sampler(const std::string& id, const TriangleMesh& mesh, double spacing_mm, bool target,
                                      std::size_t most_samples) {
  if (!(spacing_mm > 0.0)) throw UsageError("sample spacing " + std::to_string(spacing_mm) + " mm: must be > 0");
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) throw InputError("mesh " + id + " has a vertex that is not finite");
  return std::make_unique<MeshSampler>(id, mesh, spacing_mm, target, most_samples);
}

}  // namespace internal::verify

FaceSamples sample_mesh(const std::string& id, const TriangleMesh& mesh, double spacing_mm, bool target) {
  return make_sampler(id, mesh, spacing_mm, target, std::numeric_limits<std::size_t>::max())->tile(0);
}

}  // namespace flank

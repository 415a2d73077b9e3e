#include "flank/verify/sample_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

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
      throw UsageError(fmt::format("a sample spacing of {} mm gives {:.3g} samples on {}; at most {:.3g} are allowed",
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
    FaceSamples out = begin();
    if (k + 1 >= starts_.size()) return out;
    const Start from = starts_[k], to = starts_[k + 1];
    for (std::size_t t = from.triangle; t < mesh_.triangles.size() && t <= to.triangle; ++t) {
      const int end = t == to.triangle ? to.row : std::numeric_limits<int>::max();
      add_rows(out, t, t == from.triangle ? from.row : 0, end);
    }
    return out;
  }

  [[nodiscard]] FaceSamples cut(const FaceSamples& samples, std::span<const std::size_t> which) const override {
    FaceSamples out = begin();
    for (const std::size_t i : which) {
      const auto& [triangle, u, v, size] = samples.cells[i];
      const Facet facet = facet_of(static_cast<std::size_t>(triangle));
      const double part = size / kCut;
      for (int a = 0; a < kCut; ++a) {
        for (int b = 0; a + b < kCut; ++b) {
          add(out, facet, {triangle, u + a * part, v + b * part, part});
          if (a + b + 1 < kCut) add(out, facet, {triangle, u + (a + 1) * part, v + (b + 1) * part, -part});
        }
      }
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

  /// A triangle by its first corner and the sides from there.
  struct Facet {
    Vec3 a, ab, ac;
    Vec3 normal = Vec3::Zero();
    double area = 0.0, farthest = 0.0;  ///< of a corner from the centroid, mm
  };

  [[nodiscard]] Facet facet_of(std::size_t t) const {
    Facet f{corner(t, 0), corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)};
    const Vec3 across = f.ab.cross(f.ac), centroid = (f.ab + f.ac) / 3.0;
    f.area = 0.5 * across.norm();
    if (f.area > 0.0) f.normal = across.normalized();
    f.farthest = std::max({centroid.norm(), (centroid - f.ab).norm(), (centroid - f.ac).norm()});
    return f;
  }

  [[nodiscard]] FaceSamples begin() const {
    FaceSamples out;
    out.face = id_;
    out.target = target_;
    return out;
  }

  /// The sample of a cell (FaceSamples::cells) of a triangle.
  static void add(FaceSamples& out, const Facet& facet, const std::array<double, 4>& cell) {
    const auto& [triangle, u, v, size] = cell;
    out.points.push_back(facet.a + (u + size / 3.0) * facet.ab + (v + size / 3.0) * facet.ac);
    out.areas.push_back(facet.area * size * size);
    out.normals.push_back(facet.normal);
    out.cells.push_back(cell);
    out.spacing_mm = std::max(out.spacing_mm, facet.farthest * std::abs(size));
  }

  void add_rows(FaceSamples& out, std::size_t t, int first, int end) const {
    const int n = parts_of(t);
    if (first >= std::min(n, end)) return;
    const Facet facet = facet_of(t);
    const auto at = static_cast<double>(t), size = 1.0 / n;
    for (int i = first; i < std::min(n, end); ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(out, facet, {at, static_cast<double>(i) / n, static_cast<double>(j) / n, size});
        if (i + j + 1 < n) add(out, facet, {at, static_cast<double>(i + 1) / n, static_cast<double>(j + 1) / n, -size});
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

/// Of the spacing or of the width: so that the diagonals of slices are no longer than it, either.
constexpr double kSlice = 0.85;
constexpr double kMostSlices = 1e4;
/// Of the parts that a triangle has as it is: more are not worth the slices.
constexpr double kClearlyFewer = 0.6;

using Triangle = std::array<Vec3, 3>;

double longest_side(const Triangle& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

/// Parts with sides no longer than the spacing, as the judge cuts it.
double parts_of(const Triangle& t, double spacing_mm) {
  const double n = std::max(1.0, std::ceil(longest_side(t) / spacing_mm));
  return n * n;
}

/// With its longest side first.
Triangle turned(const Triangle& t) {
  std::size_t longest = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < 3; ++k)
    if (const double side = (t[(k + 1) % 3] - t[k]).norm(); side > most) most = side, longest = k;
  return {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
}

void add(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<Triangle>& out) {
  if ((b - a).cross(c - a).squaredNorm() > 0.0) out.push_back({a, b, c});
}

/// Slices of equal width along the longest side, each as one to three triangles that are turned as the whole is.
std::vector<Triangle> slices_of(const Triangle& whole, int count) {
  const Vec3 &a = whole[0], &b = whole[1], &c = whole[2];
  const double top = std::clamp((c - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  // The place on the two other sides above a share of the longest.
  const auto above = [&](double t) -> Vec3 {
    return t < top ? Vec3(a + t / top * (c - a)) : t > top ? Vec3(c + (t - top) / (1.0 - top) * (b - c)) : c;
  };
  std::vector<Triangle> out;
  for (int i = 0; i < count; ++i) {
    const double from = static_cast<double>(i) / count, to = static_cast<double>(i + 1) / count;
    const Vec3 low = a + from * (b - a), next = i + 1 == count ? b : Vec3(a + to * (b - a));
    const Vec3 left = i == 0 ? a : above(from), right = i + 1 == count ? b : above(to);
    add(low, next, right, out);
    if (from < top && top < to) {
      add(low, right, c, out);
      add(low, c, left, out);
    } else {
      add(low, right, left, out);
    }
  }
  return out;
}

/// The place as a vertex: one of the last few from `first` on, which slices share with those before them, or a new one.
int vertex(const Vec3& place, std::size_t first, TriangleMesh& mesh) {
  constexpr std::size_t kFew = 8;
  const std::size_t end = mesh.vertices.size();
  for (std::size_t v = std::max(first, end - std::min(end, kFew)); v < end; ++v)
    if (mesh.vertices[v] == place) return static_cast<int>(v);
  mesh.vertices.push_back(place);
  return static_cast<int>(end);
}

}  // namespace

namespace internal::verify {

TriangleMesh with_slivers_sliced(TriangleMesh mesh, double spacing_mm) {
  const std::size_t given = mesh.triangles.size();
  for (std::size_t k = 0; k < given; ++k) {
    Triangle own;
    for (std::size_t i = 0; i < 3; ++i) own[i] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[k][i])];
    const Triangle whole = turned(own);
    const double length = longest_side(whole);
    if (!(length > spacing_mm)) continue;
    const double width = (whole[1] - whole[0]).cross(whole[2] - whole[0]).norm() / length;
    const double count = std::min(kMostSlices, std::ceil(length / (kSlice * std::max(spacing_mm, width))));
    if (!(width > 0.0) || count < 2.0) continue;
    const std::vector<Triangle> slices = slices_of(whole, static_cast<int>(count));
    double parts = 0.0;
    for (const Triangle& slice : slices) parts += parts_of(slice, spacing_mm);
    if (parts > kClearlyFewer * parts_of(whole, spacing_mm)) continue;
    const std::size_t first = mesh.vertices.size();
    for (std::size_t s = 0; s < slices.size(); ++s) {
      std::array<int, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) corners[i] = vertex(slices[s][i], first, mesh);
      if (s == 0)
        mesh.triangles[k] = corners;
      else
        mesh.triangles.push_back(corners);
    }
  }
  return mesh;
}

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

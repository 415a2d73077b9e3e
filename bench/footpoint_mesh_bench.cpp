// Cold closest-point queries on triangle meshes: our tree (double precision) against Embree 3's rtcPointQuery (single
// precision), one thread, the same points, medians of interleaved repetitions.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/target.h"

namespace {

using flank::TriangleMesh;
using flank::Vec3;

/// A twisted graph-like patch of n x n vertices, about 40 x 60 mm.
TriangleMesh twisted_patch(int n) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 40.0 * i / (n - 1), v = 60.0 * j / (n - 1), angle = 0.6 * v / 60.0;
      const double z = 4.0 * std::sin(u / 14.0) + 3.0 * std::cos(v / 17.0);
      mesh.vertices.emplace_back(u * std::cos(angle) - z * std::sin(angle), v,
                                 u * std::sin(angle) + z * std::cos(angle));
    }
  }
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      mesh.triangles.push_back({a, a + n, a + n + 1});
      mesh.triangles.push_back({a, a + n + 1, a + 1});
    }
  }
  return mesh;
}

/// Embree's scene of one mesh, queried as its tutorial does.
class Embree {
 public:
  explicit Embree(const TriangleMesh& mesh) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    vertices_ = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                            3 * sizeof(float), mesh.vertices.size()));
    indices_ = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                              3 * sizeof(unsigned), mesh.triangles.size()));
    for (std::size_t i = 0; i < 3 * mesh.vertices.size(); ++i)
      vertices_[i] = static_cast<float>(mesh.vertices[i / 3][static_cast<int>(i % 3)]);
    for (std::size_t i = 0; i < 3 * mesh.triangles.size(); ++i)
      indices_[i] = static_cast<unsigned>(mesh.triangles[i / 3][i % 3]);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  double distance(const Vec3& p) const {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query;
    query.x = static_cast<float>(p[0]);
    query.y = static_cast<float>(p[1]);
    query.z = static_cast<float>(p[2]);
    query.time = 0.0f;
    query.radius = std::numeric_limits<float>::infinity();
    Result result{this, std::numeric_limits<float>::infinity()};
    rtcPointQuery(scene_, &query, &context, visit, &result);
    return std::sqrt(static_cast<double>(result.squared));
  }

 private:
  using V = Eigen::Vector3f;
  struct Result {
    const Embree* self;
    float squared;
  };

  static V closest(const V& p, const V& a, const V& b, const V& c) {
    const V ab = b - a, ac = c - a, ap = p - a;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.f && d2 <= 0.f) return a;
    const V bp = p - b;
    const float d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.f && d4 <= d3) return b;
    const V cp = p - c;
    const float d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.f && d5 <= d6) return c;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.f && d1 >= 0.f && d3 <= 0.f) return a + d1 / (d1 - d3) * ab;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.f && d2 >= 0.f && d6 <= 0.f) return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.f && d4 - d3 >= 0.f && d5 - d6 >= 0.f) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
    const float scale = 1.f / (va + vb + vc);
    return a + vb * scale * ab + vc * scale * ac;
  }

  static bool visit(RTCPointQueryFunctionArguments* args) {
    auto* result = static_cast<Result*>(args->userPtr);
    const unsigned* index = result->self->indices_ + 3 * args->primID;
    const float* v = result->self->vertices_;
    const auto corner = [&](int k) { return V(v[3 * index[k]], v[3 * index[k] + 1], v[3 * index[k] + 2]); };
    const V p(args->query->x, args->query->y, args->query->z);
    const float squared = (p - closest(p, corner(0), corner(1), corner(2))).squaredNorm();
    if (squared >= result->squared) return false;
    result->squared = squared;
    args->query->radius = std::sqrt(squared);
    return true;
  }

  RTCDevice device_;
  RTCScene scene_;
  float* vertices_;
  unsigned* indices_;
};

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

/// Time that this thread was on a core, so that other programs do not count.
double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double microseconds_a_point(const std::vector<Vec3>& points, const std::function<double(const Vec3&)>& query,
                            double& sum) {
  const double start = thread_microseconds();
  for (const Vec3& p : points) sum += query(p);
  return (thread_microseconds() - start) / static_cast<double>(points.size());
}

void race(const std::string& name, const std::vector<Vec3>& points,
          const std::vector<std::function<double(const Vec3&)>>& runners, const std::vector<std::string>& names) {
  constexpr int kRepetitions = 11;
  std::vector<std::vector<double>> times(runners.size());
  double sum = 0.0;
  for (int r = 0; r < kRepetitions; ++r)
    for (std::size_t i = 0; i < runners.size(); ++i) times[i].push_back(microseconds_a_point(points, runners[i], sum));
  const double embree = median(times[0]);
  std::printf("%-28s", name.c_str());
  for (std::size_t i = 0; i < runners.size(); ++i)
    std::printf("  %s %.3f us (x%.2f)", names[i].c_str(), median(times[i]), embree / median(times[i]));
  std::printf("%s\n", std::isfinite(sum) ? "" : " (not finite)");
}

void race_mesh(int n) {
  const TriangleMesh mesh = twisted_patch(n);
  const Embree embree(mesh);
  const flank::internal::TriangleBvh tree(mesh);
  const auto target = flank::make_target(mesh);
  const std::vector<std::function<double(const Vec3&)>> runners{
      [&](const Vec3& p) { return embree.distance(p); },
      [&](const Vec3& p) { return std::sqrt(tree.closest(p).squared_distance); },
      [&](const Vec3& p) { return target->closest(p).distance; },
  };
  const std::vector<std::string> names{"Embree", "flat tree", "with jets"};
  flank::internal::Random random(7);
  std::vector<Vec3> near, space;
  const flank::Box3 box = mesh.box();
  const Vec3 size = box.high - box.low;
  for (int i = 0; i < 20000; ++i) {
    const Vec3& v = mesh.vertices[random.next() % mesh.vertices.size()];
    near.push_back(v + 0.01 * box.diagonal() * Vec3(random.normal(), random.normal(), random.normal()));
    space.push_back(box.low - 0.25 * size +
                    1.5 * Vec3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(size));
  }
  const std::string label = std::to_string(n * n) + " vertices, ";
  race(label + "near", near, runners, names);
  race(label + "space", space, runners, names);
}

}  // namespace

int main() {
  std::printf(
      "cold closest points, one thread, median of 11 interleaved repetitions; in brackets: times Embree's speed\n");
  race_mesh(114);
  race_mesh(448);
  return 0;
}

#include "flank/io/mesh/write_mesh.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "flank/base/atomic_file.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

/// The bytes of a value; all machines that this is built for are little-endian, as the formats want.
template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// STL has single precision only.
void append_single(std::string& bytes, const Vec3& p) {
  for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(p[k]));
}

/// Must not begin with "solid", or some readers take it for text.
std::string stl(const TriangleMesh& mesh) {
  std::string bytes = "binary STL";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])], &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    append_single(bytes, (b - a).cross(c - a).normalized());
    for (const Vec3& p : {a, b, c}) append_single(bytes, p);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Vertices are counted from 1. Numbers read back as the same doubles.
std::string obj(const TriangleMesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Vec3& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// Binary, double precision.
std::string ply(const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
      "z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) append(bytes, v[k]);
  for (const auto& t : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const int v : t) append(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

}  // namespace

std::string mesh_to_stl(const TriangleMesh& mesh) { return stl(mesh); }

void write_mesh(const std::string& file, const TriangleMesh& mesh) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension != ".stl" && extension != ".obj" && extension != ".ply")
    throw UsageError(file + ": meshes are written as .stl, .obj or .ply");
  write_file(file, extension == ".stl" ? stl(mesh) : extension == ".obj" ? obj(mesh) : ply(mesh));
}

}  // namespace flank::internal

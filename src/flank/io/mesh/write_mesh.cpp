#include "flank/io/mesh/write_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string_view>

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

struct Writer {
  std::string_view ending;
  std::string (*bytes)(const TriangleMesh& mesh);
};

constexpr std::array<Writer, 3> kWriters{{{".stl", stl}, {".obj", obj}, {".ply", ply}}};

/// Null: no mesh is written under this name.
const Writer* writer_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  const auto* found =
      std::find_if(kWriters.begin(), kWriters.end(), [&](const Writer& w) { return w.ending == ending; });
  return found == kWriters.end() ? nullptr : found;
}

}  // namespace

std::string written_mesh_endings() {
  std::string text(kWriters.front().ending);
  for (std::size_t k = 1; k < kWriters.size(); ++k)
    text += (k + 1 == kWriters.size() ? " or " : ", ") + std::string(kWriters[k].ending);
  return text;
}

bool is_written_mesh(const std::string& file) { return writer_of(file) != nullptr; }

std::string mesh_to_stl(const TriangleMesh& mesh) { return stl(mesh); }

void write_mesh(const std::string& file, const TriangleMesh& mesh) {
  const Writer* writer = writer_of(file);
  if (writer == nullptr) throw UsageError(file + ": meshes are written as " + written_mesh_endings());
  write_file(file, writer->bytes(mesh));
}

}  // namespace flank::internal

#include "flank/io/mesh/read_stl.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "flank/error.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/read_text.h"

namespace flank::internal {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;

void add_facet(TriangleMesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

/// 80 bytes of header, a count, and for each facet a normal (not used), three vertices and two bytes.
TriangleMesh read_binary(const std::string& file, std::string_view content) {
  std::uint32_t count = 0;
  if (content.size() >= kHeader) std::memcpy(&count, content.data() + 80, sizeof count);
  if (!is_binary_stl(content))
    throw InputError(fmt::format(
        "{}: is truncated or not an STL file ({} bytes; its count of {} facets takes {}); expected binary or text STL",
        file, content.size(), count, kHeader + kFacet * std::size_t{count}));
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * std::size_t{count});
  mesh.triangles.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    float f[9];
    std::memcpy(f, content.data() + kHeader + kFacet * i + 12, sizeof f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p(f[3 * k], f[3 * k + 1], f[3 * k + 2]);
      if (!p.allFinite())
        throw InputError(
            fmt::format("{}, facet {}: a coordinate is not a finite number; expected finite coordinates", file, i + 1));
      mesh.vertices.push_back(p);
    }
    add_facet(mesh);
  }
  return mesh;
}

/// Line by line; normals are not used. A file may hold several solids one after another: they make one mesh.
TriangleMesh read_text_stl(const std::string& file, std::string_view content) {
  TriangleMesh mesh;
  TextLines lines(file, content);
  int corners = 0;
  bool ended = false;
  while (lines.next()) {
    const std::string_view word = lines.word(0);
    if (word == "vertex") {
      if (lines.words().size() < 4) lines.refuse("a vertex needs three coordinates");
      mesh.vertices.emplace_back(lines.number(1), lines.number(2), lines.number(3));
      if (++corners > 3) lines.refuse("a facet has more than three vertices; expected triangles");
    } else if (word == "endfacet") {
      if (corners != 3) lines.refuse("a facet has fewer than three vertices; expected triangles");
      add_facet(mesh);
      corners = 0;
    } else if (word == "solid") {
      ended = false;
    } else if (word == "endsolid") {
      ended = true;
    } else if (word != "facet" && word != "outer" && word != "endloop") {
      lines.refuse(fmt::format(
          "\"{}\" is not a word of a text STL file (solid, facet, outer, vertex, endloop, endfacet, endsolid)", word));
    }
  }
  if (!ended || corners != 0)
    lines.refuse("the file ends before its \"endsolid\": it is truncated; copy or export it again");
  return mesh;
}

}  // namespace

bool is_binary_stl(std::string_view content) {
  if (content.size() < kHeader) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  // Header, count, and 50 bytes per facet: the size fits the count only in a binary STL.
  return content.size() == kHeader + kFacet * static_cast<std::size_t>(count);
}

bool looks_stl(std::string_view content) {
  if (is_binary_stl(content)) return true;
  const std::string_view head = without_blanks_in_front(content).substr(0, 1000);
  return head.starts_with("solid") &&
         (head.find("facet") != std::string_view::npos || head.find("endsolid") != std::string_view::npos);
}

TriangleMesh read_stl(const std::string& file, std::string_view content) {
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  // Binary files may begin with "solid" as well, so the size that the count asks for decides first.
  const bool text = !is_binary_stl(content) && first != std::string_view::npos && content.substr(first, 5) == "solid" &&
                    content.substr(0, 4096).find('\0') == std::string_view::npos;
  return text ? read_text_stl(file, content) : read_binary(file, content);
}

}  // namespace flank::internal

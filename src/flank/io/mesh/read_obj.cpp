#include "flank/io/mesh/read_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "flank/error.h"
#include "flank/io/mesh/add_polygon.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/read_text.h"

namespace flank::internal {
namespace {

/// OBJ counts vertices from 1, or from the last one backwards.
int vertex_index(const TextLines& lines, std::size_t word, std::size_t vertices) {
  const long given = lines.integer(word), count = static_cast<long>(vertices);
  const long index = given < 0 ? count + given : given - 1;
  if (index < 0 || index >= count)
    lines.refuse(fmt::format("vertex {} does not exist; there are {} so far", given, count));
  return static_cast<int>(index);
}

}  // namespace

bool looks_obj(std::string_view content) {
  static const std::array<std::string_view, 14> words = {"v",      "vt",     "vn", "vp", "f", "l",      "p",
                                                         "mtllib", "usemtl", "o",  "g",  "s", "cstype", "deg"};
  bool vertex = false;
  int lines = 0;
  while (!content.empty() && lines < 200 && !vertex) {
    const std::size_t end = content.find('\n');
    std::string_view line = content.substr(0, end);
    content = end == std::string_view::npos ? std::string_view{} : content.substr(end + 1);
    line = without_blanks_in_front(line);
    if (line.empty() || line.front() == '#') continue;
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (std::find(words.begin(), words.end(), word) == words.end()) return false;
    vertex = word == "v";
    ++lines;
  }
  return vertex;
}

TriangleMesh read_obj(const std::string& file, std::string_view content) {
  TriangleMesh mesh;
  TextLines lines(file, content);
  std::vector<int> corners;
  while (lines.next()) {
    if (lines.word(0) == "v") {
      if (lines.words().size() < 4) lines.refuse("a vertex needs three coordinates");
      mesh.vertices.emplace_back(lines.number(1), lines.number(2), lines.number(3));
    } else if (lines.word(0) == "f") {
      if (lines.words().size() < 4) lines.refuse("a face needs at least three vertices");
      corners.clear();
      for (std::size_t i = 1; i < lines.words().size() && lines.word(i).front() != '#'; ++i)
        corners.push_back(vertex_index(lines, i, mesh.vertices.size()));
      if (corners.size() < 3) lines.refuse("a face needs at least three vertices");
      try {
        add_polygon(mesh, corners.data(), static_cast<int>(corners.size()));
      } catch (const InputError& error) {
        lines.refuse(error.what());
      }
    }
  }
  return mesh;
}

}  // namespace flank::internal

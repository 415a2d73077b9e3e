#include "flank/io/tool/read_any_tool.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/io/tool/dxf_outline.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/io/tool/tool_library.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

/// "library.json#NAME" as file and name; a file whose own name has the sign is a file.
struct Named {
  std::string file, which;
};
Named split(const std::string& text) {
  std::error_code none;
  const std::size_t at = text.rfind('#');
  if (at == std::string::npos || std::filesystem::exists(text, none)) return {text, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

/// Is the document an object, as a tool's is? A list of pairs is a holder's.
bool is_object(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

}  // namespace

bool names_a_tool_file(const std::string& text) {
  constexpr std::array<std::string_view, 4> kEndings = {".json", ".dxf", ".fctb", ".tools"};
  const std::string ending = ending_of(split(text).file);
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end() || text.find('/') != std::string::npos;
}

ToolReading read_any_tool(const std::string& name, std::optional<double> axis_length) {
  const Named named = split(name);
  const std::string ending = ending_of(named.file);
  if (ending == ".dxf") return read_tool_drawing(read_file(named.file), named.file, axis_length);
  if (axis_length) throw UsageError("axis_length_mm", named.file + " has its own");
  if (ending == ".tools")
    throw InputError(named.file +
                     ": a packed library; export it from Fusion as .json, or unpack it: it is a zip with a .json");
  const std::string text = read_file(named.file);
  if (ending == ".fctb") return tool_from_fctb(text, named.file);
  if (is_object(text)) {
    const JsonInput document(named.file, text);
    if (!document.has("schema") && is_fusion(document)) return tool_from_fusion(document, named.which, named.file);
  }
  return {tool_from_json(text, named.file), {}};
}

std::optional<std::vector<Vec2>> read_holder_file(const std::string& name) {
  const Named named = split(name);
  const std::string ending = ending_of(named.file);
  if (ending == ".fcholder") return holder_from_fcholder(read_file(named.file), named.file);
  if (ending == ".dxf") return holder_of_drawing(read_dxf_curves(read_file(named.file), named.file), named.file);
  if (ending != ".json") return std::nullopt;
  const std::string text = read_file(named.file);
  if (!is_object(text)) return std::nullopt;
  const JsonInput document(named.file, text);
  if (!is_fusion(document)) return std::nullopt;
  return holder_from_fusion(document, named.which, named.file);
}

}  // namespace flank::internal

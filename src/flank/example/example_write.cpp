#include "flank/example/example_write.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/cad/write_step.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/json_dump.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTruthSchema = "openflank/truth/1";

std::string lower_extension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// Before anything is computed or written: the kind of the part decides which files can hold it.
void check_extension(const Example& example, const std::string& file) {
  const std::string extension = lower_extension(file);
  const bool of_faces = extension == ".step" || extension == ".stp";
  if (example.mesh && !is_written_mesh(file))
    throw UsageError(file + ": " + example.name + " is a mesh; name a file that ends in " + written_mesh_endings());
  if (!example.mesh && !of_faces)
    throw UsageError(file + ": " + example.name + " is made of faces; name a file that ends in .step or .stp");
}

/// Degree, knots and poles (mm; of the direction rail without unit): the motion itself, where the path has only its
/// poses.
Json rail_json(const BSplineCurve3& rail) {
  Json poles = Json::array();
  for (int i = 0; i < rail.count(); ++i) poles.push_back({rail.poles(0, i), rail.poles(1, i), rail.poles(2, i)});
  return {{"degree", rail.degree}, {"knots", rail.knots}, {"poles", poles}};
}

std::string truth_json(const Example& example, const std::string& tool_file, const std::string& path_file) {
  const ExampleTruth& truth = *example.truth;
  Json json{{"schema", kTruthSchema},
            {"units", "mm"},
            {"name", example.name},
            {"description", example.description},
            {"diagonal", example.diagonal_mm},
            {"face_error", truth.face_error_mm},
            {"path_bound", truth.path_bound_mm},
            {"tool", tool_file},
            {"path", path_file},
            {"motions", Json::array()}};
  for (std::size_t k = 0; k < truth.motions.size(); ++k) {
    const RuledMotion& motion = truth.motions[k];
    json["motions"].push_back({{"face", truth.path.strips[k].face},
                               {"axis_length", motion.axis_length},
                               {"tip", rail_json(motion.tip)},
                               {"direction", rail_json(motion.direction)}});
  }
  return dumped(json, 1) + "\n";
}

}  // namespace

std::vector<std::string> write_example_files(const Example& example, const std::string& file) {
  check_extension(example, file);
  std::vector<std::string> written{file};
  // A solid comes with its text: its faces alone would be written as sheets.
  if (example.mesh)
    write_mesh(file, *example.mesh);
  else if (!example.step.empty())
    write_file(file, example.step);
  else
    write_step(file, example.faces);
  if (!example.truth) return written;
  // Beside the part, under its name: NAME.truth.json and the two files that it names.
  const std::filesystem::path stem = std::filesystem::path(file).replace_extension();
  const std::string tool = stem.string() + ".tool.json", path = stem.string() + ".path.json";
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(name, text);
    written.push_back(name);
  };
  // Without folders, so that the files may be moved together.
  const auto name_only = [](const std::string& name) { return std::filesystem::path(name).filename().string(); };
  write(stem.string() + ".truth.json", truth_json(example, name_only(tool), name_only(path)));
  write(tool, tool_to_json(example.truth->tool));
  write(path, path_to_json(example.truth->path));
  return written;
}

std::string example_files_json(const Example& example, const std::vector<std::string>& files) {
  return dumped(Json{{"schema", "openflank/example/1"}, {"name", example.name}, {"files", files}}, 2) + "\n";
}

}  // namespace flank::internal

// figure_folders FOLDER: a result of each kind that the report must not show green, one folder each: with one figure of the verdict
// turned false (no-NAME), for every name of the library's own list, and one that is on no list; with one caution (mind-one), and with
// one about each of them (mind-all); one that is sound (sound), and one whose holder runs into a vice (vice), by the judge and with all that is drawn. Each is whole, with its manifest and its report.html. Prints the names, one a line.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "flank/base/atomic_file.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/report.h"
#include "flank/results/acceptance.h"
#include "flank/results/view.h"
#include "flank/results/write_result.h"
#include "flank/setup/clearance_scene.h"

namespace {

namespace fs = std::filesystem;
using namespace flank;
using namespace flank::internal;

/// The barrel's envelope with the tool and path that it is of, judged as good. Without the faces' triangles: what is drawn is tested
/// elsewhere.
Result sound_result(const std::string& part_file) {
  const Example example = make_example("envelope-barrel-1");
  (void)write_example(example, part_file);
  Result result;
  FitJob job;
  job.part.file = part_file;
  job.tolerance_mm = 0.01;
  result.job = job;
  result.part_sha256 = read_part(part_file).sha256;
  result.tool = example.truth->tool;
  result.path = example.truth->path;
  result.diagonal_mm = 10.0;
  result.verify.verdict = Verdict::kPass;
  result.verify.tolerance_mm = *job.tolerance_mm;
  result.verify.depth = DepthProof::kProved;
  result.verify.coverage = result.verify.coverage_reachable = 1.0;
  result.verify.faces.emplace_back().face = "F1";
  result.verify.faces.front().target = true;
  result.verify.histogram_edges_mm = {-0.01, 0.0, 0.01};
  result.verify.histogram_area_mm2 = {1.0, 1.0};
  return result;
}

/// A cube about a point.
TriangleMesh cube(const Vec3& middle, double half) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(middle + half * Vec3((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The same with shank and holder, and a block where the holder goes.
Result colliding_result(Result result, const std::string& folder) {
  auto& job = std::get<FitJob>(result.job);
  const double length = result.tool.radial.axis_length(), radius = result.tool.radial.at(length).r;
  result.tool.shank = {{length, radius}, {length + 20.0, radius}};
  result.tool.holder = {{length + 20.0, 15.0}, {length + 60.0, 15.0}};
  const std::vector<Pose>& poses = result.path.strips.at(0).poses;
  const std::string file = (fs::path(folder) / "vice.stl").string();
  write_file(file, mesh_to_stl(cube(poses.at(poses.size() / 2).at(length + 40.0), 20.0)));
  job.obstacles.fixtures = {file};
  job.obstacles.clearance_mm = 1.0;
  const Setup setup{read_part(job.part.file), {0}, {}, *job.tolerance_mm, {read_part(file, "mm")}};
  std::vector<std::string> notes;
  result.verify.clearance =
      measure_clearance(make_clearance_scene(setup, job.obstacles, true, notes), result.tool, result.path);
  auto drawings = std::make_shared<Result::Drawings>();
  drawings->view = make_view(result.job, setup, result.tool, result.path, result.verify);
  result.drawings = drawings;
  return result;
}

void write_folder(const std::string& root, const std::string& name, const Result& result,
                  const Acceptance& acceptance) {
  const std::string path = (fs::path(root) / name).string();
  {
    ResultFolder folder(path, ResultFolder::Use::kWrite);
    folder.replace(result_files(result, acceptance), result_manifest(result, folder));
  }
  (void)write_report(path);
}

void write_all(const std::string& root) {
  fs::create_directories(root);
  const Result result = sound_result((fs::path(root) / "part.step").string());
  write_folder(root, "sound", result, {});
  const Result colliding = colliding_result(result, root);
  write_folder(root, "vice", colliding, colliding.acceptance());
  std::vector<std::string> names(kFigureNames.begin(), kFigureNames.end());
  names.emplace_back("a_figure_of_tomorrow");
  Acceptance amber;
  for (const std::string& name : names) {
    Acceptance no;
    no.reasons.push_back({name, "reason of " + name});
    amber.cautions.push_back({name, "caution about " + name});
    write_folder(root, "no-" + name, result, no);
    if (amber.cautions.size() == 1) write_folder(root, "mind-one", result, amber);
    std::printf("%s\n", name.c_str());
  }
  write_folder(root, "mind-all", result, amber);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: figure_folders FOLDER");
    write_all(argv[1]);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "figure_folders: %s\n", e.what());
    return 1;
  }
}

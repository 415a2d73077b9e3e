#include "flank/design/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/job/command_line.h"
#include "flank/job/job_json.h"
#include "flank/manifest/result_folder.h"
#include "flank/path_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr int kGuideLines = 9;

/// A task that is to come, and the pair that it is for.
struct PairTask {
  std::size_t tool, face;
  std::string way;
  BatchTask task;
};

/// Axes along a strip, as `fit --guide` reads them: tip and holder end, mm.
std::string guide_text(const std::vector<Pose>& poses, double axis_length_mm) {
  std::string text;
  for (int k = 0; k < kGuideLines; ++k) {
    const Pose& pose = poses[static_cast<std::size_t>(k) * (poses.size() - 1) / (kGuideLines - 1)];
    const Vec3 end = pose.tip + axis_length_mm * pose.axis;
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", pose.tip.x(), pose.tip.y(), pose.tip.z(),
                        end.x(), end.y(), end.z());
  }
  return text;
}

/// A folder of an earlier design, with all that it holds. Throws InputError where somebody else has put something there.
void remove_result(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) return;
  require_unread_below(folder.string());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto& ours = result_names();
    if (name != kPageFile && std::find(ours.begin(), ours.end(), name) == ours.end())
      throw InputError(entry.path().string() +
                       ": is in a folder that flank design uses for its results; move it away, or give " +
                       "another folder");
  }
  fs::remove_all(folder);
}

class Pairs {
 public:
  Pairs(DesignResult& result, const DesignFolder& folder, std::size_t first_tool)
      : result_(result), folder_(folder), first_tool_(first_tool) {}

  void run() {
    result_.pairs.resize(result_.tools.size() * result_.faces.size());
    std::vector<PairTask> own, covers, fits, moved;
    for_each(true, [&](std::size_t t, std::size_t f) {
      const DesignTool& tool = result_.tools[t];
      if (std::find(tool.fitted.begin(), tool.fitted.end(), f) == tool.fitted.end()) return;
      add_carried(t, f, tool.folder, result_.faces[f], Eigen::Isometry3d::Identity(), "fit", own);
    });
    take(own);
    for_each(true, [&](std::size_t t, std::size_t f) {
      if (!pair(t, f).finishes()) covers.push_back(cover(t, f));
    });
    take(covers);
    for_each(true, [&](std::size_t t, std::size_t f) {
      if (!pair(t, f).finishes()) fits.push_back(motion_fit(t, f, {}));
    });
    take(fits);
    for_each(false, [&](std::size_t t, std::size_t f) {
      const std::size_t base = base_of(t, f);
      const std::string& name = result_.faces[base];
      if (!pair(t, base).folder.empty())
        add_carried(t, f, pair(t, base).folder, name, motion(base, f), "as " + name, moved);
    });
    take(moved);
    // What surrounds an equal face may be another: the motion is found anew, from the one that was moved first.
    take(still_open([&](std::size_t t, std::size_t f) { return guided_fit(t, f); }));
    take(still_open([&](std::size_t t, std::size_t f) { return std::optional(motion_fit(t, f, {})); }));
    take(still_open([&](std::size_t t, std::size_t f) { return std::optional(cover(t, f)); }));
  }

 private:
  DesignPair& pair(std::size_t tool, std::size_t face) { return result_.pairs[tool * result_.faces.size() + face]; }

  /// Of the faces that are equal to f the one that is planned for a tool: that which the tool was fitted to, or the first.
  [[nodiscard]] std::size_t base_of(std::size_t t, std::size_t f) const {
    const std::size_t first = result_.equal[f].first;
    for (const std::size_t fitted : result_.tools[t].fitted)
      if (result_.equal[fitted].first == first) return fitted;
    return first;
  }
  /// Takes face a to the equal face b.
  [[nodiscard]] Eigen::Isometry3d motion(std::size_t a, std::size_t b) const {
    return result_.equal[b].from_first * result_.equal[a].from_first.inverse();
  }

  /// Of every new tool, the faces that are planned for it, or those that are equal to one of them.
  template <class Visit>
  void for_each(bool bases, Visit&& visit) {
    for (std::size_t t = first_tool_; t < result_.tools.size(); ++t)
      for (std::size_t f = 0; f < result_.faces.size(); ++f)
        if ((base_of(t, f) == f) == bases) visit(t, f);
  }

  /// Tasks for the equal faces that a tool does not finish, though it finishes the one that is planned.
  template <class Make>
  std::vector<PairTask> still_open(Make&& make) {
    std::vector<PairTask> tasks;
    for_each(false, [&](std::size_t t, std::size_t f) {
      if (!pair(t, base_of(t, f)).finishes() || pair(t, f).finishes()) return;
      if (auto task = make(t, f)) tasks.push_back(std::move(*task));
    });
    return tasks;
  }

  /// A fit of the motion alone, with the tool as it is; from a guide if there is one (the text of its file).
  [[nodiscard]] PairTask motion_fit(std::size_t t, std::size_t f, const std::string& guide) const {
    const CoverJob common = job_of(t, f);
    FitJob job;
    job.part = common.part;
    job.tool = common.tool;
    job.obstacles = common.obstacles;
    job.judge = common.judge;
    job.tolerance_mm = common.tolerance_mm;
    const std::string name = result_.faces[f] + "-" + result_.tools[t].name;
    if (!guide.empty()) {
      const fs::path file = fs::path(folder_.path) / "guides" / (name + ".txt");
      fs::create_directories(file.parent_path());
      write_file(file.string(), guide);
      job.guide = file.string();
    }
    const std::string tool = text_of_file((fs::path(folder_.path) / result_.tools[t].file).string());
    return {t,
            f,
            "motion",
            {name + (guide.empty() ? "-motion" : "-guided"), command_words(PlanJob(job)),
             sha256(folder_.inputs + tool + guide), false}};
  }

  /// The same from the strip of the equal face, moved; nothing where there is more than one.
  [[nodiscard]] std::optional<PairTask> guided_fit(std::size_t t, std::size_t f) {
    const std::size_t base = base_of(t, f);
    const DesignPair& planned = pair(t, base);
    const fs::path file = fs::path(folder_.path) / planned.folder / "path.json";
    if (planned.folder.empty() || !fs::is_regular_file(file)) return {};
    const Path path = carried(read_path(file.string()), result_.faces[base], result_.faces[f], motion(base, f));
    if (path.strips.size() != 1 || path.strips[0].poses.size() < 2) return {};
    return motion_fit(t, f, guide_text(path.strips[0].poses, result_.tools[t].tool.radial.axis_length()));
  }

  [[nodiscard]] CoverJob job_of(std::size_t t, std::size_t f) const {
    CoverJob job;
    job.part = result_.job.part;
    job.part.faces = result_.faces[f];
    job.tool.spec = (fs::path(folder_.path) / result_.tools[t].file).string();
    job.obstacles = result_.job.obstacles;
    job.judge = result_.job.judge;
    job.judge.reach_radius_mm = result_.reach_radius_mm;
    job.tolerance_mm = result_.job.tolerance_mm;
    return job;
  }

  [[nodiscard]] PairTask cover(std::size_t t, std::size_t f) const {
    const std::string tool = text_of_file((fs::path(folder_.path) / result_.tools[t].file).string());
    return {t,
            f,
            "cover",
            {result_.faces[f] + "-" + result_.tools[t].name + "-cover", command_words(PlanJob(job_of(t, f))),
             sha256(folder_.inputs + tool), false}};
  }

  /// Adds the judgement of strips of one face, moved to another, in a folder of their own; nothing if there are none.
  void add_carried(std::size_t t, std::size_t f, const std::string& source, const std::string& from,
                   const Eigen::Isometry3d& motion, const std::string& way, std::vector<PairTask>& tasks) {
    const fs::path file = fs::path(folder_.path) / source / "path.json";
    if (!fs::is_regular_file(file)) return;
    const Path path = carried(read_path(file.string()), from, result_.faces[f], motion);
    if (path.strips.empty()) return;
    const std::string name = result_.faces[f] + "-" + result_.tools[t].name;
    const fs::path folder = fs::path(folder_.path) / name;
    const std::map<std::string, std::string> files = {
        {"job.json", job_to_json(PlanJob(job_of(t, f)))},
        {"path.json", path_to_json(path)},
        {"tool.json", text_of_file((fs::path(folder_.path) / result_.tools[t].file).string())}};
    std::string inputs = folder_.inputs;
    bool there = true;
    for (const auto& [entry, text] : files) {
      there = there && text_of_file((folder / entry).string()) == text;
      inputs += sha256(text);
    }
    if (!there) {
      remove_result(folder);
      fs::create_directories(folder);
      for (const auto& [entry, text] : files) write_file((folder / entry).string(), text);
    }
    tasks.push_back({t, f, way, {name, {"verify", folder.string()}, sha256(inputs), true}});
  }

  void take(const std::vector<PairTask>& tasks) {
    std::vector<BatchTask> batch;
    for (const PairTask& task : tasks) batch.push_back(task.task);
    const std::vector<TaskRow> rows = folder_.run(batch);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      DesignPair found = read_pair(tasks[k], rows[k]);
      DesignPair& now = pair(tasks[k].tool, tasks[k].face);
      if (now.folder.empty() || found.finishes() ||
          (!now.finishes() && found.coverage_reachable > now.coverage_reachable && !found.folder.empty()))
        now = std::move(found);
    }
  }

  [[nodiscard]] DesignPair read_pair(const PairTask& task, const TaskRow& row) const {
    DesignPair pair;
    pair.row = row;
    pair.way = task.way;
    if (!row.has_result()) return pair;
    const fs::path folder = fs::path(folder_.path) / task.task.name;
    pair.folder = task.task.name;
    const auto json = nlohmann::json::parse(text_of_file((folder / "verify.json").string()), nullptr, false);
    const auto number = [&](const char* key) {
      return json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0.0;
    };
    pair.coverage_reachable = number("coverage_reachable");
    pair.coverage = number("coverage");
    pair.overcut_mm = number("overcut_mm");
    pair.other_faces_overcut_mm = number("gouge_mm");
    const Path path = read_path((folder / "path.json").string());
    pair.strips = static_cast<int>(path.strips.size());
    pair.minutes = path_minutes(path, result_.tools[task.tool].tool.radial.axis_length(), result_.job.choice);
    return pair;
  }

  DesignResult& result_;
  const DesignFolder& folder_;
  std::size_t first_tool_;
};

}  // namespace

void judge_pairs(DesignResult& result, const DesignFolder& folder, std::size_t first_tool) {
  Pairs(result, folder, first_tool).run();
}

}  // namespace flank::internal

#include "flank/sweep/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "flank/base/rest_of.h"
#include "flank/error.h"
#include "flank/io/text/toml_table.h"
#include "flank/job/check_fields.h"
#include "flank/job/command_line.h"
#include "flank/job/input_files.h"
#include "flank/part.h"
#include "flank/sweep/task_batch.h"
#include "flank/tool_request/catalogue.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "openflank/sweep-plan/1";
constexpr std::size_t kMostBytes = 1u << 20;
constexpr std::size_t kMostTasks = 100'000;
/// What the plan itself says of each job.
const std::set<std::string> kOwnFields = {"part", "faces", "tool"};

std::string read_text(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text = rest_of(stream);
  if (!stream || !fs::is_regular_file(file)) throw InputError(file + ": cannot be read; expected a plan NAME.toml");
  if (text.size() > kMostBytes)
    throw InputError(fmt::format("{}: {} bytes; a plan has at most {}", file, text.size(), kMostBytes));
  return text;
}

/// A file that is named in the plan, from the folder of the plan.
std::string from_folder(const SweepPlan& plan, const std::string& name) {
  return (fs::path(plan.folder()) / name).lexically_normal().string();
}

/// The message of an error about a field, without the field, which is named by its place already.
std::string without_field(const Error& error) {
  std::string text = error.what();
  const std::size_t length = error.field().size();
  if (length > 0 && text.starts_with(error.field())) text.erase(0, length);
  text.erase(0, std::min(text.find_first_not_of(": "), text.size()));
  return text;
}

/// Values that no two elements of a list may share.
std::vector<std::string> distinct(const TomlTable& table, const std::string& key) {
  std::vector<std::string> all = table.texts(key);
  std::set<std::string> seen;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!seen.insert(all[k]).second) table.refuse_element(key, k, all[k] + " is given twice");
  return all;
}

void check_faces(const TomlTable& table, const TomlTable& options, SweepPlan& plan) {
  const Part part = read_part(plan.part, options.has("unit") ? std::optional(options.text("unit")) : std::nullopt);
  plan.part_sha256 = part.sha256;
  for (std::size_t k = 0; k < plan.faces.size(); ++k) {
    try {
      Part split = part;
      split_faces(split, plan.faces[k]);
      (void)parse_face_list(split, plan.faces[k]);
    } catch (const Error& error) {
      table.refuse_element("faces", k, error.what());
    }
  }
}

void read_tools(const TomlTable& table, SweepPlan& plan) {
  plan.tools = distinct(table, "tools");
  for (std::size_t k = 0; k < plan.tools.size(); ++k) {
    std::string& tool = plan.tools[k];
    const std::string beside = from_folder(plan, tool);
    if (fs::is_regular_file(beside)) tool = beside;
    if (tool == "catalogue" && plan.command == "cover") continue;
    try {
      if (parse_tool_spec(tool).free && plan.command == "cover")
        throw UsageError("tool", tool, "is for fit; cover needs a family, a tool.json or catalogue");
    } catch (const Error& error) {
      table.refuse_element("tools", k, error.what());
    }
  }
}

/// Sets the fields that a table of options names.
template <class Job>
void set_options(const TomlTable& options, Job& job) {
  for (const std::string& key : options.keys()) {
    if (kOwnFields.contains(key)) options.refuse(key, "is set by the plan for each task, so it cannot be an option");
    try {
      set_field(job, key, options.words(key));
      check_fields(job);
    } catch (const UsageError& error) {
      options.refuse(key, without_field(error));
    }
  }
}

template <class Job>
Job job_of(const SweepPlan& plan, const std::string& face, const std::string& tool) {
  Job job;
  job.part.file = plan.part;
  job.part.faces = face;
  job.tool.spec = tool;
  return job;
}

/// What it reads beside the part, from the folder in which it runs; the catalogue, too, where it is not named.
template <class Job>
std::vector<std::string> inputs_of(const SweepPlan& plan, const Job& job) {
  std::vector<std::string> names;
  for_each_input(job, [&](const FieldInfo& info, const std::string& word) {
    std::error_code none;
    const std::string file = from_folder(plan, word);
    if (info.key != "part" && fs::exists(file, none)) names.push_back(file);
  });
  if constexpr (requires { job.choice.catalogue; })
    if (job.tool.spec == "catalogue" && !job.choice.catalogue) names.push_back(catalogue_folder({}));
  return names;
}

template <class Job>
void make_tasks(const TomlTable& document, SweepPlan& plan) {
  const TomlTable options = document.table("options"), variants = document.table("variants");
  plan.variants = variants.keys();
  for (const std::string& name : plan.variants)
    if (!std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }))
      variants.refuse(name, "expected a name of letters, digits, _ and -");
  const std::vector<std::string> names = plan.variants.empty() ? std::vector<std::string>{""} : plan.variants;
  if (plan.faces.size() * plan.tools.size() * names.size() > kMostTasks)
    document.refuse("faces", fmt::format("faces times tools times variants: at most {} tasks", kMostTasks));
  for (const std::string& face : plan.faces)
    for (std::size_t k = 0; k < plan.tools.size(); ++k)
      for (const std::string& variant : names) {
        Job job = job_of<Job>(plan, face, plan.tools[k]);
        set_options(options, job);
        if (!variant.empty()) set_options(variants.table(variant), job);
        std::string name = fmt::format("{}-{}{}{}", face, k + 1, variant.empty() ? "" : "-", variant);
        std::replace(name.begin(), name.end(), ',', '+');
        plan.tasks.push_back(
            {face, plan.tools[k], variant, short_name(name), command_words(PlanJob(job)), inputs_of(plan, job)});
      }
}

}  // namespace

std::string SweepPlan::folder() const { return fs::absolute(file).parent_path().lexically_normal().string(); }

SweepPlan read_plan(const std::string& file) {
  const TomlTable document = TomlTable::parse(read_text(file), file);
  (void)document.word("schema", {kSchema});
  SweepPlan plan;
  plan.file = file;
  plan.command = document.word("command", {"fit", "cover"});
  plan.part = from_folder(plan, document.text("part"));
  if (document.has("retries")) plan.retries = document.whole("retries", 0, 100);
  if (document.has("timeout_s")) plan.timeout_s = document.number("timeout_s", {1e-3, 1e7});
  plan.faces = distinct(document, "faces");
  read_tools(document, plan);
  if (plan.command == "fit")
    make_tasks<FitJob>(document, plan);
  else
    make_tasks<CoverJob>(document, plan);
  document.require_all_known();
  check_faces(document, document.table("options"), plan);
  return plan;
}

}  // namespace flank::internal

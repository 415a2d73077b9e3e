#include "flank/studio/jobs_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/studio/words_json.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook{50};
constexpr const char* kJobFile = "studio.json";
constexpr const char* kProgress = "progress.txt";
constexpr const char* kWheel = "wheel";
constexpr const char* kJournal = "resume.json";  // of a command that goes on only when it is told to
constexpr std::size_t kMostProgress = 1 << 20;   // bytes at a time
constexpr double kPatience = 20.0;               // seconds, for children that were told to stop

double now() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

Json read_json(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return Json::parse(text, nullptr, false);
}

/// Fields that the studio gives itself.
const std::vector<std::string>& kept_fields() {
  static const std::vector<std::string> kKept{"part"};
  return kKept;
}

void require_command(const std::string& command) {
  if (command != "fit" && command != "cover" && command != kWheel && command != "trochoid")
    throw UsageError("command", command, "expected fit, cover, trochoid or wheel");
}

/// What plan.json says of the operations of a wheel: "operations", "copies", "sectors", and, once the whole was judged, "pass". Nothing
/// before the first operation.
Json plan_of(const std::string& result) {
  const Json plan = read_json(result + "plan.json");
  Json told;
  for (const char* key : {"operations", "copies", "sectors", "surface", "pass"})
    if (plan.is_object() && plan.contains(key)) told[key] = plan.at(key);
  return told;
}

/// Whether the command would go on where this one ended, or begin again what ended before it had anything. A wheel goes on by itself, until
/// its whole has a verdict.
bool is_resumable(const StudioJob& job, const std::string& result) {
  if (job.state != JobState::kDone) return false;
  const bool ended_early = job.stopping || (job.exit_code && !crash_text(*job.exit_code).empty());
  if (job.command == kWheel) return ended_early && !plan_of(result).contains("pass");
  return fs::exists(result + kJournal) || (ended_early && !fs::exists(result + "summary.json"));
}

}  // namespace

Jobs::Jobs(StudioFolder folder, std::string program) : folder_(std::move(folder)), program_(std::move(program)) {
  fs::create_directories(folder_.jobs());
  read_all();
  worker_ = std::thread([this] { work(); });
}

Jobs::~Jobs() {
  ending_ = true;
  worker_.join();
  const double begin = now();
  const std::lock_guard lock(mutex_);
  for (StudioJob& job : jobs_)
    if (job.state == JobState::kRunning) {
      job.stopping = true;
      signal_child(job.child, SIGINT);
    }
  for (StudioJob& job : jobs_)
    while (job.state == JobState::kRunning && now() < begin + kPatience) {
      if (const auto code = exit_of(job.child)) finish(job, *code);
      std::this_thread::sleep_for(kLook);
    }
}

void Jobs::read_all() {
  for (const auto& entry : fs::directory_iterator(folder_.jobs())) {
    const std::string file = (entry.path() / kJobFile).string();
    if (!fs::is_regular_file(file)) continue;
    StudioJob job = job_from(read_json(file), file);
    // A folder that was renamed is another job.
    job.id = entry.path().filename().string();
    jobs_.push_back(std::move(job));
  }
  std::sort(jobs_.begin(), jobs_.end(), [](const StudioJob& a, const StudioJob& b) { return a.id < b.id; });
}

void Jobs::keep(const StudioJob& job) const {
  write_file(folder_of(job.id) + "/" + kJobFile, to_json(job).dump(2) + "\n");
}

StudioJob& Jobs::find(const std::string& id) {
  for (StudioJob& job : jobs_)
    if (job.id == id) return job;
  throw InputError("no such job: " + id);
}

std::string Jobs::add(const std::string& command, const std::string& part, const Json& fields) {
  require_command(command);
  const std::string file = folder_.files() + "/" + part;
  if (!is_plain_name(part) || !fs::is_regular_file(fs::symlink_status(file)))
    throw UsageError("part", part, "is not a part of this studio");
  std::vector<std::string> options = option_words(command, fields, folder_.files(), kept_fields());
  const std::lock_guard lock(mutex_);
  StudioJob job;
  const int last = jobs_.empty() ? 0 : std::atoi(jobs_.back().id.c_str());
  job.id = fmt::format("{:04}", last + 1);
  job.command = command, job.part = part, job.fields = fields;
  job.words = {command, file};
  job.words.insert(job.words.end(), options.begin(), options.end());
  job.words.insert(job.words.end(), {"-o", folder_of(job.id) + "/result", "--progress", "json"});
  std::vector<std::string> line{"flank", command, part};
  for (std::string& word : options) {
    if (const std::size_t at = word.find(folder_.files() + "/"); at != std::string::npos)
      word.erase(at, folder_.files().size() + 1);
    line.push_back(word);
  }
  line.insert(line.end(), {"-o", "out"});
  job.line = shell_line(line);
  fs::create_directories(folder_of(job.id) + "/programs");
  keep(job);
  jobs_.push_back(job);
  return job.id;
}

Json Jobs::told(const StudioJob& job) const {
  Json json = to_json(job);
  json.erase("process");
  json.erase("process_begun");
  json.erase("words");
  json["seconds"] = job.seconds + (job.state == JobState::kRunning ? now() - job.begun : 0.0);
  const std::string result = folder_of(job.id) + "/result/";
  json["resumable"] = is_resumable(job, result);
  json["crash"] = job.exit_code ? crash_text(*job.exit_code) : "";
  json["files"] = Json::array();
  json["programs"] = Json::array();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(result, none))
    if (entry.is_regular_file() && is_plain_name(entry.path().filename()))
      json["files"].push_back(entry.path().filename());
  for (const auto& entry : fs::directory_iterator(folder_of(job.id) + "/programs", none))
    json["programs"].push_back(entry.path().filename());
  for (const char* list : {"files", "programs"}) std::sort(json[list].begin(), json[list].end());
  if (job.state != JobState::kDone) return json;
  const Json summary = read_json(result + "summary.json");
  for (const char* key : {"pass", "complete", "reasons", "cautions", "coverage", "strips", "slenderness", "tolerance"})
    if (summary.is_object() && summary.contains(key)) json["summary"][key] = summary.at(key);
  return json;
}

Json Jobs::list() {
  const std::lock_guard lock(mutex_);
  Json all = Json::array();
  for (auto job = jobs_.rbegin(); job != jobs_.rend(); ++job) all.push_back(told(*job));
  return all;
}

Json Jobs::one(const std::string& id, std::size_t from) {
  const std::lock_guard lock(mutex_);
  Json json = told(find(id));
  ProgressLines read = read_progress(folder_of(id) + "/" + kProgress, from, kMostProgress);
  json["progress"] = std::move(read.lines);
  json["next"] = read.next;
  json["message"] = read.message;
  if (json["command"] == kWheel) json["plan"] = plan_of(folder_of(id) + "/result/");
  return json;
}

void Jobs::stop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  StudioJob& job = find(id);
  if (job.state == JobState::kDone) return;
  if (job.state == JobState::kWaiting) {
    job.state = JobState::kDone;
  } else {
    job.stopping = true;
    signal_child(job.child, SIGINT);
  }
  keep(job);
}

void Jobs::resume(const std::string& id) {
  const std::lock_guard lock(mutex_);
  StudioJob& job = find(id);
  if (job.state != JobState::kDone) return;
  job.resume = true;
  job.stopping = false;
  job.exit_code.reset();
  job.state = JobState::kWaiting;
  keep(job);
}

std::string Jobs::result(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return folder_of(find(id).id) + "/result";
}

std::string Jobs::programs(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return folder_of(find(id).id) + "/programs";
}

void Jobs::begin(StudioJob& job) {
  std::vector<std::string> words = job.words;
  const std::string folder = folder_of(job.id);
  if (job.resume && fs::exists(folder + "/result/" + kJournal)) words.emplace_back("--resume");
  fs::create_directories(folder);
  job.begun = now();
  try {
    job.child = start_child({program_, words, folder, folder + "/said.txt", folder + "/" + kProgress, true});
    job.state = JobState::kRunning;
  } catch (const InternalError&) {
    job.exit_code = -1;
    job.state = JobState::kDone;
  }
  keep(job);
}

void Jobs::finish(StudioJob& job, int exit_code) {
  const Json summary = read_json(folder_of(job.id) + "/result/summary.json");
  // A child of an earlier studio tells its code to nobody; its verdict is in its summary.
  const bool pass = summary.is_object() && summary.contains("pass") && summary.at("pass") == true;
  job.exit_code = exit_code >= 0 ? exit_code : summary.is_object() ? (pass ? 0 : 1) : -1;
  job.state = JobState::kDone;
  job.seconds += now() - job.begun;
  job.child = {};
  keep(job);
}

void Jobs::look_after(StudioJob& job) {
  if (const auto code = exit_of(job.child)) finish(job, *code);
}

void Jobs::work() {
  while (!ending_) {
    {
      const std::lock_guard lock(mutex_);
      bool busy = false;
      for (StudioJob& job : jobs_)
        if (job.state == JobState::kRunning) {
          look_after(job);
          busy = busy || job.state == JobState::kRunning;
        }
      // The one that waits longest: ids are in the order in which they came.
      const auto next = std::find_if(jobs_.begin(), jobs_.end(),
                                     [](const StudioJob& job) { return job.state == JobState::kWaiting; });
      if (!busy && next != jobs_.end()) begin(*next);
    }
    std::this_thread::sleep_for(kLook);
  }
}

}  // namespace flank::internal

#include "flank/report/browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "flank/base/atomic_file.h"
#include "flank/base/rest_of.h"
#include "flank/error.h"
#include "flank/report.h"

extern char** environ;

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// The path of a program that can be run; empty if there is none of that name.
std::string in_path(const std::string& name) {
  if (name.find('/') != std::string::npos) return access(name.c_str(), X_OK) == 0 ? name : "";
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + name;
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

/// Runs a program with its output thrown away; the exit status, or 128 if a signal ended it.
int run_quietly(const std::vector<std::string>& words) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  // Browsers write pages of warnings that say nothing about our page.
  for (int stream : {0, 1, 2}) posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  std::vector<std::string> copy = words;
  std::vector<char*> argv;
  for (std::string& word : copy) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failure = posix_spawn(&child, words.front().c_str(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) throw InternalError(words.front() + ": cannot be started");
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  if (ended != child) throw InternalError(words.front() + ": the process was lost");
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// A file as an address: what is not plain is escaped.
std::string address_of(const std::string& file) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string out = "file://";
  for (unsigned char c : fs::absolute(file).lexically_normal().string()) {
    if (std::isalnum(c) != 0 || std::string_view("/-._~").find(static_cast<char>(c)) != std::string_view::npos) {
      out += static_cast<char>(c);
    } else {
      out += '%';
      out += kDigits[c >> 4];
      out += kDigits[c & 15];
    }
  }
  return out;
}

/// A folder of the browser's own, gone afterwards.
/// Without one of its own the browser would open the page in the user's running instance, and make no picture.
class Profile {
 public:
  Profile() : folder_((fs::temp_directory_path() / "flank-browser-XXXXXX").string()) {
    if (mkdtemp(folder_.data()) == nullptr) throw InternalError(folder_ + ": cannot be made");
  }
  ~Profile() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Profile(const Profile&) = delete;
  Profile& operator=(const Profile&) = delete;
  [[nodiscard]] const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

}  // namespace

const std::vector<std::string>& browsers() {
  static const std::vector<std::string> kNames{"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"};
  return kNames;
}

std::string find_browser() {
  // Who names a browser wants that one: no other is taken in its place.
  if (const char* wanted = std::getenv("FLANK_BROWSER"); wanted != nullptr && *wanted != '\0') return in_path(wanted);
  for (const std::string& name : browsers())
    if (std::string file = in_path(name); !file.empty()) return file;
  return "";
}

}  // namespace flank::internal

namespace flank {
using namespace internal;

void make_picture(const std::string& html_file, const std::string& png_file, const PictureOptions& options) {
  const std::string browser = find_browser();
  if (browser.empty())
    throw UsageError("png",
                     "needs Chromium or Chrome in PATH (Debian: apt install chromium), or its path in FLANK_BROWSER");
  const Profile profile;
  // The browser tells the format by the ending, so it writes to a name of ours.
  const fs::path picture = fs::path(profile.folder()) / "page.png";
  // The browser's sandbox does not start as root; the page is our own. WebGL is drawn in software: the same everywhere.
  std::vector<std::string> words{
      browser,
      "--headless",
      "--hide-scrollbars",
      "--no-first-run",
      "--disable-sync",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-quic",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--force-device-scale-factor=1",
      "--virtual-time-budget=3000",
      "--user-data-dir=" + profile.folder(),
      "--window-size=" + std::to_string(options.width) + "," + std::to_string(options.height),
      "--screenshot=" + picture.string()};
  if (geteuid() == 0) words.push_back("--no-sandbox");
  words.push_back(address_of(html_file) + (options.fragment.empty() ? "" : "#" + options.fragment));
  const int status = run_quietly(words);
  std::ifstream stream(picture, std::ios::binary);
  const std::string png = rest_of(stream);
  if (status != 0 || png.empty())
    throw InternalError(browser + ": did not make a picture of " + html_file + " (exit " + std::to_string(status) +
                        ")");
  write_file(png_file, png);
}

void open_page(const std::string& html_file) {
  const std::string opener = in_path("xdg-open");
  if (opener.empty()) throw UsageError("xdg-open is not installed; open " + html_file + " in a browser");
  const bool served = html_file.starts_with("http://");
  const std::string page = served ? html_file : fs::absolute(html_file).lexically_normal().string();
  if (const int status = run_quietly({opener, page}); status != 0)
    throw UsageError("xdg-open found no browser (exit " + std::to_string(status) + "); open " + html_file + " in one");
}

}  // namespace flank

/// A folder of results as one thing: who writes to it, how its files are exchanged all at once, whether they belong
/// together (docs/decisions/0018-a-result-is-one-thing.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/base/kept/read_files.h"
#include "flank/manifest/file_text.h"
#include "flank/manifest/manifest.h"

namespace flank::internal {

/// The page that `flank report` adds to a folder.
inline constexpr const char* kPageFile = "report.html";

/// The names that fit, cover and verify write.
[[nodiscard]] const std::vector<std::string>& result_names();

/// Throws InputError if `output` is, or would become, one of the files of a result in the folder.
void require_not_a_result(const std::string& folder, const std::string& output);
/// The same for any folder: throws InputError if `output` is a file that the manifest of its folder names.
void require_no_result_there(const std::string& output);

/// A folder that is being read or written.
class ResultFolder {
 public:
  enum class Use {
    kWrite,        ///< the folder is made if there is none; refused while another process writes to it
    kWriteOrRead,  ///< the same, but a folder that may not be written is read
    kRead,         ///< never refused
  };

  /// Completes what a run that was killed has left. Throws InputError: no such folder, no folder, another process works
  /// in it, it may not be written, one of the result's names is a link or no file, or (kWrite) a file that no earlier result
  /// made, or that is read (base/kept).
  ResultFolder(std::string folder, Use use);
  /// A folder that it made and that is still empty is removed.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return folder_; }
  [[nodiscard]] bool writable() const { return writable_; }
  /// None: a folder that other programs wrote, or an earlier version.
  [[nodiscard]] const std::optional<Manifest>& manifest() const { return manifest_; }

  /// Puts files (name, content) and a manifest in the place of all that was there of an earlier result: at once, and on
  /// the disk. Files of others stay, and are never replaced. Throws InputError; what was there is whole then.
  void replace(const FileTexts& files, Manifest manifest);
  /// The same, but nothing that is not named is removed, and the manifest names all files of a result that are there.
  void add(const FileTexts& files, Manifest manifest);

  /// Throws InputError, naming the first file of the result that is not the one of the manifest. Nothing without a
  /// manifest. `but`: names that may have changed.
  void require_whole(const std::vector<std::string>& but = {}) const;

  /// Throws InputError, naming the first of these files that the manifest names and that is not there.
  void require_there(const std::vector<std::string>& names) const;

  /// Throws InputError if one of these files would be overwritten by a result in this folder.
  void require_not_inputs(const ReadFiles& inputs) const;
  /// Throws InputError if a file of this name is there and would be replaced: a link or no file, one that is read, or one
  /// that neither the manifest names nor says of itself that this program wrote it.
  void require_own(const std::string& name) const;

 private:
  [[nodiscard]] std::string in(const std::string& name) const;
  void lock();
  void make_unfinished() const;
  void require_writable();
  void require_plain(const std::string& name) const;
  void require_plain_names() const;
  [[nodiscard]] bool is_ours(const std::string& name) const;
  void require_no_strangers() const;
  void read_manifest();
  /// The manifest gets the hashes of the files.
  void publish(const FileTexts& files, Manifest manifest);
  void move_into_place();
  void remove_stale(const Manifest& next) const;
  void clean_up() const;

  std::string folder_;
  bool made_ = false, writable_ = false;
  int lock_ = -1;  ///< descriptor of the folder, whose lock ends with it
  std::optional<Manifest> manifest_;
};

}  // namespace flank::internal

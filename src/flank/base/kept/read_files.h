/// Files that are read, and the promise that none of them is written: who begins a piece of work lists what it reads,
/// and every writer of this library asks before it touches a file.
#pragma once

#include <string>
#include <vector>

namespace flank::internal {

/// Whether two names lead to one place, also if nothing is there yet, or to the same bytes.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

/// A list of files, each with who reads it.
class ReadFiles {
 public:
  /// A file by any name, or a folder with the files in it. `reader` is for messages: "the part". A name that is no file,
  /// such as the family of a tool, is passed over.
  void add(const std::string& name, const std::string& reader);
  void add(const ReadFiles& others);

  /// Throws InputError, naming both and who reads it, if `output` is one of them: by its place (after links, dots and
  /// folders), or because both names lead to the same bytes (hard links, a file system that does not tell cases apart).
  void require_not_written(const std::string& output) const;
  /// Throws InputError if one of them lies in the folder or below it: the folder will be removed.
  void require_none_below(const std::string& folder) const;

 private:
  struct File {
    std::string name, reader;
    std::string place;  ///< absolute, without links
  };
  std::vector<File> files_;
};

/// As long as it lives, writing one of these files is refused in this process, by whatever function of base/atomic_file.h
/// or manifest/result_folder.h. The list must live as long. Several at a time add up.
class Unwritten {
 public:
  explicit Unwritten(const ReadFiles& files);
  ~Unwritten();
  Unwritten(const Unwritten&) = delete;
  Unwritten& operator=(const Unwritten&) = delete;

 private:
  const ReadFiles* files_;
};

/// ReadFiles::require_not_written of every list that is in force.
void require_unread(const std::string& output);
/// ReadFiles::require_none_below likewise.
void require_unread_below(const std::string& folder);

}  // namespace flank::internal

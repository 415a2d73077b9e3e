/// Writing files so that a reader never sees half of one: a temporary name in the same folder, then a rename.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// Owns the temporary name of a file that is being written by somebody else (a library that wants a path). The
/// destructor removes what was not committed.
class AtomicFile {
 public:
  /// Throws InputError when the folder does not exist, or the file cannot be created there, or `file` is a folder.
  explicit AtomicFile(std::string file);
  /// Without commit() the temporary file is removed, and the real one is as before.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. The file exists already, empty.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

  /// Puts the temporary file in the place of the real one. Throws InputError if that fails.
  void commit();

 private:
  /// The name that readers know; the temporary one lies in the same folder, so that a rename is enough.
  std::string file_;
  /// Unique, so that two writers of one file do not meet.
  std::string temporary_;
  bool committed_ = false;
};

/// Writes `content` (text or bytes) as the whole of `file`. Throws InputError naming the file; nothing half-written is
/// left, and what was there before stays until the new content is complete.
void write_file(const std::string& file, std::string_view content);

}  // namespace flank::internal

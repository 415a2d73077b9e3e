#include "flank/io/text/read_bytes.h"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/error.h"

namespace flank::internal {

std::string_view without_blanks_in_front(std::string_view content) {
  if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  while (!content.empty() && std::isspace(static_cast<unsigned char>(content.front()))) content.remove_prefix(1);
  return content;
}

std::string read_bytes(const std::string& file, std::string_view accepted) {
  const auto but = [&](const char* separator) { return accepted.empty() ? "" : separator + std::string(accepted); };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file + ": no such file" + but("; accepted: "));
  if (std::filesystem::is_directory(status)) throw InputError(file + ": is a folder; give a file" + but(": "));
  // A pipe would make us wait, a device may never end.
  if (!std::filesystem::is_regular_file(status))
    throw InputError(file + ": is a device or a pipe; give a file" + but(": "));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be opened; check its permissions");
  // At once: growing would hold a large file twice.
  std::string content(std::filesystem::file_size(file), '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  content.append(std::istreambuf_iterator<char>(in),
                 std::istreambuf_iterator<char>());  // files without a size have some
  if (in.bad()) throw InputError(file + ": cannot be read to its end");
  if (content.empty()) throw InputError(file + ": is empty" + but("; accepted: "));
  return content;
}

}  // namespace flank::internal

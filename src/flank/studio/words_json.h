/// From what a page asks for to the words of a command line: only fields of the table, only files of the studio's folder.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace flank::internal {

/// Whether a name is that of a file in a folder, and nothing else: no folders, no "..", nothing hidden, no control characters.
[[nodiscard]] bool is_plain_name(const std::string& name);

/// Such a name of whatever a browser calls a file: without folders, what is not plain replaced by "_". "" stays "file".
[[nodiscard]] std::string plain_name(const std::string& name);

/// Options of a command from {"tolerance_mm": "0.1", "fixtures": ["vice.stl"]}; names are those of `flank fields`. Files must be
/// plain names of files in `files`, and become paths. Throws UsageError of the field: a name that the command has not, or that the
/// page does not set (`kept`: the part, the folder), a word that is neither text nor number, one with a slash, a file that is not there.
[[nodiscard]] std::vector<std::string> option_words(const std::string& command, const nlohmann::json& fields,
                                                    const std::string& files, const std::vector<std::string>& kept);

/// Words as one would type them into a shell, quoted where that is needed.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace flank::internal

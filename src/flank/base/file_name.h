/// Names of files, which may be any bytes, as text of a JSON file, which is UTF-8.
#pragma once

#include <string>

namespace flank::internal {

/// The name itself if it is UTF-8 and no address, else "file:" and the name with every other byte as %NN.
[[nodiscard]] std::string text_of_name(const std::string& name);
/// The other way: what text_of_name wrote reads back as the same bytes. Any other text is the name itself.
[[nodiscard]] std::string name_of_text(const std::string& text);

}  // namespace flank::internal

/// What is fuzzed: every reader of our own, by its name, which is that of its folder in tests/fuzz/corpus.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace flank::fuzz {

/// Reads the bytes. Refusing them (InputError, UsageError) is right; anything else that is thrown is a bug, and goes on.
using Target = std::function<void(std::string_view bytes)>;

[[nodiscard]] const std::map<std::string, Target>& targets();

}  // namespace flank::fuzz

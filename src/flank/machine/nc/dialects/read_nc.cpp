#include "flank/machine/nc/dialects/read_nc.h"

#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/dialects/recognise.h"
#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

namespace {

/// Refuses a text of another language, naming the first word that gives it away. Without it a program would fail at
/// some innocent word far below, or be read with another meaning: many words are the same everywhere.
void refuse_others(std::string_view text, const std::string& file, NcLanguage language) {
  const auto mark = recognised_language(text);
  const std::string wanted(nc_language_name(language));
  if (mark && mark->language != language)
    NcPlace{file, mark->line}.refuse(internal::quoted(mark->word) + " is of a " +
                                     std::string(nc_language_name(mark->language)) + " program; expected one for " +
                                     wanted);
  const std::string_view lacks = row_of(language).always_has;
  if (!mark && !lacks.empty())
    NcPlace{file}.refuse("no " + std::string(lacks) + " in the first lines; expected a program for " + wanted);
}

}  // namespace

std::vector<NcProgram> read_nc_operations(std::string_view text, const std::string& file, const NcDialect& dialect) {
  require_rotary_letters(dialect.rotary);
  refuse_others(text, file, dialect.language);
  return row_of(dialect.language).read(text, file, dialect);
}

NcProgram read_nc(std::string_view text, const std::string& file, const NcDialect& dialect) {
  std::vector<NcProgram> operations = read_nc_operations(text, file, dialect);
  if (operations.size() > 1)
    NcPlace{file}.refuse("has " + std::to_string(operations.size()) + " operations; expected a program of one");
  return std::move(operations.front());
}

}  // namespace flank::internal

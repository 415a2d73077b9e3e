#include "flank/machine/nc/read/read_nc.h"

#include "flank/error.h"
#include "flank/machine/nc/read/nc_lines.h"
#include "flank/machine/nc/read/read_apt.h"
#include "flank/machine/nc/read/read_fanuc.h"
#include "flank/machine/nc/read/read_heidenhain.h"
#include "flank/machine/nc/read/read_linuxcnc.h"
#include "flank/machine/nc/read/read_siemens.h"
#include "flank/machine/nc/read/recognise.h"

namespace flank::internal {

namespace {

/// Refuses a text of another language, naming the first word that gives it away. Without it a program would fail at
/// some innocent word far below, or be read with another meaning: many words are the same everywhere.
void refuse_others(std::string_view text, const std::string& file, NcLanguage language) {
  const auto mark = recognised_language(text);
  const std::string wanted(nc_language_name(language));
  if (mark && mark->language != language)
    NcPlace{file, mark->line}.refuse(internal::quoted(mark->word) + " is of a " +
                                     std::string(nc_language_name(mark->language)) + " program; accepted is one for " +
                                     wanted);
  // Plain G-code is LinuxCNC's where nothing else is said; a program for Fanuc has words that only it has.
  if (!mark && language == NcLanguage::kFanuc)
    NcPlace{file}.refuse(
        "no program number (O0001), G43.4 or G43.5 in the first lines; accepted is a program for fanuc");
}

/// The letters come from a machine's file or from a caller: the readers index by them.
void check_dialect(const NcDialect& dialect) {
  const std::string& r = dialect.rotary;
  const auto letter = [](char c) { return c == 'A' || c == 'B' || c == 'C'; };
  if (r.size() != 2 || !letter(r[0]) || !letter(r[1]) || r[0] == r[1])
    throw UsageError("rotary axes", "\"" + r + "\"", "accepted are two different letters of A, B and C");
}

}  // namespace

NcProgram read_nc(std::string_view text, const std::string& file, const NcDialect& dialect) {
  check_dialect(dialect);
  refuse_others(text, file, dialect.language);
  switch (dialect.language) {
    case NcLanguage::kFanuc:
      return read_fanuc(text, file, dialect);
    case NcLanguage::kSiemens:
      return read_siemens(text, file, dialect);
    case NcLanguage::kHeidenhain:
      return read_heidenhain(text, file, dialect);
    case NcLanguage::kApt:
      return read_apt(text, file, dialect);
    case NcLanguage::kLinuxCnc:
      break;
  }
  return read_linuxcnc(text, file, dialect);
}

}  // namespace flank::internal

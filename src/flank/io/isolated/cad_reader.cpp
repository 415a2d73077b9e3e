#include "flank/io/isolated/cad_reader.h"

#include <utility>

#include "flank/io/cad/read_cad.h"

namespace flank::internal {
namespace {

CadReader& setting() {
  static CadReader reader = [](const CadFile& file) { return read_cad(file.name, file.format, file.unit); };
  return reader;
}

}  // namespace

const CadReader& cad_reader() { return setting(); }
void set_cad_reader(CadReader reader) { setting() = std::move(reader); }

}  // namespace flank::internal

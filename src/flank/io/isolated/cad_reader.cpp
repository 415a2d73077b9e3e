#include "flank/io/isolated/cad_reader.h"

#include <utility>

#include "flank/io/cad/read_cad.h"

namespace flank::internal {
namespace {

CadReader& setting() {
  static CadReader reader = read_cad;
  return reader;
}

}  // namespace

const CadReader& cad_reader() { return setting(); }
void set_cad_reader(CadReader reader) { setting() = std::move(reader); }

}  // namespace flank::internal

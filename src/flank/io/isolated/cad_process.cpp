#include "flank/cad_process.h"

#include <string_view>

#include "flank/io/isolated/cad_reader.h"
#include "flank/io/isolated/end_with_parent.h"
#include "flank/io/isolated/part_cache.h"
#include "flank/io/isolated/read_isolated.h"
#include "flank/io/isolated/serve_cad.h"

namespace flank {
using namespace internal;

void end_with_parent() { end_with_parent_if_asked(); }

std::optional<int> serve_as_cad_reader(int argc, const char* const* argv) {
  if (argc < 2 || std::string_view(argv[1]) != kReadCadCommand) return std::nullopt;
  return serve_cad(argc - 2, argv + 2);
}

void read_cad_in_children(std::optional<double> limit_s, bool keep) {
  set_cad_reader([limits = ReadLimits{limit_s}, cache = keep ? user_part_cache() : PartCache{}](const CadFile& file) {
    return read_or_take(cache, file, [&] { return read_cad_isolated(file.name, file.format, file.unit, limits); });
  });
}

}  // namespace flank

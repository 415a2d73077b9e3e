/// manifest.json (docs/schema/manifest.md): which files of a folder make one result, and which part it was made from.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flank::internal {

inline constexpr const char* kManifestFile = "manifest.json";
/// Of a folder whose tool and path other programs have written, and may write again.
inline constexpr const char* kMadeByVerify = "verify";

/// A part, or another file, as it was when it was read.
struct PartStamp {
  std::string file;    ///< absolute
  std::string sha256;  ///< of its bytes
  bool operator==(const PartStamp&) const = default;
};

struct Manifest {
  std::string made_by;                       ///< "fit", "cover", or "verify": tool and path came from elsewhere
  std::string folder;                        ///< absolute, where job.json was written
  PartStamp part;                            ///< that the tool and the path were made for
  PartStamp judged;                          ///< that verify.json is about
  std::vector<PartStamp> inputs;             ///< what else the job read: tool, guide, fixtures, holder, catalogue
  std::map<std::string, std::string> files;  ///< name in the folder, sha256
  bool operator==(const Manifest&) const = default;
};

[[nodiscard]] std::string manifest_to_json(const Manifest& manifest);

/// Throws InputError naming the file: no JSON, another schema, a value of the wrong type, a name with a slash, a hash that is
/// none.
[[nodiscard]] Manifest manifest_from_json(std::string_view text, const std::string& file);

/// Where a file that was at `named` lies now, if it moved with the folder: at the same place beside `folder` as it was
/// beside the manifest's folder. `named` itself where nothing is there.
[[nodiscard]] std::string moved_with(const Manifest& manifest, const std::string& folder, const std::string& named);

}  // namespace flank::internal

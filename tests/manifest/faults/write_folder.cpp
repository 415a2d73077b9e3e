// write_folder FOLDER: replaces the result in a folder by a new one, as fit does, and adds a page, as report does. Exit
// codes are those of the command.
#include <cstdio>
#include <exception>

#include "flank/error.h"
#include "flank/manifest/result_folder.h"

int main(int argc, char** argv) {
  using namespace flank::internal;
  if (argc != 2) return 2;
  try {
    ResultFolder folder(argv[1], ResultFolder::Use::kWrite);
    const Manifest manifest{.made_by = "fit", .folder = argv[1], .part = {}, .judged = {}, .inputs = {}, .files = {}};
    folder.replace({{"tool.json", "new tool"}, {"path.json", "new path"}, {"verify.json", "new verdict"}}, manifest);
    folder.add({{"report.html", "new page"}}, *folder.manifest());
    return 0;
  } catch (const flank::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  }
}

#include "flank/machine.h"

#include "flank/machine/model/machine_file.h"
#include "flank/machine/model/machine_text.h"

namespace flank {

std::vector<std::string> machine_names() { return internal::machine_names(); }

std::string machine_table(const std::string& name_or_file) {
  return internal::machine_to_text(internal::read_machine(name_or_file));
}

std::string machine_json(const std::string& name_or_file) {
  return internal::machine_to_json(internal::read_machine(name_or_file));
}

std::string machine_list_table() { return internal::machine_list_text(); }

std::string machine_list_json() { return internal::machine_list_json(); }

}  // namespace flank

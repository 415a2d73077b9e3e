// LinuxCNC's own kinematics as a filter, for tests alone: joints in, poses out, or the other way round. Its modules want a few
// functions of LinuxCNC's hardware layer, which stand here without any hardware.
//
// linuxcnc_kinematics MODULE.so COORDINATES PARAMETER forward|inverse [pin=value ...]   ("-": no PARAMETER)
// forward reads lines of as many joints as there are COORDINATES, and writes X Y Z A B C; inverse the other way round.
#include <dlfcn.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <string>

namespace {

constexpr std::size_t kPinBytes = 64;

/// Memory that the module keeps until the end; it is never given back, as in LinuxCNC.
std::list<std::unique_ptr<std::array<std::byte, kPinBytes>>>& cells() {
  static std::list<std::unique_ptr<std::array<std::byte, kPinBytes>>> all;
  return all;
}

void* new_cell() {
  cells().push_back(std::make_unique<std::array<std::byte, kPinBytes>>());
  cells().back()->fill(std::byte{0});
  return cells().back()->data();
}

/// Numbers by the name of their pin, without the module's.
std::map<std::string, double*>& pins() {
  static std::map<std::string, double*> all;
  return all;
}

std::list<std::unique_ptr<std::byte[]>>& blocks() {
  static std::list<std::unique_ptr<std::byte[]>> all;
  return all;
}

}  // namespace

extern "C" {
int hal_init(const char*) { return 1; }
int hal_exit(int) { return 0; }
int hal_ready(int) { return 0; }
void* hal_malloc(long size) {
  blocks().push_back(std::make_unique<std::byte[]>(static_cast<std::size_t>(size)));  // zeros
  return blocks().back().get();
}
int hal_pin_float_newf(int, double** pin, int, const char* format, ...) {
  std::array<char, kPinBytes> name{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(name.data(), name.size(), format, values);
  va_end(values);
  *pin = static_cast<double*>(new_cell());
  const char* const dot = std::strchr(name.data(), '.');
  pins()[dot != nullptr ? dot + 1 : name.data()] = *pin;
  return 0;
}
int hal_pin_bit_new(const char*, int, void** pin, int) {
  *pin = new_cell();
  return 0;
}
int hal_pin_s32_new(const char*, int, void** pin, int) {
  *pin = new_cell();
  return 0;
}
void rtapi_print(const char*, ...) {}
void rtapi_print_msg(int, const char*, ...) {}
}

namespace {

struct Pose {
  std::array<double, 9> values{};  // x y z a b c u v w, mm and degrees
};

using Forward = int (*)(const double*, Pose*, const unsigned long*, unsigned long*);
using Inverse = int (*)(const Pose*, double*, const unsigned long*, unsigned long*);

template <class Function>
Function function(void* module, const char* name) {
  void* const found = dlsym(module, name);
  if (found == nullptr) {
    std::cerr << name << " is missing\n";
    std::exit(2);
  }
  return reinterpret_cast<Function>(found);
}

void set_text(void* module, const char* name, char* text) {
  if (void* const at = dlsym(module, name)) *static_cast<char**>(at) = text;
}

bool set_pin(const char* words) {
  const char* const equals = std::strchr(words, '=');
  const auto found = equals != nullptr ? pins().find(std::string(words, equals)) : pins().end();
  if (found == pins().end()) {
    std::cerr << words << ": no such pin\n";
    return false;
  }
  *found->second = std::strtod(equals + 1, nullptr);
  return true;
}

void print(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) std::printf(i + 1 < count ? "%.15g " : "%.15g\n", values[i]);
}

template <class Values>
bool read(Values& values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::cin >> values[i])) return false;
  return true;
}

}  // namespace

int main(int count, char** words) {
  if (count < 5) return 2;
  void* const module = dlopen(words[1], RTLD_NOW);
  if (module == nullptr) {
    std::cerr << dlerror() << '\n';
    return 2;
  }
  set_text(module, "rtapi_info_address_coordinates", words[2]);
  if (std::strcmp(words[3], "-") != 0) set_text(module, "rtapi_info_address_sparm", words[3]);
  if (function<int (*)()>(module, "rtapi_app_main")() != 0) return 2;
  for (int i = 5; i < count; ++i)
    if (!set_pin(words[i])) return 2;
  const std::size_t joint_count = std::strlen(words[2]);
  const bool forward = std::strcmp(words[4], "forward") == 0;
  const auto to_pose = function<Forward>(module, "kinematicsForward");
  const auto to_joints = function<Inverse>(module, "kinematicsInverse");
  unsigned long in = 0, out = 0;
  std::array<double, 16> joints{};
  for (Pose pose; forward ? read(joints, joint_count) : read(pose.values, 6);) {
    if (forward) {
      to_pose(joints.data(), &pose, &in, &out);
      print(pose.values.data(), 6);
    } else {
      to_joints(&pose, joints.data(), &in, &out);
      print(joints.data(), joint_count);
    }
  }
  return 0;
}

# Precompiled headers: what almost every source includes and nobody here changes, that is Eigen, the standard library, fmt, JSON and
# GoogleTest. They take a third off the build. No header of our own is among them, or each change of it would build everything anew.
#
# A source still includes all that it uses: `make tidy` reads every source without them.
option(FLANK_PRECOMPILE "Precompile the headers of third parties" ON)

set(FLANK_PRECOMPILED_NUMERIC
    <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
    <algorithm> <array> <atomic> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span>
    <string> <string_view> <utility> <vector>)
set(FLANK_PRECOMPILED_TEXT
    ${FLANK_PRECOMPILED_NUMERIC} <filesystem> <fstream> <sstream> <fmt/format.h> <nlohmann/json.hpp>)
set(FLANK_PRECOMPILED_TEST
    ${FLANK_PRECOMPILED_NUMERIC} <filesystem> <fstream> <sstream> <gtest/gtest.h>)

# flank_precompiled(NAME TYPE HEADERS LIBRARIES...): the target NAME, whose precompiled headers flank_precompile lends to others. TYPE
# is OBJECT for the library and EXECUTABLE for programs: the two are compiled with different options (-fPIC and -fPIE).
function(flank_precompiled name type headers)
  if(NOT FLANK_PRECOMPILE)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  if(type STREQUAL EXECUTABLE)
    file(CONFIGURE OUTPUT ${source} CONTENT "int main() {}\n")
    add_executable(${name} ${source})
  else()
    file(CONFIGURE OUTPUT ${source} CONTENT "// Only the precompiled headers of this target are of use.\n")
    add_library(${name} OBJECT ${source})
  endif()
  target_link_libraries(${name} PRIVATE Eigen3::Eigen ${ARGN} flank_warnings)
  target_compile_options(${name} PRIVATE -fpch-preprocess)
  target_precompile_headers(${name} PRIVATE ${headers})
endfunction()

# flank_precompile(TARGET NAME): TARGET reads the precompiled headers of NAME before its sources. It must be compiled with the same
# options; the compiler warns if it is not, and so fails.
function(flank_precompile target name)
  if(NOT FLANK_PRECOMPILE)
    return()
  endif()
  target_compile_options(${target} PRIVATE -fpch-preprocess)
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

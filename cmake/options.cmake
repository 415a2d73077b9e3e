option(FLANK_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(FLANK_BUILD_BENCH "Build the benchmarks" OFF)
option(FLANK_WARNINGS_AS_ERRORS "Let no compiler warning pass in our own code" ${PROJECT_IS_TOP_LEVEL})
set(FLANK_SANITIZE "" CACHE STRING "Sanitizers to compile with, e.g. address,undefined or thread")

option(FLANK_FUZZ "Build the readers as libFuzzer programs (clang)" OFF)
option(FLANK_HARDENING "Stack protector, checked C functions, read-only relocations, position-independent programs" ON)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(FLANK_CCACHE ccache)
if(FLANK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache keeps what was compiled with precompiled headers only if it may ignore when these were written.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${FLANK_CCACHE})
endif()

# GCC looks for garbage in all that it holds, the precompiled headers too, when it holds twice this number of kB, and else at 0.25 GB
# already: a tenth less time to compile, a tenth more memory (1.3 GB at most). The code is the same.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=500000>)

# Every target of our own links this one; third-party headers come in as SYSTEM, so it does not judge them.
add_library(flank_warnings INTERFACE)
target_compile_options(flank_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 takes "text" + std::string for an overlapping copy (GCC bug 105651), and with precompiled headers for one beyond a
  # string's end, too. The address sanitizer looks at the real thing.
  target_compile_options(flank_warnings INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()
if(FLANK_WARNINGS_AS_ERRORS)
  target_compile_options(flank_warnings INTERFACE -Werror)
endif()

# The same input gives the same bytes: no fused multiply-add that depends on the optimiser (decision 0002).
add_compile_options(-ffp-contract=off)
# For layers that read and write text and call others for what takes time: a quarter less time to compile, under a sanitizer a half, and
# their tests run as fast. The optimiser does not change what is computed.
set(FLANK_TEXT_OPTIONS $<$<CONFIG:Release>:-O1>)
# Layers of text that also walk over triangles, samples and poses, which takes minutes without the optimiser.
set(FLANK_DENSE_LAYERS bound correct)
if(FLANK_SANITIZE AND NOT FLANK_FUZZ)
  set(FLANK_TEXT_OPTIONS -O0)
  set(FLANK_DENSE_LAYERS bound correct machine io example inspect results)
endif()
# A fault in a reader is to end the program, not to be used. A distributor who sets such flags for all packages switches this
# off. FORTIFY needs the optimiser, and is not for sanitizers, which check more.
if(FLANK_HARDENING)
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
  add_compile_options(-fstack-protector-strong)
  add_link_options(-Wl,-z,relro,-z,now,-z,noexecstack)
  if(NOT FLANK_SANITIZE)
    add_compile_options("$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  endif()
endif()
if(FLANK_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
# A program that reads no part does not load the CAD kernel: it starts at once, and so does every test.
add_link_options(-Wl,--as-needed)
if(FLANK_SANITIZE)
  add_compile_options(-fsanitize=${FLANK_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FLANK_SANITIZE})
  # What the address sanitizer finds anyway; without these, Eigen's expressions compile and run twice as fast.
  add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # It sees uninitialised reads in instrumented Eigen expressions that are none.
    target_compile_options(flank_warnings INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
  else()
    # As GCC says it.
    if(FLANK_SANITIZE MATCHES "address")
      add_compile_definitions(__SANITIZE_ADDRESS__)
    elseif(FLANK_SANITIZE MATCHES "thread")
      add_compile_definitions(__SANITIZE_THREAD__)
    endif()
    # Every test program is linked with the whole library: LLVM's linker takes a fifth of the time.
    find_program(FLANK_LLD ld.lld)
    mark_as_advanced(FLANK_LLD)
    if(FLANK_LLD)
      add_link_options(-fuse-ld=lld)
    endif()
  endif()
endif()

# What find_package(OpenFlank) must find again is in cmake/OpenFlankConfig.cmake.in; the Debian packages are in
# scripts/install-deps.sh.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OCCT 7.6 REQUIRED)
# Headers only, in one source; nothing of it is linked.
find_path(FLANK_TOMLPLUSPLUS toml++/toml.h REQUIRED)
mark_as_advanced(FLANK_TOMLPLUSPLUS)
if(FLANK_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
if(FLANK_BUILD_BENCH)
  find_package(benchmark REQUIRED)
  find_package(embree 3 REQUIRED)
endif()

# One folder of src/flank, with the rooms in it, is one layer and one object library; all of them make the library `flank`.
# What a room may include is written in src/flank/layers.txt, which a test holds every include against.

# flank_layer(NAME [LIBRARIES...]): the object library flank_NAME of all sources in the folder NAME and its subfolders.
# A folder of headers only, or one that is still to come, makes no library.
function(flank_layer name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_library(flank_${name} OBJECT ${sources})
  target_include_directories(flank_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include
                             ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(flank_${name} PUBLIC Eigen3::Eigen ${ARGN} PRIVATE $<BUILD_INTERFACE:flank_warnings>)
  if("nlohmann_json::nlohmann_json" IN_LIST ARGN AND "fmt::fmt" IN_LIST ARGN)
    target_compile_options(flank_${name} PRIVATE ${FLANK_TEXT_OPTIONS})
    flank_precompile(flank_${name} flank_precompiled_text)
  else()
    flank_precompile(flank_${name} flank_precompiled_numeric)
  endif()
  flank_unity(flank_${name})
  set_property(GLOBAL APPEND PROPERTY FLANK_LAYERS flank_${name})
endfunction()

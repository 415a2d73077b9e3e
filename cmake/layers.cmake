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

# flank_parallel_tests(RESULT SOURCES...): the tests, below CMAKE_CURRENT_SOURCE_DIR, that are for the thread sanitizer: of rooms that have
# a parallel loop of their own, because they run what is inside it; and others that say how many threads there are to be (decision 0024).
function(flank_parallel_tests result)
  set(found "")
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} line REGEX "include \"flank/(threads|base/parallel)\\.h" LIMIT_COUNT 1)
    file(RELATIVE_PATH room ${CMAKE_CURRENT_SOURCE_DIR} ${source})
    string(REGEX REPLACE "/[^/]*$" "" room ${room})
    file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/flank/${room}/*.cpp ${PROJECT_SOURCE_DIR}/src/flank/${room}/*.h)
    foreach(file IN LISTS files)
      if(NOT line)
        file(STRINGS ${file} line REGEX "parallel_(for|blocks)\\(" LIMIT_COUNT 1)
      endif()
    endforeach()
    if(line)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

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
  if("nlohmann_json::nlohmann_json" IN_LIST ARGN AND "fmt::fmt" IN_LIST ARGN AND NOT name IN_LIST FLANK_DENSE_LAYERS)
    target_compile_options(flank_${name} PRIVATE ${FLANK_TEXT_OPTIONS})
    flank_precompile(flank_${name} flank_precompiled_text)
  else()
    flank_precompile(flank_${name} flank_precompiled_numeric)
  endif()
  flank_unity(flank_${name})
  set_property(GLOBAL APPEND PROPERTY FLANK_LAYERS flank_${name})
endfunction()

# flank_threaded_names(RESULT ROOM): names, without extension, of the files in a room of src/flank that have a parallel loop of their own, or
# what threads share.
function(flank_threaded_names result room)
  set(names "")
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/flank/${room}/*.cpp ${PROJECT_SOURCE_DIR}/src/flank/${room}/*.h)
  foreach(file IN LISTS files)
    file(STRINGS ${file} line REGEX "parallel_(for|blocks)\\(|std::(atomic|mutex|shared_mutex|once_flag)|thread_local" LIMIT_COUNT 1)
    if(line)
      get_filename_component(name ${file} NAME_WE)
      list(APPEND names ${name})
    endif()
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# flank_parallel_tests(RESULT SOURCES...): the tests, below CMAKE_CURRENT_SOURCE_DIR, that are for the thread sanitizer: of files that have
# a parallel loop of their own, because they run what is inside it, or hold what threads share; all of a room if such a file in it has
# no test of its own; and others that say how many threads there are to be (decision 0024).
function(flank_parallel_tests result)
  set(found "")
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} line REGEX "include \"flank/(threads|base/parallel)\\.h" LIMIT_COUNT 1)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH room ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    flank_threaded_names(names ${room})
    foreach(name IN LISTS names)
      file(GLOB own CONFIGURE_DEPENDS ${folder}/${name}*_test.cpp)
      if(NOT own OR source IN_LIST own)
        set(line yes)
      endif()
    endforeach()
    if(line)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

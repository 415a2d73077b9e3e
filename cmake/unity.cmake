# Unity builds: sources of a target whose unnamed namespaces share no name are compiled together, which reads the headers of third
# parties once for all of them, and compiles a template that several use once. What is computed does not change.
option(FLANK_UNITY "Compile several sources as one (needs Python 3 while configuring)" ON)
# Sources of a group at most. 24 compile in 0.7 of the time that groups of 8 take; more than that hardly occurs, since names meet.
set(FLANK_UNITY_SIZE 24)
find_package(Python3 COMPONENTS Interpreter QUIET)

# flank_unity(TARGET): groups of the sources that the target has so far.
function(flank_unity target)
  if(NOT FLANK_UNITY OR NOT Python3_FOUND)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  list(FILTER sources EXCLUDE REGEX "\\$<|${PROJECT_BINARY_DIR}")
  list(TRANSFORM sources REPLACE "^([^/].*)$" "${folder}/\\1")
  set_property(GLOBAL APPEND PROPERTY FLANK_UNITY_SOURCES --target ${target} ${sources})
  # Said by GCC of sources that are included, which it takes for headers, and of Eigen where it inlines a great deal.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage -Wno-maybe-uninitialized>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# The groups of all targets, once all are known: the script reads every header of ours, which is done once so.
function(_flank_make_unity_groups)
  get_property(sources GLOBAL PROPERTY FLANK_UNITY_SOURCES)
  if(NOT sources)
    return()
  endif()
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/unity.py ${FLANK_UNITY_SIZE} ${sources}
                  OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" groups "${groups}")
  foreach(line IN LISTS groups)
    if(line MATCHES "^([^ ]+) (.+)=([0-9]+)$")
      set_source_files_properties("${CMAKE_MATCH_2}" TARGET_DIRECTORY ${CMAKE_MATCH_1} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_3})
    endif()
  endforeach()
endfunction()
cmake_language(DEFER DIRECTORY ${PROJECT_SOURCE_DIR} CALL _flank_make_unity_groups)

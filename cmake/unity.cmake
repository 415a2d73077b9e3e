# Unity builds: sources of a target whose unnamed namespaces share no name are compiled together, which reads the headers of third
# parties once for all of them, and compiles a template that several use once. What is computed does not change.
option(FLANK_UNITY "Compile several sources as one (needs Python 3 while configuring)" ON)
# Sources of a group at most. 24 compile in 0.7 of the time that groups of 8 take; more than that hardly occurs, since names meet.
set(FLANK_UNITY_SIZE 24)
find_package(Python3 COMPONENTS Interpreter QUIET)

# flank_unity(TARGET): groups of the target's sources.
function(flank_unity target)
  if(NOT FLANK_UNITY OR NOT Python3_FOUND)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "\\$<|${PROJECT_BINARY_DIR}")
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/unity.py ${FLANK_UNITY_SIZE} ${sources}
                  WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" groups "${groups}")
  foreach(line IN LISTS groups)
    if(line MATCHES "^(.+)=([0-9]+)$")
      set_source_files_properties("${CMAKE_MATCH_1}" TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_2})
    endif()
  endforeach()
  # Said by GCC of sources that are included, which it takes for headers, and of Eigen where it inlines a great deal.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage -Wno-maybe-uninitialized>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

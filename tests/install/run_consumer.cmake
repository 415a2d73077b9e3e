function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
# The program of the README is compiled as it stands there.
file(READ ${EXAMPLES_DIR}/../README.md readme)
if(NOT readme MATCHES "```cpp\n(.*)\n```\n\n\\[docs/library")
  message(FATAL_ERROR "the README has no program in C++ before it names docs/library.md")
endif()
file(WRITE ${WORK_DIR}/readme.cpp "${CMAKE_MATCH_1}\n")
run(${CMAKE_COMMAND} --install ${FLANK_BUILD_DIR} --prefix ${WORK_DIR}/prefix)
file(GLOB catalogue ${WORK_DIR}/prefix/share/openflank/catalogue/*.json)
if(NOT catalogue)
  message(FATAL_ERROR "the tool catalogue is not installed")
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -D CMAKE_CXX_COMPILER=${CXX}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D WANTED_VERSION=${FLANK_VERSION}
    -D README_PROGRAM=${WORK_DIR}/readme.cpp)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer ${WORK_DIR})
if(NOT output MATCHES "^fit, cover, judge, tool and path: all there\n$")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()

# The programs of docs/library.md, one after the other, on a part that the command makes.
run(${CMAKE_COMMAND} -G Ninja -S ${EXAMPLES_DIR} -B ${WORK_DIR}/examples -D CMAKE_CXX_COMPILER=${CXX}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/examples)
run(${WORK_DIR}/prefix/bin/flank example twisted-blade -o ${WORK_DIR}/blade.step --quiet)
foreach(command "fit_a_tool blade.step F1" "judge_files blade.step F1 tool.json path.json" "cover_a_face blade.step F1")
  separate_arguments(words UNIX_COMMAND ${command})
  list(POP_FRONT words program)
  execute_process(COMMAND ${WORK_DIR}/examples/${program} ${words} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${command} ended with ${status}: ${output}")
  endif()
endforeach()
file(REMOVE_RECURSE ${WORK_DIR})

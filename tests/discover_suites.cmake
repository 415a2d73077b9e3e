# Writes the ctests of one program: one for each suite that it lists. Run after the program is linked:
#   cmake -D PROGRAM=test_X -D PREFIX=X. -D PROPERTIES="NAME value ..." -D FILE=out.cmake -P discover_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${failed}")
endif()
# Lines of tests are indented, "All/Programs." is a suite, and a type parameter stands behind "#".
string(REGEX MATCHALL "(^|\n)[^ \n#]+\\." suites "${listed}")
set(written "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n?(.+)\\.$" "\\1" suite "${suite}")
  if(NOT suite MATCHES "(^|/)DISABLED_")
    string(APPEND written "add_test([=[${PREFIX}${suite}]=] \"${PROGRAM}\" [=[--gtest_filter=${suite}.*]=] --gtest_brief=1)\n"
                          "set_tests_properties([=[${PREFIX}${suite}]=] PROPERTIES ${PROPERTIES})\n")
  endif()
endforeach()
file(WRITE ${FILE} "${written}")

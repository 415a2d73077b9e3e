# Configures a project of the optional parts alone, several times in one tree, on a system whose programs appear and go: empty scripts
# under the names that are looked for.
cmake_minimum_required(VERSION 3.25)
set(root ${WORK_DIR}/usr)
set(tree ${WORK_DIR}/build)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${root})
file(WRITE ${WORK_DIR}/project/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(Parts LANGUAGES NONE)
include(${SOURCE_DIR}/cmake/optional_part.cmake)
include(${SOURCE_DIR}/cmake/report_page.cmake)
include(${SOURCE_DIR}/cmake/python.cmake)
file(WRITE \${PROJECT_BINARY_DIR}/used \"\${FLANK_PYTHON_USED} \${FLANK_REPORT_USED}\")
")
file(COPY ${SOURCE_DIR}/web/package.json ${SOURCE_DIR}/web/package-lock.json ${SOURCE_DIR}/web/.npmrc DESTINATION ${WORK_DIR}/project/web)

function(program name status)
  file(WRITE ${root}/bin/${name} "#!/bin/sh\nmkdir -p node_modules\nexit ${status}\n")
  file(CHMOD ${root}/bin/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()

# configured(TREE STATUS USED SAYS OPTIONS...): ends the test unless the configuration ends like that, uses these parts and says that.
function(configured tree status used says)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${WORK_DIR}/project -B ${tree} -G "Unix Makefiles" -D CMAKE_MAKE_PROGRAM=${CMAKE_COMMAND} -D CMAKE_PREFIX_PATH=${root}
            -D CMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF -D CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")
  set(found "")
  if(EXISTS ${tree}/used)
    file(READ ${tree}/used found)
    file(REMOVE ${tree}/used)
  endif()
  if(NOT result STREQUAL status OR NOT found STREQUAL used OR NOT text MATCHES "${says}.*")
    message(FATAL_ERROR "exit ${result}, not ${status}, or used \"${found}\", not \"${used}\", or no \"${says}\" in:\n${text}")
  endif()
endfunction()

configured(${tree} 0 "OFF OFF" "The report page: left out .it needs Node.js.*The Python module: left out .it needs pybind11")
file(WRITE ${root}/include/pybind11/pybind11.h "")
program(python3 0)
configured(${tree} 0 "ON OFF" "The report page: left out .it needs Node.js and npm")
program(node 0)
program(npm 1)
configured(${tree} 0 "ON OFF" "npm could not fetch its packages")
configured(${tree} 1 "" "FLANK_REPORT=ON: npm could not fetch its packages" -D FLANK_REPORT=ON)
program(npm 0)
configured(${tree} 0 "ON ON" "Fetching" -D FLANK_REPORT=AUTO)
configured(${tree} 0 "ON ON" "")

# The pages that a source archive brings stand in where npm fails, and are left alone where it works.
file(WRITE ${WORK_DIR}/project/web/built/page_template.cpp "")
configured(${tree} 0 "ON ON" "")
program(npm 1)
configured(${WORK_DIR}/archive 0 "ON ON" "as it came with the sources .npm could not fetch" -D FLANK_REPORT=ON)
file(REMOVE_RECURSE ${WORK_DIR}/project/web/built)
program(npm 0)

# What the user wants is not changed by what is there.
configured(${tree} 0 "OFF OFF" "" -D FLANK_PYTHON=OFF -D FLANK_REPORT=OFF)
configured(${tree} 0 "OFF OFF" "")
file(REMOVE_RECURSE ${root})
configured(${WORK_DIR}/bare 1 "" "FLANK_PYTHON=ON: it needs pybind11" -D FLANK_PYTHON=ON)

# No other choice of the project is made by what was found: a default that is computed would be kept.
file(GLOB_RECURSE files ${SOURCE_DIR}/cmake/*.cmake ${SOURCE_DIR}/CMakeLists.txt ${SOURCE_DIR}/src/*/CMakeLists.txt)
foreach(file IN LISTS files)
  file(STRINGS ${file} options REGEX "^ *option\\(")
  foreach(option IN LISTS options)
    if(NOT option MATCHES " (ON|OFF|\\\${PROJECT_IS_TOP_LEVEL})\\)$")
      message(FATAL_ERROR "${file}: ${option}: ON or OFF is needed, or flank_optional_part")
    endif()
  endforeach()
endforeach()

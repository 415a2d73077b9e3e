# The Python module openflank (python/): built where a Python 3 with its headers and NumPy is, and pybind11's headers. Without
# them (or with FLANK_PYTHON=OFF) everything else is built.

# Several interpreters may be installed: the first that has what the module needs is taken.
function(_flank_is_usable_python result candidate)
  execute_process(
    COMMAND ${candidate} -c "import numpy, os, sys, sysconfig
sys.exit(0 if sys.version_info >= (3, 9) and os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h')) else 1)"
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(NOT status EQUAL 0)
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()
find_program(FLANK_PYTHON_EXECUTABLE NAMES python3 VALIDATOR _flank_is_usable_python)
find_path(FLANK_PYBIND11 pybind11/pybind11.h)
mark_as_advanced(FLANK_PYTHON_EXECUTABLE FLANK_PYBIND11)

if(FLANK_PYTHON_EXECUTABLE AND FLANK_PYBIND11 AND NOT FLANK_SANITIZE AND NOT FLANK_FUZZ)
  set(_flank_python_found ON)
else()
  set(_flank_python_found OFF)
endif()
option(FLANK_PYTHON "Build the Python module (needs Python 3.9 with its headers, NumPy, pybind11)" ${_flank_python_found})
if(FLANK_PYTHON AND NOT (FLANK_PYTHON_EXECUTABLE AND FLANK_PYBIND11))
  message(FATAL_ERROR "FLANK_PYTHON needs pybind11 and a Python with headers and NumPy (Debian: scripts/install-deps.sh python)")
endif()
set(FLANK_PYTHON_DESTINATION lib/python3/dist-packages CACHE STRING "Where the Python module is installed, below the prefix")
mark_as_advanced(FLANK_PYTHON_DESTINATION)

# The Python module openflank (python/): built where a Python 3 with its headers and NumPy is, and pybind11's headers. Without
# them (or with FLANK_PYTHON=OFF; FLANK_PYTHON=ON insists) everything else is built.

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

set(_flank_python_missing "")
if(FLANK_SANITIZE OR FLANK_FUZZ)
  set(_flank_python_missing "it is not built with sanitizers")
elseif(NOT FLANK_PYTHON_EXECUTABLE OR NOT FLANK_PYBIND11)
  set(_flank_python_missing "it needs pybind11 and a Python 3.9 with its headers and NumPy; Debian: scripts/install-deps.sh python")
endif()
flank_optional_part(FLANK_PYTHON "The Python module" "${_flank_python_missing}")
set(FLANK_PYTHON_DESTINATION lib/python3/dist-packages CACHE STRING "Where the Python module is installed, below the prefix")
mark_as_advanced(FLANK_PYTHON_DESTINATION)

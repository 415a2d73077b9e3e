# Finds the toolkits of Open CASCADE that read, repair and write CAD files, and their headers, by name. The package's own
# configuration file is left alone: it imports every toolkit, the viewers and their graphics libraries among them.
#
# OCCT_FOUND, OCCT_VERSION and the target OCCT::OCCT.
find_path(OCCT_INCLUDE_DIR Standard_Version.hxx PATH_SUFFIXES opencascade occt)
mark_as_advanced(OCCT_INCLUDE_DIR)

# Users before what they use, as a static build of the kernel would need it.
set(_occt_toolkits TKSTEP TKSTEP209 TKSTEPAttr TKSTEPBase TKIGES TKXSBase TKMesh TKBool TKBO TKPrim TKShHealing TKTopAlgo
    TKGeomAlgo TKBRep TKGeomBase TKG3d TKG2d TKMath TKernel)
set(_occt_libraries "")
set(_occt_required OCCT_INCLUDE_DIR)
foreach(_toolkit IN LISTS _occt_toolkits)
  find_library(OCCT_${_toolkit}_LIBRARY ${_toolkit})
  mark_as_advanced(OCCT_${_toolkit}_LIBRARY)
  list(APPEND _occt_libraries ${OCCT_${_toolkit}_LIBRARY})
  list(APPEND _occt_required OCCT_${_toolkit}_LIBRARY)
endforeach()

if(OCCT_INCLUDE_DIR)
  file(STRINGS ${OCCT_INCLUDE_DIR}/Standard_Version.hxx _occt_line REGEX "define OCC_VERSION_COMPLETE")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" OCCT_VERSION "${_occt_line}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OCCT REQUIRED_VARS ${_occt_required} VERSION_VAR OCCT_VERSION)

if(OCCT_FOUND AND NOT TARGET OCCT::OCCT)
  add_library(OCCT::OCCT INTERFACE IMPORTED)
  set_target_properties(OCCT::OCCT PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${OCCT_INCLUDE_DIR}"
                        INTERFACE_LINK_LIBRARIES "${_occt_libraries}")
endif()

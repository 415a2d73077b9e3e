# Debian packages, one a component (`make deb`). What a package needs of other packages is found by dpkg-shlibdeps; the library is
# static, so what links it needs the packages that its own build needed.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME openflank)
set(CPACK_PACKAGE_VENDOR OpenFlank)
set(CPACK_PACKAGE_CONTACT "OpenFlank maintainers <maintainers@openflank.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Flank milling of free-form surfaces: tools, five-axis motions, a judge")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Below any revision of the distribution itself, whose package then takes the place of this one.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0upstream1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_COMPONENTS_ALL dev)
if(TARGET flank_app)
  list(APPEND CPACK_COMPONENTS_ALL command)
endif()
if(TARGET flank_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME openflank)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "chromium")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "Flank milling of free-form surfaces: the command\nFinds tools and five-axis motions whose flank finishes a face, and judges them.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libopenflank-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libtbb-dev, libfmt-dev, libocct-data-exchange-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Flank milling of free-form surfaces: the C++ library\nA static library, its headers and a CMake package.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-openflank)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(TARGET flank_python)
  execute_process(COMMAND ${FLANK_PYTHON_EXECUTABLE} -c "import sys
print('python3 (>= 3.%d), python3 (<< 3.%d), python3-numpy' % (sys.version_info[1], sys.version_info[1] + 1))"
                  OUTPUT_VARIABLE CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
# Machines and the catalogue of tools come with the command.
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS openflank)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Flank milling of free-form surfaces: the Python module\nThe module openflank: the commands as functions, NumPy arrays, the judge.")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian/documents.cmake)
include(CPack)

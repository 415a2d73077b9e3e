include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(FLANK_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/OpenFlank)

# Three components, of which packages are made (cmake/package.cmake): the command, what a C++ program needs, the Python module.
install(TARGETS flank EXPORT OpenFlankTargets COMPONENT dev)
if(TARGET flank_app)
  install(TARGETS flank_app COMPONENT command)
endif()
if(TARGET flank_studio_app)
  install(TARGETS flank_studio_app DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/openflank COMPONENT command)
endif()
# The front door and nothing else: what src/flank holds is the library's own.
install(DIRECTORY include/flank DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/include/flank/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/flank COMPONENT dev)
install(DIRECTORY share/catalogue share/machines share/materials DESTINATION ${CMAKE_INSTALL_DATADIR}/openflank COMPONENT command)
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
# What the help texts name: docs/schema/machine.md and its neighbours.
install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command FILES_MATCHING PATTERN "*.md")

# Man pages and the completion of bash, made from the command's own help.
if(TARGET flank_app AND Python3_FOUND AND NOT FLANK_SANITIZE)
  set(docs ${PROJECT_BINARY_DIR}/command_docs)
  add_custom_command(OUTPUT ${docs}/completions/flank
                     COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/command_docs.py $<TARGET_FILE:flank_app> ${docs}
                     DEPENDS flank_app scripts/command_docs.py
                     COMMENT "Man pages and completion"
                     VERBATIM)
  add_custom_target(flank_command_docs ALL DEPENDS ${docs}/completions/flank)
  install(DIRECTORY ${docs}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
  install(FILES ${docs}/completions/flank DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT command)
endif()
if(TARGET flank_python)
  install(TARGETS flank_python LIBRARY DESTINATION ${FLANK_PYTHON_DESTINATION}/openflank COMPONENT python)
  install(DIRECTORY python/openflank DESTINATION ${FLANK_PYTHON_DESTINATION} COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
endif()

install(EXPORT OpenFlankTargets NAMESPACE OpenFlank:: DESTINATION ${FLANK_CMAKE_DIR} COMPONENT dev)
configure_package_config_file(cmake/OpenFlankConfig.cmake.in ${PROJECT_BINARY_DIR}/OpenFlankConfig.cmake
                              INSTALL_DESTINATION ${FLANK_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/OpenFlankConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/OpenFlankConfig.cmake ${PROJECT_BINARY_DIR}/OpenFlankConfigVersion.cmake
              cmake/FindOCCT.cmake
        DESTINATION ${FLANK_CMAKE_DIR} COMPONENT dev)

include(cmake/package.cmake)

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(FLANK_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/OpenFlank)

install(TARGETS flank EXPORT OpenFlankTargets)
if(TARGET flank_app)
  install(TARGETS flank_app)
endif()
# The front door and nothing else: what src/flank holds is the library's own.
install(DIRECTORY include/flank DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/include/flank/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/flank)
install(DIRECTORY share/catalogue share/machines DESTINATION ${CMAKE_INSTALL_DATADIR}/openflank)
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT OpenFlankTargets NAMESPACE OpenFlank:: DESTINATION ${FLANK_CMAKE_DIR})
configure_package_config_file(cmake/OpenFlankConfig.cmake.in ${PROJECT_BINARY_DIR}/OpenFlankConfig.cmake
                              INSTALL_DESTINATION ${FLANK_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/OpenFlankConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/OpenFlankConfig.cmake ${PROJECT_BINARY_DIR}/OpenFlankConfigVersion.cmake
              cmake/FindOCCT.cmake
        DESTINATION ${FLANK_CMAKE_DIR})

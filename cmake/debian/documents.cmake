# Run by CPack between staging and packaging: each Debian package gets its copyright and changelog, as Debian's policy wants them. What other
# installations have instead, LICENSE and NOTICE in a folder of the project's name, is left out.
set(packages command openflank dev libopenflank-dev python python3-openflank)
while(packages)
  list(POP_FRONT packages component package)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  if(NOT IS_DIRECTORY ${root})
    continue()
  endif()
  set(documents ${root}/share/doc/${package})
  file(REMOVE_RECURSE ${root}/share/doc/OpenFlank)
  file(MAKE_DIRECTORY ${documents})
  file(COPY ${CMAKE_CURRENT_LIST_DIR}/copyright DESTINATION ${documents} NO_SOURCE_PERMISSIONS)
  # Without name and time: the same bytes from the same text.
  execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_LIST_DIR}/changelog OUTPUT_FILE ${documents}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  file(CHMOD ${documents}/changelog.Debian.gz ${documents}/copyright PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(CHMOD ${documents} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endwhile()

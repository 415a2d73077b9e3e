# Parts of the project that need what may not be installed.

# flank_optional_part(NAME HELP MISSING): NAME is a choice of the user, AUTO (the default), ON or OFF, and NAME_USED whether the part is
# built: with AUTO where MISSING, which says what is lacking, is empty. That is found out anew by every configuration, so what is
# installed later is found later. With ON and something lacking the configuration fails and says what.
function(flank_optional_part name help missing)
  set(${name} AUTO CACHE STRING "${help}: AUTO (if what it needs is there), ON or OFF")
  set_property(CACHE ${name} PROPERTY STRINGS AUTO ON OFF)
  set(used OFF)
  if(${name} STREQUAL "AUTO")
    if(missing)
      message(STATUS "${help}: left out (${missing})")
    else()
      set(used ON)
    endif()
  elseif(${name})
    if(missing)
      message(FATAL_ERROR "${name}=${${name}}: ${missing}")
    endif()
    set(used ON)
  endif()
  set(${name}_USED ${used} PARENT_SCOPE)
endfunction()

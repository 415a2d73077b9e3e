# The published coordinates of NASA Rotor 37 (share/examples/rotor37*.csv) as rows of initialisers, which the source of
# `flank example rotor37` includes: the numbers are kept once, as data, and compiled in.

# Writes OUTPUT from the lines of CSV that begin with a number.
function(flank_csv_rows csv output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${csv})
  file(STRINGS ${csv} rows REGEX "^[-0-9]")
  list(TRANSFORM rows REPLACE "^(.+)$" "{\\1},")
  list(JOIN rows "\n" text)
  file(CONFIGURE OUTPUT ${output} CONTENT "${text}\n" @ONLY)
endfunction()

# flank_rotor37_table(TARGET): lets sources of TARGET include <rotor37_blade.inc> and <rotor37_hub.inc>.
function(flank_rotor37_table target)
  set(folder ${PROJECT_BINARY_DIR}/rotor37)
  flank_csv_rows(${PROJECT_SOURCE_DIR}/share/examples/rotor37.csv ${folder}/rotor37_blade.inc)
  flank_csv_rows(${PROJECT_SOURCE_DIR}/share/examples/rotor37_hub.csv ${folder}/rotor37_hub.inc)
  target_include_directories(${target} PRIVATE $<BUILD_INTERFACE:${folder}>)
endfunction()

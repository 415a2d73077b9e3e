# The server of `flank studio`: a program of its own, flank-studio, which the command becomes. Nothing else links what opens a connection,
# or loads it. Where cpp-httplib is missing it is not built, and the command says so.
find_path(FLANK_HTTPLIB httplib.h)
find_library(FLANK_HTTPLIB_LIBRARY cpp-httplib)
mark_as_advanced(FLANK_HTTPLIB FLANK_HTTPLIB_LIBRARY)
# With what Debian builds the library (its cpp-httplib.pc): its classes are others without.
set(FLANK_HTTPLIB_DEFINITIONS CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT CPPHTTPLIB_BROTLI_SUPPORT)
set(_flank_studio_missing "")
if(NOT FLANK_HTTPLIB OR NOT FLANK_HTTPLIB_LIBRARY)
  set(_flank_studio_missing "it needs cpp-httplib; Debian: apt install libcpp-httplib-dev")
elseif(NOT FLANK_REPORT_USED)
  set(_flank_studio_missing "it needs the report page, which is left out")
endif()
flank_optional_part(FLANK_STUDIO "The studio" "${_flank_studio_missing}")
if(NOT FLANK_STUDIO_USED AND NOT _flank_studio_missing)
  set(_flank_studio_missing "FLANK_STUDIO was ${FLANK_STUDIO} when it was built")
endif()

# What the command says when there is no flank-studio; empty where there is one.
set(FLANK_STUDIO_MISSING "${_flank_studio_missing}")

# flank_studio(): the library flank_studio of the room `studio`; nothing where it is not used.
function(flank_studio)
  if(NOT FLANK_STUDIO_USED)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/flank/studio/*.cpp)
  add_library(flank_studio STATIC ${sources})
  target_include_directories(flank_studio PUBLIC ${PROJECT_SOURCE_DIR}/src PRIVATE ${FLANK_HTTPLIB})
  target_link_libraries(flank_studio PUBLIC flank fmt::fmt nlohmann_json::nlohmann_json ${FLANK_HTTPLIB_LIBRARY}
                        PRIVATE $<BUILD_INTERFACE:flank_warnings>)
  target_compile_definitions(flank_studio PUBLIC ${FLANK_HTTPLIB_DEFINITIONS})
  # It waits for children and for people: it needs no speed.
  target_compile_options(flank_studio PRIVATE ${FLANK_TEXT_OPTIONS})
  flank_precompile(flank_studio flank_precompiled_text)
  flank_unity(flank_studio)
endfunction()

# The server of `flank studio`: linked into the command alone, so that the library opens no connection. Where cpp-httplib is missing the
# command is built without it, and says so.
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

# flank_studio(): the library flank_studio of the room `studio`, or of one source that says what was lacking.
function(flank_studio)
  set(folder ${PROJECT_SOURCE_DIR}/src/flank/studio)
  if(FLANK_STUDIO_USED)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  else()
    set(sources ${PROJECT_BINARY_DIR}/studio_missing.cpp)
    file(CONFIGURE OUTPUT ${sources} @ONLY CONTENT
"#include \"flank/error.h\"
#include \"flank/studio/studio.h\"
namespace flank::internal {
std::string_view studio_is_missing() { return \"@_flank_studio_missing@\"; }
void run_studio(const StudioOptions&, const std::string&, const std::function<void(const std::string&)>&,
                const std::function<bool()>&) {
  throw UsageError(\"studio\", \"this flank was built without the studio: \" + std::string(studio_is_missing()));
}
}  // namespace flank::internal
")
  endif()
  add_library(flank_studio STATIC ${sources})
  target_include_directories(flank_studio PUBLIC ${PROJECT_SOURCE_DIR}/src PRIVATE ${FLANK_HTTPLIB})
  target_link_libraries(flank_studio PUBLIC flank fmt::fmt nlohmann_json::nlohmann_json
                        PRIVATE $<BUILD_INTERFACE:flank_warnings>)
  if(FLANK_STUDIO_USED)
    target_link_libraries(flank_studio PUBLIC ${FLANK_HTTPLIB_LIBRARY})
    target_compile_definitions(flank_studio PUBLIC ${FLANK_HTTPLIB_DEFINITIONS})
  endif()
  # It waits for children and for people: it needs no speed.
  target_compile_options(flank_studio PRIVATE ${FLANK_TEXT_OPTIONS})
  flank_precompile(flank_studio flank_precompiled_text)
  if(FLANK_STUDIO_USED)
    flank_unity(flank_studio)
  endif()
endfunction()

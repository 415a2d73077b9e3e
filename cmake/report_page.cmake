# The pages of `flank report`, `flank inspect --html` and `flank studio`: bundled from web/ with packages that npm fetches into the build tree, and built into the
find_program(FLANK_NODE NAMES node nodejs)
find_program(FLANK_NPM npm)

# Sets FLANK_WEB_PACKAGES to the folder of the packages, or RESULT to why there are none. Asks npm only when the lock file changed, or
# has not answered yet.
function(flank_fetch_web_packages result)
  set(folder ${PROJECT_BINARY_DIR}/web)
  set(files package.json package-lock.json .npmrc)
  foreach(file IN LISTS files)
    configure_file(${PROJECT_SOURCE_DIR}/web/${file} ${folder}/${file} COPYONLY)
  endforeach()
  file(SHA256 ${folder}/package-lock.json wanted)
  set(stamp ${folder}/node_modules/.fetched)
  set(fetched "")
  if(EXISTS ${stamp})
    file(READ ${stamp} fetched)
  endif()
  if(NOT fetched STREQUAL wanted)
    message(STATUS "Fetching the packages of the report page")
    execute_process(COMMAND ${FLANK_NPM} ci --no-audit --no-fund --ignore-scripts WORKING_DIRECTORY ${folder}
                    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 300)
    if(NOT status EQUAL 0)
      message(WARNING "npm could not fetch the packages of the report page (${status}):\n${output}")
      set(${result} "npm could not fetch its packages; configure again where they can be fetched" PARENT_SCOPE)
      return()
    endif()
    file(WRITE ${stamp} ${wanted})
  endif()
  set(FLANK_WEB_PACKAGES ${folder}/node_modules PARENT_SCOPE)
endfunction()

set(_flank_report_missing "")
if(NOT FLANK_NODE OR NOT FLANK_NPM)
  set(_flank_report_missing "it needs Node.js and npm; Debian: apt install nodejs npm")
elseif(NOT DEFINED FLANK_REPORT OR FLANK_REPORT)
  flank_fetch_web_packages(_flank_report_missing)
endif()
set(_flank_shipped_pages ${PROJECT_SOURCE_DIR}/web/built/page_template.cpp)
set(_flank_use_shipped_pages OFF)
if(_flank_report_missing AND EXISTS ${_flank_shipped_pages})
  message(STATUS "The report page: as it came with the sources (${_flank_report_missing})")
  set(_flank_report_missing "")
  set(_flank_use_shipped_pages ON)
endif()
flank_optional_part(FLANK_REPORT "The report page" "${_flank_report_missing}")
if(NOT FLANK_REPORT_USED AND NOT _flank_report_missing)
  set(_flank_report_missing "FLANK_REPORT was ${FLANK_REPORT} when it was built")
endif()

# flank_report_page(TARGET): gives TARGET the source that holds the page, or one that says that there is none.
function(flank_report_page target)
  set(source ${PROJECT_BINARY_DIR}/web/page_template.cpp)
  set(why ${PROJECT_BINARY_DIR}/web/page_reason.cpp)
  file(CONFIGURE OUTPUT ${why} @ONLY CONTENT
"#include \"flank/report/page_template.h\"
namespace flank::internal {
std::string_view page_is_missing() { return \"@_flank_report_missing@\"; }
}  // namespace flank::internal
")
  if(FLANK_REPORT_USED AND _flank_use_shipped_pages)
    set(source ${_flank_shipped_pages})
  elseif(FLANK_REPORT_USED)
    file(GLOB parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/src/*)
    add_custom_command(
      OUTPUT ${source}
      BYPRODUCTS ${PROJECT_BINARY_DIR}/web/page.html ${PROJECT_BINARY_DIR}/web/faces.html ${PROJECT_BINARY_DIR}/web/studio.html
      COMMAND ${FLANK_NODE} ${PROJECT_SOURCE_DIR}/web/build.mjs ${FLANK_WEB_PACKAGES} ${PROJECT_BINARY_DIR}/web ${source}
      DEPENDS ${parts} ${PROJECT_SOURCE_DIR}/web/build.mjs ${PROJECT_SOURCE_DIR}/web/package-lock.json
      COMMENT "Bundling the report page"
      VERBATIM)
  else()
    set(source ${PROJECT_BINARY_DIR}/web/page_missing.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT
"#include \"flank/report/page_template.h\"
namespace flank::internal {
std::string_view page_template() { return {}; }
std::string_view faces_template() { return {}; }
std::string_view studio_template() { return {}; }
}  // namespace flank::internal
")
  endif()
  target_sources(${target} PRIVATE ${source} ${why})
endfunction()

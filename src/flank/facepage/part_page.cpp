#include "flank/part_page.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/report.h"
#include "flank/report/page_template.h"
#include "flank/results/view_body_json.h"
#include "flank/version.h"

namespace flank {
using namespace internal;

std::string faces_json(const Part& part, const InspectReport& report, const std::string& wheel) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(inspect_json(report));
  json["schema"] = "openflank/faces/1";
  // A page is handed on: where the part lay is nobody's business.
  json["file"] = std::filesystem::path(report.file).filename().string();
  json["bodies"] = nlohmann::ordered_json::array();
  for (const ViewFace& body : view_faces(part, {}, {})) json["bodies"].push_back(body_json(body));
  if (!wheel.empty()) json["wheel"] = nlohmann::ordered_json::parse(wheel);
  return dumped(json) + "\n";
}

std::string faces_page(const std::string& faces) {
  if (faces_template().empty())
    throw UsageError("html", "this flank was built without its pages: " + std::string(page_is_missing()));
  const std::string name = nlohmann::json::parse(faces).value("file", "");
  const std::string data = std::string("<meta name=\"generator\" content=\"OpenFlank ") + kVersion +
                           "\">\n<script type=\"application/json\" data-file=\"faces.json\">" + script_safe(faces) +
                           "</script>\n";
  return fill_page(faces_template(), "Faces of " + name + " - OpenFlank", data);
}

}  // namespace flank

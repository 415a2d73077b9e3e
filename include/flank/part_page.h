/// `flank inspect --html`: the faces of a part to look at, to point at and to choose from.
#pragma once

#include <string>

#include "flank/inspect.h"
#include "flank/part.h"

namespace flank {

/// The rows of a report with the triangles of every face, docs/schema/faces.md (schema "openflank/faces/1"). `report` is of
/// this part; its rows may be in any order, and those that it lacks have triangles all the same. `wheel`: the text of a
/// wheel.json of this part (docs/schema/wheel.md), by whose roles the page then names and colours the faces; empty: none.
[[nodiscard]] std::string faces_json(const Part& part, const InspectReport& report, const std::string& wheel = "");

/// A page that needs nothing else, of such a text. Throws UsageError if the library was built without the page.
[[nodiscard]] std::string faces_page(const std::string& faces);

}  // namespace flank

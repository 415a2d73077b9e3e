/// What the CAD kernel says of the entities of a file while it reads them. Private to io: no Open CASCADE type leaves this
/// folder and io/cad.
#pragma once

#include <Standard_Transient.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <set>
#include <string>

namespace flank::internal {

/// For each of `faces` of which something, down to a point, could not be read or made into a shape: which entity, and what the kernel says.
/// Faces of which it says nothing are not there.
[[nodiscard]] std::map<const Standard_Transient*, std::string> complaints_of_faces(
    const Handle(XSControl_WorkSession) & session, const std::set<const Standard_Transient*>& faces);

}  // namespace flank::internal

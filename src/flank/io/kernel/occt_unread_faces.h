/// Faces that a CAD file has and that the kernel made nothing of, or something else. Private to io: no Open CASCADE type
/// leaves this folder and io/cad.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <string>
#include <vector>

namespace flank::internal {

/// A face of the file of which there is no shape.
struct UnreadFace {
  int before = 1;      ///< its place: before this face of the map (from 1); one more than there are: behind all
  int beside = 0;      ///< a face of the map that is in the same shell; 0: none is
  std::string entity;  ///< what the file calls it: "#123", "D45"
  std::string why;     ///< what the kernel says of it
};

/// What the kernel left of the faces of a file.
struct FileFaces {
  std::vector<UnreadFace> unread;  ///< by their places
  /// Faces of the map (from 1) of which a border, a curve or a surface could not be read as the file has it, and why: the kernel
  /// makes a face of what is left.
  std::map<int, std::string> spoilt;
  std::vector<std::string> notes;  ///< on what else was left out
};

/// The faces of a STEP file that was transferred in `session`, whose shape has the faces of the map.
[[nodiscard]] FileFaces faces_of_step(const Handle(XSControl_WorkSession) & session,
                                      const TopTools_IndexedMapOfShape& read);

/// The same of an IGES file: bounded and trimmed surfaces, faces of shells, and surfaces that stand by themselves.
[[nodiscard]] FileFaces faces_of_iges(const Handle(XSControl_WorkSession) & session,
                                      const TopTools_IndexedMapOfShape& read);

}  // namespace flank::internal

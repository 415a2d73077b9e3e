/// Small shapes of the CAD kernel as files of every format that it writes, and damage that is done to their entities.
#pragma once

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <string>
#include <vector>

#include "flank/io/kernel/read_occt_silence.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"

namespace flank::internal::testing_io {

/// A block with a bore: six planes, a cylinder.
inline TopoDS_Shape bored_block() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape(),
                         BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(12.0, 9.0, -1.0), gp_Dir(0, 0, 1)), 4.0, 12.0).Shape())
      .Shape();
}

/// The text of the shape as STEP.
inline std::string step_text(const TopoDS_Shape& shape) {
  const Scratch scratch;
  const OcctSilence silence;
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  writer.Write(scratch.path("shape.step").c_str());
  return read_bytes(scratch.path("shape.step"));
}

/// As IGES: a solid of faces, or trimmed surfaces side by side.
inline std::string iges_text(const TopoDS_Shape& shape, bool solid) {
  const Scratch scratch;
  const OcctSilence silence;
  IGESControl_Writer writer("MM", solid ? 1 : 0);
  writer.AddShape(shape);
  writer.ComputeModel();
  writer.Write(scratch.path("shape.igs").c_str());
  return read_bytes(scratch.path("shape.igs"));
}

inline std::string brep_text(const TopoDS_Shape& shape) {
  const Scratch scratch;
  BRepTools::Write(shape, scratch.path("shape.brep").c_str());
  return read_bytes(scratch.path("shape.brep"));
}

/// Where each place that `word` begins at is.
inline std::vector<std::size_t> places_of(const std::string& text, const std::string& word) {
  std::vector<std::size_t> places;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) places.push_back(at);
  return places;
}

/// The number of the entity that the `k`-th # at or after `at` refers to.
inline std::string reference_at(const std::string& text, std::size_t at, int k) {
  for (; k >= 0; --k) at = text.find('#', at) + 1;
  return text.substr(at - 1, text.find_first_not_of("0123456789", at) - at + 1);
}

}  // namespace flank::internal::testing_io

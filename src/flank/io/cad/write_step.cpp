#include "flank/io/cad/write_step.h"

#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Compound.hxx>
#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/cad/write_occt_face.h"
#include "flank/io/cad/write_occt_products.h"
#include "flank/io/kernel/read_occt_silence.h"

namespace flank::internal {

std::string faces_to_step(const std::string& title, const std::vector<NamedFaces>& objects) {
  const OcctSilence silence;
  try {
    const BRep_Builder builder;
    std::vector<OcctProduct> products;
    for (const NamedFaces& object : objects) {
      TopoDS_Compound compound;
      builder.MakeCompound(compound);
      for (const Face& face : object.faces) builder.Add(compound, occt_face(face));
      products.push_back({object.name, compound});
    }
    return step_text(title, products);
  } catch (const Standard_Failure& failure) {
    throw InternalError(title + ": the faces cannot be written as STEP (" + failure.GetMessageString() + ")");
  }
}

void write_step(const std::string& file, const std::vector<Face>& faces) {
  const AtomicFile probe(file);  // better to learn that a folder is missing before the work than after
  const std::string name = std::filesystem::path(file).stem().string();
  write_file(file, faces_to_step(name, {{name, faces}}));
}

}  // namespace flank::internal

#include "flank/io/write_step.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Compound.hxx>
#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/base/error.h"
#include "flank/io/read_occt_silence.h"
#include "flank/io/write_occt_face.h"

namespace flank {
namespace {

/// The same faces give the same bytes: no date, and no counter in the product's name.
void write_model(const std::string& path, const std::string& name, const TopoDS_Compound& shape) {
  STEPControl_Controller::Init();  // else the settings do not exist yet at the first write, and are lost
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  Interface_Static::SetIVal("write.step.assembly", 0);  // one product, not one for each face
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw InternalError(name + ": the faces cannot be written as STEP");
  const Handle(StepData_StepModel) model = writer.Model();
  const Handle(TCollection_HAsciiString) title = new TCollection_HAsciiString(name.c_str());
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(StepBasic_Product) product = Handle(StepBasic_Product)::DownCast(model->Value(i));
    if (product.IsNull()) continue;
    product->SetName(title);
    product->SetId(title);
  }
  APIHeaderSection_MakeHeader header(model);
  header.SetName(title);
  header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));
  header.SetOriginatingSystem(new TCollection_HAsciiString("OpenFlank"));
  if (writer.Write(path.c_str()) != IFSelect_RetDone) throw InputError(name + ": cannot be written; check the disk");
}

}  // namespace

void write_step(const std::string& file, const std::vector<Face>& faces) {
  AtomicFile atomic(file);
  const OcctSilence silence;
  try {
    const BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (const Face& face : faces) builder.Add(compound, occt_face(face));
    write_model(atomic.temporary(), std::filesystem::path(file).stem().string(), compound);
  } catch (const Standard_Failure& failure) {
    throw InternalError(file + ": the faces cannot be written as STEP (" + failure.GetMessageString() + ")");
  }
  atomic.commit();
}

}  // namespace flank

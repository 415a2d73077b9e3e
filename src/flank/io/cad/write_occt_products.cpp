#include "flank/io/cad/write_occt_products.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <sstream>

#include "flank/error.h"

namespace flank::internal {
namespace {

Handle(TCollection_HAsciiString) occt_text(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

/// Open CASCADE counts the products of a process in their names: ours depend on nothing but the shapes.
void name_products(const StepData_StepModel& model, const std::vector<OcctProduct>& products) {
  std::size_t next = 0;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepBasic_Product) product = Handle(StepBasic_Product)::DownCast(model.Value(i));
    if (product.IsNull() || next == products.size()) continue;
    product->SetName(occt_text(products[next].name));
    product->SetId(occt_text(products[next].name));
    ++next;
  }
}

}  // namespace

std::string step_text(const std::string& title, const std::vector<OcctProduct>& products) {
  STEPControl_Controller::Init();  // else the settings do not exist yet at the first write, and are lost
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetIVal("write.step.assembly", 0);  // one product, not one for each face
  STEPControl_Writer writer;
  for (const OcctProduct& product : products) {
    Interface_Static::SetCVal("write.step.product.name", product.name.c_str());
    if (writer.Transfer(product.shape, STEPControl_AsIs) != IFSelect_RetDone)
      throw InternalError(title + ": " + product.name + " cannot be written as STEP");
  }
  const Handle(StepData_StepModel) model = writer.Model();
  name_products(*model, products);
  APIHeaderSection_MakeHeader header(model);
  header.SetName(occt_text(title));
  header.SetTimeStamp(occt_text("1970-01-01T00:00:00"));  // no date: the same shapes give the same bytes
  header.SetOriginatingSystem(occt_text("OpenFlank"));
  StepData_StepWriter text(model);
  text.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream out;
  if (!text.Print(out)) throw InternalError(title + ": cannot be written as STEP text");
  return out.str();
}

}  // namespace flank::internal

#include "flank/io/kernel/complaints.h"

#include <fmt/format.h>

#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <TCollection_HAsciiString.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace flank::internal {
namespace {

using Entity = Handle(Standard_Transient);

struct Complaint {
  Entity about;
  std::string text;
};

/// The first failure of a check that is about shapes; empty if there is none. A name that is none shapes nothing.
std::string failure_of(const Handle(Interface_Check) & check) {
  for (int i = 1; !check.IsNull() && i <= check->NbFails(); ++i) {
    std::string text = check->CFail(i, true);
    if (text.find("not a quoted String") != std::string::npos) continue;
    text.erase(0, text.find_first_not_of(' '));
    return text;
  }
  return {};
}

/// An edge that is neither a curve nor another edge turned round is dropped from its border with a warning.
std::string dropped_edge(const Entity& entity) {
  const auto turned = Handle(StepShape_OrientedEdge)::DownCast(entity);
  if (turned.IsNull()) return {};
  const Handle(StepShape_Edge) edge = turned->EdgeElement();
  const bool known = !edge.IsNull() && (edge->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)) ||
                                        edge->IsKind(STANDARD_TYPE(StepShape_OrientedEdge)));
  return known ? "" : "its edge is none of a curve";
}

/// Of all entities, in the order of the file.
std::vector<Complaint> complaints_of(const Handle(XSControl_WorkSession) & session) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  std::vector<Complaint> all;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    std::string text = failure_of(model->Check(i, true));
    if (text.empty())
      if (const Handle(Transfer_Binder) made = process->Find(entity); !made.IsNull()) text = failure_of(made->Check());
    if (text.empty()) text = dropped_edge(entity);
    if (!text.empty()) all.push_back({entity, std::move(text)});
  }
  return all;
}

}  // namespace

std::map<const Standard_Transient*, std::string> complaints_of_faces(const Handle(XSControl_WorkSession) & session,
                                                                     const std::set<const Standard_Transient*>& faces) {
  std::map<const Standard_Transient*, std::string> found;
  const Interface_Graph& graph = session->Graph();
  for (const Complaint& complaint : complaints_of(session)) {
    const std::string text =
        fmt::format("{}: {}", session->Model()->StringLabel(complaint.about)->ToCString(), complaint.text);
    // Up to the faces that use it, and no farther.
    std::vector<Entity> ways{complaint.about};
    std::set<const Standard_Transient*> seen{complaint.about.get()};
    while (!ways.empty()) {
      const Entity entity = ways.back();
      ways.pop_back();
      if (faces.count(entity.get()) > 0) {
        found.emplace(entity.get(), text);
        continue;
      }
      for (Interface_EntityIterator users = graph.Sharings(entity); users.More(); users.Next())
        // A curve in the parameters of a surface names the surface, and stands in the borders of both its faces. Both have the curve
        // in space, too, which counts.
        if (!users.Value()->IsKind(STANDARD_TYPE(StepGeom_Pcurve)) && seen.insert(users.Value().get()).second) ways.push_back(users.Value());
    }
  }
  return found;
}

}  // namespace flank::internal

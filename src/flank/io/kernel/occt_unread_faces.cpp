#include "flank/io/kernel/occt_unread_faces.h"

#include <fmt/format.h>

#include <IGESBasic_Group.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <IGESSolid_Shell.hxx>
#include <IGESToBRep.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_OrientedClosedShell.hxx>
#include <StepShape_OrientedFace.hxx>
#include <StepShape_OrientedOpenShell.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "flank/io/kernel/occt_complaints.h"
#include "flank/io/kernel/occt_iges_border.h"

namespace flank::internal {
namespace {

using Entity = Handle(Standard_Transient);

/// Faces that the file lists one after another: those of a shell, or all that stand by themselves. What is listed as a face and
/// is none is null.
using FaceList = std::vector<Entity>;

/// The numbers of the faces of the map by their shape without its place: an assembly has one several times.
class Numbers {
 public:
  Numbers(const Handle(XSControl_WorkSession) & session, const TopTools_IndexedMapOfShape& read)
      : process_(session->TransferReader()->TransientProcess()) {
    for (int i = 1; i <= read.Extent(); ++i) numbers_[read(i).TShape().get()].push_back(i);
  }

  /// Of what the kernel made of an entity, in its order: the numbers of each face. Empty: it made no face of it.
  [[nodiscard]] std::vector<std::vector<int>> of(const Entity& entity) const {
    std::vector<std::vector<int>> all;
    const TopoDS_Shape shape = entity.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(process_, entity);
    if (shape.IsNull()) return all;
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (int i = 1; i <= faces.Extent(); ++i)
      if (const auto found = numbers_.find(faces(i).TShape().get()); found != numbers_.end())
        all.push_back(found->second);
    return all;
  }

 private:
  Handle(Transfer_TransientProcess) process_;
  std::unordered_map<const void*, std::vector<int>> numbers_;
};

/// Gives each unread face of a list its place beside its neighbours in the list, as often as they are there.
class Places {
 public:
  explicit Places(const Numbers& numbers) : numbers_(numbers) {}

  /// `describe`: of the k-th of the list, entity and reason.
  template <class Describe>
  void add(const FaceList& list, const Describe& describe) {
    std::vector<std::vector<std::vector<int>>> made;
    for (const Entity& entity : list) made.push_back(numbers_.of(entity));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!made[k].empty()) {
        for (const std::vector<int>& face : made[k]) last_ = std::max(last_, face.back());
        continue;
      }
      UnreadFace face = describe(k);
      for (const auto& [before, beside] : places(made, k)) {
        face.before = before, face.beside = beside;
        unread_.push_back(face);
      }
    }
  }

  [[nodiscard]] std::vector<UnreadFace> take() {
    std::stable_sort(unread_.begin(), unread_.end(), [](const auto& a, const auto& b) { return a.before < b.before; });
    return std::move(unread_);
  }

 private:
  using Made = std::vector<std::vector<std::vector<int>>>;

  /// Pairs of `before` and `beside`: behind the last face before it in the list, or before the first behind it.
  [[nodiscard]] std::vector<std::pair<int, int>> places(const Made& made, std::size_t k) const {
    std::vector<std::pair<int, int>> all;
    for (std::size_t j = k; j-- > 0 && all.empty();)
      if (!made[j].empty())
        for (const int face : made[j].back()) all.emplace_back(face + 1, face);
    for (std::size_t j = k + 1; j < made.size() && all.empty(); ++j)
      if (!made[j].empty())
        for (const int face : made[j].front()) all.emplace_back(face, face);
    if (all.empty()) all.emplace_back(last_ + 1, 0);  // nothing of the list was read: behind what came before it
    return all;
  }

  const Numbers& numbers_;
  std::vector<UnreadFace> unread_;
  int last_ = 0;  ///< the largest number so far
};

/// What the faces of the lists have become.
FileFaces collect(const Handle(XSControl_WorkSession) & session, const std::vector<FaceList>& lists,
                  const TopTools_IndexedMapOfShape& read) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  std::set<const Standard_Transient*> faces;
  for (const FaceList& list : lists)
    for (const Entity& entity : list) faces.insert(entity.get());
  const std::map<const Standard_Transient*, std::string> complaints = complaints_of_faces(session, faces);
  const auto complaint = [&](const Entity& entity) {
    const auto found = complaints.find(entity.get());
    return found == complaints.end() ? std::string() : found->second;
  };
  FileFaces result;
  const Numbers numbers(session, read);
  Places places(numbers);
  for (const FaceList& list : lists) {
    places.add(list, [&](std::size_t k) {
      if (list[k].IsNull()) return UnreadFace{1, 0, "an entry of its shell", "it is not a face"};
      const std::string why = complaint(list[k]);
      return UnreadFace{1, 0, model->StringLabel(list[k])->ToCString(), why.empty() ? "no reason is given" : why};
    });
    for (const Entity& entity : list)
      if (const std::string why = entity.IsNull() ? "" : complaint(entity); !why.empty())
        for (const std::vector<int>& face : numbers.of(entity))
          for (const int number : face) result.spoilt.emplace(number, why);
  }
  result.unread = places.take();
  return result;
}

FaceList step_shell(const Handle(StepShape_ConnectedFaceSet) & shell) {
  FaceList list;
  for (int i = 1; i <= shell->NbCfsFaces(); ++i) {
    Entity face = shell->CfsFacesValue(i);
    if (const auto turned = Handle(StepShape_OrientedFace)::DownCast(face); !turned.IsNull())
      face = turned->FaceElement();
    list.push_back(face);
  }
  return list;
}

/// A surface without any trims that no other entity but a group uses, nor is meant for one.
bool stands_alone(const Handle(IGESData_IGESEntity) & entity, const Interface_Graph& graph) {
  constexpr int kPhysicallyDependent = 1;  // a bit of the status in the directory
  if (!IGESToBRep::IsTopoSurface(entity) || (entity->SubordinateStatus() & kPhysicallyDependent) != 0) return false;
  for (Interface_EntityIterator users = graph.Sharings(entity); users.More(); users.Next())
    if (Handle(IGESBasic_Group)::DownCast(users.Value()).IsNull()) return false;
  return true;
}

bool is_iges_face(const Handle(IGESData_IGESEntity) & entity, const Interface_Graph& graph) {
  return entity->IsKind(STANDARD_TYPE(IGESGeom_TrimmedSurface)) ||
         entity->IsKind(STANDARD_TYPE(IGESGeom_BoundedSurface)) || entity->IsKind(STANDARD_TYPE(IGESSolid_Face)) ||
         stands_alone(entity, graph);
}

/// The faces of a shell or of a group; nothing for other entities.
FaceList iges_members(const Handle(IGESData_IGESEntity) & entity, const Interface_Graph& graph) {
  FaceList list;
  if (const auto shell = Handle(IGESSolid_Shell)::DownCast(entity); !shell.IsNull())
    for (int i = 1; i <= shell->NbFaces(); ++i) list.push_back(shell->Face(i));
  if (const auto group = Handle(IGESBasic_Group)::DownCast(entity); !group.IsNull())
    for (int i = 1; i <= group->NbEntities(); ++i)
      if (!group->Entity(i).IsNull() && is_iges_face(group->Entity(i), graph)) list.push_back(group->Entity(i));
  return list;
}

/// Each face in one list: those that are in none of `lists` so far, as one more.
void add_rest(const FaceList& all, std::vector<FaceList>& lists) {
  std::set<const Standard_Transient*> listed;
  for (const FaceList& list : lists)
    for (const Entity& entity : list) listed.insert(entity.get());
  FaceList rest;
  for (const Entity& entity : all)
    if (listed.count(entity.get()) == 0) rest.push_back(entity);
  if (!rest.empty()) lists.push_back(std::move(rest));
}

/// Says which borders are elsewhere in space than on their surfaces.
void note_astray_borders(const Handle(XSControl_WorkSession) & session, const FaceList& faces,
                         std::vector<std::string>& notes) {
  const auto model = Handle(IGESData_IGESModel)::DownCast(session->Model());
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  for (const Entity& entity : faces) {
    const TopoDS_Shape made = TransferBRep::ShapeResult(process, entity);
    const auto face = Handle(IGESData_IGESEntity)::DownCast(entity);
    if (const double gap = made.IsNull() ? 0.0 : iges_border_gap(model, face, made); gap > 0.0)
      notes.push_back(
          fmt::format("{}: the curves of its border in space and in the parameters of its surface are up to {:.2g} mm "
                      "apart, or differ so much in length; check it before using the result",
                      model->StringLabel(entity)->ToCString(), gap));
  }
}

}  // namespace

FileFaces faces_of_step(const Handle(XSControl_WorkSession) & session, const TopTools_IndexedMapOfShape& read) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  std::vector<FaceList> lists;
  FaceList all;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    if (entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface))) all.push_back(entity);
    // A shell that is another one turned round lists nothing of its own.
    if (entity->IsKind(STANDARD_TYPE(StepShape_OrientedClosedShell)) ||
        entity->IsKind(STANDARD_TYPE(StepShape_OrientedOpenShell)))
      continue;
    if (const auto shell = Handle(StepShape_ConnectedFaceSet)::DownCast(entity); !shell.IsNull())
      lists.push_back(step_shell(shell));
  }
  add_rest(all, lists);
  return collect(session, lists, read);
}

FileFaces faces_of_iges(const Handle(XSControl_WorkSession) & session, const TopTools_IndexedMapOfShape& read) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  const Interface_Graph& graph = session->Graph();
  std::vector<FaceList> lists;
  FaceList all;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(model->Value(i));
    if (entity.IsNull()) continue;
    if (is_iges_face(entity, graph)) all.push_back(entity);
    if (FaceList list = iges_members(entity, graph); !list.empty()) lists.push_back(std::move(list));
  }
  add_rest(all, lists);
  FileFaces result = collect(session, lists, read);
  note_astray_borders(session, all, result.notes);
  return result;
}

}  // namespace flank::internal

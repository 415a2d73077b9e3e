/// The two fields about other faces, of jobs that have no obstacles but these (fields.h).
#pragma once

#include "flank/job/fields.h"

namespace flank::internal {

template <class Job, class Visitor>
void visit_other_faces(Job& job, Visitor&& visit) {
  visit(FieldInfo{"check_faces", "", "Other faces",
                  "Faces that the tool must not gouge, as F88,F12. Default: all faces that are not machined"},
        job.check_faces);
  visit(FieldInfo{"ignore_faces", "", "Other faces",
                  "Faces that the tool may cut into. S2-S5 names all faces of solids 2 to 5"},
        job.ignore_faces);
}

}  // namespace flank::internal

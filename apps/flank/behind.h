// What several commands still need from behind the front door, in one place: which files belong to a result, and which are read; and writing files.
#pragma once

#include "flank/base/atomic_file.h"
#include "flank/job/input_files.h"
#include "flank/manifest/folder_inputs.h"
#include "flank/manifest/result_folder.h"

/// The tables of the jobs that are not of the front door, design, bound, correct, redesign and wheel, fields as text, and which are basic: what options are made of.
#pragma once

#include "flank/job/bound_fields.h"
#include "flank/job/correct_fields.h"
#include "flank/job/design_fields.h"
#include "flank/job/field_text.h"
#include "flank/job/fields_json.h"
#include "flank/job/redesign_fields.h"
#include "flank/job/wheel_fields.h"

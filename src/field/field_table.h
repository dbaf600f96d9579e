#pragma once
// The table of built-in fields of positions. To add a field: one row in field_table.cpp.

#include <span>

#include "field/field_row.h"

namespace clsurf {

[[nodiscard]] std::span<const FieldRow> field_table();

}  // namespace clsurf

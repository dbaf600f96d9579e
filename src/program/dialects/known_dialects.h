#pragma once
// The dialects that clsurf reads, listed in dialects.def: the only part of a dialect that is used outside its folder.

#include "program/dialect.h"

namespace clsurf {

#define DIALECT(name, sources) extern const Dialect name##_dialect;
#include "program/dialects/dialects.def"
#undef DIALECT

}  // namespace clsurf

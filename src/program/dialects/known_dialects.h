#pragma once
// The rules of the dialects that clsurf reads, each in its own file. Listed in dialect.cpp.

#include "program/dialects/dialect_rules.h"

namespace clsurf {

extern const DialectRules fanuc_rules;           // fanuc.cpp
extern const DialectRules siemens_rules;         // siemens.cpp
extern const DialectRules linuxcnc_rules;        // rs274.cpp
extern const DialectRules heidenhain_iso_rules;  // heidenhain.cpp

}  // namespace clsurf

#pragma once
// The rules of the dialects that clsurf reads: the only part of a dialect that is used outside its folder. Listed in
// dialect_table.cpp.

#include "program/interpret/dialect_rules.h"

namespace clsurf {

extern const DialectRules fanuc_rules;           // fanuc/fanuc.cpp
extern const DialectRules siemens_rules;         // siemens/siemens.cpp
extern const DialectRules linuxcnc_rules;        // rs274.cpp
extern const DialectRules heidenhain_iso_rules;  // heidenhain/heidenhain.cpp
extern const DialectRules klartext_rules;        // klartext/klartext.cpp

}  // namespace clsurf

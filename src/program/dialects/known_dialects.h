#pragma once
// The rules of the dialects that clsurf reads, each in its own file. Listed in dialect_table.cpp.

#include <limits>
#include <span>

#include "program/interpret/dialect_rules.h"

namespace clsurf {

extern const DialectRules fanuc_rules;           // fanuc.cpp
extern const DialectRules siemens_rules;         // siemens.cpp
extern const DialectRules linuxcnc_rules;        // rs274.cpp
extern const DialectRules heidenhain_iso_rules;  // heidenhain.cpp
extern const DialectRules klartext_rules;        // klartext.cpp

/// Functions of formulas in both of HEIDENHAIN's languages.
[[nodiscard]] std::span<const FunctionRow> heidenhain_functions();
/// The greatest value of MP7431 and of circleDeviation.
inline constexpr ArcTolerance heidenhain_arc_tolerance{
    .absolute = 0.016, .most = std::numeric_limits<double>::infinity(), .reach = 0.005, .relative_reach = 1e-3};

}  // namespace clsurf

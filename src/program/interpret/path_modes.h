#pragma once
// The modes of corners: exact stops, tolerances.

#include <string>

#include "program/interpret/dialect_rules.h"
#include "program/program.h"

namespace clsurf {

class Interpreter;

/// `once`: for this block alone.
void set_path_mode(Interpreter& in, const std::string& name, const std::string& value, const PathMode& mode,
                   bool once = false);
/// A G code that sets the mode, with its P and Q.
bool path_mode_word(Interpreter& in, const CodeWord& word, const PathMode& mode, bool once = false);
/// G64 P Q: P is the tolerance, limited by the speed only without it; blocks merge within Q, or within P if there is
/// no Q.
bool rounded_corners(Interpreter& in, const CodeWord& word);

}  // namespace clsurf

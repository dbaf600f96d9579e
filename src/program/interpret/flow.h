#pragma once
// The order of lines: jumps, repeats, calls and returns.

#include <cstddef>
#include <string>
#include <vector>

#include "core/point.h"
#include "program/text/block.h"
#include "program/text/control.h"

namespace clsurf {

class Interpreter;

/// The control statements, labels and loops of a text, by line; built at the first call.
[[nodiscard]] const ControlIndex& control_index(Interpreter& in, std::size_t file);
/// Counts a jump. Fails if there are more than the options allow.
void count_jump(Interpreter& in);
/// The condition of an elseif.
[[nodiscard]] bool branch_taken(const Interpreter& in, const Control& branch);
/// To a label or a block number. `may_miss`: if it does not exist, the program continues.
void jump_to(Interpreter& in, const std::string& label, int direction, bool may_miss);
/// CASE v OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C
void choose_label(Interpreter& in, const std::string& text, std::size_t begin);
/// REPEAT and REPEATB: executes lines between labels again, P times: from one label to another, to ENDLABEL or to
/// this line.
void repeat_lines(Interpreter& in, const Control& repeat, const std::string& text);
/// Begins the section again, or continues after its REPEAT.
void next_of_section(Interpreter& in);
/// Back to a line, `times` times; then continues.
void repeat_from(Interpreter& in, LineNumber begin, double times);
/// Reads a subprogram's file once, for any number of calls.
[[nodiscard]] bool load_text(Interpreter& in, const std::string& name);
/// A subprogram of the program or in a file of its own. `locals`: with a set of local variables.
void call_subprogram(Interpreter& in, const std::string& name, int repeats, bool locals,
                     const std::vector<double>& arguments);
/// A subprogram in a file of its own; labels of the program are ignored.
void call_file(Interpreter& in, const std::string& name);
/// Continues after the active call, or repeats its subprogram; in the main program this is the end.
void leave(Interpreter& in, bool from_end_of_text);
/// M98 P L: P0031234 calls program 1234 three times if there is no L and `counted`.
void call_by_number(Interpreter& in, const Block& block, int least_repeats, bool counted);
/// M99 P: back to that block of the caller, in the main program a jump to it; M99: to after the call.
void return_to_block(Interpreter& in, const Block& block);

}  // namespace clsurf

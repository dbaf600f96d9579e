#pragma once
// Which line comes next: jumps, repeats, calls and returns.

#include <cstddef>
#include <string>
#include <vector>

#include "core/point.h"
#include "program/text/block.h"
#include "program/text/control.h"

namespace clsurf {

class Interpreter;

/// The control statements, labels and loops of a text, by line; made at the first call.
[[nodiscard]] const ControlIndex& control_index(Interpreter& in, std::size_t file);
/// A jump more. Fails where there are more than the options allow.
void count_jump(Interpreter& in);
/// The condition of an elseif.
[[nodiscard]] bool branch_taken(const Interpreter& in, const Control& branch);
/// To a label or a block number. `may_miss`: without it the program goes on.
void jump_to(Interpreter& in, const std::string& label, int direction, bool may_miss);
/// CASE v OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C
void choose_label(Interpreter& in, const std::string& text, std::size_t begin);
/// REPEAT and REPEATB: lines between labels once more, P times. From one label on, as far as ENDLABEL
/// or this line.
void repeat_lines(Interpreter& in, const Control& repeat, const std::string& text);
/// Once more from its beginning, or back behind its REPEAT.
void next_of_section(Interpreter& in);
/// Back to a line, `times` times; then on.
void repeat_from(Interpreter& in, LineNumber begin, double times);
/// Reads a subprogram's file once, however often it is called.
[[nodiscard]] bool load_text(Interpreter& in, const std::string& name);
/// A subprogram of the program or in a file of its own. `locals`: with a set of local variables.
void call_subprogram(Interpreter& in, const std::string& name, int repeats, bool locals,
                     const std::vector<double>& arguments);
/// A subprogram in a file of its own, whatever labels the program has.
void call_file(Interpreter& in, const std::string& name);
/// Behind the call that runs, or once more through its subprogram; out of the main program it is the end.
void leave(Interpreter& in, bool from_end_of_text);
/// M98 P L: P0031234 calls program 1234 three times where no L says how often and `counted`.
void call_by_number(Interpreter& in, const Block& block, int least_repeats, bool counted);
/// M99 P: back to that block of the caller, in the main program a jump to it; M99: behind the call.
void return_to_block(Interpreter& in, const Block& block);

}  // namespace clsurf

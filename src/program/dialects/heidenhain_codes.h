#pragma once
// What words of HEIDENHAIN's DIN/ISO do: M functions, frames and arcs, which Klartext has as well, and Q functions.

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// M91, M92: the positions of the block are those of the machine.
bool machine_position(Interpreter& in, int code, const Block& block);
/// M128, M129: positions are those of the tool's tip while rotary axes turn.
bool tool_centre_point(Interpreter& in, int code, const Block& block);

/// G54, G28, G73, G72: each replaces its own earlier one; the one that was first stays outermost.
void set_frame_part(Interpreter& in, HeidenhainFrames::Part part, const ProgramFrame& frame);
/// Inch programs give the feed in tenths of an inch.
void set_inches(Interpreter& in, bool inches);
/// An arc about the pole, or along the tangent. False: its radius is given.
bool arc_about_pole(Interpreter& in, const Block& block, ArcWords& words);

/// D00 … D12: `D01 Q5 P01 +Q2 P02 3` sets Q5, D09 … D12 jump to the label of the third. True: it was one.
bool run_q_function(Interpreter& in, std::string_view text);
/// `L5,3`: back to label 5 three times; `L5,0` and `L5` call it. True: it was one.
bool run_label_line(Interpreter& in, std::string_view text);

}  // namespace clsurf

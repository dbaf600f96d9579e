#pragma once
// The meaning of words of SINUMERIK: frames, poles, words of several letters, calls, definitions, cycles. Handlers in
// siemens.cpp call them. All throw like Interpreter::fail().

#include <limits>
#include <optional>
#include <vector>

#include "program/interpret/interpreter_state.h"

namespace clsurf::siemens {

struct State final : DialectState {
    ProgramFrame swivel;  ///< of CYCLE800; TRANS, ROT … are relative to it
    double contour_tolerance = std::numeric_limits<double>::quiet_NaN();  ///< CTOL, CYCLE832 [mm]; NaN: the machine's
};
[[nodiscard]] inline State& state_of(Interpreter& in) { return static_cast<State&>(*in.dialect_state_); }

/// G110 from the present position, G111 from the zero, G112 from the last pole.
void move_pole(Interpreter& in, int code, const Block& block);
void apply_keyword(Interpreter& in, const Keyword& keyword, Block& block);
void set_contour_tolerance(Interpreter& in, const Block& block);          ///< CTOL=
void define_variables(Interpreter& in, const std::string& definition);    ///< DEF
bool arc_of_words(Interpreter& in, const Block& block, ArcWords& words);  ///< true: CR=, AR=, CIP, CT …

/// Values between parentheses; nullopt: omitted, or a text.
[[nodiscard]] std::vector<std::optional<double>> arguments_of(const Variables& variables, const TextRules& rules,
                                                              const Keyword& keyword);
/// CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, …): shifts by X0 Y0 Z0, rotates by A, B and C in
/// succession about the rotated axes in the order given by MODE, shifts by X1 Y1 Z1.
void swivel(Interpreter& in, const Keyword& keyword);
/// Calls a subprogram by its name. Returns whether there is one.
bool call_by_name(Interpreter& in, const std::string& name, const Keyword& keyword, int repeats);
/// Returns whether the word was a cycle; it is then executed or reported.
bool cycle_keyword(Interpreter& in, const Keyword& keyword);
/// Runs what MCALL has named at the position that a block has reached. Returns whether it was a cycle.
bool repeat_modal_call(Interpreter& in);

}  // namespace clsurf::siemens

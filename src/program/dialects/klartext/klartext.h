#pragma once
// Shared by the parts of Klartext: the current statement, and its handlers that are in other files.

#include <optional>
#include <string>
#include <string_view>

#include "core/point.h"
#include "program/dialects/heidenhain/heidenhain_codes.h"
#include "program/dialects/klartext/klartext_words.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf::klartext {

/// A corner that the next line cuts: RND, CHF.
struct Corner {
    bool pending = false;
    bool rounded = false;  ///< else a chamfer
    double size = 0;       ///< radius, or length removed from each line [mm]
    double feed = 0;       ///< as programmed
    LineNumber line = 0;
};

struct State final : HeidenhainState {
    double tool_feed = 0;  ///< F of TOOL CALL, used by F AUTO
    KlartextSide side = KlartextSide::none;
    Corner corner;
};
[[nodiscard]] inline State& state_of(Interpreter& in) { return static_cast<State&>(*in.dialect_state_); }

/// A statement; the cursor is after its first words.
struct Line {
    Interpreter& in;
    Cursor c;
    std::size_t start = 0;  ///< byte of its first word

    /// A signed number or Q parameter at the cursor.
    double value() { return read_klartext_value(c, in.variables_, in.rules_->text); }
    /// A text in quotes at the cursor, without them. Throws ReadError.
    std::string quoted();
};

/// The label at the cursor: digits without leading zeros, or a name with its quotes.
[[nodiscard]] std::string label_of(Cursor& c);

// klartext_motions.cpp
/// A straight line: G1, or G0 under FMAX; cuts the corner before it if RND or CHF is pending.
void straight(Line& line, const KlartextWords& words);
/// An arc: C, CR, CT and their polar forms.
void arc(Line& line, const KlartextWords& words, ArcKind kind);
// klartext_spline.cpp
/// SPL
void spline(Line& line);

// klartext_motions.cpp
/// Words of a block with a G code.
void move_with(Line& line, const KlartextWords& words, int code);
/// Whether a statement of that name may follow RND and CHF.
[[nodiscard]] bool takes_corner(std::string_view name);

// klartext_q.cpp
/// Q5 = formula; words of a cycle that continue over several lines.
void assign_formula(Line& line);
/// FN 0: Q5 = +10 … FN 13: Q5 = +Q1 ANG +Q2
void calculate(Line& line);

// klartext_cycles.cpp
void define_cycle(Line& line);
void call_cycle(Line& line);
void note_cycle(Interpreter& in, const std::string& what, std::size_t column);
void tilt_plane(Line& line);
void start_tool_centre_point(Line& line);
void end_tool_centre_point(Line& line);
void shift_datum_by_axis(Line& line);

}  // namespace clsurf::klartext

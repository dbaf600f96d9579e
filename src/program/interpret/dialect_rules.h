#pragma once
// DialectRules: the meaning of lines, words and codes in a dialect. A value: one constant per dialect (folder
// dialects). The interpreter asks these rules and never which dialect it reads.
//
// What all dialects share (G0 … G3, planes, G90, drilling cycles) is in codes.cpp; a row here takes precedence.
// Handlers use the interface of interpreter_state.h.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "program/dialect.h"
#include "program/interpret/arc.h"
#include "program/interpret/dialect_signs.h"
#include "program/text/block.h"
#include "program/text/text_rules.h"

namespace clsurf {

class Interpreter;

/// State that one dialect keeps from block to block besides the common state: its rules create it, and its handlers
/// know its type.
struct DialectState {
    DialectState() = default;
    DialectState(const DialectState&) = delete;
    DialectState& operator=(const DialectState&) = delete;
    virtual ~DialectState() = default;
};
template <typename State>
[[nodiscard]] std::unique_ptr<DialectState> make_state() {
    return std::make_unique<State>();
}

/// A G code in tenths, as blocks store it: 54.1_g is 541.
consteval int operator""_g(long double code) { return static_cast<int>(code * 10 + 0.5L); }
consteval int operator""_g(unsigned long long code) { return static_cast<int>(code * 10); }

/// A G code in its block.
struct CodeWord {
    int code;  ///< in tenths
    Block& block;
    std::size_t column;
};
/// Executes a code. Returns false if the code has its common meaning.
using CodeHandler = bool (*)(Interpreter&, const CodeWord&);

struct CodeRule {
    int code;
    CodeHandler handle;
    int order = -1;  ///< among the codes of a block, as order_of() in codes.cpp; −1: the usual order
};

struct MRule {
    int code;
    /// Returns false if the code has its common meaning.
    bool (*handle)(Interpreter&, int code, const Block&);
};

/// A letter that is not allowed with an arc, and what to write instead.
struct RefusedLetter {
    char letter;
    const char* hint;
};

/// How blocks that move are read.
struct MotionRules {
    bool plain_blocks = true;                          ///< letters with numbers do not need the dialect's own reader
    bool needs_mode = false;                           ///< axis words without a motion mode are an error, not G1
    bool moves_without_axes = false;                   ///< G0 or G1 alone makes a motion of no length
    bool rotary_in_machine = false;                    ///< G53 applies to A, B, C as well
    bool turns_by_p = false;                           ///< P with an arc counts its turns
    bool feed_keeps_unit = false;                      ///< F keeps the unit that was active when it was programmed
    bool separate_uvw = false;                         ///< U, V, W are separate axes, which do not change X, Y, Z
    bool splines_by_last_block = false;                ///< all spans of a spline come with the block that ends it
    bool refuses_curve_codes = true;                   ///< G5.2, G5.3, G6.1 … move axes elsewhere: an error
    std::string_view idle_letters = "IJKLPQR";         ///< without meaning in a straight motion: reported
    std::span<const RefusedLetter> refused_at_arcs{};  ///< P, L, Q: turns in other dialects
    std::span<const int> forbidden_in_compensation{};  ///< codes, in tenths
};

/// The source of the length of G43.
enum class LengthOf : std::uint8_t { nothing, tool_in_spindle, row_of_h };

struct ToolRules {
    bool t_changes = false;         ///< T calls the tool, without M6
    bool m61 = false;               ///< M61 Q: this tool is in the spindle
    bool always_looks_up = false;   ///< a tool that is not in the table is reported, even in an empty one
    bool length_with_tool = false;  ///< the length is active from the tool change on, without G43
    bool edges = false;             ///< D1 activates the length, D0 cancels it
    bool radius_by_d = false;       ///< G41 D: a row of the table; false: the tool in the spindle
    LengthOf length_of = LengthOf::nothing;
};

struct OffsetRules {
    bool rotary = false;           ///< A, B, C of G10, G92 and G28 are evaluated
    bool rotation = false;         ///< R of G10 L2 rotates a work system
    bool tool_data = false;        ///< G10 L1, L10, L11 are rows of the tool table
    bool always_by_point = false;  ///< G28 moves through the intermediate point even if no axis is named
};

struct CycleRules {
    bool rs274 = false;         ///< G76 threads, G73 and G83 need Q, G74 and G84 tap in other planes
    double dwell_unit = 1;      ///< [s] of P
    bool repeats_by_k = false;  ///< K as well as L
};

struct CallRules {
    bool by_sub = false;              ///< a subprogram begins at its control statement; false: at a label
    bool label_if_no_sub = false;     ///< if there is none, at a label of that name
    bool subs_run_through = false;    ///< a label that the program reaches is executed; false: skipped
    bool begins_at_label = false;     ///< the line of the label itself is executed
    bool file_from_top = false;       ///< a subprogram in its own file begins at its first line
    bool returns_value = false;       ///< a call returns a value: #<_value>
    bool return_ends_main = false;    ///< outside of calls a return ends the program; false: it does nothing
    bool second_name_ends = false;    ///< the name of another program ends the first
    bool blocks_after_label = false;  ///< LABEL: G1 X10
    bool jumps_to_numbers = false;    ///< GOTO 10 and GOTO #1; false: to labels, and to N10
};

struct DialectRules {
    TextRules text{};
    std::span<const CodeRule> codes{};
    CodeHandler other_code = nullptr;  ///< codes that are in no row
    std::span<const MRule> m_codes{};
    MotionRules motion{};
    ToolRules tools{};
    OffsetRules offsets{};
    CycleRules cycles{};
    CallRules calls{};
    ArcTolerance arc_tolerance{};                      ///< [mm]
    std::optional<ArcTolerance> arc_tolerance_inch{};  ///< in inch programs; nullopt: the same
    GuessSigns signs{};

    /// Reads a line of plain words: nearly all lines of a finishing program.
    PlainResult (*plain)(std::string_view line, Words&) = read_plain;

    // Hooks for what a table cannot express. nullptr: nothing.
    /// State that the dialect keeps from block to block.
    std::unique_ptr<DialectState> (*make_state)() = nullptr;
    /// Whether a line of plain words may move at once. False: it is read like other lines. nullptr: always.
    bool (*plain_moves)(Interpreter&) = nullptr;
    /// Before the first line: initial position and state.
    void (*begin)(Interpreter&) = nullptr;
    /// `%` and the title after it (TextRules::named_titles).
    void (*title)(Interpreter&, const std::string& title) = nullptr;
    /// A line without its comments. Returns whether it was executed.
    bool (*statement)(Interpreter&, const Statement&) = nullptr;
    /// A block before its codes. Returns whether it was executed.
    bool (*begin_block)(Interpreter&, Block&) = nullptr;
    /// After its codes, before it moves.
    void (*after_codes)(Interpreter&, const Block&) = nullptr;
    /// After it has moved.
    void (*after_motion)(Interpreter&, const Block&) = nullptr;
    /// After its M codes: calls.
    void (*after_block)(Interpreter&, const Block&) = nullptr;
    /// After the last line.
    void (*at_end)(Interpreter&) = nullptr;
    /// An arc given by words other than I J K and R. Returns whether it was one.
    bool (*arc)(Interpreter&, const Block&, ArcWords&) = nullptr;
    /// The called macro or cycle of a modal call. Returns whether it was one of the dialect's own.
    bool (*modal_call)(Interpreter&) = nullptr;
    /// Parameters that the control keeps; NaN: ordinary variables.
    double (*parameter)(Interpreter&, int number) = nullptr;
    double (*named_parameter)(Interpreter&, const std::string& name) = nullptr;
    /// Writes one of them. Returns whether it was one.
    bool (*write_parameter)(Interpreter&, int number, double value) = nullptr;
    /// The polar words of a block, about the pole: `end` is the position before the block. nullptr: @ and ^ about the
    /// zero.
    void (*about_pole)(Interpreter&, const Block&, Vec3& end) = nullptr;
    /// The name of work systems after G59, from 7 on; nullptr: G54.1 P1 …
    std::string (*work_system_name)(int number) = nullptr;

    /// Tolerances of the controls of the dialect. `unit_mm`: of the program's lengths.
    [[nodiscard]] const ArcTolerance& arc_tolerance_in(double unit_mm) const {
        return unit_mm != 1 && arc_tolerance_inch ? *arc_tolerance_inch : arc_tolerance;
    }
};

}  // namespace clsurf

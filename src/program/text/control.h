#pragma once
// Control statements: they decide which line comes next. O-words of LinuxCNC, Fanuc's custom macro (IF, WHILE, GOTO,
// M98/M99), Siemens' IF, WHILE, FOR, LOOP, REPEAT, GOTO, Heidenhain's labels.

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/point.h"
#include "program/program.h"
#include "program/text/cursor.h"
#include "program/text/text_rules.h"

namespace clsurf {

enum class ControlKind : std::uint8_t {
    none,
    sub,
    end_sub,
    call,
    leave,  // leave: return from a subprogram
    while_begin,
    while_end,  // while … endwhile, WHILE … DO m / END m
    do_begin,
    do_while,  // do … while, LOOP/REPEAT … UNTIL
    if_begin,
    else_if,
    else_branch,
    if_end,
    repeat_begin,
    repeat_end,
    for_begin,
    for_end,
    break_loop,
    continue_loop,
    go_to,
    if_go_to,
    if_then,         // IF […] GOTO n, IF […] THEN …
    label,           // a place to jump to; a program number
    repeat_section,  // REPEAT LABEL P=n, REPEAT FROM TO P=n: these lines, n times more
    repeat_block,    // REPEATB LABEL P=n: that line, n times more
    choice,          // CASE v OF 1 GOTOF A … DEFAULT GOTOF B
    end_loop,        // end of an endless loop
};

struct Control {
    ControlKind kind = ControlKind::none;
    std::string label;       ///< O-word, DO number, GOTO target, label: in the letter case of comparisons
    std::size_t rest = 0;    ///< byte at which its expression or arguments begin
    std::size_t target = 0;  ///< of IF … GOTO and IF … THEN: byte at which the rest begins
    int direction = 0;       ///< of a GOTO: +1 forward, −1 backward, 0 both
    bool may_miss = false;   ///< GOTOC: if the label does not exist, the program continues
    LineNumber line = 0;     ///< its line, in an index
    int partner = -1;  ///< index of its other end: while ↔ end, if → its endif, break and continue → their loop
    int next_branch = -1;  ///< of if, elseif: the next elseif, else or endif
};

/// The control statement of a cleaned line, if any. Throws ReadError.
[[nodiscard]] Control parse_control(std::string_view statement, const TextRules& rules);

// For the dialects' parsers.
/// The digits of a label without leading zeros: "007" is "7", "0" is empty.
[[nodiscard]] std::string number_label(Cursor& c);
/// The start of a word (upper case) in a statement, not preceded by a letter; npos if not found.
[[nodiscard]] std::size_t find_control_word(std::string_view text, std::string_view word, std::size_t from);

/// All control statements of a text, matched. Built at the first one. O(text).
class ControlIndex {
public:
    ControlIndex() = default;
    ControlIndex(const SourceText& text, const TextRules& rules);

    [[nodiscard]] const std::vector<Control>& all() const { return controls_; }
    /// The statement of a line, or −1.
    [[nodiscard]] int at_line(LineNumber line) const;
    /// The first `sub` or `label` of that name, or −1; from `line` on in `direction`, 0: anywhere.
    [[nodiscard]] int find(ControlKind kind, const std::string& label, LineNumber line = 0, int direction = 0) const;

private:
    std::vector<Control> controls_;
    std::unordered_map<std::string, std::vector<int>> named_;  ///< subs and labels, in order
};

/// The lines of all block numbers of a text. Built at the first jump that needs it. O(text).
class BlockNumbers {
public:
    BlockNumbers() = default;
    explicit BlockNumbers(const SourceText& text);
    /// The line of block `number` nearest after `line` in `direction` (0: forward, then from the
    /// start), or 0. O(log lines).
    [[nodiscard]] LineNumber find(double number, LineNumber line, int direction) const;

private:
    std::vector<std::pair<double, LineNumber>> lines_;  ///< sorted
};

}  // namespace clsurf

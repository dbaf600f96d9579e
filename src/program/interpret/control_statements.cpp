// Control statements: conditions, loops, calls and labels of every dialect.

#include "program/interpret/control_statements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

/// The value of a condition or a loop's count at a byte of the statement.
double value_at(const Interpreter& in, std::string_view text, std::size_t at) {
    Cursor c{text, at};
    return evaluate(c, in.variables_, in.rules_->text);
}

/// The statement of the current line, as matched by the index.
const Control& own_control(Interpreter& in) {
    const int at = control_index(in, in.place_.file).at_line(in.place_.line);
    if (at < 0) in.fail("this control statement is not allowed here");
    return control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)];
}

const Control& partner_of(Interpreter& in, const Control& control, const char* what) {
    if (control.partner < 0) in.fail(fmt::format("{} has no matching statement", what));
    return control_index(in, in.place_.file).all()[static_cast<std::size_t>(control.partner)];
}

/// Continues with the line after another one.
void go_after(Interpreter& in, LineNumber line) {
    count_jump(in);
    in.go_to(in.place_.file, line + 1);
}

void pass_sub(Interpreter& in, const Control&, const Statement&) {
    // A label of HEIDENHAIN: its section is executed in sequence as well.
    if (!in.rules_->calls.subs_run_through) go_after(in, partner_of(in, own_control(in), "sub").line);
}

void return_from_sub(Interpreter& in, const Control& control, const Statement& statement) {
    if (control.rest < statement.text.size() && in.rules_->calls.returns_value) {
        Cursor c{statement.text, control.rest};
        if (c.peek() != '\0') {
            in.variables_.set("_value", read_value(c, in.variables_, in.rules_->text));
            in.variables_.set("_value_returned", 1);
        }
    }
    if (!in.calls_.frames.empty() || in.rules_->calls.return_ends_main) leave(in, false);
}

/// O-words: o<name> call [1] [2].
void call_sub(Interpreter& in, const Control& control, const Statement& statement) {
    std::vector<double> arguments;
    Cursor c{statement.text, control.rest};
    while (c.peek() == '[') {
        ++c.at;
        arguments.push_back(evaluate(c, in.variables_, in.rules_->text));
        if (!c.take(']')) throw ReadError{"'[' is not closed", c.column(), {}};
    }
    std::string label = control.label;
    if (label.starts_with('[') || label.starts_with('#')) {
        Cursor name{label, 0};
        label = fmt::format("{}", std::lround(read_value(name, in.variables_, in.rules_->text)));
    }
    call_subprogram(in, label, 1, true, arguments);
}

void begin_while(Interpreter& in, const Control& control, const Statement& statement) {
    const Control& begin = own_control(in);
    if (begin.kind == ControlKind::do_while) {  // `o1 while` that closes `o1 do`
        if (value_at(in, statement.text, control.rest) != 0) go_after(in, partner_of(in, begin, "while").line);
        return;
    }
    const bool goes_in = control.rest == std::string_view::npos || value_at(in, statement.text, control.rest) != 0;
    if (!goes_in) go_after(in, partner_of(in, begin, "while").line);
}

void end_loop(Interpreter& in, const Control&, const Statement&) {
    const Control& begin = partner_of(in, own_control(in), "end of a loop");
    count_jump(in);
    in.go_to(in.place_.file, begin.line);
}

/// UNTIL
void end_do(Interpreter& in, const Control& control, const Statement& statement) {
    const Control& begin = partner_of(in, own_control(in), "until");
    if (value_at(in, statement.text, control.rest) == 0) go_after(in, begin.line);
}

void begin_if(Interpreter& in, const Control& control, const Statement& statement) {
    const Control* branch = &own_control(in);
    if (value_at(in, statement.text, control.rest) != 0) return;
    do {
        if (branch->next_branch < 0) in.fail("if has no endif");
        branch = &control_index(in, in.place_.file).all()[static_cast<std::size_t>(branch->next_branch)];
        if (branch->kind != ControlKind::else_if) break;
        in.place_.line = branch->line;
        in.place_.text = in.program_.files[in.place_.file].line(in.place_.line);
    } while (!branch_taken(in, *branch));
    go_after(in, branch->line);
}

/// Reached at the end of a branch that was taken: continues after the whole statement.
void pass_else_if(Interpreter& in, const Control&, const Statement&) {
    go_after(in, partner_of(in, own_control(in), "elseif").line);
}

void pass_else(Interpreter& in, const Control&, const Statement&) {
    go_after(in, partner_of(in, own_control(in), "else").line);
}

void pass(Interpreter&, const Control&, const Statement&) {}

void begin_repeat(Interpreter& in, const Control& control, const Statement& statement) {
    const Control& begin = own_control(in);
    Cursor c{statement.text, control.rest};
    const double count = read_value(c, in.variables_, in.rules_->text);
    if (!(count >= 1)) return go_after(in, partner_of(in, begin, "repeat").line);
    in.calls_.counters[in.place_.line] = std::floor(count + 1e-6) - 1;
}

void end_repeat(Interpreter& in, const Control&, const Statement&) {
    const Control& begin = partner_of(in, own_control(in), "endrepeat");
    double& left = in.calls_.counters[begin.line];
    if (left < 1) return;
    left -= 1;
    go_after(in, begin.line);
}

/// FOR v = from TO to
void begin_for(Interpreter& in, const Control& control, const Statement& statement) {
    Cursor c{statement.text, control.rest};
    const std::string name = c.identifier();
    c.at += name.size();
    if (name.empty() || !c.take('=')) throw ReadError{"expected a variable and '=' after FOR", c.column(), {}};
    const double from = evaluate(c, in.variables_, in.rules_->text);
    if (!c.take_word("TO")) throw ReadError{"expected TO", c.column(), {}};
    const double to = evaluate(c, in.variables_, in.rules_->text);
    double value = from;
    const auto running = in.calls_.counters.find(in.place_.line);
    const bool numbered =
        name.size() > 1 && name[0] == 'R' && name.find_first_not_of("0123456789", 1) == std::string::npos;
    const int number = numbered && name.size() < 7 ? 100000 + std::stoi(name.substr(1)) : 0;
    if (running != in.calls_.counters.end()) value = running->second + 1;
    if (numbered)
        in.variables_.set(number, value);
    else
        in.variables_.set(name, value);
    if (value > to) {
        in.calls_.counters.erase(in.place_.line);
        go_after(in, partner_of(in, own_control(in), "for").line);
    } else {
        in.calls_.counters[in.place_.line] = value;
    }
}

void end_for(Interpreter& in, const Control&, const Statement&) {
    count_jump(in);
    in.go_to(in.place_.file, partner_of(in, own_control(in), "endfor").line);
}

void leave_loop(Interpreter& in, const Control& control, const Statement&) {
    const Control& own = own_control(in);
    if (own.partner < 0) in.fail("break or continue outside a loop");
    const Control& begin = partner_of(in, own, "break or continue");
    const Control& end = partner_of(in, begin, "loop");
    if (control.kind == ControlKind::break_loop) return go_after(in, end.line);
    count_jump(in);
    in.go_to(in.place_.file, end.line);
}

void go_to_label(Interpreter& in, const Control& control, const Statement& statement) {
    if (control.kind == ControlKind::if_go_to && value_at(in, statement.text, control.rest) == 0) return;
    std::string label = control.label;
    if (label.empty() && in.rules_->calls.jumps_to_numbers) {
        Cursor c{statement.text, control.target};
        label = fmt::format("{}", std::lround(read_value(c, in.variables_, in.rules_->text)));
    }
    jump_to(in, label, control.direction, control.may_miss);
}

/// The rest of a statement as a block of its own.
void run_rest(Interpreter& in, std::string_view text, std::size_t at) {
    Cursor c{text, at};
    read_block(c, in.variables_, in.rules_->text, in.state_.least_increment(), in.block_);
    in.execute(in.block_);
}

/// IF […] THEN …
void run_if(Interpreter& in, const Control& control, const Statement& statement) {
    if (value_at(in, statement.text, control.rest) != 0) run_rest(in, statement.text, control.target);
}

/// A program number; what follows in its block still counts. A second one ends the first program, as another program
/// begins there.
void pass_label(Interpreter& in, const Control& control, const Statement& statement) {
    const bool begins_another =
        in.rules_->calls.second_name_ends && in.program_.motions.size() > 0 && in.calls_.frames.empty();
    if (begins_another) {
        in.event("end", "O" + control.label);
        in.ended_ = true;
        return;
    }
    const std::string& text = statement.text;
    const std::size_t rest = std::min(control.rest, text.size());
    const bool goes_on = in.rules_->calls.blocks_after_label &&
                         text.find_first_not_of(' ', rest) != std::string::npos && text.find(':') != std::string::npos;
    if (!goes_on) return;
    Statement after_label = statement;
    std::fill(after_label.text.begin(), after_label.text.begin() + static_cast<std::ptrdiff_t>(rest), ' ');
    if (!control_statement(in, after_label)) run_rest(in, after_label.text, 0);
}

void repeat(Interpreter& in, const Control& control, const Statement& statement) {
    repeat_lines(in, control, statement.text);
}

void choose_branch(Interpreter& in, const Control& control, const Statement& statement) {
    choose_label(in, statement.text, control.rest);
}

struct ControlRow {
    ControlKind kind;
    void (*run)(Interpreter&, const Control&, const Statement&);
};

}  // namespace

bool control_statement(Interpreter& in, const Statement& statement) {
    static constexpr auto rows = std::to_array<ControlRow>({
        {ControlKind::sub, pass_sub},
        {ControlKind::end_sub, return_from_sub},
        {ControlKind::call, call_sub},
        {ControlKind::leave, return_from_sub},
        {ControlKind::while_begin, begin_while},
        {ControlKind::while_end, end_loop},
        {ControlKind::do_begin, pass},
        {ControlKind::do_while, end_do},
        {ControlKind::if_begin, begin_if},
        {ControlKind::else_if, pass_else_if},
        {ControlKind::else_branch, pass_else},
        {ControlKind::if_end, pass},
        {ControlKind::repeat_begin, begin_repeat},
        {ControlKind::repeat_end, end_repeat},
        {ControlKind::for_begin, begin_for},
        {ControlKind::for_end, end_for},
        {ControlKind::break_loop, leave_loop},
        {ControlKind::continue_loop, leave_loop},
        {ControlKind::go_to, go_to_label},
        {ControlKind::if_go_to, go_to_label},
        {ControlKind::if_then, run_if},
        {ControlKind::label, pass_label},
        {ControlKind::repeat_section, repeat},
        {ControlKind::repeat_block, repeat},
        {ControlKind::choice, choose_branch},
    });
    const Control parsed = parse_control(statement.text, in.rules_->text);
    const auto* row =
        std::find_if(rows.begin(), rows.end(), [&](const ControlRow& r) { return r.kind == parsed.kind; });
    if (row == rows.end()) return false;
    row->run(in, parsed, statement);
    return true;
}

}  // namespace clsurf

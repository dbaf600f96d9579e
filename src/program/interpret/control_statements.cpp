// Control statements: conditions, loops, calls and labels, whatever the dialect writes for them.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// The value of a condition or a loop's count at a byte of the statement.
double Interpreter::value_at(std::string_view text, std::size_t at) const {
    Cursor c{text, at};
    return evaluate(c, variables_, rules_->text);
}

/// The statement of the line that runs, as the index has matched it.
const Control& Interpreter::own_control() {
    const int at = index(place_.file).at_line(place_.line);
    if (at < 0) fail("this control statement is not allowed here");
    return index(place_.file).all()[static_cast<std::size_t>(at)];
}

const Control& Interpreter::partner_of(const Control& control, const char* what) {
    if (control.partner < 0) fail(fmt::format("{} has no matching statement", what));
    return index(place_.file).all()[static_cast<std::size_t>(control.partner)];
}

/// On with the line after another one.
void Interpreter::go_after(LineNumber line) {
    count_jump();
    go_to(place_.file, line + 1);
}

void Interpreter::pass_sub(const Control&, const Statement&) {
    // A label of HEIDENHAIN: what it begins is carried out on the way as well.
    if (!rules_->calls.subs_run_through) go_after(partner_of(own_control(), "sub").line);
}

void Interpreter::return_from_sub(const Control& control, const Statement& statement) {
    if (control.rest < statement.text.size() && rules_->calls.returns_value) {
        Cursor c{statement.text, control.rest};
        if (c.peek() != '\0') {
            variables_.set("_value", read_value(c, variables_, rules_->text));
            variables_.set("_value_returned", 1);
        }
    }
    if (!calls_.frames.empty() || rules_->calls.return_ends_main) leave(false);
}

/// O-words: o<name> call [1] [2].
void Interpreter::call_sub(const Control& control, const Statement& statement) {
    std::vector<double> arguments;
    Cursor c{statement.text, control.rest};
    while (c.peek() == '[') {
        ++c.at;
        arguments.push_back(evaluate(c, variables_, rules_->text));
        if (!c.take(']')) throw ReadError{"'[' is not closed", c.column(), {}};
    }
    std::string label = control.label;
    if (label.starts_with('[') || label.starts_with('#')) {
        Cursor name{label, 0};
        label = fmt::format("{}", std::lround(read_value(name, variables_, rules_->text)));
    }
    call(label, 1, true, arguments);
}

void Interpreter::begin_while(const Control& control, const Statement& statement) {
    const Control& begin = own_control();
    if (begin.kind == ControlKind::do_while) {  // `o1 while` that closes `o1 do`
        if (value_at(statement.text, control.rest) != 0) go_after(partner_of(begin, "while").line);
        return;
    }
    const bool goes_in = control.rest == std::string_view::npos || value_at(statement.text, control.rest) != 0;
    if (!goes_in) go_after(partner_of(begin, "while").line);
}

void Interpreter::end_loop(const Control&, const Statement&) {
    const Control& begin = partner_of(own_control(), "end of a loop");
    count_jump();
    go_to(place_.file, begin.line);
}

/// UNTIL
void Interpreter::end_do(const Control& control, const Statement& statement) {
    const Control& begin = partner_of(own_control(), "until");
    if (value_at(statement.text, control.rest) == 0) go_after(begin.line);
}

void Interpreter::begin_if(const Control& control, const Statement& statement) {
    const Control* branch = &own_control();
    if (value_at(statement.text, control.rest) != 0) return;
    do {
        if (branch->next_branch < 0) fail("if has no endif");
        branch = &index(place_.file).all()[static_cast<std::size_t>(branch->next_branch)];
        if (branch->kind != ControlKind::else_if) break;
        place_.line = branch->line;
        place_.text = program_.files[place_.file].line(place_.line);
    } while (!branch_taken(*branch));
    go_after(branch->line);
}

/// Reached by running on from a branch that was taken: the whole is over.
void Interpreter::pass_else_if(const Control&, const Statement&) { go_after(partner_of(own_control(), "elseif").line); }
void Interpreter::pass_else(const Control&, const Statement&) { go_after(partner_of(own_control(), "else").line); }
void Interpreter::pass(const Control&, const Statement&) {}

void Interpreter::begin_repeat(const Control& control, const Statement& statement) {
    const Control& begin = own_control();
    Cursor c{statement.text, control.rest};
    const double count = read_value(c, variables_, rules_->text);
    if (!(count >= 1)) return go_after(partner_of(begin, "repeat").line);
    calls_.counters[place_.line] = std::floor(count + 1e-6) - 1;
}

void Interpreter::end_repeat(const Control&, const Statement&) {
    const Control& begin = partner_of(own_control(), "endrepeat");
    double& left = calls_.counters[begin.line];
    if (left < 1) return;
    left -= 1;
    go_after(begin.line);
}

/// FOR v = from TO to
void Interpreter::begin_for(const Control& control, const Statement& statement) {
    Cursor c{statement.text, control.rest};
    const std::string name = c.identifier();
    c.at += name.size();
    if (name.empty() || !c.take('=')) throw ReadError{"expected a variable and '=' after FOR", c.column(), {}};
    const double from = evaluate(c, variables_, rules_->text);
    if (!c.take_word("TO")) throw ReadError{"expected TO", c.column(), {}};
    const double to = evaluate(c, variables_, rules_->text);
    double value = from;
    const auto running = calls_.counters.find(place_.line);
    const bool numbered =
        name.size() > 1 && name[0] == 'R' && name.find_first_not_of("0123456789", 1) == std::string::npos;
    const int number = numbered && name.size() < 7 ? 100000 + std::stoi(name.substr(1)) : 0;
    if (running != calls_.counters.end()) value = running->second + 1;
    if (numbered)
        variables_.set(number, value);
    else
        variables_.set(name, value);
    if (value > to) {
        calls_.counters.erase(place_.line);
        go_after(partner_of(own_control(), "for").line);
    } else {
        calls_.counters[place_.line] = value;
    }
}

void Interpreter::end_for(const Control&, const Statement&) {
    count_jump();
    go_to(place_.file, partner_of(own_control(), "endfor").line);
}

void Interpreter::leave_loop(const Control& control, const Statement&) {
    const Control& own = own_control();
    if (own.partner < 0) fail("break or continue outside a loop");
    const Control& begin = partner_of(own, "break or continue");
    const Control& end = partner_of(begin, "loop");
    if (control.kind == ControlKind::break_loop) return go_after(end.line);
    count_jump();
    go_to(place_.file, end.line);
}

void Interpreter::go_to_label(const Control& control, const Statement& statement) {
    if (control.kind == ControlKind::if_go_to && value_at(statement.text, control.rest) == 0) return;
    std::string label = control.label;
    if (label.empty() && rules_->calls.jumps_to_numbers) {
        Cursor c{statement.text, control.target};
        label = fmt::format("{}", std::lround(read_value(c, variables_, rules_->text)));
    }
    jump_to(label, control.direction, control.may_miss);
}

/// The rest of a statement as a block of its own.
void Interpreter::run_rest(std::string_view text, std::size_t at) {
    Cursor c{text, at};
    read_block(c, variables_, rules_->text, state_.least_increment(), block_);
    execute(block_);
}

/// IF […] THEN …
void Interpreter::run_if(const Control& control, const Statement& statement) {
    if (value_at(statement.text, control.rest) != 0) run_rest(statement.text, control.target);
}

/// A program number; what follows in its block still counts. A second one ends the first program, as another program
/// begins there.
void Interpreter::pass_label(const Control& control, const Statement& statement) {
    const bool begins_another = rules_->calls.second_name_ends && program_.motions.size() > 0 && calls_.frames.empty();
    if (begins_another) {
        event("end", "O" + control.label);
        ended_ = true;
        return;
    }
    const std::string& text = statement.text;
    const std::size_t rest = std::min(control.rest, text.size());
    const bool goes_on = rules_->calls.blocks_after_label && text.find_first_not_of(' ', rest) != std::string::npos &&
                         text.find(':') != std::string::npos;
    if (!goes_on) return;
    Statement after_label = statement;
    std::fill(after_label.text.begin(), after_label.text.begin() + static_cast<std::ptrdiff_t>(rest), ' ');
    if (!control_statement(after_label)) run_rest(after_label.text, 0);
}

void Interpreter::repeat(const Control& control, const Statement& statement) { repeat_lines(control, statement.text); }

void Interpreter::choose_branch(const Control& control, const Statement& statement) {
    choose(statement.text, control.rest);
}

struct Interpreter::ControlRow {
    ControlKind kind;
    void (Interpreter::*run)(const Control&, const Statement&);
};

/// True: the statement was one of control.
bool Interpreter::control_statement(const Statement& statement) {
    static constexpr auto rows = std::to_array<ControlRow>({
        {ControlKind::sub, &Interpreter::pass_sub},
        {ControlKind::end_sub, &Interpreter::return_from_sub},
        {ControlKind::call, &Interpreter::call_sub},
        {ControlKind::leave, &Interpreter::return_from_sub},
        {ControlKind::while_begin, &Interpreter::begin_while},
        {ControlKind::while_end, &Interpreter::end_loop},
        {ControlKind::do_begin, &Interpreter::pass},
        {ControlKind::do_while, &Interpreter::end_do},
        {ControlKind::if_begin, &Interpreter::begin_if},
        {ControlKind::else_if, &Interpreter::pass_else_if},
        {ControlKind::else_branch, &Interpreter::pass_else},
        {ControlKind::if_end, &Interpreter::pass},
        {ControlKind::repeat_begin, &Interpreter::begin_repeat},
        {ControlKind::repeat_end, &Interpreter::end_repeat},
        {ControlKind::for_begin, &Interpreter::begin_for},
        {ControlKind::for_end, &Interpreter::end_for},
        {ControlKind::break_loop, &Interpreter::leave_loop},
        {ControlKind::continue_loop, &Interpreter::leave_loop},
        {ControlKind::go_to, &Interpreter::go_to_label},
        {ControlKind::if_go_to, &Interpreter::go_to_label},
        {ControlKind::if_then, &Interpreter::run_if},
        {ControlKind::label, &Interpreter::pass_label},
        {ControlKind::repeat_section, &Interpreter::repeat},
        {ControlKind::repeat_block, &Interpreter::repeat},
        {ControlKind::choice, &Interpreter::choose_branch},
    });
    const Control parsed = parse_control(statement.text, rules_->text);
    const auto* row =
        std::find_if(rows.begin(), rows.end(), [&](const ControlRow& r) { return r.kind == parsed.kind; });
    if (row == rows.end()) return false;
    (this->*row->run)(parsed, statement);
    return true;
}

}  // namespace clsurf

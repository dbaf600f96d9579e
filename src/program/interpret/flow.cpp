// Which line comes next: control statements, calls and returns.

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr std::size_t deepest_call = 64;

}  // namespace

const ControlIndex& Interpreter::index(std::size_t file) {
    if (!indexed_[file]) {
        indexes_[file] = ControlIndex(program_.files[file], rules_->text);
        indexed_[file] = true;
    }
    return indexes_[file];
}

void Interpreter::count_jump() {
    if (++jumps_ > options_.most_jumps) {
        fail(fmt::format("more than {} jumps and calls: a loop without end?", options_.most_jumps));
    }
}

/// The condition of an elseif.
bool Interpreter::branch_taken(const Control& branch) const {
    const Statement statement = clean_line(program_.files[file_].line(branch.line), rules_->text);
    Cursor c{statement.text, branch.rest};
    return evaluate(c, variables_, rules_->text) != 0;
}

bool Interpreter::control(const Statement& statement) {
    const std::string& text = statement.text;
    const Control parsed = parse_control(text, rules_->text);
    if (parsed.kind == ControlKind::none) return false;
    const auto condition = [&](std::size_t at) {
        Cursor c{text, at};
        return evaluate(c, variables_, rules_->text) != 0;
    };
    const auto own = [&]() -> const Control& {
        const int at = index(file_).at_line(line_);
        if (at < 0) fail("this control statement cannot stand here");
        return index(file_).all()[static_cast<std::size_t>(at)];
    };
    const auto partner_of = [&](const Control& c, const char* what) -> const Control& {
        if (c.partner < 0) fail(fmt::format("{} has no other end", what));
        return index(file_).all()[static_cast<std::size_t>(c.partner)];
    };
    const auto after = [&](LineNumber line) {
        count_jump();
        go_to(file_, line + 1);
    };
    switch (parsed.kind) {
        case ControlKind::sub:
            if (rules_->calls.subs_run_through) {
                // A label; what it begins is carried out on the way as well.
                return true;
            }
            after(partner_of(own(), "sub").line);
            return true;
        case ControlKind::end_sub:
        case ControlKind::leave: {
            if (parsed.rest < text.size() && rules_->calls.returns_value) {
                Cursor c{text, parsed.rest};
                if (c.peek() != '\0') {
                    const double value = read_value(c, variables_, rules_->text);
                    variables_.set("_value", value);
                    variables_.set("_value_returned", 1);
                }
            }
            if (frames_.empty() && !rules_->calls.return_ends_main) return true;
            leave(false);
            return true;
        }
        case ControlKind::call: {
            std::vector<double> arguments;
            Cursor c{text, parsed.rest};
            while (c.peek() == '[') {
                ++c.at;
                arguments.push_back(evaluate(c, variables_, rules_->text));
                if (!c.take(']')) throw ReadError{"'[' is not closed", c.column(), {}};
            }
            std::string label = parsed.label;
            if (label.starts_with('[') || label.starts_with('#')) {
                Cursor name{label, 0};
                label = fmt::format("{}", std::lround(read_value(name, variables_, rules_->text)));
            }
            call(label, 1, true, arguments);
            return true;
        }
        case ControlKind::while_begin: {
            const Control& begin = own();
            if (begin.kind == ControlKind::do_while) {  // `o1 while` that closes `o1 do`
                if (condition(parsed.rest)) after(partner_of(begin, "while").line);
                return true;
            }
            const bool goes_in = parsed.rest == std::string_view::npos || condition(parsed.rest);
            if (!goes_in) after(partner_of(begin, "while").line);
            return true;
        }
        case ControlKind::while_end: {
            const Control& begin = partner_of(own(), "end of a loop");
            count_jump();
            go_to(file_, begin.line);
            return true;
        }
        case ControlKind::do_begin: return true;
        case ControlKind::do_while: {  // UNTIL
            const Control& begin = partner_of(own(), "until");
            if (!condition(parsed.rest)) after(begin.line);
            return true;
        }
        case ControlKind::if_begin:
        case ControlKind::else_if: {
            const Control* branch = &own();
            // Reached by running on from a branch that was taken: the whole is over.
            if (parsed.kind == ControlKind::else_if) {
                after(partner_of(*branch, "elseif").line);
                return true;
            }
            if (condition(parsed.rest)) return true;
            do {
                if (branch->next_branch < 0) fail("if has no endif");
                branch = &index(file_).all()[static_cast<std::size_t>(branch->next_branch)];
                if (branch->kind != ControlKind::else_if) break;
                line_ = branch->line;
                current_ = program_.files[file_].line(line_);
            } while (!branch_taken(*branch));
            after(branch->line);
            return true;
        }
        case ControlKind::else_branch: after(partner_of(own(), "else").line); return true;
        case ControlKind::if_end: return true;
        case ControlKind::repeat_begin: {
            const Control& begin = own();
            Cursor c{text, parsed.rest};
            const double count = read_value(c, variables_, rules_->text);
            if (!(count >= 1)) {
                after(partner_of(begin, "repeat").line);
                return true;
            }
            counters_[line_] = std::floor(count + 1e-6) - 1;
            return true;
        }
        case ControlKind::repeat_section:
        case ControlKind::repeat_block: repeat_lines(parsed, text); return true;
        case ControlKind::choice: choose(text, parsed.rest); return true;
        case ControlKind::repeat_end: {
            const Control& begin = partner_of(own(), "endrepeat");
            double& left = counters_[begin.line];
            if (left >= 1) {
                left -= 1;
                after(begin.line);
            }
            return true;
        }
        case ControlKind::for_begin: {
            // FOR v = from TO to
            Cursor c{text, parsed.rest};
            const std::string name = c.identifier();
            c.at += name.size();
            if (name.empty() || !c.take('=')) throw ReadError{"expected a variable and '=' after FOR", c.column(), {}};
            const double from = evaluate(c, variables_, rules_->text);
            if (!c.take_word("TO")) throw ReadError{"expected TO", c.column(), {}};
            const double to = evaluate(c, variables_, rules_->text);
            double value = from;
            const auto running = counters_.find(line_);
            const bool numbered =
                name.size() > 1 && name[0] == 'R' && name.find_first_not_of("0123456789", 1) == std::string::npos;
            const int number = numbered && name.size() < 7 ? 100000 + std::stoi(name.substr(1)) : 0;
            if (running != counters_.end()) value = running->second + 1;
            if (numbered)
                variables_.set(number, value);
            else
                variables_.set(name, value);
            if (value > to) {
                counters_.erase(line_);
                after(partner_of(own(), "for").line);
            } else {
                counters_[line_] = value;
            }
            return true;
        }
        case ControlKind::for_end: {
            count_jump();
            go_to(file_, partner_of(own(), "endfor").line);
            return true;
        }
        case ControlKind::break_loop:
        case ControlKind::continue_loop: {
            const int loop = index(file_).loop_around(line_, parsed.label);
            if (loop < 0) fail("break or continue outside a loop");
            const Control& begin = index(file_).all()[static_cast<std::size_t>(loop)];
            const Control& end = partner_of(begin, "loop");
            if (parsed.kind == ControlKind::break_loop) {
                after(end.line);
            } else {
                count_jump();
                go_to(file_, end.line);
            }
            return true;
        }
        case ControlKind::if_go_to:
        case ControlKind::go_to: {
            if (parsed.kind == ControlKind::if_go_to && !condition(parsed.rest)) return true;
            std::string label = parsed.label;
            if (label.empty() && rules_->calls.jumps_to_numbers) {
                Cursor c{text, parsed.target};
                label = fmt::format("{}", std::lround(read_value(c, variables_, rules_->text)));
            }
            jump_to(label, parsed.direction, parsed.may_miss);
            return true;
        }
        case ControlKind::if_then: {
            if (!condition(parsed.rest)) return true;
            Cursor c{text, static_cast<std::size_t>(std::stoul(parsed.label))};
            read_block(c, variables_, rules_->text, state_.least_increment(), block_);
            execute(block_);
            return true;
        }
        case ControlKind::label: {
            // A program number; what follows in its block still counts. A second one ends the first
            // program, as another program begins there.
            const bool begins_another =
                rules_->calls.second_name_ends && program_.motions.size() > 0 && frames_.empty();
            if (begins_another) {
                event("end", "O" + parsed.label);
                ended_ = true;
                return true;
            }
            const std::string word = text.substr(std::min(parsed.rest, text.size()));
            if (rules_->calls.blocks_after_label && word.find_first_not_of(' ') != std::string::npos &&
                text.find(':') != std::string::npos) {
                Statement after_label = statement;
                std::fill(after_label.text.begin(), after_label.text.begin() + static_cast<std::ptrdiff_t>(parsed.rest),
                          ' ');
                if (control(after_label)) return true;
                Cursor c{after_label.text, 0};
                read_block(c, variables_, rules_->text, state_.least_increment(), block_);
                execute(block_);
            }
            return true;
        }
        case ControlKind::end_loop:
        case ControlKind::none: return false;
    }
    return false;
}

/// To a label or a block number. `may_miss`: without it the program goes on.
void Interpreter::jump_to(const std::string& label, int direction, bool may_miss) {
    count_jump();
    const bool numbers = rules_->calls.jumps_to_numbers;
    const bool number = numbers || (label.size() > 1 && label[0] == 'N' && is_digit(label[1]));
    LineNumber line = 0;
    if (number) {
        const std::string digits = numbers ? label : label.substr(1);
        double value = 0;
        if (read_decimal(digits, 0, value) > 0) line = find_block(value, line_, direction);
    } else {
        // Backwards from the end of this line: its own label counts.
        const int at = index(file_).find(ControlKind::label, label, line_ + (direction < 0 ? 1 : 0), direction);
        if (at >= 0) line = index(file_).all()[static_cast<std::size_t>(at)].line;
    }
    if (line == 0 && may_miss) return;
    if (line == 0) fail(fmt::format("there is no block to go to: '{}'", label));
    const bool leaves = !sections_.empty() && sections_.back().level == frames_.size() &&
                        (line < sections_.back().begin || line > sections_.back().end);
    if (leaves) {
        sections_.pop_back();
        watch_section();
    }
    go_to(file_, line);
}

/// CASE v OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C
void Interpreter::choose(const std::string& text, std::size_t begin) {
    Cursor c{text, begin};
    const double wanted = evaluate(c, variables_, rules_->text);
    if (!c.take_word("OF")) throw ReadError{"expected OF after the value of CASE", c.column(), {}};
    while (c.peek() != '\0') {
        const bool chosen = c.take_word("DEFAULT") || std::abs(read_value(c, variables_, rules_->text) - wanted) < 1e-9;
        const std::string jump = c.identifier();
        const bool known = jump == "GOTO" || jump == "GOTOF" || jump == "GOTOB" || jump == "GOTOC";
        if (!known) throw ReadError{"expected GOTOF or GOTOB and a label in CASE", c.column(), {}};
        (void)c.take_word(jump);
        const std::string label = c.identifier();
        if (chosen) {
            jump_to(label, jump == "GOTOF" ? 1 : jump == "GOTOB" ? -1 : 0, jump == "GOTOC");
            return;
        }
        (void)c.take_word(label);
    }
}

/// REPEAT and REPEATB: lines between labels once more, P times. From one label on, as far as ENDLABEL
/// or this line.
void Interpreter::repeat_lines(const Control& repeat, const std::string& text) {
    Cursor c{text, repeat.rest};
    const auto line_of = [&](const std::string& label) {
        int at = index(file_).find(ControlKind::label, label, line_, -1);
        if (at < 0) at = index(file_).find(ControlKind::label, label, line_, 1);
        if (at < 0) fail(fmt::format("REPEAT: there is no label '{}'", label));
        return index(file_).all()[static_cast<std::size_t>(at)].line;
    };
    Section section{.begin = line_of(repeat.label), .level = frames_.size(), .back = line_};
    section.end = section.begin;
    if (repeat.kind == ControlKind::repeat_section) {
        const std::string until = c.identifier();
        Cursor after = c;
        const bool named = !until.empty() && after.take_word(until) && after.peek() != '=';
        if (named) {
            c = after;
            section.end = line_of(until);
        } else {
            const int end = index(file_).find(ControlKind::label, "ENDLABEL", section.begin, 1);
            const LineNumber line = end < 0 ? 0 : index(file_).all()[static_cast<std::size_t>(end)].line;
            section.end = line != 0 && (line < line_ || section.begin > line_) ? line : line_ - 1;
        }
    }
    double times = 1;
    if (c.take_word("P")) {
        if (!c.take('=')) throw ReadError{"expected '=' after P", c.column(), {}};
        times = evaluate(c, variables_, rules_->text);
    }
    if (c.peek() != '\0') throw ReadError{"expected P= after the labels of REPEAT", c.column(), {}};
    if (section.end < section.begin || (section.begin <= line_ && line_ <= section.end))
        fail(fmt::format("REPEAT: no lines to repeat from '{}' on", repeat.label));
    if (sections_.size() >= deepest_call) fail(fmt::format("repeats are nested more than {} deep", deepest_call));
    section.left = std::floor(times);
    if (!(section.left >= 1)) return;
    sections_.push_back(section);
    next_of_section();
}

/// Once more from its beginning, or back behind its REPEAT.
void Interpreter::next_of_section() {
    Section& section = sections_.back();
    count_jump();
    if (section.left >= 1) {
        section.left -= 1;
        go_to(file_, section.begin);
    } else {
        go_to(file_, section.back + 1);
        sections_.pop_back();
    }
    watch_section();
}

/// Which line to stop before: that behind the section that is repeated at this level of calls.
void Interpreter::watch_section() {
    while (!sections_.empty() && sections_.back().level > frames_.size()) sections_.pop_back();
    const bool here = !sections_.empty() && sections_.back().level == frames_.size();
    behind_section_ = here ? sections_.back().end + 1 : 0;
}

/// Back to a line, `times` times; then on.
void Interpreter::repeat_from(LineNumber begin, double times) {
    const auto found = counters_.try_emplace(line_, std::floor(times)).first;
    if (!(found->second >= 1)) {
        counters_.erase(found);
        return;
    }
    found->second -= 1;
    count_jump();
    go_to(file_, begin);
}

LineNumber Interpreter::find_block(double number, LineNumber line, int direction) {
    auto found = numbers_.find(file_);
    if (found == numbers_.end()) found = numbers_.emplace(file_, BlockNumbers(program_.files[file_])).first;
    return found->second.find(number, line, direction);
}

/// Reads a subprogram's file once, whatever how often it is called.
bool Interpreter::load(const std::string& name) {
    if (loaded_.contains(name)) return true;
    std::optional<SourceText> text = options_.load ? options_.load(name) : std::nullopt;
    if (!text) return false;
    if (program_.files.size() >= 65535) fail("too many subprogram files");
    loaded_.emplace(name, program_.files.size());
    program_.files.push_back(std::move(*text));
    indexes_.emplace_back();
    indexed_.push_back(false);
    return true;
}

void Interpreter::call(const std::string& name, int repeats, bool locals, const std::vector<double>& arguments) {
    count_jump();
    if (frames_.size() >= deepest_call) {
        fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    const CallRules& calls = rules_->calls;
    const ControlKind kind = calls.by_sub ? ControlKind::sub : ControlKind::label;
    const auto begin_in = [&](std::size_t file) {
        const int begin = index(file).find(kind, name);
        // M98 of LinuxCNC calls `O1 … M99`, as Fanuc writes it.
        return begin < 0 && calls.label_if_no_sub ? index(file).find(ControlKind::label, name) : begin;
    };
    std::size_t file = file_;
    int at = begin_in(file);
    for (std::size_t other = 0; at < 0 && other < program_.files.size(); ++other) {
        file = other;
        at = begin_in(other);
    }
    LineNumber line = 1;
    if (at >= 0) {
        line = indexes_[file].all()[static_cast<std::size_t>(at)].line;
    } else {
        if (!load(name)) fail(fmt::format("subprogram '{}' is neither in the program nor beside it", name));
        file = loaded_.at(name);
        const int begin = begin_in(file);
        if (begin >= 0) line = indexes_[file].all()[static_cast<std::size_t>(begin)].line;
    }
    LineNumber first = line + (at >= 0 || !calls.begins_at_label ? 1 : 0);
    if (at < 0 && calls.file_from_top) first = 1;
    enter(file, first, repeats, locals);
    for (std::size_t k = 0; k < arguments.size() && k < 33; ++k) {
        if (!std::isnan(arguments[k])) variables_.set(static_cast<int>(k) + 1, arguments[k]);
    }
}

void Interpreter::call_file(const std::string& name) {
    count_jump();
    if (frames_.size() >= deepest_call) {
        fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    if (!load(name)) fail(fmt::format("subprogram '{}' is neither in the program nor beside it", name));
    enter(loaded_.at(name), 1, 1, false);
}

/// Goes on at a line of a subprogram, and comes back behind the line that runs.
void Interpreter::enter(std::size_t file, LineNumber line, int repeats, bool locals) {
    Frame frame;
    frame.file = file_;
    frame.line = line_;
    frame.start_file = file;
    frame.start_line = line;
    frame.call = call_;
    call_ = call_from_here();
    frame.repeats = repeats - 1;
    frame.locals = locals;
    frame.counters = std::move(counters_);
    counters_.clear();
    if (locals) variables_.push_locals();
    frames_.push_back(std::move(frame));
    kept_modes_.emplace_back();
    restores_modes_.push_back(false);
    watch_section();
    go_to(file, line);
}

/// The call that the line makes which runs; a loop that calls again and again makes one.
std::uint32_t Interpreter::call_from_here() {
    std::vector<Call>& calls = program_.motions.calls;
    constexpr std::size_t most_calls = 1'000'000;  // of lines and ways to them; what more there is counts as its caller
    if (calls.size() >= most_calls) return call_;
    const auto [found, is_new] = known_calls_.try_emplace({call_, static_cast<std::uint32_t>(file_), line_},
                                                          static_cast<std::uint32_t>(calls.size() + 1));
    if (is_new) calls.push_back({call_, static_cast<std::uint16_t>(file_), line_});
    return found->second;
}

void Interpreter::leave(bool from_end_of_text) {
    if (frames_.empty()) {
        ended_ = true;
        if (from_end_of_text)
            note(Severity::note, "program.no-end", "the program ends without M2 or M30");
        else
            event("end", "return from the main program");
        return;
    }
    Frame& frame = frames_.back();
    if (frame.repeats > 0) {
        count_jump();
        --frame.repeats;
        go_to(frame.start_file, frame.start_line);
        return;
    }
    if (restores_modes_.back() && kept_modes_.back()) restore_modes(*kept_modes_.back());
    kept_modes_.pop_back();
    restores_modes_.pop_back();
    if (frame.locals) variables_.pop_locals();
    counters_ = std::move(frame.counters);
    const std::size_t file = frame.file;
    const LineNumber line = frame.line;
    call_ = frame.call;
    frames_.pop_back();
    watch_section();
    go_to(file, line + 1);
}

/// M98 P L: P0031234 calls program 1234 three times where no L says how often and `counted`.
void Interpreter::call_by_number(const Block& block, int least_repeats, bool counted) {
    const Words& w = block.words;
    if (!w.given('P')) fail("M98 needs the program's number (P)");
    int number = static_cast<int>(std::clamp(w.of('P'), 0.0, 99999999.0));
    int repeats = w.given('L') ? static_cast<int>(std::clamp(w.of('L'), double(least_repeats), 99999.0)) : 1;
    if (counted && !w.given('L') && number > 9999) {
        repeats = number / 10000;
        number %= 10000;
    }
    if (repeats > 0) call(fmt::format("{}", number), repeats, false, {});
}

/// M99 P: back to that block of the caller; M99: behind the call.
void Interpreter::return_to_block(const Block& block) {
    if (!block.words.given('P')) return leave(false);
    const double number = block.words.of('P');
    leave(false);
    const LineNumber line = find_block(number, 0, 0);
    if (line == 0) fail(fmt::format("M99 P{:g}: there is no block N{:g}", number, number));
    go_to(file_, line);
}

}  // namespace clsurf

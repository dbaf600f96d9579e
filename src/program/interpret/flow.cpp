// The order of lines: control statements, calls and returns.

#include "program/interpret/flow.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"
#include "program/interpret/kept_modes.h"

namespace clsurf {
namespace {

constexpr std::size_t deepest_call = 64;

/// Sets the line before which to stop: the one after the section that is repeated at this level of calls.
void watch_section(CallStack& calls) {
    while (!calls.sections.empty() && calls.sections.back().level > calls.frames.size()) calls.sections.pop_back();
    const bool here = !calls.sections.empty() && calls.sections.back().level == calls.frames.size();
    calls.behind_section = here ? calls.sections.back().end + 1 : 0;
}

LineNumber find_block(Interpreter& in, double number, LineNumber line, int direction) {
    auto found = in.texts_.numbers.find(in.place_.file);
    if (found == in.texts_.numbers.end())
        found = in.texts_.numbers.emplace(in.place_.file, BlockNumbers(in.program_.files[in.place_.file])).first;
    return found->second.find(number, line, direction);
}

/// The call from the current line; repeated calls in a loop count as one.
std::uint32_t call_from_here(CallStack& stack, const ReadingPlace& place, Motions& motions) {
    std::vector<Call>& calls = motions.calls;
    constexpr std::size_t most_calls = 1'000'000;  // by line and caller; further calls count as their caller
    if (calls.size() >= most_calls) return stack.running;
    const auto [found, is_new] =
        stack.known.try_emplace({stack.running, static_cast<std::uint32_t>(place.file), place.line},
                                static_cast<std::uint32_t>(calls.size() + 1));
    if (is_new) calls.push_back({stack.running, static_cast<std::uint16_t>(place.file), place.line});
    return found->second;
}

/// Continues at a line of a subprogram, and returns to after the current line.
void enter(Interpreter& in, std::size_t file, LineNumber line, int repeats, bool locals) {
    CallFrame frame;
    frame.file = in.place_.file;
    frame.line = in.place_.line;
    frame.start_file = file;
    frame.start_line = line;
    frame.call = in.calls_.running;
    in.calls_.running = call_from_here(in.calls_, in.place_, in.program_.motions);
    frame.repeats = repeats - 1;
    frame.locals = locals;
    frame.counters = std::move(in.calls_.counters);
    in.calls_.counters.clear();
    if (locals) in.variables_.push_locals();
    in.calls_.frames.push_back(std::move(frame));
    in.calls_.kept_modes.emplace_back();
    in.calls_.restores_modes.push_back(false);
    watch_section(in.calls_);
    in.go_to(file, line);
}

}  // namespace

const ControlIndex& control_index(Interpreter& in, std::size_t file) {
    if (!in.texts_.indexed[file]) {
        in.texts_.indexes[file] = ControlIndex(in.program_.files[file], in.rules_->text);
        in.texts_.indexed[file] = true;
    }
    return in.texts_.indexes[file];
}

void count_jump(Interpreter& in) {
    if (++in.calls_.jumps > in.options_.most_jumps) {
        in.fail(fmt::format("more than {} jumps and calls: an endless loop?", in.options_.most_jumps));
    }
}

bool branch_taken(const Interpreter& in, const Control& branch) {
    const Statement statement = clean_line(in.program_.files[in.place_.file].line(branch.line), in.rules_->text);
    Cursor c{statement.text, branch.rest};
    return evaluate(c, in.variables_, in.rules_->text) != 0;
}

void jump_to(Interpreter& in, const std::string& label, int direction, bool may_miss) {
    count_jump(in);
    const bool numbers = in.rules_->calls.jumps_to_numbers;
    const bool number = numbers || (label.size() > 1 && label[0] == 'N' && is_digit(label[1]));
    LineNumber line = 0;
    if (number) {
        const std::string digits = numbers ? label : label.substr(1);
        double value = 0;
        if (read_decimal(digits, 0, value) > 0) line = find_block(in, value, in.place_.line, direction);
    } else {
        // Backwards from the end of this line: its own label counts.
        const int at = control_index(in, in.place_.file)
                           .find(ControlKind::label, label, in.place_.line + (direction < 0 ? 1 : 0), direction);
        if (at >= 0) line = control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line;
    }
    if (line == 0 && may_miss) return;
    if (line == 0) in.fail(fmt::format("there is no block to go to: '{}'", label));
    const bool leaves = !in.calls_.sections.empty() && in.calls_.sections.back().level == in.calls_.frames.size() &&
                        (line < in.calls_.sections.back().begin || line > in.calls_.sections.back().end);
    if (leaves) {
        in.calls_.sections.pop_back();
        watch_section(in.calls_);
    }
    in.go_to(in.place_.file, line);
}

void choose_label(Interpreter& in, const std::string& text, std::size_t begin) {
    Cursor c{text, begin};
    const double wanted = evaluate(c, in.variables_, in.rules_->text);
    if (!c.take_word("OF")) throw ReadError{"expected OF after the value of CASE", c.column(), {}};
    while (c.peek() != '\0') {
        const bool chosen =
            c.take_word("DEFAULT") || std::abs(read_value(c, in.variables_, in.rules_->text) - wanted) < 1e-9;
        const std::string jump = c.identifier();
        const bool known = jump == "GOTO" || jump == "GOTOF" || jump == "GOTOB" || jump == "GOTOC";
        if (!known) throw ReadError{"expected GOTOF or GOTOB and a label in CASE", c.column(), {}};
        (void)c.take_word(jump);
        const std::string label = c.identifier();
        if (chosen) {
            jump_to(in, label, jump == "GOTOF" ? 1 : jump == "GOTOB" ? -1 : 0, jump == "GOTOC");
            return;
        }
        (void)c.take_word(label);
    }
}

void repeat_lines(Interpreter& in, const Control& repeat, const std::string& text) {
    Cursor c{text, repeat.rest};
    const auto line_of = [&](const std::string& label) {
        int at = control_index(in, in.place_.file).find(ControlKind::label, label, in.place_.line, -1);
        if (at < 0) at = control_index(in, in.place_.file).find(ControlKind::label, label, in.place_.line, 1);
        if (at < 0) in.fail(fmt::format("REPEAT: there is no label '{}'", label));
        return control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line;
    };
    Section section{.begin = line_of(repeat.label), .level = in.calls_.frames.size(), .back = in.place_.line};
    section.end = section.begin;
    if (repeat.kind == ControlKind::repeat_section) {
        const std::string until = c.identifier();
        Cursor after = c;
        const bool named = !until.empty() && after.take_word(until) && after.peek() != '=';
        if (named) {
            c = after;
            section.end = line_of(until);
        } else {
            const int end = control_index(in, in.place_.file).find(ControlKind::label, "ENDLABEL", section.begin, 1);
            const LineNumber line =
                end < 0 ? 0 : control_index(in, in.place_.file).all()[static_cast<std::size_t>(end)].line;
            section.end =
                line != 0 && (line < in.place_.line || section.begin > in.place_.line) ? line : in.place_.line - 1;
        }
    }
    double times = 1;
    if (c.take_word("P")) {
        if (!c.take('=')) throw ReadError{"expected '=' after P", c.column(), {}};
        times = evaluate(c, in.variables_, in.rules_->text);
    }
    if (c.peek() != '\0') throw ReadError{"expected P= after the labels of REPEAT", c.column(), {}};
    if (section.end < section.begin || (section.begin <= in.place_.line && in.place_.line <= section.end))
        in.fail(fmt::format("REPEAT: no lines to repeat from '{}' on", repeat.label));
    if (in.calls_.sections.size() >= deepest_call)
        in.fail(fmt::format("repeats are nested more than {} deep", deepest_call));
    section.left = std::floor(times);
    if (!(section.left >= 1)) return;
    in.calls_.sections.push_back(section);
    next_of_section(in);
}

void next_of_section(Interpreter& in) {
    Section& section = in.calls_.sections.back();
    count_jump(in);
    if (section.left >= 1) {
        section.left -= 1;
        in.go_to(in.place_.file, section.begin);
    } else {
        in.go_to(in.place_.file, section.back + 1);
        in.calls_.sections.pop_back();
    }
    watch_section(in.calls_);
}

void repeat_from(Interpreter& in, LineNumber begin, double times) {
    const auto found = in.calls_.counters.try_emplace(in.place_.line, std::floor(times)).first;
    if (!(found->second >= 1)) {
        in.calls_.counters.erase(found);
        return;
    }
    found->second -= 1;
    count_jump(in);
    in.go_to(in.place_.file, begin);
}

bool load_text(Interpreter& in, const std::string& name) {
    if (in.texts_.loaded.contains(name)) return true;
    std::optional<SourceText> text = in.options_.load ? in.options_.load(name) : std::nullopt;
    if (!text) return false;
    if (in.program_.files.size() >= 65535) in.fail("too many subprogram files");
    in.texts_.loaded.emplace(name, in.program_.files.size());
    in.program_.files.push_back(std::move(*text));
    in.texts_.indexes.emplace_back();
    in.texts_.indexed.push_back(false);
    return true;
}

void call_subprogram(Interpreter& in, const std::string& name, int repeats, bool locals,
                     const std::vector<double>& arguments) {
    count_jump(in);
    if (in.calls_.frames.size() >= deepest_call) {
        in.fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    const CallRules& calls = in.rules_->calls;
    const ControlKind kind = calls.by_sub ? ControlKind::sub : ControlKind::label;
    const auto begin_in = [&](std::size_t file) {
        const int begin = control_index(in, file).find(kind, name);
        // M98 of LinuxCNC calls `O1 … M99`, as Fanuc writes it.
        return begin < 0 && calls.label_if_no_sub ? control_index(in, file).find(ControlKind::label, name) : begin;
    };
    std::size_t file = in.place_.file;
    int at = begin_in(file);
    for (std::size_t other = 0; at < 0 && other < in.program_.files.size(); ++other) {
        file = other;
        at = begin_in(other);
    }
    LineNumber line = 1;
    if (at >= 0) {
        line = in.texts_.indexes[file].all()[static_cast<std::size_t>(at)].line;
    } else {
        if (!load_text(in, name))
            in.fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", name));
        file = in.texts_.loaded.at(name);
        const int begin = begin_in(file);
        if (begin >= 0) line = in.texts_.indexes[file].all()[static_cast<std::size_t>(begin)].line;
    }
    LineNumber first = line + (at >= 0 || !calls.begins_at_label ? 1 : 0);
    if (at < 0 && calls.file_from_top) first = 1;
    enter(in, file, first, repeats, locals);
    for (std::size_t k = 0; k < arguments.size() && k < 33; ++k) {
        if (!std::isnan(arguments[k])) in.variables_.set(static_cast<int>(k) + 1, arguments[k]);
    }
}

void call_file(Interpreter& in, const std::string& name) {
    count_jump(in);
    if (in.calls_.frames.size() >= deepest_call) {
        in.fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    if (!load_text(in, name)) in.fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", name));
    enter(in, in.texts_.loaded.at(name), 1, 1, false);
}

void leave(Interpreter& in, bool from_end_of_text) {
    if (in.calls_.frames.empty()) {
        in.ended_ = true;
        if (from_end_of_text)
            in.note(Severity::note, "program.no-end", "the program ends without M2 or M30");
        else
            in.event("end", "return from the main program");
        return;
    }
    CallFrame& frame = in.calls_.frames.back();
    if (frame.repeats > 0) {
        count_jump(in);
        --frame.repeats;
        in.go_to(frame.start_file, frame.start_line);
        return;
    }
    if (in.calls_.restores_modes.back() && in.calls_.kept_modes.back()) restore_modes(in, *in.calls_.kept_modes.back());
    in.calls_.kept_modes.pop_back();
    in.calls_.restores_modes.pop_back();
    if (frame.locals) in.variables_.pop_locals();
    in.calls_.counters = std::move(frame.counters);
    const std::size_t file = frame.file;
    const LineNumber line = frame.line;
    in.calls_.running = frame.call;
    in.calls_.frames.pop_back();
    watch_section(in.calls_);
    in.go_to(file, line + 1);
}

void call_by_number(Interpreter& in, const Block& block, int least_repeats, bool counted) {
    const Words& w = block.words;
    if (!w.given('P')) in.fail("M98 needs the program's number (P)");
    int number = static_cast<int>(std::clamp(w.of('P'), 0.0, 99999999.0));
    int repeats = w.given('L') ? static_cast<int>(std::clamp(w.of('L'), double(least_repeats), 99999.0)) : 1;
    if (counted && !w.given('L') && number > 9999) {
        repeats = number / 10000;
        number %= 10000;
    }
    if (repeats > 0) call_subprogram(in, fmt::format("{}", number), repeats, false, {});
}

void return_to_block(Interpreter& in, const Block& block) {
    if (!block.words.given('P')) return leave(in, false);
    const double number = block.words.of('P');
    if (in.calls_.frames.empty())
        count_jump(in);
    else
        leave(in, false);
    const LineNumber line = find_block(in, number, 0, 0);
    if (line == 0) in.fail(fmt::format("M99 P{:g}: there is no block N{:g}", number, number));
    in.go_to(in.place_.file, line);
}

}  // namespace clsurf

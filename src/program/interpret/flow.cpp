// Which line comes next: control statements, calls and returns.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr std::size_t deepest_call = 64;

}  // namespace

const ControlIndex& Interpreter::index(std::size_t file) {
    if (!texts_.indexed[file]) {
        texts_.indexes[file] = ControlIndex(program_.files[file], rules_->text);
        texts_.indexed[file] = true;
    }
    return texts_.indexes[file];
}

void Interpreter::count_jump() {
    if (++calls_.jumps > options_.most_jumps) {
        fail(fmt::format("more than {} jumps and calls: an endless loop?", options_.most_jumps));
    }
}

/// The condition of an elseif.
bool Interpreter::branch_taken(const Control& branch) const {
    const Statement statement = clean_line(program_.files[place_.file].line(branch.line), rules_->text);
    Cursor c{statement.text, branch.rest};
    return evaluate(c, variables_, rules_->text) != 0;
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
        if (read_decimal(digits, 0, value) > 0) line = find_block(value, place_.line, direction);
    } else {
        // Backwards from the end of this line: its own label counts.
        const int at =
            index(place_.file).find(ControlKind::label, label, place_.line + (direction < 0 ? 1 : 0), direction);
        if (at >= 0) line = index(place_.file).all()[static_cast<std::size_t>(at)].line;
    }
    if (line == 0 && may_miss) return;
    if (line == 0) fail(fmt::format("there is no block to go to: '{}'", label));
    const bool leaves = !calls_.sections.empty() && calls_.sections.back().level == calls_.frames.size() &&
                        (line < calls_.sections.back().begin || line > calls_.sections.back().end);
    if (leaves) {
        calls_.sections.pop_back();
        watch_section();
    }
    go_to(place_.file, line);
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
        int at = index(place_.file).find(ControlKind::label, label, place_.line, -1);
        if (at < 0) at = index(place_.file).find(ControlKind::label, label, place_.line, 1);
        if (at < 0) fail(fmt::format("REPEAT: there is no label '{}'", label));
        return index(place_.file).all()[static_cast<std::size_t>(at)].line;
    };
    Section section{.begin = line_of(repeat.label), .level = calls_.frames.size(), .back = place_.line};
    section.end = section.begin;
    if (repeat.kind == ControlKind::repeat_section) {
        const std::string until = c.identifier();
        Cursor after = c;
        const bool named = !until.empty() && after.take_word(until) && after.peek() != '=';
        if (named) {
            c = after;
            section.end = line_of(until);
        } else {
            const int end = index(place_.file).find(ControlKind::label, "ENDLABEL", section.begin, 1);
            const LineNumber line = end < 0 ? 0 : index(place_.file).all()[static_cast<std::size_t>(end)].line;
            section.end = line != 0 && (line < place_.line || section.begin > place_.line) ? line : place_.line - 1;
        }
    }
    double times = 1;
    if (c.take_word("P")) {
        if (!c.take('=')) throw ReadError{"expected '=' after P", c.column(), {}};
        times = evaluate(c, variables_, rules_->text);
    }
    if (c.peek() != '\0') throw ReadError{"expected P= after the labels of REPEAT", c.column(), {}};
    if (section.end < section.begin || (section.begin <= place_.line && place_.line <= section.end))
        fail(fmt::format("REPEAT: no lines to repeat from '{}' on", repeat.label));
    if (calls_.sections.size() >= deepest_call) fail(fmt::format("repeats are nested more than {} deep", deepest_call));
    section.left = std::floor(times);
    if (!(section.left >= 1)) return;
    calls_.sections.push_back(section);
    next_of_section();
}

/// Once more from its beginning, or back behind its REPEAT.
void Interpreter::next_of_section() {
    Section& section = calls_.sections.back();
    count_jump();
    if (section.left >= 1) {
        section.left -= 1;
        go_to(place_.file, section.begin);
    } else {
        go_to(place_.file, section.back + 1);
        calls_.sections.pop_back();
    }
    watch_section();
}

/// Which line to stop before: that behind the section that is repeated at this level of calls.
void Interpreter::watch_section() {
    while (!calls_.sections.empty() && calls_.sections.back().level > calls_.frames.size()) calls_.sections.pop_back();
    const bool here = !calls_.sections.empty() && calls_.sections.back().level == calls_.frames.size();
    calls_.behind_section = here ? calls_.sections.back().end + 1 : 0;
}

/// Back to a line, `times` times; then on.
void Interpreter::repeat_from(LineNumber begin, double times) {
    const auto found = calls_.counters.try_emplace(place_.line, std::floor(times)).first;
    if (!(found->second >= 1)) {
        calls_.counters.erase(found);
        return;
    }
    found->second -= 1;
    count_jump();
    go_to(place_.file, begin);
}

LineNumber Interpreter::find_block(double number, LineNumber line, int direction) {
    auto found = texts_.numbers.find(place_.file);
    if (found == texts_.numbers.end())
        found = texts_.numbers.emplace(place_.file, BlockNumbers(program_.files[place_.file])).first;
    return found->second.find(number, line, direction);
}

/// Reads a subprogram's file once, however often it is called.
bool Interpreter::load(const std::string& name) {
    if (texts_.loaded.contains(name)) return true;
    std::optional<SourceText> text = options_.load ? options_.load(name) : std::nullopt;
    if (!text) return false;
    if (program_.files.size() >= 65535) fail("too many subprogram files");
    texts_.loaded.emplace(name, program_.files.size());
    program_.files.push_back(std::move(*text));
    texts_.indexes.emplace_back();
    texts_.indexed.push_back(false);
    return true;
}

void Interpreter::call(const std::string& name, int repeats, bool locals, const std::vector<double>& arguments) {
    count_jump();
    if (calls_.frames.size() >= deepest_call) {
        fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    const CallRules& calls = rules_->calls;
    const ControlKind kind = calls.by_sub ? ControlKind::sub : ControlKind::label;
    const auto begin_in = [&](std::size_t file) {
        const int begin = index(file).find(kind, name);
        // M98 of LinuxCNC calls `O1 … M99`, as Fanuc writes it.
        return begin < 0 && calls.label_if_no_sub ? index(file).find(ControlKind::label, name) : begin;
    };
    std::size_t file = place_.file;
    int at = begin_in(file);
    for (std::size_t other = 0; at < 0 && other < program_.files.size(); ++other) {
        file = other;
        at = begin_in(other);
    }
    LineNumber line = 1;
    if (at >= 0) {
        line = texts_.indexes[file].all()[static_cast<std::size_t>(at)].line;
    } else {
        if (!load(name)) fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", name));
        file = texts_.loaded.at(name);
        const int begin = begin_in(file);
        if (begin >= 0) line = texts_.indexes[file].all()[static_cast<std::size_t>(begin)].line;
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
    if (calls_.frames.size() >= deepest_call) {
        fail(fmt::format("calls are nested more than {} deep: a subprogram that calls itself?", deepest_call));
    }
    if (!load(name)) fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", name));
    enter(texts_.loaded.at(name), 1, 1, false);
}

/// Goes on at a line of a subprogram, and comes back behind the line that runs.
void Interpreter::enter(std::size_t file, LineNumber line, int repeats, bool locals) {
    CallFrame frame;
    frame.file = place_.file;
    frame.line = place_.line;
    frame.start_file = file;
    frame.start_line = line;
    frame.call = calls_.running;
    calls_.running = call_from_here();
    frame.repeats = repeats - 1;
    frame.locals = locals;
    frame.counters = std::move(calls_.counters);
    calls_.counters.clear();
    if (locals) variables_.push_locals();
    calls_.frames.push_back(std::move(frame));
    calls_.kept_modes.emplace_back();
    calls_.restores_modes.push_back(false);
    watch_section();
    go_to(file, line);
}

/// The call that the line makes which runs; a loop that calls again and again makes one.
std::uint32_t Interpreter::call_from_here() {
    std::vector<Call>& calls = program_.motions.calls;
    constexpr std::size_t most_calls = 1'000'000;  // by line and caller; further calls count as their caller
    if (calls.size() >= most_calls) return calls_.running;
    const auto [found, is_new] =
        calls_.known.try_emplace({calls_.running, static_cast<std::uint32_t>(place_.file), place_.line},
                                 static_cast<std::uint32_t>(calls.size() + 1));
    if (is_new) calls.push_back({calls_.running, static_cast<std::uint16_t>(place_.file), place_.line});
    return found->second;
}

void Interpreter::leave(bool from_end_of_text) {
    if (calls_.frames.empty()) {
        ended_ = true;
        if (from_end_of_text)
            note(Severity::note, "program.no-end", "the program ends without M2 or M30");
        else
            event("end", "return from the main program");
        return;
    }
    CallFrame& frame = calls_.frames.back();
    if (frame.repeats > 0) {
        count_jump();
        --frame.repeats;
        go_to(frame.start_file, frame.start_line);
        return;
    }
    if (calls_.restores_modes.back() && calls_.kept_modes.back()) restore_modes(*calls_.kept_modes.back());
    calls_.kept_modes.pop_back();
    calls_.restores_modes.pop_back();
    if (frame.locals) variables_.pop_locals();
    calls_.counters = std::move(frame.counters);
    const std::size_t file = frame.file;
    const LineNumber line = frame.line;
    calls_.running = frame.call;
    calls_.frames.pop_back();
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

/// M99 P: back to that block of the caller, in the main program a jump to it; M99: behind the call.
void Interpreter::return_to_block(const Block& block) {
    if (!block.words.given('P')) return leave(false);
    const double number = block.words.of('P');
    if (calls_.frames.empty())
        count_jump();
    else
        leave(false);
    const LineNumber line = find_block(number, 0, 0);
    if (line == 0) fail(fmt::format("M99 P{:g}: there is no block N{:g}", number, number));
    go_to(place_.file, line);
}

}  // namespace clsurf

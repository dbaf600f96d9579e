// HEIDENHAIN Klartext (.h): its statements, each a row of a table, executed as the interpreter's motions and modes.
// Facts: HEIDENHAIN, TNC 620 and iTNC 530, User's Manuals "Klartext Programming" and "Cycle Programming". Cycles, frames
// and planes: klartext_cycles.cpp; Q parameters: klartext_q.cpp; words: klartext_words.cpp.

#include "program/dialects/klartext/klartext.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "program/dialects/heidenhain/heidenhain_codes.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace klartext {
namespace {

KlartextWords words_of(Line& line, bool radius_word = false) {
    return read_klartext_words(line.c, line.in.variables_, line.in.rules_->text, radius_word);
}

/// Keeps the rest of a statement as an event without motion.
void note_rest(Line& line, const char* event) { line.in.event(event, std::string(line.c.text.substr(line.start))); }

// Program, blank, stops.
void begin_program(Line& line) {
    const std::string_view rest = line.c.text.substr(line.c.at);
    if (!line.c.take_word("PGM")) throw ReadError{"expected PGM after BEGIN", line.c.column(), {}};
    set_inches(line.in, rest.ends_with(" INCH"));
    line.c.skip_blanks();
    line.in.event("program", std::string(line.c.text.substr(line.c.at)));
}
void end_program(Line& line) { leave(line.in, false); }
void blank_form(Line& line) { note_rest(line, "blank"); }
void stop(Line& line) {
    line.in.event("stop", "STOP");
    move_with(line, words_of(line), 1_g);
}
void note_statement(Line& line) { note_rest(line, "mode"); }

// Tools.
void define_tool(Line& line) {
    Tool tool;
    tool.number = static_cast<int>(std::clamp(line.value(), 0.0, 1e6));
    while (line.c.peek() != '\0') {
        if (line.c.peek() == 'L' || line.c.peek() == 'l') {
            ++line.c.at;
            tool.offset.z() = line.value() * line.in.state_.unit_mm;
        } else if (line.c.peek() == 'R' || line.c.peek() == 'r') {
            ++line.c.at;
            tool.diameter = 2 * line.value() * line.in.state_.unit_mm;
        } else {
            throw ReadError{"expected L or R of the tool", line.c.column(), {}};
        }
    }
    line.in.tools_.table.tools[tool.number] = tool;
}

/// TOOL CALL 5 Z S8000 F500 DL+0.1 DR-0.05: the axis sets the working plane; F stays active until the next F.
void call_tool(Line& line) {
    Interpreter& in = line.in;
    Block& block = in.block_;
    block.clear();
    double longer = 0;
    double wider = 0;
    if (line.c.peek() == '"') {
        const std::string name = line.quoted();
        in.event("tool", "T=" + name, ToolWord{{}, name});
    } else if (is_digit(line.c.peek()) || upper(line.c.peek()) == 'Q') {
        block.words.set('T', line.value(), line.c.column());
    }
    while (line.c.peek() != '\0') {
        const std::size_t column = line.c.column();
        const char letter = upper(line.c.peek());
        const auto delta = [&](std::string_view name, double& by) {
            const std::string_view rest = line.c.text.substr(line.c.at);
            if (!rest.starts_with(name) || rest.size() == name.size() || is_digit(rest[name.size()])) return false;
            line.c.at += name.size();
            by = line.value() * in.state_.unit_mm;
            return true;
        };
        if (line.c.take_word("X") || line.c.take_word("Y") || line.c.take_word("Z")) {
            in.state_.plane_axis = letter - 'X';
        } else if (delta("DL", longer) || delta("DR", wider)) {
            continue;
        } else if (line.c.text.substr(line.c.at).starts_with("DR2")) {
            line.c.at += 3;
            (void)line.value();
        } else if (letter == 'S' || letter == 'F') {
            ++line.c.at;
            const double value = line.value();
            if (letter == 'S') block.words.set('S', value, column);
            if (letter == 'F') in.state_.feed = state_of(in).tool_feed = value;
        } else {
            throw ReadError{"expected Z, S, F, DL or DR of TOOL CALL", column, {}};
        }
    }
    in.execute(block);
    if (in.tools_.table.tools.empty()) return;
    in.tools_.in_spindle.diameter += 2 * wider;
    if (longer != 0) in.state_.rebase([&] { in.state_.tool_offset.total[in.state_.plane_axis] += longer; });
}

// Motions.
void line_to(Line& line) { straight(line, words_of(line)); }

/// LN X Y Z NX NY NZ TX TY TZ: NX NY NZ are the normal of the surface, TX TY TZ the tool axis.
void line_with_normal(Line& line) {
    const KlartextWords words = words_of(line);
    const bool has_axis = words.find("TX") != nullptr || words.find("TY") != nullptr || words.find("TZ") != nullptr;
    const bool turns_on = std::find(words.m.begin(), words.m.end(), 128) != words.m.end();
    if (has_axis && !line.in.five_axis_.tool_centre_point && !turns_on)
        line.in.fail("TX TY TZ need M128 or FUNCTION TCPM before them", line.start + 1);
    straight(line, words);
}

void set_pole(Line& line) {
    Interpreter& in = line.in;
    const KlartextWords words = words_of(line);
    const Vec3 programmed = in.state_.programmed();
    const Vec3 here = programmed.array().isNaN().select(0.0, programmed);
    if (words.values.empty()) in.polar_.pole = here;
    for (const auto& [name, word] : words.values) {
        if (name.size() != 1 || name[0] < 'X' || name[0] > 'Z')
            throw ReadError{"CC takes X, Y and Z only", word.column, {}};
        const int k = name[0] - 'X';
        in.polar_.pole[k] = (word.incremental ? here[k] : 0.0) + word.value * in.state_.unit_mm;
    }
}

template <ArcKind kind>
void arc_to(Line& line) {
    arc(line, words_of(line, kind == ArcKind::by_radius), kind);
}

void line_polar(Line& line) { straight(line, words_of(line)); }

/// RND R5 F100, CHF 2: at the corner at the end of the last line.
template <bool rounded>
void cut_corner(Line& line) {
    Interpreter& in = line.in;
    const std::size_t column = line.c.column();
    if (line.c.peek() == 'R' || line.c.peek() == 'r') ++line.c.at;
    const double size = line.value() * in.state_.unit_mm;
    const KlartextWords words = words_of(line);
    if (!(size > 0)) in.fail("RND and CHF need a length above 0", column);
    const bool after_line = !in.program_.motions.kind.empty() && in.program_.motions.kind.back() == MotionKind::feed;
    if (!after_line || state_of(in).corner.pending)
        in.fail("RND and CHF are read between straight lines with feed", column);
    if (in.compensation_.path.on()) in.fail("RND and CHF under RL or RR with a tool radius are not supported", column);
    state_of(in).corner = {.pending = true,
                           .rounded = rounded,
                           .size = size,
                           .feed = words.feed == KlartextFeed::number ? words.feed_value : in.state_.feed,
                           .line = in.place_.line};
}

[[noreturn]] void refuse(Line& line) {
    const std::string_view word = line.c.text.substr(line.start, line.c.at - line.start);
    line.in.fail(fmt::format("{} is not supported in klartext, and moves axes", word), line.start + 1,
                 "let the CAM system write L, C and CR blocks");
}

// Labels and calls.
void call_label(Line& line) {
    Interpreter& in = line.in;
    const std::string label = label_of(line.c);
    if (!line.c.take_word("REP") && line.c.peek() == '\0') return call_subprogram(in, label, 1, false, {});
    if (line.c.text.substr(line.c.at).starts_with("REP")) line.c.at += 3;
    const double times = line.value();
    const int at = control_index(in, in.place_.file).find(ControlKind::sub, label);
    if (at < 0) in.fail(fmt::format("there is no label to repeat: '{}'", label));
    repeat_from(in, control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line + 1, times);
}

void call_program(Line& line) {
    std::string name = line.c.peek() == '"' ? line.quoted() : std::string(line.c.text.substr(line.c.at));
    name = name.substr(name.find_last_of("\\/:") + 1);
    if (name.ends_with(".H") || name.ends_with(".h")) name.resize(name.size() - 2);
    if (name.empty()) throw ReadError{"expected the program's name after CALL PGM", line.c.column(), {}};
    call_file(line.in, name);
}

struct StatementRow {
    std::string_view words;  ///< upper case, one blank between
    void (*run)(Line&);
};
/// Longer names come before their own prefixes.
constexpr auto statements = std::to_array<StatementRow>({
    {"L", line_to},
    {"LN", line_with_normal},
    {"CC", set_pole},
    {"C", arc_to<ArcKind::usual>},
    {"CR", arc_to<ArcKind::by_radius>},
    {"CT", arc_to<ArcKind::tangential>},
    {"CP", arc_to<ArcKind::usual>},
    {"CTP", arc_to<ArcKind::tangential>},
    {"LP", line_polar},
    {"RND", cut_corner<true>},
    {"CHF", cut_corner<false>},
    {"FN", calculate},
    {"CYCL DEF", define_cycle},
    {"CYCL CALL", call_cycle},
    {"PLANE", tilt_plane},
    {"FUNCTION TCPM", start_tool_centre_point},
    {"FUNCTION RESET TCPM", end_tool_centre_point},
    {"FUNCTION MODE TURN", refuse},
    {"FUNCTION", note_statement},
    {"TRANS DATUM", shift_datum_by_axis},
    {"CALL LBL", call_label},
    {"CALL PGM", call_program},
    {"TOOL CALL", call_tool},
    {"TOOL DEF", define_tool},
    {"STOP", stop},
    {"BEGIN", begin_program},
    {"END", end_program},
    {"BLK FORM", blank_form},
    {"PRESET", note_statement},
    {"SEL", note_statement},
    {"DECLARE", note_statement},
    {"ERROR", note_statement},
    {"CONTOUR DEF", note_statement},
    {"PATTERN DEF", note_statement},
    {"TCH PROBE", call_cycle},
    {"APPR", refuse},
    {"DEP", refuse},
    {"FPOL", refuse},
    {"FL", refuse},
    {"FLT", refuse},
    {"FC", refuse},
    {"FCT", refuse},
    {"SPL", spline},
});

bool takes(Cursor& c, std::string_view words) {
    Cursor ahead = c;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        const std::string_view word = words.substr(0, end);
        const std::string id = ahead.identifier();
        // "FN0" and "APPR LT": a number may follow at once.
        if (id != word &&
            !(word == "FN" && id.starts_with("FN") && id.find_first_not_of("0123456789", 2) == std::string::npos))
            return false;
        ahead.skip_blanks();
        ahead.at += word.size();
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    c = ahead;
    return true;
}

/// X+10 F100: a block of one axis, without L.
bool begins_with_axis(std::string_view text) {
    const std::size_t at = text.starts_with('I') ? 1 : 0;
    return text.size() > at + 1 && is_axis_letter(text[at]) &&
           (text[at + 1] == '+' || text[at + 1] == '-' || is_digit(text[at + 1]));
}

Control read_control(std::string_view statement) {
    Control control;
    Cursor c{statement, 0};
    if (c.take_word("LBL")) {
        control.label = label_of(c);
        control.kind = control.label == "0" ? ControlKind::end_sub : ControlKind::sub;
        control.rest = statement.size();
    }
    return control;
}

bool carry_out(Interpreter& in, const Statement& statement) {
    std::string text = statement.text;
    if (text.find('"') == std::string::npos) {
        // A decimal comma; '~' if a block continues in the next line.
        for (std::size_t k = 1; k + 1 < text.size(); ++k) {
            if (text[k] == ',' && is_digit(text[k - 1]) && is_digit(text[k + 1])) text[k] = '.';
        }
        if (text.back() == '~') text.back() = ' ';
        while (!text.empty() && text.back() == ' ') text.pop_back();
    }
    Line line{in, Cursor{text, 0}, 0};
    const char first = line.c.peek();
    if (first == '\0' || first == '*') return true;  // "* - …" is a heading
    line.start = line.c.at;
    const std::string id = line.c.identifier();
    if (id == "LBL") return false;
    const bool is_q = id.size() > 1 && id[0] == 'Q';
    if (state_of(in).corner.pending && !takes_corner(id) && !is_q)
        in.fail("a straight line with feed must follow RND and CHF", line.start + 1);
    if (is_q) {
        if (id.starts_with("QS"))
            note_rest(line, "mode");
        else
            assign_formula(line);
        return true;
    }
    for (const StatementRow& row : statements) {
        if (!takes(line.c, row.words)) continue;
        row.run(line);
        return true;
    }
    if (begins_with_axis(text.substr(line.start))) {
        straight(line, words_of(line));
        return true;
    }
    if (id.size() > 1 && id[0] == 'M' && id.find_first_not_of("0123456789", 1) == std::string::npos) {
        move_with(line, words_of(line), 1_g);
        return true;
    }
    in.fail(fmt::format("'{}' is not a statement of klartext", id.empty() ? std::string(1, first) : id),
            line.start + 1);
}

bool cycle_after_block(Interpreter& in, int code, const Block&) {
    note_cycle(in, fmt::format("M{}", code), 0);
    return true;
}
constexpr auto m_codes = std::to_array<MRule>({{89, cycle_after_block},
                                               {91, machine_position},
                                               {92, machine_position},
                                               {99, cycle_after_block},
                                               {128, tool_centre_point},
                                               {129, tool_centre_point}});

constexpr auto ending_signs = std::to_array<EndingSign>({{".h", 4}});
constexpr auto mark_signs = std::to_array<MarkSign>({{Mark::program_begin, 100}});
constexpr auto word_signs = std::to_array<WordSign>({{"FMAX", 6}, {"CYCL", 8}, {"LBL", 8}, {"DR", 2}, {"CC", 4}});

}  // namespace

std::string label_of(Cursor& c) {
    if (c.peek() == '"') {
        const std::size_t end = c.text.find('"', c.at + 1);
        if (end == std::string_view::npos) throw ReadError{"'\"' is not closed", c.column(), {}};
        std::string name(c.text.substr(c.at, end + 1 - c.at));
        c.at = end + 1;
        return name;
    }
    const std::size_t column = c.column();
    if (!is_digit(c.peek())) throw ReadError{"expected the number or the name of a label", column, {}};
    const std::string label = number_label(c);
    return label.empty() ? "0" : label;
}

}  // namespace klartext

const DialectRules klartext_rules{
    .text = {.semicolon_comments = true,
             .round_comments = false,
             .formulas = true,
             .block_numbers = true,
             .straight_word = "L",
             .first_block = "BEGIN PGM ",
             .inch_feed = 0.1,
             .splines = SplineForm::polynomial,
             .caret_power = true,
             .round_brackets = true,
             .numbered_names = "Q",
             .functions = heidenhain_functions(),
             .control = klartext::read_control},
    .m_codes = klartext::m_codes,
    .motion = {.plain_blocks = false, .refuses_curve_codes = false, .idle_letters = {}},
    .tools = {.t_changes = true, .length_with_tool = true},
    .calls = {.by_sub = true, .subs_run_through = true, .file_from_top = true},
    .arc_tolerance = heidenhain_arc_tolerance,
    .signs = {.words = klartext::word_signs, .endings = klartext::ending_signs, .marks = klartext::mark_signs},
    .plain = read_plain_klartext,
    .make_state = make_state<klartext::State>,
    .plain_moves = [](Interpreter& in) { return !klartext::state_of(in).corner.pending; },
    .statement = klartext::carry_out,
    .at_end =
        [](Interpreter& in) {
            if (klartext::state_of(in).corner.pending) in.fail("a straight line with feed must follow RND and CHF");
        },
    .arc = arc_about_pole,
    .about_pole =
        [](Interpreter& in, const Block& block, Vec3& end) {
            put_about_pole(in.polar_, in.state_, block.polar_radius, block.polar_angle, block.polar_radius_incremental,
                           block.polar_angle_incremental, end);
        },
};

const Dialect klartext_dialect{"klartext", "Heidenhain Klartext (.h): L, CC, C, CYCL DEF, Q parameters, PLANE",
                               &klartext_rules};

}  // namespace clsurf

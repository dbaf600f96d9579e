// The rules of SINUMERIK: the meaning of its codes and control statements. Words of several letters and frames:
// siemens_words.cpp; cycles: siemens_cycles.cpp. Facts: Siemens, SINUMERIK 840D sl, Programming Manual "Fundamentals"
// and "Job Planning".

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "program/dialects/known_dialects.h"
#include "program/dialects/siemens/siemens_words.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/codes.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/offsets.h"
#include "program/interpret/path_modes.h"

namespace clsurf {
namespace siemens {
namespace {

struct ControlWord {
    std::string_view text;
    ControlKind kind;
};
constexpr std::array<ControlWord, 17> control_words{{
    {"IF", ControlKind::if_begin},
    {"ELSE", ControlKind::else_branch},
    {"ENDIF", ControlKind::if_end},
    {"WHILE", ControlKind::while_begin},
    {"ENDWHILE", ControlKind::while_end},
    {"FOR", ControlKind::for_begin},
    {"ENDFOR", ControlKind::for_end},
    {"LOOP", ControlKind::while_begin},
    {"ENDLOOP", ControlKind::while_end},
    {"REPEAT", ControlKind::do_begin},
    {"UNTIL", ControlKind::do_while},
    {"RET", ControlKind::leave},
    {"M17", ControlKind::leave},
    {"PROC", ControlKind::label},
    {"ENDPROC", ControlKind::leave},
    {"REPEATB", ControlKind::repeat_block},
    {"CASE", ControlKind::choice},
}};

/// GOTO, GOTOF, GOTOB, GOTOC with its label, after the letters GOTO.
void read_go_to(Cursor& c, Control& control) {
    const char letter = c.at < c.text.size() ? upper(c.text[c.at]) : ' ';
    const bool named = letter == 'F' || letter == 'B' || letter == 'C';
    if (named) ++c.at;
    control.direction = letter == 'F' ? 1 : letter == 'B' ? -1 : 0;
    control.may_miss = letter == 'C';
    control.label = c.identifier();
}

Control read_control(std::string_view statement) {
    Control control;
    Cursor c{statement, 0};
    const std::string id = c.identifier();
    if (id.empty()) return control;
    Cursor after = c;
    after.at += id.size();
    if (after.peek() == ':' && id.size() > 1) {
        control.kind = ControlKind::label;
        control.label = id;
        control.rest = after.at + 1;
        return control;
    }
    if (id == "GOTO" || id == "GOTOF" || id == "GOTOB" || id == "GOTOC") {
        control.kind = ControlKind::go_to;
        c.skip_blanks();
        c.at += 4;
        read_go_to(c, control);
        return control;
    }
    for (const ControlWord& row : control_words) {
        if (id != row.text) continue;
        control.kind = row.kind;
        control.rest = after.at;
        if (id == "LOOP") control.rest = std::string_view::npos;
        if (id == "REPEATB" || (id == "REPEAT" && !after.identifier().empty())) {
            control.kind = id == "REPEATB" ? ControlKind::repeat_block : ControlKind::repeat_section;
            control.label = after.identifier();
            control.rest = after.at + after.text.substr(after.at).find_first_not_of(' ') + control.label.size();
            return control;
        }
        if (row.kind == ControlKind::if_begin) {
            const std::size_t at = find_control_word(statement, "GOTO", after.at);
            if (at != std::string_view::npos) {
                control.kind = ControlKind::if_go_to;
                Cursor target{statement, at + 4};
                read_go_to(target, control);
            }
        }
        return control;
    }
    return control;
}

constexpr auto of_arguments = std::to_array<ArgumentsRow>({
    {"MINVAL", 2, [](const std::vector<double>& v) { return std::min(v[0], v[1]); }},
    {"MAXVAL", 2, [](const std::vector<double>& v) { return std::max(v[0], v[1]); }},
    // Lower, upper, value.
    {"BOUND", 3, [](const std::vector<double>& v) { return std::max(v[0], std::min(v[2], v[1])); }},
});

// Codes.
bool dwell(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    in.this_block_.motion_suppressed = true;
    const bool turns = words.given('S') && in.state_.spindle > 0;  // revolutions of the spindle
    in.dwell(turns ? words.of('S') * seconds_per_minute / in.state_.spindle : words.given('F') ? words.of('F') : 0);
    return true;
}
/// Only lengths, not the feed.
bool count_lengths_in_inches(Interpreter& in, const CodeWord&) {
    in.state_.unit_mm = mm_per_inch;
    return true;
}
bool count_lengths_in_mm(Interpreter& in, const CodeWord&) {
    in.state_.unit_mm = 1;
    return true;
}
bool count_in_machine(Interpreter& in, const CodeWord&) {
    in.this_block_.machine_coordinates = true;
    return true;
}
bool without_work_system(Interpreter& in, const CodeWord&) {
    select_work_system(in, 0);
    return true;
}
bool axis_frame(Interpreter& in, const CodeWord& w) {
    in.note(Severity::warning, "program.frame",
            code_text(w.code) + " is not carried out, positions are read as programmed", w.column);
    in.this_block_.motion_suppressed = true;
    return true;
}
/// Of the work area or of the spindle.
bool limit_area(Interpreter& in, const CodeWord& w) {
    in.event("mode", code_text(w.code));
    in.this_block_.motion_suppressed = true;
    return true;
}
bool go_to_fixed_point(Interpreter& in, const CodeWord& w) {
    in.event("reference", code_text(w.code));
    in.this_block_.motion_suppressed = true;
    return true;
}
bool set_pole(Interpreter& in, const CodeWord& w) {
    move_pole(in, w.code, w.block);
    return true;
}
/// Soft approach and retract: their path is not executed.
bool approach(Interpreter& in, const CodeWord& w) {
    in.note(Severity::warning, "program.approach",
            code_text(w.code) + " is not carried out: its end is approached straight", w.column);
    return true;
}
bool note_mode(Interpreter& in, const CodeWord& w) {
    in.event("mode", code_text(w.code));
    return true;
}
bool thread(Interpreter& in, const CodeWord& w) {
    in.state_.motion = MotionMode::thread;
    return note_mode(in, w);
}
bool refuse_exact_stop(Interpreter& in, const CodeWord& w) {
    in.fail(code_text(w.code) + " is not a word of siemens", w.column,
            "the exact stop of siemens is G60 or G9; fanuc and linuxcnc have G61 (--dialect)");
}
bool stop_exactly(Interpreter& in, const CodeWord& w) {
    return path_mode_word(in, w, {BlockEnd::exact_stop, 0}, w.code == 9_g);
}
bool round_within_tolerance(Interpreter& in, const CodeWord& w) {
    return path_mode_word(in, w, {BlockEnd::rounded, state_of(in).contour_tolerance});
}
/// G64: the deviation is limited by the speed only, unless CTOL or CYCLE832 gave a tolerance.
bool round_corners(Interpreter& in, const CodeWord& w) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    return path_mode_word(
        in, w,
        {BlockEnd::rounded, std::isnan(state_of(in).contour_tolerance) ? unlimited : state_of(in).contour_tolerance});
}

constexpr auto codes = std::to_array<CodeRule>({
    {4_g, dwell},
    {9_g, stop_exactly},
    {25_g, limit_area},
    {26_g, limit_area},
    {27_g, note_mode},
    {33_g, note_mode},
    {34_g, note_mode},
    {35_g, note_mode},
    {50_g, note_mode},
    {53_g, count_in_machine},
    {58_g, axis_frame},
    {59_g, axis_frame},
    {60_g, stop_exactly},
    {61_g, refuse_exact_stop},
    {61.1_g, refuse_exact_stop},
    {62_g, note_mode},
    {62.1_g, note_mode},
    {63_g, note_mode},
    {64_g, round_corners},
    {70_g, count_lengths_in_inches},
    {71_g, count_lengths_in_mm},
    {74_g, go_to_fixed_point},
    {75_g, go_to_fixed_point},
    {110_g, set_pole},
    {111_g, set_pole},
    {112_g, set_pole},
    {140_g, note_mode},
    {141_g, note_mode},
    {142_g, note_mode},
    {143_g, note_mode},
    {147_g, approach},
    {148_g, approach},
    {153_g, count_in_machine},
    {247_g, approach},
    {248_g, approach},
    {250_g, note_mode},
    {331_g, thread},
    {332_g, thread},
    {340_g, note_mode},
    {341_g, note_mode},
    {347_g, approach},
    {348_g, approach},
    {400_g, note_mode},
    {450_g, note_mode},
    {451_g, note_mode},
    {460_g, note_mode},
    {461_g, note_mode},
    {462_g, note_mode},
    {500_g, without_work_system},
    {510_g, note_mode},
    {601_g, note_mode},
    {602_g, note_mode},
    {603_g, note_mode},
    {641_g, round_within_tolerance},
    {642_g, round_within_tolerance},
    {643_g, round_within_tolerance},
    {644_g, round_within_tolerance},
    {645_g, round_within_tolerance},
    {700_g, count_in_inches},
    {710_g, count_in_mm},
    {961_g, note_mode},
    {971_g, note_mode},
    {973_g, note_mode},
});

/// Settable work systems: G505 … G599.
bool work_system(Interpreter& in, const CodeWord& w) {
    if (w.code < 505_g || w.code > 599_g) return false;
    select_work_system(in, (w.code - 505_g) / 10 + 5);
    return true;
}

constexpr auto m_codes = std::to_array<MRule>({
    {17,
     [](Interpreter& in, int, const Block&) {
         leave(in, false);
         return true;
     }},
});

constexpr auto refused_at_arcs =
    std::to_array<RefusedLetter>({{'P', "turns are TURN= in siemens, P in linuxcnc (--dialect linuxcnc)"}});

/// The kinds of machining of CYCLE832.
void begin(Interpreter& in) {
    for (const auto& [name, kind] : {std::pair{"_OFF", 0},
                                     {"_FINISH", 1},
                                     {"_SEMIFIN", 2},
                                     {"_ROUGH", 3},
                                     {"_PRECISION", 4},
                                     {"_ORI_FINISH", 11},
                                     {"_ORI_SEMIFIN", 12},
                                     {"_ORI_ROUGH", 13},
                                     {"_ORI_PRECISION", 14},
                                     {"_TOP_SURFACE_SMOOTH_OFF", 0},
                                     {"_TOP_SURFACE_SMOOTH_ON", 1000}})
        in.variables_.set(name, kind);
}

bool statement(Interpreter& in, const Statement& statement) {
    Cursor c{statement.text, 0};
    if (!c.take_word("DEF")) return false;
    define_variables(in, statement.text.substr(c.at));
    return true;
}

/// G0 to G3, or a thread.
bool names_motion(const Block& block) {
    const auto* first = block.words.g.data();
    return std::any_of(first, first + block.words.g_count, [](std::int32_t code) {
        return code <= 30 || (code >= 330 && code <= 350) || code == 3310 || code == 3320;
    });
}

bool begin_block(Interpreter& in, Block& block) {
    if (names_motion(block)) in.arcs_.kind = ArcKind::usual;  // this ends CIP and CT
    for (const Keyword& keyword : block.keywords) apply_keyword(in, keyword, block);
    if (!in.ended_) set_contour_tolerance(in, block);
    return false;
}

/// L5 P2: subprogram L5 twice.
void call_subprogram(Interpreter& in, const Block& block) {
    const Words& w = block.words;
    if (!w.given('L') || in.this_block_.motion_suppressed) return;
    const int times = w.given('P') ? static_cast<int>(std::clamp(w.of('P'), 1.0, 9999.0)) : 1;
    call_subprogram(in, fmt::format("L{}", std::lround(w.of('L'))), times, true, {});
}

/// Variables of the control ($P_…) are read as 0, and reported.
double named_parameter(Interpreter& in, const std::string& name) {
    if (!name.starts_with('$')) return std::numeric_limits<double>::quiet_NaN();
    in.this_block_.unknown_name = name;
    return 0;
}

std::string work_system_name(int number) { return fmt::format("G{}", 505 + number - 5); }

constexpr auto word_signs = std::to_array<WordSign>(
    {{"TRAORI", 10}, {"TRAFOOF", 10}, {"TRANSMIT", 8}, {"SUPA", 6},       {"MCALL", 10},    {"MSG", 6},
     {"FFWON", 8},   {"FFWOF", 8},    {"SOFT", 4},     {"BRISK", 4},      {"GOTOF", 8},     {"GOTOB", 8},
     {"GOTOC", 8},   {"PROC", 8},     {"ENDPROC", 8},  {"RET", 4},        {"COMPCAD", 8},   {"COMPCURV", 8},
     {"COMPON", 8},  {"COMPSURF", 8}, {"COMPOF", 8},   {"STOPRE", 8},     {"WORKPIECE", 8}, {"TRANS", 6},
     {"ATRANS", 8},  {"ROT", 6},      {"AROT", 8},     {"ASCALE", 8},     {"AMIRROR", 8},   {"ASPLINE", 8},
     {"BSPLINE", 8}, {"CSPLINE", 8},  {"POLY", 8},     {"SPLINEPATH", 8}, {"FNORM", 6},     {"DIAMON", 6},
     {"DIAMOF", 6},  {"EXTCALL", 8},  {"ORIWKS", 8},   {"ORIMKS", 8},     {"ORIVECT", 8},   {"ORIAXES", 8},
     {"DEF", 8},     {"ENDFOR", 8},   {"ENDLOOP", 8},  {"CIP", 6},        {"REPEATB", 8},   {"CASE", 6}});
constexpr auto numbered_signs = std::to_array<WordSign>({{"CYCLE", 10}, {"POCKET", 8}, {"HOLES", 8}, {"SLOT", 8}});
constexpr auto code_signs = std::to_array<CodeSign>({{641_g, 8, "", ""},
                                                     {642_g, 8, "", ""},
                                                     {643_g, 8, "", ""},
                                                     {644_g, 8, "", ""},
                                                     {645_g, 8, "", ""},
                                                     {601_g, 6, "", ""},
                                                     {602_g, 6, "", ""},
                                                     {603_g, 6, "", ""},
                                                     {60_g, 3, "", "XYZ"},
                                                     {500_g, 5, "", ""},
                                                     {153_g, 5, "", ""},
                                                     {700_g, 5, "", ""},
                                                     {710_g, 5, "", ""},
                                                     {111_g, 5, "", ""},
                                                     {450_g, 5, "", ""},
                                                     {451_g, 5, "", ""}});
constexpr auto ending_signs = std::to_array<EndingSign>({{".mpf", 6}, {".spf", 6}});
constexpr auto mark_signs = std::to_array<MarkSign>({{Mark::tape_name, 15},
                                                     {Mark::round_comment, -3},
                                                     {Mark::letter_equals, 6},
                                                     {Mark::return_m, 4},
                                                     {Mark::jump_to_label, 4},
                                                     {Mark::open_if, 4},
                                                     {Mark::name_equals, 6},
                                                     {Mark::name_colon, 6}});

}  // namespace
}  // namespace siemens

const DialectRules siemens_rules{
    .text = {.semicolon_comments = true,
             .round_comments = false,
             .splines = SplineForm::basis,
             .words = WordStyle::names,
             .ranks = OperatorRanks::siemens,
             .round_brackets = true,
             .numbered_names = "RQ",
             .of_arguments = siemens::of_arguments,
             .control = siemens::read_control},
    .codes = siemens::codes,
    .other_code = siemens::work_system,
    .m_codes = siemens::m_codes,
    .motion = {.plain_blocks = false, .idle_letters = "IJK", .refused_at_arcs = siemens::refused_at_arcs},
    .tools = {.length_with_tool = true, .edges = true},
    .calls = {.file_from_top = true, .return_ends_main = true, .blocks_after_label = true},
    // The defaults of MD21000 CIRCLE_ERROR_CONST and MD21010 CIRCLE_ERROR_FACTOR.
    .arc_tolerance = {.absolute = 0.01,
                      .relative = 1e-3,
                      .most = std::numeric_limits<double>::infinity(),
                      .reach = 0.005,
                      .relative_reach = 1e-3,
                      .moves_centre = true},
    .signs = {.words = siemens::word_signs,
              .numbered_words = siemens::numbered_signs,
              .codes = siemens::code_signs,
              .endings = siemens::ending_signs,
              .marks = siemens::mark_signs},
    .make_state = make_state<siemens::State>,
    .begin = siemens::begin,
    .statement = siemens::statement,
    .begin_block = siemens::begin_block,
    .after_block = siemens::call_subprogram,
    .arc = siemens::arc_of_words,
    .modal_call = siemens::repeat_modal_call,
    .named_parameter = siemens::named_parameter,
    .about_pole =
        [](Interpreter& in, const Block& block, Vec3& end) {
            put_about_pole(in.polar_, in.state_, block.polar_radius, block.polar_angle, block.polar_radius_incremental,
                           block.polar_angle_incremental, end);
        },
    .work_system_name = siemens::work_system_name,
};

const Dialect siemens_dialect{"siemens", "SINUMERIK: X=AC(…), TRAORI, CYCLE832, R parameters", &siemens_rules};

}  // namespace clsurf

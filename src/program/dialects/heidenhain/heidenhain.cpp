// Heidenhain DIN/ISO: frames by cycle, pole and polar motions, arcs about the pole, Q functions.
// Facts: Heidenhain, TNC 426/430 and iTNC 530, User's Manual "DIN/ISO Programming".

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "program/dialects/heidenhain/heidenhain_codes.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tangential_arc.h"
#include "program/interpret/tool_axis.h"

namespace clsurf {
namespace {

constexpr std::uint32_t ijk = Words::bit('I') | Words::bit('J') | Words::bit('K');

}  // namespace

bool machine_position(Interpreter& in, int code, const Block&) {
    in.this_block_.machine_coordinates = code == 91;
    if (code == 92) in.note(Severity::warning, "program.unknown-word", "M92: the machine's second zero is not known");
    return true;
}

bool tool_centre_point(Interpreter& in, int code, const Block&) {
    control_tool_centre_point(in, code == 128, fmt::format("M{}", code));
    return true;
}

void set_frame_part(Interpreter& in, OrderedFrames::Part part, const ProgramFrame& frame) {
    OrderedFrames& f = heidenhain_state(in).frames;
    f.frame[part] = frame;
    std::erase(f.order, part);
    if (frame.active()) f.order.push_back(part);
    ProgramFrame all;
    for (const std::size_t k : f.order) all = all.around(f.frame[k]);
    in.state_.frame = all;
    in.this_block_.motion_suppressed = true;
}

void set_inches(Interpreter& in, bool inches) {
    in.state_.unit_mm = inches ? mm_per_inch : 1;
    in.state_.feed_unit_mm = inches ? in.rules_->text.inch_feed * mm_per_inch : 1;
}

bool arc_about_pole(Interpreter& in, const Block& block, ArcWords& words) {
    if (in.arcs_.kind == ArcKind::tangential) {
        arc_along_tangent(in, words);
        return true;
    }
    in.arcs_.last_clockwise = words.clockwise;
    if (block.words.given('R') && !in.arcs_.polar_line) return false;
    words.centre = in.polar_.pole;
    words.centre[words.axis] = words.begin[words.axis];
    return true;
}

namespace heidenhain {
namespace {

/// `%NAME G71` begins and ends a program with its unit of measure; `%NAME` alone calls one.
void begin_or_call(Interpreter& in, const std::string& title) {
    std::istringstream words(title);
    std::string name;
    std::string unit;
    words >> name >> unit;
    const std::string_view before = in.program_.files[in.place_.file].text().substr(
        0, static_cast<std::size_t>(in.place_.text.data() - in.program_.files[in.place_.file].text().data()));
    const bool begins = before.find_first_not_of(" \t\r\n\xef\xbb\xbf") == std::string_view::npos;
    if (begins) {
        set_inches(in, unit == "G70");
        in.event("program", title);
    } else if (unit == "G70" || unit == "G71") {
        leave(in, false);
    } else {
        call_subprogram(in, name, 1, false, {});
    }
}

/// An axis letter without a number, for example in G28 X Y.
bool take_mention(char letter, Block& block) {
    return std::erase_if(block.unknown, [&](const UnknownWord& word) {
               return word.text.size() == 1 && upper(word.text[0]) == letter;
           }) > 0;
}

/// I J K set the pole, which is modal: in the block of the arc, or before it.
void take_pole(Interpreter& in, const Block& block) {
    if ((block.words.has & ijk) == 0) return;
    const Vec3 here = in.state_.programmed();
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("IJK"[k])) continue;
        const double value = block.words.of("IJK"[k]) * in.state_.unit_mm;
        in.polar_.pole[k] = in.state_.incremental ? (std::isnan(here[k]) ? 0.0 : here[k]) + value : value;
    }
    const bool alone =
        (block.words.has & (Words::xyz | Words::bit('H') | Words::bit('R'))) == 0 && block.words.g_count == 0;
    if (alone) in.this_block_.motion_suppressed = true;
}

/// Functions of formulas.
constexpr std::array<FunctionRow, 5> functions{{
    {"SQ", [](double v) { return v * v; }},
    {"NEG", [](double v) { return -v; }},
    {"FRAC", [](double v) { return v - std::trunc(v); }},
    {"SGN", [](double v) { return v > 0   ? 1.0
                                  : v < 0 ? -1.0
                                          : 0.0; }},
    {"LOG", [](double v) { return std::log10(v); }},
}};

Control read_control(std::string_view statement) {
    Control control;
    Cursor c{statement, 0};
    // G98 L5 is a label, G98 L0 the end of a subprogram.
    if (upper(c.peek()) != 'G') return control;
    ++c.at;
    double code = 0;
    const std::size_t next = read_decimal(c.text, c.at, code);
    if (next == c.at || code != 98) return control;
    c.at = next;
    if (upper(c.peek()) != 'L') return control;
    ++c.at;
    control.label = number_label(c);
    control.kind = control.label.empty() ? ControlKind::end_sub : ControlKind::sub;
    control.rest = c.at;
    return control;
}

bool not_carried_out(Interpreter& in, const CodeWord& w, const char* what) {
    in.note(Severity::warning, "program.unknown-word",
            fmt::format("{} ({}) is not carried out", code_text(w.code), what), w.column);
    in.this_block_.motion_suppressed = true;
    return true;
}
bool count_in_unit(Interpreter& in, const CodeWord& w) {
    set_inches(in, w.code == 70_g);
    return true;
}
bool dwell(Interpreter& in, const CodeWord& w) {
    in.this_block_.motion_suppressed = true;
    in.dwell(w.block.words.given('F') ? w.block.words.of('F') : 0);
    return true;
}
bool move_as_usual(Interpreter& in, const CodeWord&) {
    in.arcs_.polar_line = false;
    in.arcs_.kind = ArcKind::usual;
    return false;
}
bool arc_by_radius(Interpreter& in, const CodeWord&) {
    in.arcs_.kind = ArcKind::by_radius;
    in.state_.motion = in.arcs_.last_clockwise ? MotionMode::cw : MotionMode::ccw;
    return true;
}
bool arc_tangential(Interpreter& in, const CodeWord& w) {
    in.arcs_.kind = ArcKind::tangential;
    in.state_.motion = MotionMode::cw;
    if (w.code == 16_g) in.arcs_.polar_line = true;
    return true;
}
bool move_along_axis(Interpreter& in, const CodeWord&) {
    in.state_.motion = MotionMode::feed;
    return true;
}
bool polar_line(Interpreter& in, const CodeWord& w) {
    in.arcs_.polar_line = true;
    in.state_.motion = w.code == 10_g ? MotionMode::rapid : MotionMode::feed;
    return true;
}
bool polar_arc(Interpreter& in, const CodeWord& w) {
    in.arcs_.polar_line = true;
    in.arcs_.kind = ArcKind::usual;
    if (w.code != 15_g) in.arcs_.last_clockwise = w.code == 12_g;
    in.state_.motion = in.arcs_.last_clockwise ? MotionMode::cw : MotionMode::ccw;
    return true;
}
bool take_position_as_pole(Interpreter& in, const CodeWord&) {
    const Vec3 here = in.state_.programmed();
    in.polar_.pole = here.array().isNaN().select(0.0, here);
    in.this_block_.motion_suppressed = true;
    in.event("pole", "G29");
    return true;
}
bool chamfer(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "chamfer"); }
bool round_corner(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "corner rounding"); }
bool approach(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "tangential approach"); }
bool depart(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "tangential departure"); }
bool fourth_axis(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "fourth axis as tool axis"); }
bool datum_table(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "datum table"); }
bool paraxial(Interpreter& in, const CodeWord& w) { return not_carried_out(in, w, "paraxial radius compensation"); }
bool mirror_axes(Interpreter& in, const CodeWord& w) {
    Vec3 factors = Vec3::Ones();
    for (int k = 0; k < 3; ++k) {
        if (w.block.words.given("XYZ"[k]) || take_mention("XYZ"[k], w.block)) factors[k] = -1;
    }
    set_frame_part(in, OrderedFrames::mirror, ProgramFrame::scaled(factors, Vec3::Zero()));
    in.event("mirror", "G28");
    return true;
}
bool shift_datum(Interpreter& in, const CodeWord& w) {
    for (int k = 0; k < 3; ++k) {
        if (!w.block.words.given("XYZ"[k])) continue;
        const double value = w.block.words.of("XYZ"[k]) * in.state_.unit_mm;
        heidenhain_state(in).datum[k] = in.state_.incremental ? heidenhain_state(in).datum[k] + value : value;
    }
    set_frame_part(in, OrderedFrames::datum, ProgramFrame::moved(heidenhain_state(in).datum));
    in.event("datum-shift", "G54" + words_text(w.block, "XYZ"));
    return true;
}
bool scale_all(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    if (!words.given('F') || words.of('F') == 0) in.fail("G72 needs its factor (F)", w.column);
    set_frame_part(in, OrderedFrames::scaling, ProgramFrame::scaled(Vec3::Constant(words.of('F')), Vec3::Zero()));
    in.event("scaling", "G72" + words_text(w.block, "F"));
    return true;
}
bool rotate(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    if (!words.given('H')) in.fail("G73 needs its angle (H)", w.column);
    heidenhain_state(in).turned_by =
        in.state_.incremental ? heidenhain_state(in).turned_by + words.of('H') : words.of('H');
    set_frame_part(
        in, OrderedFrames::rotation,
        ProgramFrame::turned(Vec3::Unit(in.state_.plane_axis), heidenhain_state(in).turned_by, Vec3::Zero()));
    in.event("rotation", "G73" + words_text(w.block, "H"));
    return true;
}
bool tilt(Interpreter& in, const CodeWord& w) {
    constexpr std::uint32_t angles = Words::bit('A') | Words::bit('B') | Words::bit('C');
    if ((w.block.words.has & angles) != 0) return not_carried_out(in, w, "tilted working plane");
    in.this_block_.motion_suppressed = true;
    return true;
}
bool stop(Interpreter& in, const CodeWord& w) {
    in.event("stop", "G38");
    in.this_block_.motion_suppressed = true;
    w.block.words.has &= ~(Words::bit('T') | Words::bit('L'));
    return true;
}
/// Blank form, spindle angle, tools, probing, labels.
bool note_mode(Interpreter& in, const CodeWord& w) {
    in.event("mode", code_text(w.code) + words_text(w.block, "TLR"));
    in.this_block_.motion_suppressed = true;
    w.block.words.has &= ~(Words::bit('T') | Words::bit('L'));
    return true;
}
bool define_tool(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    if (words.given('T')) {
        Tool tool{.number = static_cast<int>(std::clamp(words.of('T'), 0.0, 1e6))};
        if (words.given('L')) tool.offset.z() = words.of('L') * in.state_.unit_mm;
        if (words.given('R')) tool.diameter = 2 * words.of('R') * in.state_.unit_mm;
        in.tools_.table.tools[tool.number] = tool;
    }
    return note_mode(in, w);
}

constexpr int order_of_offsets = 9;  ///< G54 is not a work system here: G90 or G91 applies to its words
constexpr auto codes = std::to_array<CodeRule>({
    {0_g, move_as_usual},
    {1_g, move_as_usual},
    {2_g, move_as_usual},
    {3_g, move_as_usual},
    {4_g, dwell},
    {5_g, arc_by_radius},
    {6_g, arc_tangential},
    {7_g, move_along_axis},
    {10_g, polar_line},
    {11_g, polar_line},
    {12_g, polar_arc},
    {13_g, polar_arc},
    {15_g, polar_arc},
    {16_g, arc_tangential},
    {20_g, fourth_axis},
    {24_g, chamfer},
    {25_g, round_corner},
    {26_g, approach},
    {27_g, depart},
    {28_g, mirror_axes},
    {29_g, take_position_as_pole},
    {30_g, note_mode},
    {31_g, note_mode},
    {36_g, note_mode},
    {38_g, stop},
    {39_g, note_mode},
    {43_g, paraxial},
    {44_g, paraxial},
    {50_g, note_mode},
    {51_g, note_mode},
    {53_g, datum_table},
    {54_g, shift_datum, order_of_offsets},
    {55_g, note_mode},
    {70_g, count_in_unit},
    {71_g, count_in_unit},
    {72_g, scale_all},
    {73_g, rotate},
    {80_g, tilt},
    {98_g, note_mode},
    {99_g, define_tool},
});

/// G62 T0.05 P01 0 P02 5, like cycle 32: the tolerance of the path; without T the machine's own is active again. P01
/// is the mode, P02 the tolerance of rotary axes.
bool set_tolerance(Interpreter& in, std::string_view text) {
    Cursor c{text, 0};
    if (!c.take_word("G62")) return false;
    double tolerance = 0;
    while (c.peek() != '\0') {
        const std::size_t column = c.column();
        const char letter = upper(c.peek());
        ++c.at;
        double number = 0;
        const std::size_t end = letter == 'P' ? read_decimal(text, c.at, number) : c.at;
        if ((letter != 'T' && letter != 'P') || (letter == 'P' && end == c.at))
            throw ReadError{"expected T, P01 or P02 of G62", column, {}};
        c.at = end;
        const double value = evaluate(c, in.variables_, in.rules_->text);
        if (letter == 'T') tolerance = value * in.state_.unit_mm;
        if (tolerance < 0) throw ReadError{"a tolerance below 0", column, {}};
    }
    heidenhain_state(in).contour_tolerance = tolerance > 0 ? tolerance : std::numeric_limits<double>::quiet_NaN();
    set_path_mode(in, "path-mode", std::string(text.substr(text.find_first_not_of(' '))),
                  {BlockEnd::rounded, heidenhain_state(in).contour_tolerance});
    return true;
}

/// Klartext is HEIDENHAIN's other language.
void begin(Interpreter& in) {
    const SourceText& text = in.program_.main();
    LineNumber line = 1;
    while (line < text.line_count() && text.line(line).find_first_not_of(" \t\r") == std::string_view::npos) ++line;
    const std::string_view first = text.line(line);
    const std::size_t name = first.find_first_not_of("0123456789 \t\xef\xbb\xbf");
    if (name == std::string_view::npos || !first.substr(name).starts_with("BEGIN PGM ")) return;
    throw InputError(Place::of_line(text.name(), line), "is Klartext (BEGIN PGM), not DIN/ISO",
                     "--dialect klartext reads it");
}

/// Machining cycles: read, not executed.
bool cycle(Interpreter& in, const CodeWord& w) {
    const int code = w.code;
    const bool known = code == 79_g || (code >= 74_g && code <= 86_g) || (code >= 200_g && code <= 499_g) ||
                       (code >= 56_g && code <= 59_g) || code == 37_g || code == 120_g;
    return known && not_carried_out(in, w, "cycle");
}

constexpr auto m_codes = std::to_array<MRule>(
    {{91, machine_position}, {92, machine_position}, {128, tool_centre_point}, {129, tool_centre_point}});

/// L5 together with other words of a block.
void call_label(Interpreter& in, const Block& block) {
    if (!block.words.given('L') || in.this_block_.motion_suppressed) return;
    call_subprogram(in, fmt::format("{}", std::lround(block.words.of('L'))), 1, false, {});
}

constexpr auto code_signs = std::to_array<CodeSign>({{98_g, 6, "L", "XYZ"}, {99_g, 5, "T", ""}});
constexpr auto ending_signs = std::to_array<EndingSign>({{".i", 4}});
constexpr auto mark_signs = std::to_array<MarkSign>(
    {{Mark::title_with_unit, 15}, {Mark::stars, 60}, {Mark::q_equals, 6}, {Mark::blank_in_plane, 2}});

}  // namespace
}  // namespace heidenhain

std::span<const FunctionRow> heidenhain_functions() { return heidenhain::functions; }

const DialectRules heidenhain_iso_rules{
    .text = {.semicolon_comments = true,
             .formulas = true,
             .star_ends_block = true,
             .named_titles = true,
             .inch_feed = 0.1,
             .q_words = true,
             .caret_power = true,
             .round_brackets = true,
             .numbered_names = "RQ",
             .functions = heidenhain::functions,
             .control = heidenhain::read_control},
    .codes = heidenhain::codes,
    .other_code = heidenhain::cycle,
    .m_codes = heidenhain::m_codes,
    .motion = {.plain_blocks = false, .refuses_curve_codes = false, .idle_letters = {}},
    .tools = {.t_changes = true, .length_with_tool = true},
    .calls = {.by_sub = true, .subs_run_through = true, .file_from_top = true},
    .arc_tolerance = heidenhain_arc_tolerance,
    .signs = {.codes = heidenhain::code_signs, .endings = heidenhain::ending_signs, .marks = heidenhain::mark_signs},
    .make_state = make_state<HeidenhainState>,
    .begin = heidenhain::begin,
    .title = heidenhain::begin_or_call,
    .statement =
        [](Interpreter& in, const Statement& s) {
            return run_q_function(in, s.text) || run_label_line(in, s.text) || heidenhain::set_tolerance(in, s.text);
        },
    .after_codes = heidenhain::take_pole,
    .after_block = heidenhain::call_label,
    .arc = arc_about_pole,
    .about_pole =
        [](Interpreter& in, const Block& block, Vec3& end) {
            const auto word = [&](char letter) {
                return block.words.given(letter) ? std::optional(block.words.of(letter)) : std::nullopt;
            };
            straight_to_pole_plane(in.state_, block, end.array().isNaN().select(0.0, end), end);
            put_about_pole(in.polar_, in.state_, word('R'), word('H'), false, in.state_.incremental, end);
        },
};

const Dialect heidenhain_iso_dialect{"heidenhain-iso", "Heidenhain DIN/ISO: blocks ending in *, Q parameters",
                                     &heidenhain_iso_rules};

}  // namespace clsurf

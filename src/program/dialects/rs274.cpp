// LinuxCNC: RS274/NGC (NIST IR 6556) with its extensions, as executed by its own interpreter. Facts: LinuxCNC 2.9, "G
// Codes", "O Codes", "Overview: Parameters"; emc/rs274ngc.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/compensated_motions.h"
#include "program/interpret/curves.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/kept_modes.h"
#include "program/interpret/lathe_cycles.h"
#include "program/interpret/offsets.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tools.h"

namespace clsurf {
namespace rs274 {
namespace {

struct OWord {
    std::string_view text;
    ControlKind kind;
};
constexpr std::array<OWord, 16> o_words{{
    {"SUB", ControlKind::sub},
    {"ENDSUB", ControlKind::end_sub},
    {"CALL", ControlKind::call},
    {"RETURN", ControlKind::leave},
    {"WHILE", ControlKind::while_begin},
    {"ENDWHILE", ControlKind::while_end},
    {"DO", ControlKind::do_begin},
    {"IF", ControlKind::if_begin},
    {"ELSEIF", ControlKind::else_if},
    {"ELSE", ControlKind::else_branch},
    {"ENDIF", ControlKind::if_end},
    {"REPEAT", ControlKind::repeat_begin},
    {"ENDREPEAT", ControlKind::repeat_end},
    {"BREAK", ControlKind::break_loop},
    {"CONTINUE", ControlKind::continue_loop},
    {"PROGRAM", ControlKind::label},
}};

/// O100, O<name>; an indirect label (O[#1], O#1) keeps its text and is resolved by the interpreter.
std::string o_label(Cursor& c) {
    if (c.take('<')) {
        const std::size_t end = c.text.find('>', c.at);
        if (end == std::string_view::npos) throw ReadError{"'o<' is not closed by '>'", c.column(), {}};
        std::string name = folded_name(c.text.substr(c.at, end - c.at));
        c.at = end + 1;
        return name;
    }
    const char next = c.peek();
    if (next == '[' || next == '#') {
        const std::size_t begin = c.at;
        int depth = 0;
        while (c.at < c.text.size()) {
            const char ch = c.text[c.at];
            if (ch == '[') ++depth;
            if (ch == ']') --depth;
            if (depth == 0 && is_blank(ch)) break;
            ++c.at;
            if (depth == 0 && ch == ']') break;
        }
        return std::string(c.text.substr(begin, c.at - begin));
    }
    std::string digits;
    while (c.at < c.text.size() && is_digit(c.text[c.at])) digits += c.text[c.at++];
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return digits.empty() ? "0" : digits;
}

Control read_control(std::string_view statement) {
    Cursor c{statement, 0};
    Control control;
    if (upper(c.peek()) != 'O') return control;
    ++c.at;
    control.label = o_label(c);
    const std::string word = c.identifier();
    if (word.empty()) {
        control.kind = ControlKind::label;
        control.rest = c.at;
        return control;
    }
    for (const OWord& row : o_words) {
        if (word != row.text) continue;
        c.take_word(row.text);
        control.kind = row.kind;
        control.rest = c.at;
        return control;
    }
    throw ReadError{"unknown O-word '" + word + "'", c.column(), "sub, call, while, if, repeat, do …"};
}

double numbered_parameter(Interpreter& in, int number) {
    const double unit = in.state_.unit_mm;
    const double machine_unit = in.tools_.table.unit_mm;
    const Vec3 at = tool_position(in.compensation_, in.state_);
    const Vec3 known = at.array().isNaN().select(0.0, at);
    const auto axis_of = [&](int first, const AxisValues& values, double per) {
        const int k = number - first;
        return k < 3 ? values.linear[k] / per : k < 6 ? values.rotary[k - 3] : 0.0;
    };
    if (number >= 5420 && number <= 5428) return axis_of(5420, {known, in.state_.rotary}, unit);
    if (number >= 5161 && number <= 5169) return axis_of(5161, in.state_.home, machine_unit);
    if (number >= 5181 && number <= 5189) return axis_of(5181, in.state_.second_home, machine_unit);
    if (number >= 5211 && number <= 5219) return axis_of(5211, in.state_.work_offsets.shift, machine_unit);
    if (number == 5220) return in.state_.work_offsets.system;
    if (number >= 5221 && number < 5221 + 9 * 20) {
        const int system = (number - 5221) / 20 + 1;
        const int axis = (number - 5221) % 20;
        const WorkOffset offset = in.state_.work_offsets.of(system);
        if (axis == 9) return offset.rotation;
        if (axis >= 3 && axis < 6) return offset.rotary[axis - 3];
        return axis < 3 ? offset.shift[axis] / machine_unit : 0.0;
    }
    switch (number) {
        case 5400: return in.tools_.in_spindle.number;
        case 5410: return in.tools_.in_spindle.diameter / machine_unit;
        case 5411: return in.tools_.in_spindle.front_angle;
        case 5412: return in.tools_.in_spindle.back_angle;
        case 5413: return in.tools_.in_spindle.orientation;
        default: break;
    }
    if (number >= 5401 && number <= 5409) return axis_of(5401, {.linear = in.tools_.in_spindle.offset}, machine_unit);
    return missing<double>;
}

/// #<_motion_mode>: the code in tenths.
int code_of(MotionMode mode, int cycle) {
    switch (mode) {
        case MotionMode::rapid: return 0;
        case MotionMode::feed: return 10;
        case MotionMode::cw: return 20;
        case MotionMode::ccw: return 30;
        case MotionMode::thread: return 330;
        case MotionMode::tap: return 331;
        case MotionMode::cubic_spline: return 50;
        case MotionMode::quadratic_spline: return 51;
        case MotionMode::nurbs: return 52;
        case MotionMode::knotted_nurbs: return 62;
        case MotionMode::akima_spline:
        case MotionMode::basis_spline:
        case MotionMode::point_spline:
        case MotionMode::polynomial: return 800;  // of siemens
        case MotionMode::probe: return 382;
        case MotionMode::cycle: return cycle;
        case MotionMode::none: return 800;
    }
    return 800;
}

/// `_x`, `_abs_a`: the position of an axis, in the units of the program.
double axis_parameter(const Interpreter& in, const std::string& name) {
    const double unit = in.state_.unit_mm;
    const Vec3 at = tool_position(in.compensation_, in.state_);
    const Vec3 machine = in.state_.to_machine(at);
    for (int k = 0; k < 3; ++k) {
        const std::string linear(1, "xyz"[k]);
        const std::string turning(1, "abc"[k]);
        if (name == "_" + linear) return at[k] / unit;
        if (name == "_abs_" + linear) return machine[k] / unit;
        if (name == "_" + turning) return in.state_.rotary[k];
        if (name == "_abs_" + turning) return in.state_.rotary[k] + in.state_.work_offsets.rotary()[k];
        if (name == "_" + std::string(1, "uvw"[k])) return 0;  // axes that are not supported
    }
    return missing<double>;
}

/// Names of LinuxCNC, "Predefined Named Parameters", except those whose values a program cannot know.
double named_parameter(Interpreter& in, const std::string& name) {
    if (const double axis = axis_parameter(in, name); !std::isnan(axis)) return axis;
    const double unit = in.state_.unit_mm;
    const int system = in.state_.work_offsets.system;
    constexpr int numbered_systems = 6;
    const std::pair<const char*, double> modes[] = {
        {"_metric", unit == 1},
        {"_imperial", unit != 1},
        {"_absolute", !in.state_.incremental},
        {"_incremental", in.state_.incremental},
        {"_inverse_time", in.state_.feed_mode == FeedMode::inverse_time},
        {"_units_per_minute", in.state_.feed_mode == FeedMode::per_minute},
        {"_units_per_rev", in.state_.feed_mode == FeedMode::per_revolution},
        {"_ijk_absolute_mode", in.state_.centre_absolute},
        {"_ijk_incremental_mode", !in.state_.centre_absolute},
        {"_lathe_diameter_mode", in.state_.diameter},
        {"_lathe_radius_mode", !in.state_.diameter},
        {"_retract_r_plane", in.state_.retract_to_r},
        {"_retract_old_z", !in.state_.retract_to_r},
        {"_motion_mode", code_of(in.state_.motion, in.state_.cycle)},
        {"_plane", in.state_.plane_axis == 2   ? 170
                   : in.state_.plane_axis == 1 ? 180
                                               : 190},
        {"_coord_system", system <= numbered_systems ? 530 + 10 * system : 590 + system - numbered_systems},
        {"_tool_offset", !in.state_.tool_offset.total.isZero()},
        {"_ccomp", !in.compensation_.path.on()    ? 400
                   : in.compensation_.path.left() ? 410
                                                  : 420},
        {"_feed", in.state_.feed},
        {"_rpm", in.state_.spindle},
        {"_current_tool", in.tools_.in_spindle.number},
        {"_current_pocket", in.tools_.in_spindle.number},
        {"_selected_tool", in.tools_.next},
        {"_selected_pocket", in.tools_.next},
        {"_call_level", static_cast<double>(in.calls_.frames.size())},
        {"_line", static_cast<double>(in.place_.line)},
        {"_value", 0},
        {"_value_returned", 0},
        {"_feed_override", 1},
        {"_speed_override", 1},
        {"_feed_hold", 1},
        {"_adaptive_feed", 0},
        {"_remap_level", 0},
        {"_task", 0},
        {"_vmajor", 2.9},
        {"_vminor", 0},
    };
    for (const auto& [known, value] : modes) {
        if (name == known) return value;
    }
    return missing<double>;
}

/// LinuxCNC's interpreter knows the positions of the axes, has default tools, and retracts to R.
void begin(Interpreter& in) {
    if (!in.options_.tools) in.tools_.table = stand_alone_tools();
    in.state_.position = in.options_.start.value_or(Vec3::Zero());
    in.state_.retract_to_r = true;
    in.program_.motions.start = Xyz(in.state_.position);
}

template <MotionMode mode>
bool set_motion(Interpreter& in, const CodeWord&) {
    in.state_.motion = mode;
    return true;
}

bool lathe_cycle(Interpreter& in, const CodeWord& w) {
    lathe_cycle(in, w.code, Block(w.block), w.column);
    return true;
}
bool set_diameter(Interpreter& in, const CodeWord& w) {
    in.state_.diameter = w.code == 7_g;
    in.event("lathe", code_text(w.code));
    return true;
}
bool compensate(Interpreter& in, const CodeWord& w) {
    start_compensation(in, w.code, w.block, w.column);
    return true;
}
bool keep_reference(Interpreter& in, const CodeWord& w) {
    keep_reference(in.state_, in.this_block_, w.code);
    return true;
}

constexpr auto codes = std::to_array<CodeRule>({
    {5_g, set_motion<MotionMode::cubic_spline>},
    {5.1_g, set_motion<MotionMode::quadratic_spline>},
    {5.2_g, set_motion<MotionMode::nurbs>},
    {5.3_g,
     [](Interpreter& in, const CodeWord&) {
         nurbs_end(in);
         return true;
     }},
    {6.2_g, set_motion<MotionMode::knotted_nurbs>},
    {7_g, set_diameter},
    {8_g, set_diameter},
    {10_g,
     [](Interpreter& in, const CodeWord& w) {
         set_offsets(in, w.block);
         return true;
     }},
    {28.1_g, keep_reference},
    {30.1_g, keep_reference},
    {33.1_g, set_motion<MotionMode::tap>},
    {38.2_g, set_motion<MotionMode::probe>},
    {38.3_g, set_motion<MotionMode::probe>},
    {38.4_g, set_motion<MotionMode::probe>},
    {38.5_g, set_motion<MotionMode::probe>},
    {40_g,
     [](Interpreter& in, const CodeWord&) {
         stop_compensation(in);
         return true;
     }},
    {41_g, compensate},
    {41.1_g, compensate},
    {42_g, compensate},
    {42.1_g, compensate},
    {61_g,
     [](Interpreter& in, const CodeWord& w) {
         return path_mode_word(in, w, {BlockEnd::exact_path, 0});
     }},
    {61.1_g,
     [](Interpreter& in, const CodeWord& w) {
         return path_mode_word(in, w, {BlockEnd::exact_stop, 0});
     }},
    {64_g, [](Interpreter& in, const CodeWord& w) { return rounded_corners(in, w); }},
    {70_g, lathe_cycle},
    {71_g, lathe_cycle},
    {71.1_g, lathe_cycle},
    {71.2_g, lathe_cycle},
    {72_g, lathe_cycle},
    {72.1_g, lathe_cycle},
    {72.2_g, lathe_cycle},
});

bool keep_modes(Interpreter& in, int code, const Block&) {
    keep_modes(in, code);
    return true;
}
constexpr auto m_codes = std::to_array<MRule>({
    {70, keep_modes},
    {71, keep_modes},
    {72, keep_modes},
    {73, keep_modes},
    {98,
     [](Interpreter& in, int, const Block& block) {
         call_by_number(in, block, 0, false);  // L0 calls nothing
         return true;
     }},
    {99,
     [](Interpreter& in, int, const Block& block) {
         return_to_block(in, block);
         return true;
     }},
});

/// Codes without a meaning, or with another one, while the tool path differs from the programmed path.
constexpr auto forbidden_in_compensation = std::to_array<int>(
    {5_g,    5.1_g,  5.2_g,  6.2_g,  28_g, 28.1_g, 30_g,   30.1_g, 33_g,   33.1_g, 38.2_g, 38.3_g, 38.4_g,
     38.5_g, 43_g,   43.1_g, 43.2_g, 49_g, 52_g,   53_g,   54_g,   55_g,   56_g,   57_g,   58_g,   59_g,
     59.1_g, 59.2_g, 59.3_g, 70_g,   71_g, 71.1_g, 71.2_g, 72_g,   72.1_g, 72.2_g, 73_g,   74_g,   76_g,
     81_g,   82_g,   83_g,   84_g,   85_g, 86_g,   87_g,   88_g,   89_g,   92_g});

std::string work_system_name(int number) { return fmt::format("G59.{}", number - 6); }

constexpr auto word_signs = std::to_array<WordSign>({{"EXISTS", 8}});
constexpr auto code_signs = std::to_array<CodeSign>(
    {{64_g, 6, "P", ""},  {5_g, 6, "IJQ", ""}, {5.1_g, 6, "IJ", "Q"}, {5.2_g, 8, "", ""},  {5.3_g, 8, "", ""},
     {6.2_g, 8, "Q", ""}, {33.1_g, 5, "", ""}, {38.2_g, 4, "", ""},   {38.3_g, 4, "", ""}, {38.4_g, 4, "", ""},
     {38.5_g, 4, "", ""}, {41.1_g, 4, "", ""}, {42.1_g, 4, "", ""},   {43.1_g, 3, "", ""}, {61_g, 2, "", ""},
     {61.1_g, 2, "", ""}, {90.1_g, 3, "", ""}, {91.1_g, 3, "", ""},   {92.1_g, 3, "", ""}, {92.2_g, 3, "", ""},
     {92.3_g, 3, "", ""}, {28.1_g, 3, "", ""}, {30.1_g, 3, "", ""}});
constexpr auto ending_signs = std::to_array<EndingSign>({{".ngc", 4}});
constexpr auto mark_signs = std::to_array<MarkSign>({{Mark::polar_sign, 6},
                                                     {Mark::active_comment, 6},
                                                     {Mark::hash_name, 10},
                                                     {Mark::output_m, 2},
                                                     {Mark::state_m, 2},
                                                     {Mark::o_name, 10},
                                                     {Mark::o_statement, 10}});

// src/emc/rs274ngc/interp_internal.hh: CENTER_ARC_RADIUS_TOLERANCE_INCH and _MM, RADIUS_TOLERANCE_INCH.
constexpr ArcTolerance tolerance_of(double least) {
    const double absolute = 2 * std::numbers::sqrt2 * least;
    return {.absolute = absolute, .relative = 1e-3, .most = 100 * absolute, .reach = 5e-5 * mm_per_inch};
}

}  // namespace
}  // namespace rs274

const DialectRules linuxcnc_rules{
    .text = {.blanks_in_numbers = true,
             .skip_levels = false,
             .splines = SplineForm::cubic_plane,
             .polar_signs = true,
             .repeated_words = false,
             .assigns_expressions = false,
             .divided_arc_tangent = true,
             .exact_comparison = true,
             .positive_modulo = true,
             .numbered_parameters = 5602,
             .control = rs274::read_control},
    .codes = rs274::codes,
    .m_codes = rs274::m_codes,
    .motion = {.needs_mode = true,
               .moves_without_axes = true,
               .rotary_in_machine = true,
               .turns_by_p = true,
               .feed_keeps_unit = true,
               .separate_uvw = true,
               .splines_by_last_block = true,
               .forbidden_in_compensation = rs274::forbidden_in_compensation},
    .tools = {.m61 = true, .always_looks_up = true, .length_of = LengthOf::tool_in_spindle},
    .offsets = {.rotary = true, .rotation = true, .tool_data = true, .always_by_point = true},
    .cycles = {.rs274 = true},
    .calls = {.by_sub = true, .label_if_no_sub = true, .returns_value = true},
    .arc_tolerance = rs274::tolerance_of(0.01),
    .arc_tolerance_inch = rs274::tolerance_of(0.001 * mm_per_inch),
    .signs = {.words = rs274::word_signs,
              .codes = rs274::code_signs,
              .endings = rs274::ending_signs,
              .marks = rs274::mark_signs},
    .begin = rs274::begin,
    .after_motion = [](Interpreter& in, const Block& block) { read_machine_position(in, block); },
    .parameter = rs274::numbered_parameter,
    .named_parameter = rs274::named_parameter,
    .work_system_name = rs274::work_system_name,
};

const Dialect linuxcnc_dialect{"linuxcnc", "LinuxCNC: RS274/NGC with O-words and named parameters", &linuxcnc_rules};

}  // namespace clsurf

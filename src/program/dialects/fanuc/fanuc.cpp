// The rules of Fanuc and HNC: the meaning of their codes and control statements. Longer handlers are in
// fanuc_words.cpp. Facts: Fanuc, operator's manual of the series 30i (B-63944EN).

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "program/dialects/fanuc/fanuc_words.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/codes.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/offsets.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tilted_plane.h"

namespace clsurf {
namespace fanuc {
namespace {

constexpr double undefined = missing<double>;

/// The digits of v in one base, read in another base; undefined if a double cannot represent them exactly.
double digits_again(double v, std::uint64_t base, double other) {
    constexpr double most = 1e15;
    if (!(v >= 0 && v < most)) return undefined;
    double value = 0;
    double place = 1;
    for (auto rest = static_cast<std::uint64_t>(v); rest > 0; rest /= base, place *= other)
        value += static_cast<double>(rest % base) * place;
    return value;
}
/// Fanuc stores each digit in four bits: 18 is binary 0001'0010 in BCD. BIN reads it as 12.
double from_decimal_digits(double v) { return digits_again(v, 16, 10); }
double to_decimal_digits(double v) { return digits_again(v, 10, 16); }
constexpr std::array<FunctionRow, 2> functions{{{"BIN", from_decimal_digits}, {"BCD", to_decimal_digits}}};
constexpr auto of_arguments =
    std::to_array<ArgumentsRow>({{"POW", 2, [](const std::vector<double>& v) { return std::pow(v[0], v[1]); }}});

/// O1000 and :1000.
Control program_number(std::string_view statement) {
    Cursor c{statement, 0};
    Control control;
    const char first = upper(c.peek());
    if (first != 'O' && first != ':') return control;
    ++c.at;
    control.label = number_label(c);
    if (control.label.empty()) control.label = "0";
    control.kind = ControlKind::label;
    control.rest = c.at;
    return control;
}

Control read_control(std::string_view statement) {
    Control control = program_number(statement);
    if (control.kind != ControlKind::none) return control;
    Cursor c{statement, 0};
    const std::string id = c.identifier();
    if (id.empty()) return control;
    if (id == "IF") {
        c.take_word("IF");
        control.rest = c.at;
        std::size_t at = find_control_word(statement, "GOTO", c.at);
        if (at != std::string_view::npos) {
            control.kind = ControlKind::if_go_to;
            control.target = at + 4;
            Cursor target{statement, at + 4};
            control.label = number_label(target);
            return control;
        }
        at = find_control_word(statement, "THEN", c.at);
        if (at == std::string_view::npos) throw ReadError{"expected GOTO or THEN after IF […]", c.column(), {}};
        control.kind = ControlKind::if_then;
        control.target = at + 4;
        return control;
    }
    if (id.starts_with("GOTO")) {
        c.skip_blanks();
        c.at += 4;
        control.kind = ControlKind::go_to;
        control.target = c.at;
        control.label = number_label(c);
        return control;
    }
    if (id == "WHILE") {
        c.take_word("WHILE");
        control.rest = c.at;
        const std::size_t at = find_control_word(statement, "DO", c.at);
        if (at == std::string_view::npos) throw ReadError{"expected DO after WHILE […]", c.column(), {}};
        control.kind = ControlKind::while_begin;
        Cursor target{statement, at + 2};
        control.label = number_label(target);
        return control;
    }
    const auto numbered = [&](std::string_view word) {
        return id.starts_with(word) && id.find_first_not_of("0123456789", word.size()) == std::string::npos;
    };
    if (numbered("DO")) {
        c.skip_blanks();
        c.at += 2;
        control.kind = ControlKind::while_begin;
        control.label = number_label(c);
        control.rest = std::string_view::npos;  // no condition
    } else if (numbered("END")) {
        c.skip_blanks();
        c.at += 3;
        control.kind = ControlKind::while_end;
        control.label = number_label(c);
    }
    return control;
}

/// G7.1 C0 ends cylindrical interpolation.
bool has_rotary_word(const Block& block) {
    return std::any_of(std::begin("ABC"), std::end("ABC") - 1,
                       [&](char letter) { return block.words.given(letter) && block.words.of(letter) != 0; });
}

// Codes.
bool refuse_curves(Interpreter& in, const CodeWord& w) {
    refuse_motion(in, code_text(w.code), w.block, w.column, "involutes and exponential curves are not supported");
}
bool refuse_rotary_interpolation(Interpreter& in, const CodeWord& w) {
    refuse_motion(
        in, code_text(w.code), w.block, w.column,
        "cylindrical and polar coordinate interpolation are not supported: X, Y and C mean something else there");
}
bool interpolate_on_cylinder(Interpreter& in, const CodeWord& w) {
    if (has_rotary_word(w.block)) return refuse_rotary_interpolation(in, w);
    in.this_block_.motion_suppressed = true;
    return true;
}
bool ignore(Interpreter&, const CodeWord&) { return true; }
bool dwell(Interpreter& in, const CodeWord& w) {
    // X and U belong to the dwell and count seconds, P milliseconds.
    const Words& words = w.block.words;
    in.this_block_.motion_suppressed = true;
    in.dwell(words.given('P')   ? words.of('P') / 1000
             : words.given('U') ? words.of('U')
             : words.given('X') ? words.of('X')
                                : 0);
    return true;
}
/// Return check, return from the reference point, unidirectional positioning: a rapid to the end.
bool go_at_rapid(Interpreter& in, const CodeWord& w) {
    in.straight(MotionKind::rapid, target_of(in, w.block, in.this_block_.machine_coordinates),
                rotary_target(in, w.block));
    in.this_block_.motion_suppressed = true;
    in.event("mode", code_text(w.code));
    return true;
}
bool skip(Interpreter& in, const CodeWord&) {
    in.this_block_.probes = true;
    return true;
}
bool high_speed(Interpreter& in, const CodeWord& w) {
    Words& words = w.block.words;
    const bool moves = (words.has & Words::xyz) != 0;
    if (w.code < 8_g && moves)
        refuse_motion(in, code_text(w.code), w.block, w.column,
                      code_text(w.code) + " with coordinates is a spline of linuxcnc: --dialect linuxcnc");
    in.event("high-speed", code_text(w.code) + words_text(w.block, "PQR"));
    in.this_block_.motion_suppressed = !moves;
    words.has &= ~(Words::bit('P') | Words::bit('Q') | Words::bit('R'));
    return true;
}
bool start_nurbs(Interpreter& in, const CodeWord&) {
    in.state_.motion = MotionMode::knotted_nurbs;
    return true;
}
bool set_data(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    if (words.given('L') && words.of('L') >= 50) state_of(in).data_entry = true;
    const int level = words.given('L') ? static_cast<int>(std::clamp(words.of('L'), -1e6, 1e6)) : 0;
    in.this_block_.motion_suppressed = true;
    if (!set_offsets(in, level, w.block)) set_offsets(in, w.block);
    return true;
}
bool end_data(Interpreter& in, const CodeWord&) {
    state_of(in).data_entry = false;
    return true;
}
bool end_polar(Interpreter& in, const CodeWord&) {
    in.polar_.on = false;
    return true;
}
bool start_polar(Interpreter& in, const CodeWord&) {
    in.polar_.on = true;
    in.polar_.radius = in.polar_.angle = 0;
    in.polar_.pole = Vec3::Zero();
    in.event("polar", "G16");
    return true;
}
bool mirror(Interpreter& in, const CodeWord& w) {
    mirror_frame(in, w.code, w.block);
    return true;
}
bool end_scaling(Interpreter& in, const CodeWord& w) {
    state_of(in).frame.scaling = {};
    in.state_.frame = state_of(in).frame.all();
    in.event("scaling", "G50" + words_text(w.block, "S"));
    return true;
}
bool turn_polygon(Interpreter& in, const CodeWord& w) {
    in.note(Severity::warning, "program.polygon", code_text(w.code) + " is not carried out", w.column);
    return true;
}
bool scale(Interpreter& in, const CodeWord& w) {
    scale_frame(in, w.block);
    return true;
}
bool set_local_zero(Interpreter& in, const CodeWord& w) {
    count_from_local_zero(in, w.block);
    return true;
}
bool set_extended_system(Interpreter& in, const CodeWord& w) {
    if (!w.block.words.given('P') || w.block.words.has_g(65_g) || w.block.words.has_g(66_g)) return false;
    select_work_system(in, plain_work_systems + static_cast<int>(std::clamp(w.block.words.of('P'), 1.0, 300.0)));
    return true;
}
bool start_modal_macro(Interpreter& in, const CodeWord& w) {
    const Words& words = w.block.words;
    in.modal_call_ = {.active = true,
                      .name = fmt::format("{}", macro_program(in, w.block, w.code, w.column)),
                      .repeats = words.given('L') ? static_cast<int>(std::clamp(words.of('L'), 1.0, 99999.0)) : 1,
                      .arguments = macro_arguments(w.block),
                      .level = in.calls_.frames.size(),
                      .column = w.column};
    if (w.code == 66.1_g)
        in.note(Severity::warning, "program.modal-macro", "G66.1 is read as G66: called after blocks that move",
                w.column);
    in.this_block_.motion_suppressed = true;
    return true;
}
bool end_modal_macro(Interpreter& in, const CodeWord&) {
    in.modal_call_ = {};
    return true;
}
bool rotate(Interpreter& in, const CodeWord& w) {
    rotate_frame(in, w.block, w.column);
    return true;
}
bool tilt(Interpreter& in, const CodeWord& w) {
    tilt_plane(in, w.block, w.column);
    return true;
}
bool turn_to_plane(Interpreter& in, const CodeWord& w) {
    if (!in.five_axis_.tilted)
        in.note(Severity::warning, "program.rotation",
                code_text(w.code) + " without a tilted plane (G68.2) does nothing", w.column);
    else
        turn_to_plane(in, state_of(in).frame.rotation.direction_to_work(Vec3::UnitZ()), w.code == 53.6_g,
                      code_text(w.code));
    return true;
}
bool tilt_otherwise(Interpreter& in, const CodeWord& w) {
    in.note(Severity::warning, "program.rotation",
            code_text(w.code) + ": the tilted plane is not carried out, the path is read as programmed", w.column);
    in.this_block_.motion_suppressed = true;
    return true;
}
bool end_rotation(Interpreter& in, const CodeWord& w) {
    state_of(in).frame.rotation = {};
    state_of(in).frame.angle = 0;
    in.state_.frame = state_of(in).frame.all();
    in.event("rotation", code_text(w.code));
    end_tilted_plane(in, code_text(w.code));
    return true;
}
bool note_mode(Interpreter& in, const CodeWord& w) {
    in.event("mode", code_text(w.code) + words_text(w.block, "PQHDR"));
    in.this_block_.motion_suppressed = w.code == 22_g;
    return true;
}
bool stop_exactly(Interpreter& in, const CodeWord& w) {
    return path_mode_word(in, w, {BlockEnd::exact_stop, 0}, w.code == 9_g);
}
bool round_in_corners(Interpreter& in, const CodeWord& w) { return path_mode_word(in, w, {BlockEnd::exact_path, 0}); }
bool round_within_tolerance(Interpreter& in, const CodeWord& w) { return rounded_corners(in, w); }

constexpr auto codes = std::to_array<CodeRule>({
    {1.2_g, refuse_curves},
    {2.2_g, refuse_curves},
    {2.3_g, refuse_curves},
    {3.2_g, refuse_curves},
    {3.3_g, refuse_curves},
    {4_g, dwell},
    {5_g, high_speed},
    {5.1_g, high_speed},
    {6.2_g, start_nurbs},
    {7.1_g, interpolate_on_cylinder},
    {8_g, high_speed},
    {8.1_g, high_speed},
    {9_g, stop_exactly},
    {10_g, set_data},
    {11_g, end_data},
    {12.1_g, refuse_rotary_interpolation},
    {12.5_g, note_mode},
    {13.1_g, ignore},
    {13.5_g, note_mode},
    {15_g, end_polar},
    {16_g, start_polar},
    {22_g, note_mode},
    {23_g, note_mode},
    {24_g, mirror},
    {25_g, mirror},
    {26_g, note_mode},
    {27_g, go_at_rapid},
    {29_g, go_at_rapid},
    {31_g, skip},
    {40.5_g, note_mode},
    {50_g, end_scaling},
    {50.1_g, mirror},
    {50.2_g, turn_polygon},
    {51_g, scale},
    {51.1_g, mirror},
    {51.2_g, turn_polygon},
    {52_g, set_local_zero},
    {53.1_g, turn_to_plane},
    {53.4_g, note_mode},
    {53.5_g, note_mode},
    {53.6_g, turn_to_plane},
    {54_g, set_extended_system},
    {54.5_g, note_mode},
    {60_g, go_at_rapid},
    {60.1_g, note_mode},
    {61_g, stop_exactly},
    {61.1_g, round_in_corners},
    {62_g, note_mode},
    {63_g, note_mode},
    {64_g, round_within_tolerance},
    {66_g, start_modal_macro},
    {66.1_g, start_modal_macro},
    {67_g, end_modal_macro},
    {68_g, rotate},
    {68.2_g, tilt},
    {68.3_g, tilt_otherwise},
    {68.4_g, tilt_otherwise},
    {69_g, end_rotation},
    {69.1_g, end_rotation},
    {107_g, interpolate_on_cylinder},
    {112_g, refuse_rotary_interpolation},
    {113_g, ignore},
});

constexpr auto m_codes = std::to_array<MRule>({
    {98,
     [](Interpreter& in, int, const Block& block) {
         call_by_number(in, block, 1, true);
         return true;
     }},
    {99,
     [](Interpreter& in, int, const Block& block) {
         return_to_block(in, block);
         return true;
     }},
});

constexpr const char* spirals = "spirals of several turns are not supported";
constexpr auto refused_at_arcs = std::to_array<RefusedLetter>(
    {{'P', "turns are P in linuxcnc: --dialect linuxcnc"}, {'L', spirals}, {'Q', spirals}});

/// G11 ends data; between G10 L50 and G11 nothing else is executed. G65 uses the whole block.
bool begin_block(Interpreter& in, Block& block) {
    if (state_of(in).data_entry && !is_data_end(in, block)) return true;
    if (!block.words.has_g(65_g)) return false;
    macro_call(in, block);
    return true;
}

bool call_modal_macro(Interpreter& in) {
    const ModalCall called = in.modal_call_;
    call_subprogram(in, called.name, called.repeats, true, called.arguments);
    return true;
}

/// G16: the first axis of the plane is the radius, the second the angle. The pole is the work zero, or the present position
/// if the radius is incremental. (Fanuc, Operator's Manual, "Polar coordinate command".)
void move_about_pole(Interpreter& in, const Block& block, Vec3& end) {
    const ModalState& state = in.state_;
    const Vec3 from = end.array().isNaN().select(0.0, end);
    straight_to_pole_plane(in.state_, block, from, end);
    const char radius = "XYZ"[(state.plane_axis + 1) % 3];
    const char angle = "XYZ"[(state.plane_axis + 2) % 3];
    if (!block.words.given(radius) && !block.words.given(angle)) return;
    PolarState& polar = in.polar_;
    if (block.words.given(radius)) {
        polar.radius = block.words.of(radius) * state.unit_mm;
        polar.pole = state.incremental ? from : Vec3(Vec3::Zero());
    }
    if (block.words.given(angle)) polar.angle = block.words.of(angle) + (state.incremental ? polar.angle : 0.0);
    put_at_pole(in.polar_, in.state_.plane_axis, end);
}

constexpr auto code_signs = std::to_array<CodeSign>({{5_g, 8, "P", "IJQXYZ"},
                                                     {5.1_g, 8, "Q", ""},
                                                     {8_g, 6, "P", ""},
                                                     {43.4_g, 6, "", ""},
                                                     {43.5_g, 6, "", ""},
                                                     {53.1_g, 4, "", ""},
                                                     {54.1_g, 4, "P", ""},
                                                     {68.2_g, 6, "", ""},
                                                     {51.1_g, 3, "", ""},
                                                     {50.1_g, 3, "", ""},
                                                     {6.2_g, 6, "", ""},
                                                     {65_g, 6, "P", ""},
                                                     {66_g, 6, "P", ""},
                                                     {7.1_g, 4, "", ""},
                                                     {12.1_g, 4, "", ""},
                                                     {68_g, 4, "R", ""},
                                                     {16_g, 2, "", ""},
                                                     {51_g, 3, "PIJK", ""}});
constexpr auto mark_signs = std::to_array<MarkSign>({{Mark::comma_corner, 4},
                                                     {Mark::free_assignment, 4},
                                                     {Mark::subprogram_m, 2},
                                                     {Mark::o_number, 3},
                                                     {Mark::jump_to_block, 8},
                                                     {Mark::bracketed_if, 8}});

}  // namespace
}  // namespace fanuc

const DialectRules fanuc_rules{
    .text = {.splines = SplineForm::knotted,
             .counts_centres = true,
             .functions_after_words = false,
             .ranks = OperatorRanks::fanuc,
             .vacant_variables = true,
             .bitwise_logic = true,
             .rounds_to_increment = true,
             .functions = fanuc::functions,
             .of_arguments = fanuc::of_arguments,
             .control = fanuc::read_control},
    .codes = fanuc::codes,
    .m_codes = fanuc::m_codes,
    .motion = {.refused_at_arcs = fanuc::refused_at_arcs},
    .tools = {.radius_by_d = true, .length_of = LengthOf::row_of_h},
    .cycles = {.dwell_unit = 0.001, .repeats_by_k = true},
    .calls = {.begins_at_label = true, .second_name_ends = true, .jumps_to_numbers = true},
    // Parameter 3410 differs from machine to machine.
    .arc_tolerance = {.absolute = 0.03, .relative = 1e-3, .most = 0.5, .reach = 0.005, .relative_reach = 1e-3},
    .signs = {.codes = fanuc::code_signs, .marks = fanuc::mark_signs},
    .make_state = make_state<fanuc::State>,
    .begin_block = fanuc::begin_block,
    .modal_call = fanuc::call_modal_macro,
    .parameter = [](Interpreter& in, int number) { return fanuc::parameter(in, number); },
    .write_parameter = [](Interpreter& in, int number,
                          double value) { return fanuc::write_parameter(in, number, value); },
    .about_pole = fanuc::move_about_pole,
};

const Dialect fanuc_dialect{"fanuc", "Fanuc, HNC and most others: G-code with custom macro B", &fanuc_rules};

}  // namespace clsurf

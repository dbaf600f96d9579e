// Facts: Fanuc, operator's manual of the series 30i (B-63944EN).

#include "program/dialects/fanuc/fanuc_words.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "program/interpret/compensated_motions.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/offsets.h"
#include "program/interpret/tilted_plane.h"

namespace clsurf::fanuc {
namespace {

constexpr double most_factor = 50;  ///< above it a factor of G51 is in thousandths
constexpr double full_turn = 360;   ///< above it an angle of G68 is in thousandths

/// Every I, J and K of a block in its order; a block of plain words has each at most once and does not keep the order.
std::vector<CentreWord> centres_of(const Block& block) {
    std::vector<CentreWord> centres = block.centres;
    if (!centres.empty()) return centres;
    for (const char letter : {'I', 'J', 'K'}) {
        if (block.words.given(letter))
            centres.push_back(
                {letter, block.words.of(letter), block.words.column[static_cast<std::size_t>(letter - 'A')]});
    }
    std::sort(centres.begin(), centres.end(),
              [](const CentreWord& a, const CentreWord& b) { return a.column < b.column; });
    return centres;
}

double factor_of(double value) { return std::abs(value) > most_factor ? value / 1000 : value; }

/// The coordinates of a frame's centre: as given, else the present position.
Vec3 frame_centre(const Interpreter& in, const Block& block, const Vec3& now) {
    Vec3 centre = now.array().isNaN().select(0.0, now);
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("XYZ"[k])) continue;
        const double value = block.words.of("XYZ"[k]) * in.state_.unit_mm;
        centre[k] = in.state_.incremental ? centre[k] + value : value;
    }
    return centre;
}

/// Work offsets by variable: #5221 … G54, #5241 … G55, #7001 … G54.1 P1.
WorkOffset* offset_of_variable(Interpreter& in, int number, int& axis) {
    constexpr int per_system = 20;
    const auto found = [&](int first, int systems, int first_system) -> WorkOffset* {
        if (number < first || number >= first + systems * per_system) return nullptr;
        axis = (number - first) % per_system;
        return axis < 3 ? &in.state_.work_offsets.by_system[first_system + (number - first) / per_system] : nullptr;
    };
    if (WorkOffset* offset = found(5221, 6, 1)) return offset;
    return found(7001, 48, plain_work_systems + 1);
}

}  // namespace

/// G68 X Y R in the plane, or X Y Z I J K R about an axis. The centre is in scaled coordinates.
void rotate_frame(Interpreter& in, const Block& block, std::size_t column) {
    in.this_block_.motion_suppressed = true;
    const Words& w = block.words;
    if (!w.given('R')) in.fail("G68 needs the angle (R)", column);
    double angle = w.of('R');
    if (std::abs(angle) > full_turn) angle /= 1000;
    const ProgramFrame inner = state_of(in).frame.scaling.around(state_of(in).frame.mirror);
    const Vec3 centre = inner.to_work(frame_centre(in, block, in.state_.programmed()));
    Vec3 axis = Vec3::Unit(in.state_.plane_axis);
    const bool about_an_axis = w.given('I') || w.given('J') || w.given('K');
    if (about_an_axis) {
        for (int k = 0; k < 3; ++k) axis[k] = w.given("IJK"[k]) ? w.of("IJK"[k]) : 0.0;
        if (axis.isZero()) in.fail("G68: I J K give no direction", column);
    }
    state_of(in).frame.angle = in.state_.incremental && !about_an_axis ? state_of(in).frame.angle + angle : angle;
    state_of(in).frame.rotation = ProgramFrame::turned(axis, state_of(in).frame.angle, centre);
    in.state_.frame = state_of(in).frame.all();
    in.event("rotation", "G68" + words_text(block, "XYZIJKR"));
}

/// G51 X Y Z P, or I J K for each axis; negative: mirrored.
void scale_frame(Interpreter& in, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const Words& w = block.words;
    Vec3 factors = Vec3::Constant(w.given('P') ? factor_of(w.of('P')) : 1.0);
    if (!w.given('P')) {
        for (int k = 0; k < 3; ++k) factors[k] = w.given("IJK"[k]) ? factor_of(w.of("IJK"[k])) : 1.0;
    }
    if ((factors.array() == 0).any()) in.fail("G51: a factor of 0");
    const Vec3 centre = frame_centre(in, block, state_of(in).frame.mirror.to_work(in.state_.programmed()));
    state_of(in).frame.scaling = ProgramFrame::scaled(factors, centre);
    in.state_.frame = state_of(in).frame.all();
    in.event("scaling", "G51" + words_text(block, "XYZIJKP"));
}

/// G51.1 and G50.1 (HNC: G24, G25): mirror about X, Y, Z as given.
void mirror_frame(Interpreter& in, int code, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const bool on = code == 51.1_g || code == 24_g;
    const bool all = !on && (block.words.has & Words::xyz) == 0;
    for (int k = 0; k < 3; ++k) {
        if (!all && !block.words.given("XYZ"[k])) continue;
        state_of(in).mirrored[k] = on;
        if (on) state_of(in).mirror_at[k] = block.words.of("XYZ"[k]) * in.state_.unit_mm;
    }
    Vec3 factors = Vec3::Ones();
    for (int k = 0; k < 3; ++k) {
        if (state_of(in).mirrored[k]) factors[k] = -1;
    }
    state_of(in).frame.mirror = ProgramFrame::scaled(factors, state_of(in).mirror_at);
    in.state_.frame = state_of(in).frame.all();
    in.event("mirror", code_text(code) + words_text(block, "XYZ"));
}

/// G52: a local zero in every work system.
void count_from_local_zero(Interpreter& in, const Block& block) {
    in.this_block_.motion_suppressed = true;
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("XYZ"[k])) continue;
        const double value = block.words.of("XYZ"[k]) * in.state_.unit_mm;
        state_of(in).local_zero[k] = in.state_.incremental ? state_of(in).local_zero[k] + value : value;
    }
    state_of(in).frame.local = ProgramFrame::moved(state_of(in).local_zero);
    in.state_.frame = state_of(in).frame.all();
    in.event("local-zero", "G52" + words_text(block, "XYZ"));
}

long macro_program(const Interpreter& in, const Block& block, int code, std::size_t column) {
    if (!block.words.given('P')) in.fail(code_text(code) + " needs the program's number (P)", column);
    return static_cast<long>(std::clamp(block.words.of('P'), 0.0, 99999999.0));
}

/// #1 … #33 of a macro call; NaN: not given. Repeated or reordered I, J and K continue the numbering: the second I is
/// #7 (argument specification II). If two words set the same variable, the later one counts.
std::vector<double> macro_arguments(const Block& block) {
    static constexpr std::pair<char, std::size_t> numbers[] = {
        {'A', 1},  {'B', 2},  {'C', 3},  {'D', 7},  {'E', 8},  {'F', 9},  {'H', 11}, {'Q', 17}, {'R', 18},
        {'S', 19}, {'T', 20}, {'U', 21}, {'V', 22}, {'W', 23}, {'X', 24}, {'Y', 25}, {'Z', 26}};
    constexpr std::size_t number_of_m = 13, first_of_centres = 4, last = 33;
    std::vector<double> arguments(last, missing<double>);
    std::array<std::size_t, last> columns{};
    const auto pass = [&](std::size_t number, double value, std::size_t column) {
        if (number > last || columns[number - 1] > column) return;
        arguments[number - 1] = value;
        columns[number - 1] = column;
    };
    for (const auto& [letter, number] : numbers) {
        if (block.words.given(letter))
            pass(number, block.words.of(letter), block.words.column[static_cast<std::size_t>(letter - 'A')]);
    }
    if (block.words.m_count > 0) pass(number_of_m, block.words.m[0], 0);
    std::size_t group = 0;
    char before = 0;
    for (const CentreWord& word : centres_of(block)) {
        if (word.letter <= before) ++group;
        before = word.letter;
        pass(first_of_centres + 3 * group + static_cast<std::size_t>(word.letter - 'I'), word.value, word.column);
    }
    return arguments;
}

/// Between G10 L50 and G11 the lines are parameters of the control.
bool is_data_end(Interpreter& in, const Block& block) {
    if (block.words.has_g(11_g)) return true;
    in.event("data-entry", std::string(in.place_.text.substr(0, 80)));
    return false;
}

/// G65: nothing else in the block is executed; its words are arguments.
void macro_call(Interpreter& in, const Block& block) {
    const int repeats = block.words.given('L') ? static_cast<int>(std::clamp(block.words.of('L'), 1.0, 99999.0)) : 1;
    call_subprogram(in, fmt::format("{}", macro_program(in, block, 65_g, 0)), repeats, true, macro_arguments(block));
}

/// G10 of Fanuc: L2 and L20 set work offsets, L10 … L13 tools; G90 sets, G91 adds.
bool set_offsets(Interpreter& in, int level, const Block& block) {
    const Words& w = block.words;
    const bool adds = in.state_.incremental;
    if (level == 2 || level == 20) {
        const int number = w.given('P') ? static_cast<int>(std::clamp(w.of('P'), 0.0, 300.0)) : 0;
        if (level == 2 && number == 0) {
            in.event("work-offset",
                     "G10 L2 P0" + words_text(block, "XYZ"));  // shifts all systems alike, on the machine
            return true;
        }
        const int system = level == 20 ? plain_work_systems + number : number;
        Vec3 shift = in.state_.work_offsets.by_system[system].shift;
        for (int k = 0; k < 3; ++k) {
            if (!w.given("XYZ"[k])) continue;
            const double value = w.of("XYZ"[k]) * in.state_.unit_mm;
            shift[k] = adds ? shift[k] + value : value;
        }
        in.state_.rebase([&] {
            WorkOffset& offset = in.state_.work_offsets.by_system[system];
            offset.shift = shift;
            if (!adds) offset.set = static_cast<std::uint8_t>(offset.set | axes_named(w));
        });
        return true;
    }
    const bool of_tool = level == 0 || level == 1 || (level >= 10 && level <= 13);
    if (of_tool && w.given('P') && w.given('R')) {
        Tool& tool = in.tools_.table.tools[static_cast<int>(std::clamp(w.of('P'), 0.0, 1e6))];
        const double value = w.of('R') * in.state_.unit_mm;
        const bool wear = level == 11 || level == 13;
        if (level == 12 || level == 13)
            tool.diameter = (adds || wear ? tool.diameter : 0.0) + 2 * value;
        else
            tool.offset.z() = (adds || wear ? tool.offset.z() : 0.0) + value;
    }
    return false;
}

/// The effect of writing a variable of the control. Returns whether it was one.
bool write_parameter(Interpreter& in, int number, double value) {
    if (number < 1000) return false;
    int axis = 0;
    if (offset_of_variable(in, number, axis) != nullptr) {
        in.state_.rebase([&] {
            WorkOffset& offset = *offset_of_variable(in, number, axis);
            offset.shift[axis] = value * in.state_.unit_mm;
            offset.set = static_cast<std::uint8_t>(offset.set | (1u << axis));
        });
        return true;
    }
    if (number == 3000) {
        in.note(Severity::warning, "program.alarm", fmt::format("the program raises alarm {:g} and ends here", value));
        in.event("end", fmt::format("#3000={:g}", value));
        in.ended_ = true;
        return true;
    }
    if (number == 3006) {
        in.event("stop", fmt::format("#3006={:g}", value));
        return true;
    }
    return false;
}

double parameter(Interpreter& in, int number) {
    const Vec3 at = tool_position(in.compensation_, in.state_);
    const Vec3 known = at.array().isNaN().select(0.0, at);
    const double unit = in.state_.unit_mm;
    const auto axis_of = [&](int first, const Vec3& lengths) {
        const int k = number - first;
        return k < 3 ? lengths[k] / unit : in.state_.rotary[k - 3];
    };
    for (const int first : {5001, 5041}) {
        if (number >= first && number < first + 6) return axis_of(first, in.state_.frame.to_programmed(known));
    }
    if (number >= 5021 && number < 5027) return axis_of(5021, in.state_.to_machine(known));
    const auto offset = [&](int first, int first_system) {
        const int axis = (number - first) % 20;
        return axis > 2 ? 0.0 : in.state_.work_offsets.of(first_system + (number - first) / 20).shift[axis] / unit;
    };
    if (number >= 5221 && number < 5341) return offset(5221, 1);
    if (number >= 7001 && number < 7961) return offset(7001, plain_work_systems + 1);
    switch (number) {
        case 4001:
            return in.state_.motion == MotionMode::rapid ? 0
                   : in.state_.motion == MotionMode::cw  ? 2
                   : in.state_.motion == MotionMode::ccw ? 3
                                                         : 1;
        case 4002: return 17 + (2 - in.state_.plane_axis);
        case 4003: return in.state_.incremental ? 91 : 90;
        case 4005:
            return in.state_.feed_mode == FeedMode::inverse_time ? 93
                   : in.state_.feed_mode == FeedMode::per_minute ? 94
                                                                 : 95;
        case 4006: return unit == 1 ? 21 : 20;
        case 4009: return in.state_.cycle > 0 && in.state_.motion == MotionMode::cycle ? in.state_.cycle / 10 : 80;
        case 4010: return in.state_.retract_to_r ? 99 : 98;
        case 4014:
            return in.state_.work_offsets.system <= plain_work_systems ? 53 + in.state_.work_offsets.system : 54.1;
        case 4109: return in.state_.feed;
        case 4119: return in.state_.spindle;
        case 4120: return in.tools_.next;
        default: break;
    }
    if (number >= 1000 && !in.variables_.has(number)) in.this_block_.unknown_parameter = number;
    return missing<double>;
}

/// G68.2 X Y Z I J K: the plane's zero and its Euler angles, about Z, the new X and the new Z; with P1 Q the angles
/// are those about X, Y and Z of the work system, in the order given by Q.
void tilt_plane(Interpreter& in, const Block& block, std::size_t column) {
    in.this_block_.motion_suppressed = true;
    const Words& w = block.words;
    const auto refuse = [&](const std::string& what) {
        in.note(Severity::warning, "program.rotation",
                what + ": this tilted plane is not carried out, the path is read as programmed", column);
    };
    const int form = w.given('P') ? static_cast<int>(std::clamp(w.of('P'), 0.0, 99.0)) : 0;
    if (form > 1) return refuse(fmt::format("G68.2 P{}", form));
    if (in.state_.plane_axis != 2) return refuse("G68.2 in G18 or G19");
    if (in.compensation_.path.on()) in.fail("G68.2 while cutter compensation is on", column);
    const auto words = [&](const char* letters) {
        Vec3 v = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            if (w.given(letters[k])) v[k] = w.of(letters[k]);
        }
        return v;
    };
    const auto turned_about = [](int axis, double degrees) { return ProgramFrame::turned(Vec3::Unit(axis), degrees); };
    const Vec3 angles = words("IJK");
    ProgramFrame turn;
    if (form == 0) {
        turn = turned_about(2, angles[0]).around(turned_about(0, angles[1])).around(turned_about(2, angles[2]));
    } else {
        const int order = w.given('Q') ? static_cast<int>(std::clamp(w.of('Q'), 0.0, 999.0)) : 123;
        const std::array<int, 3> axes{order / 100 - 1, order / 10 % 10 - 1, order % 10 - 1};
        std::array<bool, 3> named{};
        for (const int axis : axes) {
            if (axis >= 0 && axis < 3) named[static_cast<std::size_t>(axis)] = true;
        }
        if (!(named[0] && named[1] && named[2]))
            in.fail(fmt::format("G68.2 P1: Q{} is not a permutation of 1, 2 and 3", order), column);
        for (const int axis : axes) turn = turned_about(axis, angles[axis]).around(turn);
    }
    state_of(in).frame.rotation = ProgramFrame::moved(in.state_.unit_mm * words("XYZ")).around(turn);
    state_of(in).frame.angle = 0;
    in.state_.frame = state_of(in).frame.all();
    const std::string text = "G68.2" + words_text(block, "PQXYZIJK");
    in.event("rotation", text);
    begin_tilted_plane(in, text);
}

}  // namespace clsurf::fanuc

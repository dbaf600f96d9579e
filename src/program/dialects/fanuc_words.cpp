// Fanuc and HNC: frames, polar coordinates, macro calls, offsets, system variables.
// Facts: Fanuc, operator's manual of the series 30i (B-63944EN).

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr double most_factor = 50;  ///< above it a factor of G51 is in thousandths
constexpr double full_turn = 360;   ///< above it an angle of G68 is in thousandths
constexpr std::size_t argument_count = 26;

/// Every I, J and K of a block in its order; a block of plain words has none of them twice and does not keep the order.
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

}  // namespace

/// The coordinates of a frame's centre: as given, else the present position.
Vec3 Interpreter::frame_centre(const Block& block, const Vec3& now) const {
    Vec3 centre = now.array().isNaN().select(0.0, now);
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("XYZ"[k])) continue;
        const double value = block.words.of("XYZ"[k]) * state_.unit_mm;
        centre[k] = state_.incremental ? centre[k] + value : value;
    }
    return centre;
}

void Interpreter::settle_fanuc_frame() {
    const FanucFrame& f = frames_.fanuc;
    state_.frame = f.local.around(f.rotation.around(f.scaling.around(f.mirror)));
}

/// G68 X Y R in the plane, or X Y Z I J K R about an axis. The centre counts in scaled coordinates.
void Interpreter::rotate_frame(const Block& block, std::size_t column) {
    this_block_.motion_suppressed = true;
    const Words& w = block.words;
    if (!w.given('R')) fail("G68 needs the angle (R)", column);
    double angle = w.of('R');
    if (std::abs(angle) > full_turn) angle /= 1000;
    const ProgramFrame inner = frames_.fanuc.scaling.around(frames_.fanuc.mirror);
    const Vec3 centre = inner.to_work(frame_centre(block, state_.programmed()));
    Vec3 axis = Vec3::Unit(state_.plane_axis);
    const bool about_an_axis = w.given('I') || w.given('J') || w.given('K');
    if (about_an_axis) {
        for (int k = 0; k < 3; ++k) axis[k] = w.given("IJK"[k]) ? w.of("IJK"[k]) : 0.0;
        if (axis.isZero()) fail("G68: I J K give no direction", column);
    }
    frames_.fanuc.angle = state_.incremental && !about_an_axis ? frames_.fanuc.angle + angle : angle;
    frames_.fanuc.rotation = ProgramFrame::turned(axis, frames_.fanuc.angle, centre);
    settle_fanuc_frame();
    event("rotation", "G68" + words_text(block, "XYZIJKR"));
}

/// G51 X Y Z P, or I J K for each axis; negative: mirrored.
void Interpreter::scale_frame(const Block& block) {
    this_block_.motion_suppressed = true;
    const Words& w = block.words;
    Vec3 factors = Vec3::Constant(w.given('P') ? factor_of(w.of('P')) : 1.0);
    if (!w.given('P')) {
        for (int k = 0; k < 3; ++k) factors[k] = w.given("IJK"[k]) ? factor_of(w.of("IJK"[k])) : 1.0;
    }
    if ((factors.array() == 0).any()) fail("G51: a factor of 0");
    const Vec3 centre = frame_centre(block, frames_.fanuc.mirror.to_work(state_.programmed()));
    frames_.fanuc.scaling = ProgramFrame::scaled(factors, centre);
    settle_fanuc_frame();
    event("scaling", "G51" + words_text(block, "XYZIJKP"));
}

/// G51.1 and G50.1 (HNC: G24, G25): mirrored about X, Y, Z as given.
void Interpreter::mirror_frame(int code, const Block& block) {
    this_block_.motion_suppressed = true;
    const bool on = code == 51.1_g || code == 24_g;
    const bool all = !on && (block.words.has & Words::xyz) == 0;
    for (int k = 0; k < 3; ++k) {
        if (!all && !block.words.given("XYZ"[k])) continue;
        frames_.mirrored[k] = on;
        if (on) frames_.mirror_at[k] = block.words.of("XYZ"[k]) * state_.unit_mm;
    }
    Vec3 factors = Vec3::Ones();
    for (int k = 0; k < 3; ++k) {
        if (frames_.mirrored[k]) factors[k] = -1;
    }
    frames_.fanuc.mirror = ProgramFrame::scaled(factors, frames_.mirror_at);
    settle_fanuc_frame();
    event("mirror", code_text(code) + words_text(block, "XYZ"));
}

/// G52: a zero of its own in every work system.
void Interpreter::local_zero(const Block& block) {
    this_block_.motion_suppressed = true;
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("XYZ"[k])) continue;
        const double value = block.words.of("XYZ"[k]) * state_.unit_mm;
        frames_.local_zero[k] = state_.incremental ? frames_.local_zero[k] + value : value;
    }
    frames_.fanuc.local = ProgramFrame::moved(frames_.local_zero);
    settle_fanuc_frame();
    event("local-zero", "G52" + words_text(block, "XYZ"));
}

long Interpreter::macro_program(const Block& block, int code, std::size_t column) const {
    if (!block.words.given('P')) fail(code_text(code) + " needs the program's number (P)", column);
    return static_cast<long>(std::clamp(block.words.of('P'), 0.0, 99999999.0));
}

/// #1 … #33 of a macro call; NaN: not given. Where I, J and K stand again or in another order they count on: the second
/// I is #7 (argument specification II). Of two words for one variable the later one holds.
std::vector<double> Interpreter::macro_arguments(const Block& block) const {
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
bool Interpreter::is_data_end(const Block& block) {
    if (block.words.has_g(11_g)) return true;
    event("data-entry", std::string(place_.text.substr(0, 80)));
    return false;
}

/// G65: nothing else in the block is carried out, its words are arguments.
void Interpreter::macro_call(const Block& block) {
    const int repeats = block.words.given('L') ? static_cast<int>(std::clamp(block.words.of('L'), 1.0, 99999.0)) : 1;
    call(fmt::format("{}", macro_program(block, 65_g, 0)), repeats, true, macro_arguments(block));
}

/// G10 of Fanuc: L2 and L20 work offsets, L10 … L13 of tools; G90 sets, G91 adds.
bool Interpreter::set_fanuc_offsets(int level, const Block& block) {
    const Words& w = block.words;
    const bool adds = state_.incremental;
    if (level == 2 || level == 20) {
        const int number = w.given('P') ? static_cast<int>(std::clamp(w.of('P'), 0.0, 300.0)) : 0;
        if (level == 2 && number == 0) {
            event("work-offset", "G10 L2 P0" + words_text(block, "XYZ"));  // moves all systems alike, on the machine
            return true;
        }
        const int system = level == 20 ? plain_work_systems + number : number;
        Vec3 shift = state_.work_offsets[system].shift;
        for (int k = 0; k < 3; ++k) {
            if (!w.given("XYZ"[k])) continue;
            const double value = w.of("XYZ"[k]) * state_.unit_mm;
            shift[k] = adds ? shift[k] + value : value;
        }
        state_.rebase([&] {
            WorkOffset& offset = state_.work_offsets[system];
            offset.shift = shift;
            if (!adds) offset.set = static_cast<std::uint8_t>(offset.set | axes_named(w));
        });
        return true;
    }
    const bool of_tool = level == 0 || level == 1 || (level >= 10 && level <= 13);
    if (of_tool && w.given('P') && w.given('R')) {
        Tool& tool = tools_.table.tools[static_cast<int>(std::clamp(w.of('P'), 0.0, 1e6))];
        const double value = w.of('R') * state_.unit_mm;
        const bool wear = level == 11 || level == 13;
        if (level == 12 || level == 13)
            tool.diameter = (adds || wear ? tool.diameter : 0.0) + 2 * value;
        else
            tool.offset.z() = (adds || wear ? tool.offset.z() : 0.0) + value;
    }
    return false;
}

/// Work offsets by variable: #5221 … G54, #5241 … G55, #7001 … G54.1 P1.
WorkOffset* Interpreter::offset_of_variable(int number, int& axis) {
    constexpr int per_system = 20;
    const auto found = [&](int first, int systems, int first_system) -> WorkOffset* {
        if (number < first || number >= first + systems * per_system) return nullptr;
        axis = (number - first) % per_system;
        return axis < 3 ? &state_.work_offsets[first_system + (number - first) / per_system] : nullptr;
    };
    if (WorkOffset* offset = found(5221, 6, 1)) return offset;
    return found(7001, 48, plain_work_systems + 1);
}

/// What writing a variable of the control does; true: it was one.
bool Interpreter::write_fanuc_parameter(int number, double value) {
    if (number < 1000) return false;
    int axis = 0;
    if (offset_of_variable(number, axis) != nullptr) {
        state_.rebase([&] {
            WorkOffset& offset = *offset_of_variable(number, axis);
            offset.shift[axis] = value * state_.unit_mm;
            offset.set = static_cast<std::uint8_t>(offset.set | (1u << axis));
        });
        return true;
    }
    if (number == 3000) {
        note(Severity::warning, "program.alarm", fmt::format("the program raises alarm {:g} and ends here", value));
        event("end", fmt::format("#3000={:g}", value));
        ended_ = true;
        return true;
    }
    if (number == 3006) {
        event("stop", fmt::format("#3006={:g}", value));
        return true;
    }
    return false;
}

double Interpreter::fanuc_parameter(int number) {
    const Vec3 at = tool_position();
    const Vec3 known = at.array().isNaN().select(0.0, at);
    const double unit = state_.unit_mm;
    const auto axis_of = [&](int first, const Vec3& lengths) {
        const int k = number - first;
        return k < 3 ? lengths[k] / unit : state_.rotary[k - 3];
    };
    for (const int first : {5001, 5041}) {
        if (number >= first && number < first + 6) return axis_of(first, state_.frame.to_programmed(known));
    }
    if (number >= 5021 && number < 5027) return axis_of(5021, state_.to_machine(known));
    const auto offset = [&](int first, int first_system) {
        const auto found = state_.work_offsets.find(first_system + (number - first) / 20);
        const int axis = (number - first) % 20;
        return found == state_.work_offsets.end() || axis > 2 ? 0.0 : found->second.shift[axis] / unit;
    };
    if (number >= 5221 && number < 5341) return offset(5221, 1);
    if (number >= 7001 && number < 7961) return offset(7001, plain_work_systems + 1);
    switch (number) {
        case 4001:
            return state_.motion == MotionMode::rapid ? 0
                   : state_.motion == MotionMode::cw  ? 2
                   : state_.motion == MotionMode::ccw ? 3
                                                      : 1;
        case 4002: return 17 + (2 - state_.plane_axis);
        case 4003: return state_.incremental ? 91 : 90;
        case 4005:
            return state_.feed_mode == FeedMode::inverse_time ? 93 : state_.feed_mode == FeedMode::per_minute ? 94 : 95;
        case 4006: return unit == 1 ? 21 : 20;
        case 4009: return state_.cycle > 0 && state_.motion == MotionMode::cycle ? state_.cycle / 10 : 80;
        case 4010: return state_.retract_to_r ? 99 : 98;
        case 4014: return state_.work_system <= plain_work_systems ? 53 + state_.work_system : 54.1;
        case 4109: return state_.feed;
        case 4119: return state_.spindle;
        case 4120: return tools_.next;
        default: break;
    }
    if (number >= 1000 && !variables_.has(number)) this_block_.unknown_parameter = number;
    return missing<double>;
}

}  // namespace clsurf

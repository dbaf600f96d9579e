// Offsets: work coordinate systems, G92, tools and their lengths, reference points.

#include "program/interpret/offsets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/axis_words.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/tools.h"

namespace clsurf {

void set_offsets(Interpreter& in, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const int level = block.words.given('L') ? static_cast<int>(std::clamp(block.words.of('L'), -1e6, 1e6)) : 0;
    if (level != 2 && level != 20) {
        if (in.rules_->offsets.tool_data) set_tool(in, level, block);
        in.event("tool-table", "G10" + words_text(block, "LPRZXYIJQ"));
        return;
    }
    int system = block.words.given('P') ? static_cast<int>(std::clamp(block.words.of('P'), -1e6, 1e6)) : 0;
    if (system == 0) system = in.state_.work_offsets.system;
    const Vec3 machine = in.state_.to_machine(in.state_.position);
    const Vec3 machine_rotary = in.state_.rotary + in.state_.work_offsets.rotary();
    const Vec3 position = in.state_.position.array().isNaN().select(0.0, in.state_.position);
    in.state_.rebase([&] {
        WorkOffset& offset = in.state_.work_offsets.by_system[system];
        unsigned named = axes_named(block.words);
        if (block.words.given('R') && level == 2 && in.rules_->offsets.rotation) {
            offset.rotation = block.words.of('R');
            named |= WorkFrame::rotation;
        }
        const WorkOffset active = in.state_.work_offsets.active();
        const bool measured = level == 20 && active.set == 0 && offset.set == 0 && in.state_.work_offsets.system != 0;
        if (measured)
            offset.measured_from = active.measured_from != 0 ? active.measured_from : in.state_.work_offsets.system;
        else
            offset.set = static_cast<std::uint8_t>(offset.set | named);
        Vec3 reads = position;  // L20: the present position equals the words, in that system
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "XYZ"[axis];
            if (!block.words.given(letter)) continue;
            const double value = block.words.of(letter) * in.state_.unit_mm;
            reads[axis] = value;
            if (level == 2) { offset.shift[axis] = value; }
        }
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "ABC"[axis];
            if (!in.rules_->offsets.rotary || !block.words.given(letter)) continue;
            const double value = block.words.of(letter);
            offset.rotary[axis] =
                level == 2 ? value : machine_rotary[axis] - in.state_.work_offsets.shift.rotary[axis] - value;
        }
        if (level == 20) {
            const Vec3 turned = rotated_about_z(reads + in.state_.work_offsets.shift.linear, offset.rotation);
            for (int axis = 0; axis < 3; ++axis) {
                const bool turns = axis < 2 && offset.rotation != 0;  // one word moves both zeros then
                if (block.words.given("XYZ"[axis]) || turns)
                    offset.shift[axis] = machine[axis] - in.state_.tool_offset.total[axis] - turned[axis];
            }
        }
    });
}

void shift_position(Interpreter& in, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const bool local = std::find(block.words.g.begin(), block.words.g.begin() + block.words.g_count, 52_g) !=
                       block.words.g.begin() + block.words.g_count;
    in.state_.rebase([&] {
        const Vec3 position = in.state_.position;
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "XYZ"[axis];
            if (!block.words.given(letter)) continue;
            const double value = block.words.of(letter) * in.state_.unit_mm;
            if (local) {
                in.state_.work_offsets.shift.linear[axis] = value;
            } else {
                const double now = std::isnan(position[axis]) ? 0.0 : position[axis];
                in.state_.work_offsets.shift.linear[axis] += now - value;
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (!in.rules_->offsets.rotary || !block.words.given("ABC"[axis])) continue;
            const double value = block.words.of("ABC"[axis]);
            in.state_.work_offsets.shift.rotary[axis] =
                local ? value : in.state_.work_offsets.shift.rotary[axis] + in.state_.rotary[axis] - value;
        }
        if (!local) in.state_.work_offsets.saved_shift = in.state_.work_offsets.shift;
    });
}

void restore_shift(ModalState& state, int code) {
    WorkOffsets& offsets = state.work_offsets;
    state.rebase([&] {
        if (code == 92.3_g) {
            offsets.shift = offsets.saved_shift;
            return;
        }
        offsets.saved_shift = code == 92.2_g ? offsets.shift : AxisValues{};
        offsets.shift = {};
    });
}

void select_work_system(Interpreter& in, int number) {
    if (number == in.state_.work_offsets.system) return;
    in.state_.rebase([&] { in.state_.work_offsets.system = number; });
    in.event("work-system", number >= 1 && number <= 6 ? fmt::format("G{}", 53 + number) : fmt::format("{}", number));
}

void keep_reference(ModalState& state, BlockFlags& flags, int code) {
    flags.motion_suppressed = true;
    AxisValues& reference = code == 28.1_g ? state.home : state.second_home;
    reference.linear = state.to_machine(state.position);
    reference.rotary = state.rotary + state.work_offsets.rotary();
}

void approach_reference(Interpreter& in, int code, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const AxisValues& reference = code == 28_g ? in.state_.home : in.state_.second_home;
    const Vec3 home = in.state_.from_machine(reference.linear);
    const Vec3 home_rotary = reference.rotary - in.state_.work_offsets.rotary();
    std::uint32_t named = 0;
    for (const char c : {'X', 'Y', 'Z', 'A', 'B', 'C'}) named |= block.words.has & Words::bit(c);
    // RS274 moves to the intermediate point even if it is the present one: this applies a new offset.
    if (named != 0 || in.rules_->offsets.always_by_point) {
        in.straight(MotionKind::rapid, target_of(in, block, in.this_block_.machine_coordinates),
                    rotary_target(in, block));
    }
    // RS274: without axis words all axes move; with them only those.
    constexpr unsigned all = WorkFrame::all_axes;
    in.state_.place(named == 0 ? all : axes_named(block.words), true);
    Vec3 end = in.state_.position;
    Vec3 rotary = in.state_.rotary;
    for (int axis = 0; axis < 3; ++axis) {
        if (named == 0 || block.words.given("XYZ"[axis])) end[axis] = home[axis];
        if (named == 0 || (block.words.given("ABC"[axis]) && in.rules_->offsets.rotary))
            rotary[axis] = home_rotary[axis];
    }
    in.straight(MotionKind::rapid, end, rotary);
}

}  // namespace clsurf

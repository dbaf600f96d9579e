// Offsets: work coordinate systems, G92, tools and their lengths, reference points.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr int last_work_system = 9;  ///< G59.3

bool is_given(const Block& block, char letter) { return block.words.given(letter); }

}  // namespace

WorkFrame ModalState::work_frame() const {
    const WorkOffset offset = work_offset();
    WorkFrame now;
    now.local = Eigen::Translation3d(offset.shift) * Eigen::AngleAxisd(offset.rotation * rad_per_deg, Vec3::UnitZ()) *
                Eigen::Translation3d(shift);
    if (offset.rotation == 0) now.local.linear().setIdentity();
    now.tool = tool_offset - assumed_tool;
    now.rotary = rotary_offset() * rad_per_deg;
    now.held = held;
    now.words = frame;
    now.absolute = absolute;
    if (work_system == 0) return now;  // G500 of Siemens
    constexpr unsigned whole = WorkFrame::all_axes | WorkFrame::rotation;
    now.free = static_cast<std::uint8_t>(offset.set == 0 ? whole : WorkFrame::all_axes & ~unsigned{offset.set});
    if (now.free != 0) now.system = offset.measured_from != 0 ? offset.measured_from : work_system;
    return now;
}

/// The index of the frame that the next motion counts in; a new one where it is.
void Interpreter::settle_work_frame() {
    work_frames_.changes = state_.frame_changes;
    work_frames_.held = state_.held;
    work_frames_.absolute = state_.absolute;
    work_frames_.words = state_.frame;
    const WorkFrame frame = state_.work_frame();
    std::array<double, 34> key{};
    std::copy_n(frame.local.data(), 16, key.begin());
    key[16] = frame.system;
    key[17] = frame.free + 16 * frame.held + 256 * frame.absolute;
    std::copy_n(frame.tool.data(), 3, key.begin() + 18);
    // Rotary offsets: one number is enough to tell those apart that a program uses.
    key[21] = frame.rotary.dot(Vec3(1, 1e-3, 1e-6));
    std::ranges::copy(frame.words.numbers(), key.begin() + 22);
    std::vector<WorkFrame>& frames = program_.motions.frames;
    const auto [known, added] = work_frames_.known.try_emplace(key, static_cast<std::uint32_t>(frames.size()));
    if (added && work_frames_.known.size() == 1 && forgotten_ == 0 && program_.motions.kind.size() == 1) {
        known->second = 0;
        frames.front() = frame;
    } else if (added) {
        frames.push_back(frame);
    }
    work_frames_.current = known->second;
}

void Interpreter::set_offsets(const Block& block) {
    this_block_.motion_suppressed = true;
    const int level = is_given(block, 'L') ? static_cast<int>(std::clamp(block.words.of('L'), -1e6, 1e6)) : 0;
    if (level != 2 && level != 20) {
        if (rules_->offsets.tool_data) set_tool(level, block);
        event("tool-table", "G10" + words_text(block, "LPRZXYIJQ"));
        return;
    }
    int system = is_given(block, 'P') ? static_cast<int>(std::clamp(block.words.of('P'), -1e6, 1e6)) : 0;
    if (system == 0) system = state_.work_system;
    const Vec3 machine = state_.to_machine(state_.position);
    const Vec3 machine_rotary = state_.rotary + state_.rotary_offset();
    const Vec3 position = state_.position.array().isNaN().select(0.0, state_.position);
    state_.rebase([&] {
        WorkOffset& offset = state_.work_offsets[system];
        unsigned named = axes_named(block.words);
        if (is_given(block, 'R') && level == 2 && rules_->offsets.rotation) {
            offset.rotation = block.words.of('R');
            named |= WorkFrame::rotation;
        }
        const WorkOffset active = state_.work_offset();
        const bool measured = level == 20 && active.set == 0 && offset.set == 0 && state_.work_system != 0;
        if (measured)
            offset.measured_from = active.measured_from != 0 ? active.measured_from : state_.work_system;
        else
            offset.set = static_cast<std::uint8_t>(offset.set | named);
        Vec3 reads = position;  // L20: the present position reads as the words, in that system
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "XYZ"[axis];
            if (!is_given(block, letter)) continue;
            const double value = block.words.of(letter) * state_.unit_mm;
            reads[axis] = value;
            if (level == 2) { offset.shift[axis] = value; }
        }
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "ABC"[axis];
            if (!rules_->offsets.rotary || !is_given(block, letter)) continue;
            const double value = block.words.of(letter);
            offset.rotary[axis] = level == 2 ? value : machine_rotary[axis] - state_.rotary_shift[axis] - value;
        }
        if (level == 20) {
            const Vec3 turned = ModalState::rotated(reads + state_.shift, offset.rotation);
            for (int axis = 0; axis < 3; ++axis) {
                const bool turns = axis < 2 && offset.rotation != 0;  // one word moves both zeros then
                if (is_given(block, "XYZ"[axis]) || turns)
                    offset.shift[axis] = machine[axis] - state_.tool_offset[axis] - turned[axis];
            }
        }
    });
}

void Interpreter::shift_position(const Block& block) {
    this_block_.motion_suppressed = true;
    const bool local = std::find(block.words.g.begin(), block.words.g.begin() + block.words.g_count, 52_g) !=
                       block.words.g.begin() + block.words.g_count;
    state_.rebase([&] {
        const Vec3 position = state_.position;
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = "XYZ"[axis];
            if (!is_given(block, letter)) continue;
            const double value = block.words.of(letter) * state_.unit_mm;
            if (local) {
                state_.shift[axis] = value;
            } else {
                const double now = std::isnan(position[axis]) ? 0.0 : position[axis];
                state_.shift[axis] += now - value;
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (!rules_->offsets.rotary || !is_given(block, "ABC"[axis])) continue;
            const double value = block.words.of("ABC"[axis]);
            state_.rotary_shift[axis] = local ? value : state_.rotary_shift[axis] + state_.rotary[axis] - value;
        }
        if (!local) {
            state_.saved_shift = state_.shift;
            state_.saved_rotary_shift = state_.rotary_shift;
        }
    });
}

/// G92.1 takes the shift away for good, G92.2 keeps it for G92.3.
void Interpreter::restore_shift(int code) {
    state_.rebase([&] {
        if (code == 92.3_g) {
            state_.shift = state_.saved_shift;
            state_.rotary_shift = state_.saved_rotary_shift;
            return;
        }
        const bool keeps = code == 92.2_g;
        state_.saved_shift = keeps ? state_.shift : Vec3(Vec3::Zero());
        state_.saved_rotary_shift = keeps ? state_.rotary_shift : Vec3(Vec3::Zero());
        state_.shift = Vec3::Zero();
        state_.rotary_shift = Vec3::Zero();
    });
}

/// M70 … M73 of LinuxCNC: modes are kept and come back; after M73 when the subprogram returns.
void Interpreter::keep_modes(int code) {
    std::optional<ModalState>& kept = calls_.kept_modes.back();
    if (code == 70 || code == 73) {
        kept = state_;
        if (code == 73) calls_.restores_modes.back() = true;
        return;
    }
    if (code == 71) {
        kept.reset();
        return;
    }
    if (!kept) {
        note(Severity::warning, "program.modes", "M72 without M70 or M73 before it");
        return;
    }
    restore_modes(*kept);
}

void Interpreter::restore_modes(const ModalState& kept) {
    state_.unit_mm = kept.unit_mm;
    state_.feed_unit_mm = kept.feed_unit_mm;
    state_.plane_axis = kept.plane_axis;
    state_.incremental = kept.incremental;
    state_.centre_absolute = kept.centre_absolute;
    select_feed_mode(kept.feed_mode);
    state_.feed = kept.feed;
    state_.spindle = kept.spindle;
    state_.retract_to_r = kept.retract_to_r;
    state_.diameter = kept.diameter;
    set_path_mode("path-mode", "as it was", kept.path_mode);
    select_work_system(kept.work_system);
    if (kept.tool_offset.isZero()) state_.rebase([&] { state_.tool_offset = state_.assumed_tool = Vec3::Zero(); });
    const bool shifted = !(kept.shift.isZero() && kept.rotary_shift.isZero());
    if (!shifted && !(state_.shift.isZero() && state_.rotary_shift.isZero())) restore_shift(92.2_g);
}

void Interpreter::select_work_system(int number) {
    if (number == state_.work_system) return;
    state_.rebase([&] { state_.work_system = number; });
    event("work-system", number >= 1 && number <= 6 ? fmt::format("G{}", 53 + number) : fmt::format("{}", number));
}

/// Lines of the tool table: L1 gives a tool's values, L10 and L11 the offset with which the present
/// position reads as the words, in the active system or (L11) in G59.3 without G92.
void Interpreter::set_tool(int level, const Block& block) {
    if (level != 1 && level != 10 && level != 11) fail(fmt::format("G10 L{} is not known", level));
    if (!is_given(block, 'P')) fail("G10 L1, L10 and L11 need the tool's number (P)");
    const int number = static_cast<int>(std::clamp(std::round(block.words.of('P')), 0.0, 1e6));
    Tool tool = tools_.table.find(number) != nullptr ? *tools_.table.find(number) : Tool{number};
    const auto length = [&](char letter) { return block.words.of(letter) * state_.unit_mm; };
    ModalState fixture = state_;  // where the words count
    if (level == 11) {
        fixture.work_system = last_work_system;
        fixture.shift = Vec3::Zero();
    }
    Vec3 reads = fixture.from_machine(state_.to_machine(state_.position));
    for (int axis = 0; axis < 3; ++axis) {
        if (is_given(block, "XYZ"[axis])) reads[axis] = length("XYZ"[axis]);
    }
    const Vec3 wanted = fixture.tool_offset + state_.to_machine(state_.position) - fixture.to_machine(reads);
    for (int axis = 0; axis < 3; ++axis) {
        if (is_given(block, "XYZ"[axis])) tool.offset[axis] = level == 1 ? length("XYZ"[axis]) : wanted[axis];
    }
    tool.assumed = false;
    if (is_given(block, 'R')) tool.diameter = 2 * length('R');
    if (is_given(block, 'I')) tool.front_angle = block.words.of('I');
    if (is_given(block, 'J')) tool.back_angle = block.words.of('J');
    if (is_given(block, 'Q')) tool.orientation = static_cast<int>(std::clamp(block.words.of('Q'), 0.0, 9.0));
    tools_.table.tools[number] = tool;
    if (tools_.in_spindle.number == number) tools_.in_spindle = tool;
}

/// The tool of the table; one that is not there has neither length nor diameter, and is reported.
Tool Interpreter::tool_of(int number, std::size_t column) {
    if (const Tool* found = tools_.table.find(number)) return *found;
    if (number != 0) {
        note(Severity::warning, "program.tool-table",
             fmt::format("tool {} is not in the tool table: read without length and diameter", number), column);
    }
    return Tool{number};
}

void Interpreter::change_tool(const Block& block) {
    const auto whole = [&](char letter) {
        return static_cast<int>(std::clamp(std::round(block.words.of(letter)), 0.0, 1e8));
    };
    if (is_given(block, 'T')) tools_.next = whole('T');
    // A block with T calls the tool in Heidenhain's dialect; Siemens takes its length with the edge D1.
    bool changed = false;
    if (rules_->tools.t_changes && is_given(block, 'T')) {
        tools_.in_spindle =
            tools_.table.tools.empty() ? Tool{tools_.next} : tool_of(tools_.next, block.words.column['T' - 'A']);
        changed = true;
    }
    const auto* first = block.words.m.data();
    for (const std::int32_t code : std::vector<std::int32_t>(first, first + block.words.m_count)) {
        if (code != 6 && (code != 61 || !rules_->tools.m61)) continue;
        if (compensation_.path.on()) fail("a tool cannot be changed while cutter compensation is on");
        if (code == 61 && !is_given(block, 'Q')) fail("M61 needs the tool's number (Q)");
        // Without a table the other dialects have nothing to look up.
        const bool known = rules_->tools.always_looks_up || !tools_.table.tools.empty();
        tools_.in_spindle = known ? tool_of(code == 61 ? whole('Q') : tools_.next, 0) : Tool{tools_.next};
        changed = true;
    }
    const bool edge = rules_->tools.edges && is_given(block, 'D');
    if (!rules_->tools.length_with_tool || tools_.table.tools.empty() || !(changed || edge)) return;
    const Vec3 offset = edge && block.words.of('D') == 0 ? Vec3(Vec3::Zero()) : tools_.in_spindle.offset;
    state_.rebase([&] { state_.tool_offset = offset; });
}

/// From here on the end of the last motion is not what the position reads: a length was taken off, or
/// compensation ended beside the programmed point.
void Interpreter::part_from_machine(const Vec3& by) {
    if (compensation_.unread_since != program_.motions.size()) compensation_.unread = Vec3::Zero();
    compensation_.unread_since = program_.motions.size();
    compensation_.unread += by;
}

/// After a tool change, or after waiting for an input, the interpreter takes up the end of the last
/// motion again. The stand-alone one does so without the length that was taken off since: T1 M6 G43 in
/// one block leaves the position as it reads.
void Interpreter::read_machine_position(const Block& block) {
    const auto* first = block.words.m.data();
    const bool reads =
        std::any_of(first, first + block.words.m_count, [](std::int32_t code) { return code == 6 || code == 66; });
    if (!reads || compensation_.unread_since != program_.motions.size()) return;
    state_.position += compensation_.unread;
    compensation_.unread = Vec3::Zero();
}

void Interpreter::tool_length(int code, const Block& block) {
    const auto words_move = [&](Vec3 offset) {
        for (int axis = 0; axis < 3; ++axis) {
            if (is_given(block, "XYZ"[axis])) offset[axis] = block.words.of("XYZ"[axis]) * state_.unit_mm;
        }
        return offset;
    };
    const auto tool_named = [&](bool loaded) {
        if (loaded) return tools_.in_spindle;
        const auto column = block.words.column['H' - 'A'];
        return tool_of(static_cast<int>(std::clamp(std::round(block.words.of('H')), 0.0, 1e8)), column);
    };
    const auto assumed_in = [](const Tool& tool) { return tool.assumed ? tool.offset : Vec3(Vec3::Zero()); };
    Vec3 offset = state_.tool_offset;
    Vec3 assumed = state_.assumed_tool;
    if (code == 43.1_g) {
        this_block_.motion_suppressed = true;
        offset = words_move(offset);
        for (int axis = 0; axis < 3; ++axis) {
            if (is_given(block, "XYZ"[axis])) assumed[axis] = 0;
        }
    } else if (code == 49_g) {
        offset = assumed = Vec3::Zero();
    } else if (rules_->tools.length_of == LengthOf::tool_in_spindle && code == 43_g) {
        const Tool tool = tool_named(!is_given(block, 'H') || block.words.of('H') == 0);
        offset = tool.offset;
        assumed = assumed_in(tool);
    } else if (rules_->tools.length_of == LengthOf::tool_in_spindle && code == 43.2_g) {
        if (!is_given(block, 'H')) fail("G43.2 needs the tool's number (H)");
        const Tool tool = tool_named(false);
        offset += tool.offset;
        assumed += assumed_in(tool);
    } else if (rules_->tools.length_of == LengthOf::row_of_h && code >= 43_g && code <= 44_g && code != 43.2_g &&
               !tools_.table.tools.empty()) {
        if (is_given(block, 'H'))
            tools_.length_row = static_cast<int>(std::clamp(std::round(block.words.of('H')), 0.0, 1e8));
        offset = tool_of(tools_.length_row, is_given(block, 'H') ? block.words.column['H' - 'A'] : 0).offset *
                 (code == 44_g ? -1.0 : 1.0);
    }
    part_from_machine(offset - state_.tool_offset);
    state_.rebase([&] {
        state_.tool_offset = offset;
        state_.assumed_tool = assumed;
    });
    event("tool-length", code_text(code) + words_text(block, "H"));
}

void Interpreter::keep_reference(int code) {
    this_block_.motion_suppressed = true;
    (code == 28.1_g ? state_.home : state_.second_home) = state_.to_machine(state_.position);
    (code == 28.1_g ? state_.home_rotary : state_.second_home_rotary) = state_.rotary + state_.rotary_offset();
}

void Interpreter::reference(int code, const Block& block) {
    this_block_.motion_suppressed = true;
    const Vec3 home = state_.from_machine(code == 28_g ? state_.home : state_.second_home);
    const Vec3 home_rotary = (code == 28_g ? state_.home_rotary : state_.second_home_rotary) - state_.rotary_offset();
    std::uint32_t named = 0;
    for (const char c : {'X', 'Y', 'Z', 'A', 'B', 'C'}) named |= block.words.has & Words::bit(c);
    // RS274 goes to the intermediate point even where that is the present one: a new offset shows in it.
    if (named != 0 || rules_->offsets.always_by_point) {
        straight(MotionKind::rapid, target(block, this_block_.machine_coordinates), rotary_target(block));
    }
    // RS274: without axis words all axes go; with them only those.
    constexpr unsigned all = WorkFrame::all_axes;
    state_.place(named == 0 ? all : axes_named(block.words), true);
    Vec3 end = state_.position;
    Vec3 rotary = state_.rotary;
    for (int axis = 0; axis < 3; ++axis) {
        if (named == 0 || is_given(block, "XYZ"[axis])) end[axis] = home[axis];
        if (named == 0 || (is_given(block, "ABC"[axis]) && rules_->offsets.rotary)) rotary[axis] = home_rotary[axis];
    }
    straight(MotionKind::rapid, end, rotary);
}

}  // namespace clsurf

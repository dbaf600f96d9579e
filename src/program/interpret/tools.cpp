#include "program/interpret/tools.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr int last_work_system = 9;  ///< G59.3

}  // namespace

void set_tool(Interpreter& in, int level, const Block& block) {
    if (level != 1 && level != 10 && level != 11) in.fail(fmt::format("G10 L{} is not known", level));
    if (!block.words.given('P')) in.fail("G10 L1, L10 and L11 need the tool's number (P)");
    const int number = static_cast<int>(std::clamp(std::round(block.words.of('P')), 0.0, 1e6));
    Tool tool = in.tools_.table.find(number) != nullptr ? *in.tools_.table.find(number) : Tool{number};
    const auto length = [&](char letter) { return block.words.of(letter) * in.state_.unit_mm; };
    ModalState fixture = in.state_;  // the system of the words
    if (level == 11) {
        fixture.work_offsets.system = last_work_system;
        fixture.work_offsets.shift.linear = Vec3::Zero();
    }
    Vec3 reads = fixture.from_machine(in.state_.to_machine(in.state_.position));
    for (int axis = 0; axis < 3; ++axis) {
        if (block.words.given("XYZ"[axis])) reads[axis] = length("XYZ"[axis]);
    }
    const Vec3 wanted =
        fixture.tool_offset.total + in.state_.to_machine(in.state_.position) - fixture.to_machine(reads);
    for (int axis = 0; axis < 3; ++axis) {
        if (block.words.given("XYZ"[axis])) tool.offset[axis] = level == 1 ? length("XYZ"[axis]) : wanted[axis];
    }
    tool.assumed = false;
    if (block.words.given('R')) tool.diameter = 2 * length('R');
    if (block.words.given('I')) tool.front_angle = block.words.of('I');
    if (block.words.given('J')) tool.back_angle = block.words.of('J');
    if (block.words.given('Q')) tool.orientation = static_cast<int>(std::clamp(block.words.of('Q'), 0.0, 9.0));
    in.tools_.table.tools[number] = tool;
    if (in.tools_.in_spindle.number == number) in.tools_.in_spindle = tool;
}

Tool tool_of(Interpreter& in, int number, std::size_t column) {
    if (const Tool* found = in.tools_.table.find(number)) return *found;
    if (number != 0) {
        in.note(Severity::warning, "program.tool-table",
                fmt::format("tool {} is not in the tool table: read without length and diameter", number), column);
    }
    return Tool{number};
}

void change_tool(Interpreter& in, const Block& block) {
    const auto whole = [&](char letter) {
        return static_cast<int>(std::clamp(std::round(block.words.of(letter)), 0.0, 1e8));
    };
    if (block.words.given('T')) in.tools_.next = whole('T');
    // A block with T calls the tool in Heidenhain's dialect; Siemens activates its length with the edge D1.
    bool changed = false;
    if (in.rules_->tools.t_changes && block.words.given('T')) {
        in.tools_.in_spindle = in.tools_.table.tools.empty()
                                   ? Tool{in.tools_.next}
                                   : tool_of(in, in.tools_.next, block.words.column['T' - 'A']);
        changed = true;
    }
    const auto* first = block.words.m.data();
    for (const std::int32_t code : std::vector<std::int32_t>(first, first + block.words.m_count)) {
        if (code != 6 && (code != 61 || !in.rules_->tools.m61)) continue;
        if (in.compensation_.path.on()) in.fail("a tool cannot be changed while cutter compensation is on");
        if (code == 61 && !block.words.given('Q')) in.fail("M61 needs the tool's number (Q)");
        // Without a table the other dialects have nothing to look up.
        const bool known = in.rules_->tools.always_looks_up || !in.tools_.table.tools.empty();
        in.tools_.in_spindle = known ? tool_of(in, code == 61 ? whole('Q') : in.tools_.next, 0) : Tool{in.tools_.next};
        changed = true;
    }
    const bool edge = in.rules_->tools.edges && block.words.given('D');
    if (!in.rules_->tools.length_with_tool || in.tools_.table.tools.empty() || !(changed || edge)) return;
    const Vec3 offset = edge && block.words.of('D') == 0 ? Vec3(Vec3::Zero()) : in.tools_.in_spindle.offset;
    in.state_.rebase([&] { in.state_.tool_offset.total = offset; });
}

void part_from_machine(CompensationState& compensation, std::int64_t motions, const Vec3& by) {
    if (compensation.unread_since != motions) compensation.unread = Vec3::Zero();
    compensation.unread_since = motions;
    compensation.unread += by;
}

void read_machine_position(Interpreter& in, const Block& block) {
    const auto* first = block.words.m.data();
    const bool reads =
        std::any_of(first, first + block.words.m_count, [](std::int32_t code) { return code == 6 || code == 66; });
    if (!reads || in.compensation_.unread_since != in.program_.motions.size()) return;
    in.state_.position += in.compensation_.unread;
    in.compensation_.unread = Vec3::Zero();
}

void tool_length(Interpreter& in, int code, const Block& block) {
    const auto words_move = [&](Vec3 offset) {
        for (int axis = 0; axis < 3; ++axis) {
            if (block.words.given("XYZ"[axis])) offset[axis] = block.words.of("XYZ"[axis]) * in.state_.unit_mm;
        }
        return offset;
    };
    const auto tool_named = [&](bool loaded) {
        if (loaded) return in.tools_.in_spindle;
        const auto column = block.words.column['H' - 'A'];
        return tool_of(in, static_cast<int>(std::clamp(std::round(block.words.of('H')), 0.0, 1e8)), column);
    };
    const auto assumed_in = [](const Tool& tool) { return tool.assumed ? tool.offset : Vec3(Vec3::Zero()); };
    ToolOffset next = in.state_.tool_offset;
    if (code == 43.1_g) {
        in.this_block_.motion_suppressed = true;
        next.total = words_move(next.total);
        for (int axis = 0; axis < 3; ++axis) {
            if (block.words.given("XYZ"[axis])) next.assumed[axis] = 0;
        }
    } else if (code == 49_g) {
        next = {};
    } else if (in.rules_->tools.length_of == LengthOf::tool_in_spindle && code == 43_g) {
        const Tool tool = tool_named(!block.words.given('H') || block.words.of('H') == 0);
        next = {tool.offset, assumed_in(tool)};
    } else if (in.rules_->tools.length_of == LengthOf::tool_in_spindle && code == 43.2_g) {
        if (!block.words.given('H')) in.fail("G43.2 needs the tool's number (H)");
        const Tool tool = tool_named(false);
        next.total += tool.offset;
        next.assumed += assumed_in(tool);
    } else if (in.rules_->tools.length_of == LengthOf::row_of_h && code >= 43_g && code <= 44_g && code != 43.2_g &&
               !in.tools_.table.tools.empty()) {
        if (block.words.given('H'))
            in.tools_.length_row = static_cast<int>(std::clamp(std::round(block.words.of('H')), 0.0, 1e8));
        next.total =
            tool_of(in, in.tools_.length_row, block.words.given('H') ? block.words.column['H' - 'A'] : 0).offset *
            (code == 44_g ? -1.0 : 1.0);
    }
    part_from_machine(in.compensation_, in.program_.motions.size(), next.total - in.state_.tool_offset.total);
    in.state_.rebase([&] { in.state_.tool_offset = next; });
    in.event("tool-length", code_text(code) + words_text(block, "H"));
}

}  // namespace clsurf

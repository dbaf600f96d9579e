// The meaning of the words of a block: G and M codes, offsets, modes.

#include "program/interpret/codes.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/axis_words.h"
#include "program/interpret/compensated_motions.h"
#include "program/interpret/feeds.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/motions.h"
#include "program/interpret/offsets.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tool_axis.h"
#include "program/interpret/tools.h"

namespace clsurf {
namespace {

bool is(const Block& block, char letter) { return block.words.given(letter); }
bool names_axes(const Block& block) {
    constexpr std::uint32_t axes = Words::xyz | Words::bit('A') | Words::bit('B') | Words::bit('C') | Words::bit('U') |
                                   Words::bit('V') | Words::bit('W');
    return (block.words.has & axes) != 0 || block.polar_radius || block.polar_angle;
}

/// G codes of curves in other dialects, which also move axes in the blocks that follow.
bool is_curve_elsewhere(int code) {
    return code == 5.2_g || code == 5.3_g || code == 6.1_g || code == 6.2_g || code == 6.3_g;
}

/// "X1=" of siemens: an axis of the machine by its name.
bool is_numbered_axis(std::string_view word) {
    return word.size() > 2 && word.back() == '=' && is_axis_letter(word.front()) &&
           word.find_first_not_of("0123456789", 1) == word.size() - 1;
}

/// "Y" alone, or in "YF100" before another word: an axis without its value.
bool is_axis_without_value(std::string_view word) {
    if (word.empty() || !is_axis_letter(upper(word.front()))) return false;
    return word.size() == 1 || (word.size() > 2 && is_letter(word[1]) && !is_letter(word[2]));
}

/// The execution order of the codes of one block (RS274/NGC, table 8).
constexpr int order_of_modes = 7, order_of_offsets = 9, usual_order = 8;
constexpr auto orders = std::to_array<std::pair<int, int>>({
    {93_g, 0},
    {94_g, 0},
    {95_g, 0},
    {17_g, 1},
    {18_g, 1},
    {19_g, 1},
    {20_g, 1},
    {21_g, 1},
    {70_g, 1},
    {71_g, 1},
    {4_g, 2},
    {40_g, 3},
    {41_g, 3},
    {42_g, 3},
    {41.1_g, 3},
    {42.1_g, 3},
    {43_g, 4},
    {43.1_g, 4},
    {43.2_g, 4},
    {43.4_g, 4},
    {44_g, 4},
    {49_g, 4},
    {53_g, 6},
    {90_g, order_of_modes},
    {91_g, order_of_modes},
    {90.1_g, order_of_modes},
    {91.1_g, order_of_modes},
    {28_g, order_of_offsets},
    {30_g, order_of_offsets},
    {28.1_g, order_of_offsets},
    {30.1_g, order_of_offsets},
    {10_g, order_of_offsets},
    {52_g, order_of_offsets},
    {92_g, order_of_offsets},
    {92.1_g, order_of_offsets},
    {92.2_g, order_of_offsets},
    {92.3_g, order_of_offsets},
});
int order_of(int code) {
    const auto* found = std::find_if(orders.begin(), orders.end(), [&](const auto& row) { return row.first == code; });
    if (found != orders.end()) return found->second;
    return code >= 54_g && code < 60_g ? 5 : usual_order;
}

/// M codes that stop the program or change which line comes next: executed after the motion of the block.
bool stops_block(int m) { return m == 0 || m == 1 || m == 2 || m == 30 || m == 60 || m == 98 || m == 99; }

template <MotionMode mode>
bool set_motion(Interpreter& in, const CodeWord&) {
    in.state_.motion = mode;
    return true;
}
template <int axis>
bool set_plane(Interpreter& in, const CodeWord&) {
    in.state_.plane_axis = axis;
    return true;
}
template <FeedMode mode>
bool set_feed_mode(Interpreter& in, const CodeWord&) {
    select_feed_mode(in, mode);
    return true;
}
template <bool ModalState::*flag, bool value>
bool set_flag(Interpreter& in, const CodeWord&) {
    in.state_.*flag = value;
    return true;
}
bool dwell_in_seconds(Interpreter& in, const CodeWord& w) {
    in.dwell(is(w.block, 'P') ? w.block.words.of('P') : 0);
    return true;
}
bool go_to_reference(Interpreter& in, const CodeWord& w) {
    approach_reference(in, w.code, w.block);
    return true;
}
template <bool tip>
bool set_tool_length(Interpreter& in, const CodeWord& w) {
    tool_length(in, w.code, w.block);
    control_tool_centre_point(in, tip, code_text(w.code));
    return true;
}
bool set_position(Interpreter& in, const CodeWord& w) {
    shift_position(in, w.block);
    return true;
}
bool end_position_shift(Interpreter& in, const CodeWord& w) {
    restore_shift(in.state_, w.code);
    return true;
}
bool count_in_machine(Interpreter& in, const CodeWord&) {
    in.this_block_.machine_coordinates = true;
    return true;
}
bool set_work_system(Interpreter& in, const CodeWord& w) {
    const bool extended = w.code > 59_g;  // G59.1 … G59.3
    select_work_system(in, extended ? 6 + w.code - 59_g : (w.code - 54_g) / 10 + 1);
    return true;
}
bool set_extended_system(Interpreter& in, const CodeWord& w) {
    const double number = is(w.block, 'P') ? w.block.words.of('P') : 1;
    select_work_system(in, 6 + static_cast<int>(std::clamp(number, -1e6, 1e6)));
    return true;
}
bool end_cycles(Interpreter& in, const CodeWord&) {
    in.state_.motion = MotionMode::none;
    in.state_.cycle = 0;
    return true;
}
bool start_table_compensation(Interpreter& in, const CodeWord& w) {
    compensate_by_table(in, w.code, w.block, w.column);
    return true;
}
bool note_mode(Interpreter& in, const CodeWord& w, const char* name) {
    in.event(name, code_text(w.code) + words_text(w.block, "PQ"));
    // P and Q belong to this code only.
    w.block.words.has &= ~(Words::bit('P') | Words::bit('Q'));
    return true;
}
bool end_compensation(Interpreter& in, const CodeWord& w) {
    if (!in.compensation_.path.on()) return note_mode(in, w, "cutter-compensation");
    stop_compensation(in);
    return true;
}
bool note_spindle_mode(Interpreter& in, const CodeWord& w) { return note_mode(in, w, "spindle-mode"); }
bool note_unused(Interpreter& in, const CodeWord& w) { return note_mode(in, w, "unused"); }
bool start_cycle(Interpreter& in, const CodeWord& w) {
    if (in.state_.motion != MotionMode::cycle) in.cycle_ = {};
    // RS274: another cycle needs its own words; the initial level of the first one is kept.
    const bool begins_anew = in.rules_->cycles.rs274 && in.state_.cycle != w.code;
    if (begins_anew) in.cycle_ = CycleState{.initial = in.cycle_.initial};
    in.state_.motion = MotionMode::cycle;
    in.state_.cycle = w.code;
    return true;
}

/// The common meaning of codes; a row of a dialect takes precedence.
constexpr auto common_codes = std::to_array<CodeRule>({
    {0_g, set_motion<MotionMode::rapid>},
    {1_g, set_motion<MotionMode::feed>},
    {2_g, set_motion<MotionMode::cw>},
    {3_g, set_motion<MotionMode::ccw>},
    {4_g, dwell_in_seconds},
    {8_g, note_unused},
    {13_g, note_unused},
    {17_g, set_plane<2>},
    {18_g, set_plane<1>},
    {19_g, set_plane<0>},
    {20_g, count_in_inches},
    {21_g, count_in_mm},
    {28_g, go_to_reference},
    {30_g, go_to_reference},
    {33_g, set_motion<MotionMode::thread>},
    {40_g, end_compensation},
    {41_g, start_table_compensation},
    {41.1_g, start_table_compensation},
    {42_g, start_table_compensation},
    {42.1_g, start_table_compensation},
    {43_g, set_tool_length<false>},
    {43.1_g, set_tool_length<false>},
    {43.2_g, set_tool_length<false>},
    {43.4_g, set_tool_length<true>},
    {43.5_g, set_tool_length<true>},
    {44_g, set_tool_length<false>},
    {49_g, set_tool_length<false>},
    {52_g, set_position},
    {53_g, count_in_machine},
    {54_g, set_work_system},
    {54.1_g, set_extended_system},
    {55_g, set_work_system},
    {56_g, set_work_system},
    {57_g, set_work_system},
    {58_g, set_work_system},
    {59_g, set_work_system},
    {59.1_g, set_work_system},
    {59.2_g, set_work_system},
    {59.3_g, set_work_system},
    {73_g, start_cycle},
    {74_g, start_cycle},
    {76_g, start_cycle},
    {80_g, end_cycles},
    {81_g, start_cycle},
    {82_g, start_cycle},
    {83_g, start_cycle},
    {84_g, start_cycle},
    {84.3_g, start_cycle},
    {85_g, start_cycle},
    {86_g, start_cycle},
    {87_g, start_cycle},
    {88_g, start_cycle},
    {89_g, start_cycle},
    {90_g, set_flag<&ModalState::incremental, false>},
    {90.1_g, set_flag<&ModalState::centre_absolute, true>},
    {91_g, set_flag<&ModalState::incremental, true>},
    {91.1_g, set_flag<&ModalState::centre_absolute, false>},
    {92_g, set_position},
    {92.1_g, end_position_shift},
    {92.2_g, end_position_shift},
    {92.3_g, end_position_shift},
    {93_g, set_feed_mode<FeedMode::inverse_time>},
    {94_g, set_feed_mode<FeedMode::per_minute>},
    {95_g, set_feed_mode<FeedMode::per_revolution>},
    {96_g, note_spindle_mode},
    {97_g, note_spindle_mode},
    {98_g, set_flag<&ModalState::retract_to_r, false>},
    {99_g, set_flag<&ModalState::retract_to_r, true>},
});

constexpr bool in_order(std::span<const CodeRule> rows) {
    return std::is_sorted(rows.begin(), rows.end(),
                          [](const CodeRule& a, const CodeRule& b) { return a.code < b.code; });
}
static_assert(in_order(common_codes));

const CodeRule* rule_of(const std::vector<CodeRule>& rules, int code) {
    const auto found = std::lower_bound(rules.begin(), rules.end(), code,
                                        [](const CodeRule& row, int wanted) { return row.code < wanted; });
    return found != rules.end() && found->code == code ? &*found : nullptr;
}

void apply_common(Interpreter& in, int code, Block& block, std::size_t column) {
    const auto* found = std::lower_bound(common_codes.begin(), common_codes.end(), code,
                                         [](const CodeRule& row, int wanted) { return row.code < wanted; });
    if (found != common_codes.end() && found->code == code) {
        (void)found->handle(in, {code, block, column});
        return;
    }
    if ((in.rules_->motion.refuses_curve_codes && is_curve_elsewhere(code)) || names_axes(block))
        refuse_motion(in, code_text(code), block, column, where_code_is_known(code));
    in.note(Severity::warning, "program.unknown-word", code_text(code) + " is not known", column);
}

void apply_code(Interpreter& in, int code, Block& block, std::size_t column) {
    refuse_in_compensation(in, code, block, column);
    const CodeWord word{code, block, column};
    const CodeRule* rule = rule_of(in.code_rules_, code);
    const CodeHandler handle = rule != nullptr ? rule->handle : in.rules_->other_code;
    if (handle == nullptr || !handle(in, word)) apply_common(in, code, block, column);
}

void settle_codes(Interpreter& in, Block& block) {
    const int count = block.words.g_count;
    if (count == 1) return apply_code(in, block.words.g[0], block, block.words.g_column[0]);
    struct Step {
        int order;
        std::size_t k;
    };
    std::array<Step, Words::most_codes> steps{};
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const CodeRule* rule = rule_of(in.code_rules_, block.words.g[k]);
        steps[k] = {rule != nullptr && rule->order >= 0 ? rule->order : order_of(block.words.g[k]), k};
    }
    std::stable_sort(steps.begin(), steps.begin() + count,
                     [](const Step& a, const Step& b) { return a.order < b.order; });
    for (int i = 0; i < count; ++i) {
        const std::size_t k = steps[static_cast<std::size_t>(i)].k;
        apply_code(in, block.words.g[k], block, block.words.g_column[k]);
    }
}

void apply_m(Interpreter& in, int code, const Block& block) {
    for (const MRule& row : in.rules_->m_codes) {
        if (row.code == code && row.handle(in, code, block)) return;
    }
    switch (code) {
        case 0:
        case 1:
        case 60: in.event("stop", fmt::format("M{}", code)); return;
        case 2:
        case 30:
            in.event("end", fmt::format("M{}", code));
            in.ended_ = true;
            return;
        case 3:
        case 4:
        case 5: in.event("spindle", fmt::format("M{}", code)); return;
        case 6: in.event("tool-change", is(block, 'T') ? fmt::format("M6 T{:g}", block.words.of('T')) : "M6"); return;
        case 7:
        case 8:
        case 9: in.event("coolant", fmt::format("M{}", code)); return;
        case 17:
        case 70:
        case 71:
        case 72:
        case 73:
        case 98:
        case 99: return;
        case 91:
        case 92:
        case 128:
        case 129: in.event("m-code", fmt::format("M{}", code)); return;
        default: in.event("m-code", fmt::format("M{}", code) + words_text(block, "PQ")); return;
    }
}

/// Reports words of arcs, cycles and calls in a straight motion, which does not use them: an R meant as a corner, an
/// I whose G2 is missing. Blocks with a code of another kind are not checked.
void report_idle(Interpreter& in, const Block& block) {
    constexpr auto plain_codes =
        std::to_array<int>({0_g, 1_g, 17_g, 18_g, 19_g, 20_g, 21_g, 70_g, 71_g, 90_g, 91_g, 94_g});
    const bool straight = (in.state_.motion == MotionMode::rapid || in.state_.motion == MotionMode::feed) &&
                          !in.this_block_.motion_suppressed;
    const auto* first = block.words.g.data();
    const bool plain = std::all_of(first, first + block.words.g_count, [&](int code) {
        return std::find(plain_codes.begin(), plain_codes.end(), code) != plain_codes.end();
    });
    const bool theirs = block.words.m_count > 0 || !block.keywords.empty() || in.modal_call_.active ||
                        in.five_axis_.tool_centre_point || in.compensation_.path.on();
    if (!straight || !plain || theirs) return;
    for (const char letter : in.rules_->motion.idle_letters) {
        if (!is(block, letter)) continue;
        in.note(Severity::warning, "program.unused-word",
                fmt::format("word {} has no meaning for a straight motion and is ignored", letter),
                block.words.column[static_cast<std::size_t>(letter - 'A')]);
    }
}

/// Reports words without a meaning in any part of the interpreter.
void report_unused(Interpreter& in, const Block& block) {
    report_idle(in, block);
    for (const UnknownWord& word : block.unknown) {
        if (is_numbered_axis(word.text)) refuse_motion(in, word.text, block, word.column);
        if (is_axis_without_value(word.text)) in.fail(fmt::format("{} has no value", word.text.front()), word.column);
        in.note(Severity::warning, "program.unknown-word", "'" + word.text + "' is not known", word.column);
    }
    for (const NamedWord& word : block.named) {
        const bool corner = word.name == "RND" || word.name == "RNDM" || word.name == "CHR" || word.name == "CHF" ||
                            word.name == "DISR";
        if (corner)
            in.note(Severity::warning, "program.corner",
                    fmt::format("{}={:g} is not carried out: the corner is read as programmed", word.name, word.value),
                    word.column);
        const bool line = word.name == "ANG" && (in.this_block_.motion_suppressed || !ends_by_angle(in.state_, block));
        if (line)
            in.note(
                Severity::warning, "program.corner",
                fmt::format(
                    "ANG={:g} is not carried out without one coordinate of the plane: the end is read as programmed",
                    word.value),
                word.column);
    }
    for (const char letter : {'V', 'W', 'U', 'E'}) {
        if (!is(block, letter) || in.this_block_.motion_suppressed) continue;
        const std::size_t column = block.words.column[static_cast<std::size_t>(letter - 'A')];
        if (letter == 'E') {
            in.note(Severity::warning, "program.unknown-word", "word E is not known", column);
            continue;
        }
        // If such an axis stays at 0, it has no effect; if it moves, it displaces the tool or the part.
        const bool moves = in.state_.motion == MotionMode::rapid || in.state_.motion == MotionMode::feed ||
                           in.state_.motion == MotionMode::cw || in.state_.motion == MotionMode::ccw;
        if (block.words.of(letter) == 0) continue;
        if (moves && in.rules_->motion.separate_uvw) {
            // In this dialect U V W are never increments of X Y Z, which stay correct.
            in.note(Severity::warning, "program.axis",
                    fmt::format("axis {} moves: positions are those of X Y Z without it", letter), column);
            continue;
        }
        if (moves)
            in.fail(fmt::format("axis {} moves: where the tool is with axes U V W is not known", letter), column,
                    "X Y Z A B C are");
        in.note(Severity::warning, "program.axis", fmt::format("word {} has no meaning here", letter), column);
    }
}

}  // namespace

bool count_in_inches(Interpreter& in, const CodeWord&) {
    count_in(in.state_, in.rules_->motion, mm_per_inch);
    return true;
}

bool count_in_mm(Interpreter& in, const CodeWord&) {
    count_in(in.state_, in.rules_->motion, 1);
    return true;
}

void refuse_motion(const Interpreter& in, const std::string& word, const Block& block, std::size_t column,
                   const std::string& hint) {
    in.fail(fmt::format("{} is not known in {}{}", word, in.program_.dialect->name,
                        names_axes(block) ? ", and its block moves axes" : ", and moves axes"),
            column, hint);
}

void Interpreter::execute(Block& block) {
    this_block_.machine_coordinates = false;
    this_block_.motion_suppressed = false;
    this_block_.probes = false;
    if (rules_->begin_block != nullptr && rules_->begin_block(*this, block)) return;
    if (ended_) return;
    change_tool(*this, block);
    settle_codes(*this, block);
    if (rules_->after_codes != nullptr) rules_->after_codes(*this, block);
    if (is(block, 'F') && !this_block_.motion_suppressed) take_feed(state_, rules_->motion, block.words.of('F'));
    if (is(block, 'S')) {
        if (block.words.of('S') < 0) note(Severity::warning, "program.spindle", "negative spindle speed");
        state_.spindle = block.words.of('S');
        event("spindle", fmt::format("S{:g}", state_.spindle));
    }
    if (is(block, 'T')) event("tool", fmt::format("T{:g}", block.words.of('T')), ToolWord{block.words.of('T'), {}});
    const auto apply_m_codes = [&](bool that_stop) {
        for (int i = 0; i < block.words.m_count; ++i) {
            const int code = block.words.m[static_cast<std::size_t>(i)];
            if (stops_block(code) == that_stop) apply_m(*this, code, block);
        }
    };
    apply_m_codes(false);
    const std::int64_t before = program_.motions.size();
    if (!this_block_.motion_suppressed) move_axes(*this, block);
    if (rules_->after_motion != nullptr) rules_->after_motion(*this, block);
    report_unused(*this, block);
    if (std::exchange(this_block_.path_mode_returns, false))
        set_path_mode(*this, "path-mode", "as it was", state_.path_mode);
    apply_m_codes(true);
    if (ended_) return;
    if (rules_->after_block != nullptr) rules_->after_block(*this, block);
    const bool calls =
        modal_call_.active && calls_.frames.size() == modal_call_.level && program_.motions.size() > before;
    if (calls && rules_->modal_call != nullptr) rules_->modal_call(*this);
}

std::vector<CodeRule> by_code(std::span<const CodeRule> rules) {
    std::vector<CodeRule> sorted(rules.begin(), rules.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const CodeRule& a, const CodeRule& b) { return a.code < b.code; });
    return sorted;
}

}  // namespace clsurf

// What the words of a block mean: G and M codes, offsets, modes.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

/// Codes that are read, kept as an event and change no motion, by dialect.
struct NotedCode {
    int code;  ///< tenths
    const char* event;
};
constexpr auto noted_everywhere = std::to_array<NotedCode>({
    {400, "cutter-compensation"},
    {960, "spindle-mode"},
    {970, "spindle-mode"},
    {80, "unused"},
    {130, "unused"},
});
bool is(const Block& block, char letter) { return block.words.given(letter); }
/// G0 to G3, or a thread.
bool names_motion(const Block& block) {
    const auto* first = block.words.g.data();
    return std::any_of(first, first + block.words.g_count, [](std::int32_t code) {
        return code <= 30 || (code >= 330 && code <= 350) || code == 3310 || code == 3320;
    });
}

bool names_axes(const Block& block) {
    constexpr std::uint32_t axes = Words::xyz | Words::bit('A') | Words::bit('B') | Words::bit('C') | Words::bit('U') |
                                   Words::bit('V') | Words::bit('W');
    return (block.words.has & axes) != 0 || block.polar_radius || block.polar_angle;
}

/// G codes of curves, which move axes in the blocks after theirs as well.
bool is_motion_elsewhere(int code, DialectId dialect) {
    static constexpr auto curves = std::to_array<int>({52, 53, 61, 62, 63});
    // G6.2 of Heidenhain would be its G06.
    return dialect != DialectId::heidenhain_iso && std::find(curves.begin(), curves.end(), code) != curves.end();
}

/// "X1=" of siemens: an axis of the machine by its name.
bool is_numbered_axis(std::string_view word) {
    return word.size() > 2 && word.back() == '=' &&
           std::string_view("XYZABCUVW").find(word.front()) != std::string::npos &&
           word.find_first_not_of("0123456789", 1) == word.size() - 1;
}

/// Where an unknown code is known.
std::string hint_of_code(int code, DialectId dialect) {
    if ((code == 50 || code == 51 || code == 52 || code == 53) && dialect != DialectId::linuxcnc)
        return fmt::format("{} is a spline of linuxcnc: --dialect linuxcnc", code_text(code));
    if (code == 61 || code == 62 || code == 63) return "NURBS are not read: let the CAM system write lines and arcs";
    return {};
}

constexpr auto cycle_codes = std::to_array<int>({730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890, 843});

/// The order in which the codes of one block work (RS274/NGC, table 8).
int order_of(int code) {
    switch (code) {
        case 930:
        case 940:
        case 950: return 0;
        case 170:
        case 180:
        case 190: return 1;
        case 40: return 2;
        case 400:
        case 410:
        case 420:
        case 411:
        case 421: return 3;
        case 200:
        case 210:
        case 700:
        case 710: return 1;
        case 430:
        case 431:
        case 432:
        case 434:
        case 440:
        case 490: return 4;
        case 530: return 6;
        case 900:
        case 910:
        case 901:
        case 911: return 7;
        case 280:
        case 300:
        case 281:
        case 301:
        case 100:
        case 520: return 9;
        case 920:
        case 921:
        case 922:
        case 923: return 9;
        default: break;
    }
    return code >= 540 && code < 600 ? 5 : 8;
}

}  // namespace

void Interpreter::execute(Block& block) {
    machine_coordinates_ = false;
    motion_suppressed_ = false;
    call_program_ = -1;
    if (dialect_ == DialectId::siemens && names_motion(block)) arc_kind_ = ArcKind::usual;  // what ends CIP and CT
    if (data_entry_ && !is_data_end(block)) return;
    if (macro_call(block)) return;
    for (const Keyword& keyword : block.keywords) { apply_keyword(keyword, block); }
    if (ended_) return;
    contour_tolerance(block);
    change_tool(block);
    settle_codes(block);
    take_pole(block);
    if (is(block, 'F') && !motion_suppressed_) state_.feed = block.words.of('F');
    if (is(block, 'S')) {
        if (block.words.of('S') < 0) note(Severity::warning, "program.spindle", "negative spindle speed");
        state_.spindle = block.words.of('S');
        event("spindle", fmt::format("S{:g}", state_.spindle));
    }
    if (is(block, 'T')) event("tool", fmt::format("T{:g}", block.words.of('T')));
    bool stops = false;
    for (int i = 0; i < block.words.m_count; ++i) {
        const int code = block.words.m[static_cast<std::size_t>(i)];
        if (code == 0 || code == 1 || code == 2 || code == 30 || code == 60 || code == 98 || code == 99) {
            stops = true;
        } else {
            apply_m(code, block);
        }
    }
    const std::int64_t before = program_.motions.size();
    if (!motion_suppressed_) move(block);
    if (dialect_ == DialectId::linuxcnc) read_machine_position(block);
    report_unused(block);
    if (std::exchange(path_mode_returns_, false)) set_path_mode("path-mode", "as it was", state_.path_mode);
    if (stops) {
        for (int i = 0; i < block.words.m_count; ++i) {
            const int code = block.words.m[static_cast<std::size_t>(i)];
            if (code == 0 || code == 1 || code == 2 || code == 30 || code == 60 || code == 98 || code == 99) {
                apply_m(code, block);
            }
        }
    }
    if (ended_) return;
    if (dialect_ != DialectId::linuxcnc) call_from_words(block);
    const bool calls = modal_call_.active && frames_.size() == modal_call_.level && program_.motions.size() > before;
    if (calls) run_modal_call();
}

void Interpreter::settle_codes(Block& block) {
    const int count = block.words.g_count;
    std::array<int, Words::most_codes> sequence{};
    for (int i = 0; i < count; ++i) sequence[static_cast<std::size_t>(i)] = i;
    std::stable_sort(sequence.begin(), sequence.begin() + count, [&](int a, int b) {
        const auto order = [&](int k) {
            const int code = block.words.g[static_cast<std::size_t>(k)];
            // Heidenhain's G54 is no work system: its words count as G90 or G91 has it.
            return dialect_ == DialectId::heidenhain_iso && code == 540 ? order_of(520) : order_of(code);
        };
        return order(a) < order(b);
    });
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(sequence[static_cast<std::size_t>(i)]);
        apply_code(block.words.g[k], block, block.words.g_column[k]);
    }
}

void Interpreter::apply_code(int code, Block& block, std::size_t column) {
    refuse_in_compensation(code, block, column);
    if (apply_path_mode(code, block, column) || apply_of_dialect(code, block, column)) return;
    apply_common(code, block, column);
}

void Interpreter::apply_common(int code, Block& block, std::size_t column) {
    const auto noted = std::find_if(noted_everywhere.begin(), noted_everywhere.end(),
                                    [&](const NotedCode& n) { return n.code == code; });
    switch (code) {
        case 0: state_.motion = MotionMode::rapid; return;
        case 10: state_.motion = MotionMode::feed; return;
        case 20: state_.motion = MotionMode::cw; return;
        case 30: state_.motion = MotionMode::ccw; return;
        case 40: dwell(block); return;
        case 170: state_.plane_axis = 2; return;
        case 180: state_.plane_axis = 1; return;
        case 190: state_.plane_axis = 0; return;
        case 200: state_.count_in(mm_per_inch); return;
        case 210: state_.count_in(1); return;
        case 280:
        case 300: reference(code, block); return;
        case 330: state_.motion = MotionMode::thread; return;
        case 430:
        case 431:
        case 432:
        case 440:
        case 490:
            tool_length(code, block);
            control_tool_centre_point(false, code_text(code));
            return;
        case 434:
        case 435:
            tool_length(code, block);
            control_tool_centre_point(true, code_text(code));
            return;
        case 520:
        case 920:
        case 921:
        case 922:
        case 923:
            if (code == 520 || code == 920)
                shift_position(block);
            else
                restore_shift(code);
            return;
        case 530: machine_coordinates_ = true; return;
        case 540:
        case 550:
        case 560:
        case 570:
        case 580:
        case 590: select_work_system((code - 540) / 10 + 1); return;
        case 591:
        case 592:
        case 593: select_work_system(6 + code - 590); return;
        case 541:
            select_work_system(6 + (is(block, 'P') ? static_cast<int>(std::clamp(block.words.of('P'), -1e6, 1e6)) : 1));
            return;
        case 800:
            state_.motion = MotionMode::none;
            state_.cycle = 0;
            return;
        case 900: state_.incremental = false; return;
        case 910: state_.incremental = true; return;
        case 901: state_.centre_absolute = true; return;
        case 911: state_.centre_absolute = false; return;
        case 930: select_feed_mode(FeedMode::inverse_time); return;
        case 940: select_feed_mode(FeedMode::per_minute); return;
        case 950: select_feed_mode(FeedMode::per_revolution); return;
        case 980: state_.retract_to_r = false; return;
        case 990: state_.retract_to_r = true; return;
        case 410:
        case 420:
        case 411:
        case 421: compensate_by_table(code, block, column); return;
        case 400:
            if (!compensation_.on()) break;
            stop_compensation();
            return;
        default: break;
    }
    if (std::find(cycle_codes.begin(), cycle_codes.end(), code) != cycle_codes.end()) {
        // Another cycle needs its own words; the level where the first of them began stays.
        if (state_.motion != MotionMode::cycle) cycle_ = {};
        if (state_.cycle != code) cycle_ = CycleState{.initial = cycle_.initial};
        state_.motion = MotionMode::cycle;
        state_.cycle = code;
        return;
    }
    if (noted != noted_everywhere.end()) {
        event(noted->event, code_text(code) + words_text(block, "PQ"));
        // Their words are theirs alone.
        block.words.has &= ~(Words::bit('P') | Words::bit('Q'));
        return;
    }
    if (is_motion_elsewhere(code, dialect_) || names_axes(block))
        refuse_motion(code_text(code), block, column, hint_of_code(code, dialect_));
    note(Severity::warning, "program.unknown-word", code_text(code) + " is not known", column);
}

/// A word whose motion would be read as another one, or not at all.
void Interpreter::refuse_motion(const std::string& word, const Block& block, std::size_t column,
                                const std::string& hint) const {
    fail(fmt::format("{} is not known in {}{}", word, program_.dialect->name,
                     names_axes(block) ? ", and its block moves axes" : ", and moves axes"),
         column, hint);
}

bool Interpreter::apply_of_dialect(int code, Block& block, std::size_t column) {
    switch (dialect_) {
        case DialectId::linuxcnc:
            switch (code) {
                case 400: stop_compensation(); return true;
                case 410:
                case 420:
                case 411:
                case 421: start_compensation(code, block, column); return true;
                case 50: state_.motion = MotionMode::cubic_spline; return true;
                case 51: state_.motion = MotionMode::quadratic_spline; return true;
                case 52: state_.motion = MotionMode::nurbs; return true;
                case 53: nurbs_end(); return true;
                case 70:
                case 80:
                    state_.diameter = code == 70;
                    event("lathe", code_text(code));
                    return true;
                case 100: set_offsets(block); return true;
                case 281:
                case 301: keep_reference(code); return true;
                case 331: state_.motion = MotionMode::tap; return true;
                case 382:
                case 383:
                case 384:
                case 385: state_.motion = MotionMode::probe; return true;
                case 700:
                case 710:
                case 711:
                case 712:
                case 720:
                case 721:
                case 722: lathe_cycle(code, Block(block), column); return true;
                case 690: return false;
                default: return false;
            }
        case DialectId::fanuc: return apply_fanuc(code, block, column);
        case DialectId::siemens: return apply_siemens(code, block, column);
        case DialectId::heidenhain_iso: return apply_heidenhain(code, block, column);
    }
    return false;
}

void Interpreter::apply_m(int code, const Block& block) {
    switch (code) {
        case 0:
        case 1:
        case 60: event("stop", fmt::format("M{}", code)); return;
        case 2:
        case 30:
            event("end", fmt::format("M{}", code));
            ended_ = true;
            return;
        case 3:
        case 4:
        case 5: event("spindle", fmt::format("M{}", code)); return;
        case 6: event("tool-change", is(block, 'T') ? fmt::format("M6 T{:g}", block.words.of('T')) : "M6"); return;
        case 7:
        case 8:
        case 9: event("coolant", fmt::format("M{}", code)); return;
        case 17:
            if (dialect_ == DialectId::siemens) leave(false);
            return;
        case 70:
        case 71:
        case 72:
        case 73:
            if (dialect_ == DialectId::linuxcnc) keep_modes(code);
            return;
        case 98:
        case 99:
            if (dialect_ == DialectId::fanuc || dialect_ == DialectId::linuxcnc) {
                if (code == 98) {
                    call_program_ =
                        is(block, 'P') ? static_cast<int>(std::clamp(block.words.of('P'), 0.0, 99999999.0)) : -2;
                    if (dialect_ == DialectId::linuxcnc) call_from_words(block);
                } else if (is(block, 'P')) {
                    // M99 P: back to that block of the caller.
                    const double number = block.words.of('P');
                    leave(false);
                    const LineNumber line = find_block(number, 0, 0);
                    if (line == 0) fail(fmt::format("M99 P{:g}: there is no block N{:g}", number, number));
                    go_to(file_, line);
                } else {
                    leave(false);
                }
            }
            return;
        case 91:
        case 92:
            if (dialect_ == DialectId::heidenhain_iso) {
                machine_coordinates_ = code == 91;
                if (code == 92)
                    note(Severity::warning, "program.unknown-word", "M92: the machine's second zero is not known");
                return;
            }
            event("m-code", fmt::format("M{}", code));
            return;
        case 128:
        case 129:
            if (dialect_ == DialectId::heidenhain_iso) {
                control_tool_centre_point(code == 128, fmt::format("M{}", code));
                return;
            }
            event("m-code", fmt::format("M{}", code));
            return;
        default: event("m-code", fmt::format("M{}", code) + words_text(block, "PQ")); return;
    }
}

void Interpreter::dwell(const Block& block) {
    // Fanuc's X and U belong to the dwell; RS274 lets a motion follow in the same block.
    motion_suppressed_ = dialect_ != DialectId::linuxcnc;
    double seconds = 0;
    if (dialect_ == DialectId::siemens) {
        if (is(block, 'F')) seconds = block.words.of('F');
        if (is(block, 'S') && state_.spindle > 0) seconds = block.words.of('S') * seconds_per_minute / state_.spindle;
    } else if (dialect_ == DialectId::fanuc) {
        // X and U count seconds, P milliseconds.
        if (is(block, 'X')) seconds = block.words.of('X');
        if (is(block, 'U')) seconds = block.words.of('U');
        if (is(block, 'P')) seconds = block.words.of('P') / 1000;
    } else if (dialect_ == DialectId::heidenhain_iso) {
        if (is(block, 'F')) seconds = block.words.of('F');
    } else if (is(block, 'P')) {
        seconds = block.words.of('P');
    }
    if (seconds < 0) fail("negative dwell time");
    push(MotionKind::dwell, tool_position(), state_.rotary, static_cast<float>(seconds));
}

/// Words of arcs, cycles and calls beside a straight motion, which uses none of them: an R that was
/// meant as a corner, an I whose G2 is missing. Blocks with a code of another kind are left to it.
void Interpreter::report_idle(const Block& block) {
    constexpr auto plain_codes = std::to_array<int>({0, 10, 170, 180, 190, 200, 210, 700, 710, 900, 910, 940});
    const bool straight =
        (state_.motion == MotionMode::rapid || state_.motion == MotionMode::feed) && !motion_suppressed_;
    const auto* first = block.words.g.data();
    const bool plain = std::all_of(first, first + block.words.g_count, [&](int code) {
        return std::find(plain_codes.begin(), plain_codes.end(), code) != plain_codes.end();
    });
    const bool theirs = block.words.m_count > 0 || !block.keywords.empty() || modal_call_.active ||
                        tool_centre_point_ || compensation_.on();
    if (!straight || !plain || theirs || dialect_ == DialectId::heidenhain_iso) return;
    for (const char letter : std::string_view(dialect_ == DialectId::siemens ? "IJK" : "IJKLPQR")) {
        if (!is(block, letter)) continue;
        note(Severity::warning, "program.unused-word",
             fmt::format("word {} has no meaning beside a straight motion: it is left out", letter),
             block.words.column[static_cast<std::size_t>(letter - 'A')]);
    }
}

/// Words that no part of the interpreter has a meaning for.
void Interpreter::report_unused(const Block& block) {
    report_idle(block);
    for (const UnknownWord& word : block.unknown) {
        if (is_numbered_axis(word.text)) refuse_motion(word.text, block, word.column);
        note(Severity::warning, "program.unknown-word", "'" + word.text + "' is not known", word.column);
    }
    for (const NamedWord& word : block.named) {
        const bool corner = word.name == "RND" || word.name == "RNDM" || word.name == "CHR" || word.name == "CHF" ||
                            word.name == "DISR";
        if (corner)
            note(Severity::warning, "program.corner",
                 fmt::format("{}={:g} is not carried out: the corner is read as programmed", word.name, word.value),
                 word.column);
        const bool line = word.name == "ANG" && (motion_suppressed_ || !ends_by_angle(block));
        if (line)
            note(Severity::warning, "program.corner",
                 fmt::format(
                     "ANG={:g} is not carried out without one coordinate of the plane: the end is read as programmed",
                     word.value),
                 word.column);
    }
    for (const char letter : {'V', 'W', 'U', 'E'}) {
        if (!is(block, letter) || motion_suppressed_) continue;
        const std::size_t column = block.words.column[static_cast<std::size_t>(letter - 'A')];
        if (letter == 'E') {
            note(Severity::warning, "program.unknown-word", "word E is not known", column);
            continue;
        }
        // Where such an axis stays at 0 it changes nothing; moved, it takes the tool or the part elsewhere.
        const bool moves = state_.motion == MotionMode::rapid || state_.motion == MotionMode::feed ||
                           state_.motion == MotionMode::cw || state_.motion == MotionMode::ccw;
        if (block.words.of(letter) == 0) continue;
        if (moves && dialect_ == DialectId::linuxcnc) {
            // Its axes U V W are never increments of X Y Z, which stay true.
            note(Severity::warning, "program.axis",
                 fmt::format("axis {} moves: positions are those of X Y Z without it", letter), column);
            continue;
        }
        if (moves)
            fail(fmt::format("axis {} moves: where the tool is with axes U V W is not known", letter), column,
                 "X Y Z A B C are");
        note(Severity::warning, "program.axis", fmt::format("word {} has no meaning here", letter), column);
    }
}

}  // namespace clsurf

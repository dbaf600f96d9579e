// What the words of a block mean: G and M codes, offsets, modes.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "program/interpreter_state.h"

namespace clsurf {
namespace {

/// Codes that are read, kept as an event and change no motion, by dialect.
struct NotedCode {
    int code;  ///< tenths
    const char* event;
};
constexpr auto noted_everywhere = std::to_array<NotedCode>({
    {400, "cutter-compensation"}, {610, "path-mode"}, {611, "path-mode"}, {640, "path-mode"},
    {960, "spindle-mode"}, {970, "spindle-mode"}, {80, "unused"}, {150, "polar"}, {130, "unused"},
    {690, "rotation"}, {500, "scaling"}, {670, "modal-macro"},
});
constexpr auto noted_siemens = std::to_array<int>({
    90,  250, 260, 270, 330, 340, 350, 500, 600, 601, 602, 603, 2500, 4500, 4510, 4600, 4610, 4620,
    6010, 6020, 6030, 620, 621, 641, 6410, 6420, 6430, 6440, 6450, 1470, 1480, 2470, 2480, 3470, 3480,
    1400, 1410, 1420, 1430, 3400, 3410, 4000, 5000, 5100, 9610, 9710, 9730,
});

bool is(const Block& block, char letter) { return block.words.given(letter); }

constexpr auto cycle_codes = std::to_array<int>({730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890, 843});

/// The order in which the codes of one block work (RS274/NGC, table 8).
int order_of(int code) {
    switch (code) {
        case 930: case 940: case 950: return 0;
        case 170: case 180: case 190: return 1;
        case 40: return 2;
        case 400: case 410: case 420: case 411: case 421: return 3;
        case 200: case 210: case 700: case 710: case 7000: case 7100: return 1;
        case 430: case 431: case 432: case 434: case 440: case 490: return 4;
        case 530: return 6;
        case 900: case 910: case 901: case 911: return 7;
        case 280: case 300: case 281: case 301: case 100: case 520: return 9;
        case 920: case 921: case 922: case 923: return 9;
        default: break;
    }
    return code >= 540 && code < 600 ? 5 : 8;
}

}  // namespace

void Interpreter::execute(Block& block) {
    machine_coordinates_ = false;
    motion_suppressed_ = false;
    call_program_ = -1;
    for (const Keyword& keyword : block.keywords) {
        apply_keyword(keyword, block);
    }
    if (ended_) return;
    if (dialect_ == DialectId::linuxcnc) change_tool(block);
    settle_codes(block);
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
    if (!motion_suppressed_) move(block);
    if (dialect_ == DialectId::linuxcnc) read_machine_position(block);
    report_unused(block);
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
}

void Interpreter::settle_codes(Block& block) {
    const int count = block.words.g_count;
    std::array<int, Words::most_codes> sequence{};
    for (int i = 0; i < count; ++i) sequence[static_cast<std::size_t>(i)] = i;
    std::stable_sort(sequence.begin(), sequence.begin() + count, [&](int a, int b) {
        return order_of(block.words.g[static_cast<std::size_t>(a)]) < order_of(block.words.g[static_cast<std::size_t>(b)]);
    });
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(sequence[static_cast<std::size_t>(i)]);
        apply_code(block.words.g[k], block, block.words.g_column[k]);
    }
}

void Interpreter::apply_code(int code, Block& block, std::size_t column) {
    refuse_in_compensation(code, block, column);
    if (apply_of_dialect(code, block, column)) return;
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
        case 200: state_.unit_mm = mm_per_inch; return;
        case 210: state_.unit_mm = 1; return;
        case 280: case 300: reference(code, block); return;
        case 330: state_.motion = MotionMode::thread; return;
        case 430: case 431: case 432: case 440: case 490: tool_length(code, block); return;
        case 434: case 435: event("tool-centre-point", code_text(code)); return;
        case 520: case 920: case 921: case 922: case 923:
            if (code == 520 || code == 920) shift_position(block);
            else restore_shift(code);
            return;
        case 530: machine_coordinates_ = true; return;
        case 540: case 550: case 560: case 570: case 580: case 590:
            select_work_system((code - 540) / 10 + 1);
            return;
        case 591: case 592: case 593: select_work_system(6 + code - 590); return;
        case 541:
            select_work_system(6 + (is(block, 'P') ? static_cast<int>(block.words.of('P')) : 1));
            return;
        case 800: state_.motion = MotionMode::none; state_.cycle = 0; return;
        case 900: state_.incremental = false; return;
        case 910: state_.incremental = true; return;
        case 901: state_.centre_absolute = true; return;
        case 911: state_.centre_absolute = false; return;
        case 930: state_.feed_mode = FeedMode::inverse_time; return;
        case 940: state_.feed_mode = FeedMode::per_minute; return;
        case 950: state_.feed_mode = FeedMode::per_revolution; return;
        case 980: state_.retract_to_r = false; return;
        case 990: state_.retract_to_r = true; return;
        case 410: case 420: case 411: case 421:
            note(Severity::warning, "program.cutter-compensation",
                 code_text(code) + ": the path is read as programmed, without cutter compensation", column);
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
    note(Severity::warning, "program.unknown-word", code_text(code) + " is not known", column);
}

bool Interpreter::apply_of_dialect(int code, Block& block, std::size_t column) {
    switch (dialect_) {
        case DialectId::linuxcnc:
            switch (code) {
                case 400: stop_compensation(); return true;
                case 410: case 420: case 411: case 421: start_compensation(code, block, column); return true;
                case 50: state_.motion = MotionMode::cubic_spline; return true;
                case 51: state_.motion = MotionMode::quadratic_spline; return true;
                case 52: state_.motion = MotionMode::nurbs; return true;
                case 53: nurbs_end(); return true;
                case 70: case 80:
                    state_.diameter = code == 70;
                    event("lathe", code_text(code));
                    return true;
                case 100: set_offsets(block); return true;
                case 281: case 301: keep_reference(code); return true;
                case 331: state_.motion = MotionMode::tap; return true;
                case 382: case 383: case 384: case 385:
                    state_.motion = MotionMode::probe;
                    return true;
                case 700: case 710: case 711: case 712: case 720: case 721: case 722:
                    lathe_cycle(code, Block(block), column);
                    return true;
                case 690: return false;
                default: return false;
            }
        case DialectId::fanuc:
            switch (code) {
                case 50: case 51: case 80: case 81:
                    event("high-speed", code_text(code) + words_text(block, "PQR"));
                    motion_suppressed_ = (block.words.has & (Words::bit('X') | Words::bit('Y') | Words::bit('Z'))) == 0;
                    block.words.has &= ~(Words::bit('P') | Words::bit('Q') | Words::bit('R'));
                    return true;
                case 90:
                    return false;
                case 100: set_offsets(block); return true;
                case 650: motion_suppressed_ = true; return true;  // its words are arguments (flow.cpp)
                case 502: note(Severity::warning, "program.polygon", "G50.2 is not carried out", column); return true;
                case 510:
                    note(Severity::warning, "program.scaling", "G51: scaling is not carried out, the path is read as programmed", column);
                    motion_suppressed_ = true;
                    return true;
                case 680: case 682:
                    note(Severity::warning, "program.rotation", code_text(code) + ": rotation is not carried out, the path is read as programmed", column);
                    motion_suppressed_ = true;
                    return true;
                default: return false;
            }
        case DialectId::siemens:
            switch (code) {
                case 700: case 7000: state_.unit_mm = mm_per_inch; return true;
                case 710: case 7100: state_.unit_mm = 1; return true;
                case 530: case 1530: machine_coordinates_ = true; return true;
                case 5000: select_work_system(0); return true;
                case 740: case 750:
                    event("reference", code_text(code));
                    motion_suppressed_ = true;
                    return true;
                case 1100: case 1110: case 1120:
                    note(Severity::warning, "program.polar", code_text(code) + ": polar coordinates are not carried out", column);
                    motion_suppressed_ = true;
                    return true;
                case 280: case 300: case 430: case 520: case 920: return false;
                default: break;
            }
            if (code >= 5050 && code <= 5990) {
                select_work_system((code - 5050) / 10 + 5);
                return true;
            }
            if (std::find(noted_siemens.begin(), noted_siemens.end(), code) != noted_siemens.end()) {
                event("mode", code_text(code));
                return true;
            }
            return false;
        case DialectId::heidenhain_iso:
            switch (code) {
                case 700: state_.unit_mm = mm_per_inch; return true;
                case 710: state_.unit_mm = 1; return true;
                case 300: case 310:  // blank form
                case 990: case 980:
                    motion_suppressed_ = true;
                    return true;
                case 290: event("pole", words_text(block, "IJK")); motion_suppressed_ = true; return true;
                case 60: case 70: case 100: case 110: case 120: case 130: case 150: case 160: case 240: case 250: case 270:
                    note(Severity::warning, "program.unknown-word", code_text(code) + " is not carried out", column);
                    motion_suppressed_ = true;
                    return true;
                default: return false;
            }
    }
    return false;
}

void Interpreter::apply_m(int code, const Block& block) {
    switch (code) {
        case 0: case 1: case 60: event("stop", fmt::format("M{}", code)); return;
        case 2: case 30: event("end", fmt::format("M{}", code)); ended_ = true; return;
        case 3: case 4: case 5: event("spindle", fmt::format("M{}", code)); return;
        case 6: event("tool-change", is(block, 'T') ? fmt::format("M6 T{:g}", block.words.of('T')) : "M6"); return;
        case 7: case 8: case 9: event("coolant", fmt::format("M{}", code)); return;
        case 17:
            if (dialect_ == DialectId::siemens) leave(false);
            return;
        case 70: case 71: case 72: case 73:
            if (dialect_ == DialectId::linuxcnc) keep_modes(code);
            return;
        case 98: case 99:
            if (dialect_ == DialectId::fanuc || dialect_ == DialectId::linuxcnc) {
                if (code == 98) {
                    call_program_ = is(block, 'P') ? static_cast<int>(std::clamp(block.words.of('P'), 0.0, 99999999.0)) : -2;
                    if (dialect_ == DialectId::linuxcnc) call_from_words(block);
                } else if (is(block, 'P')) {
                    // M99 P: back to that block of the caller.
                    const double number = block.words.of('P');
                    leave(false);
                    const LineNumber line = find_block_number(program_.files[file_], number, 0, 0);
                    if (line == 0) fail(fmt::format("M99 P{:g}: there is no block N{:g}", number, number));
                    go_to(file_, line);
                } else {
                    leave(false);
                }
            }
            return;
        default:
            event("m-code", fmt::format("M{}", code) + words_text(block, "PQ"));
            return;
    }
}

void Interpreter::apply_keyword(const Keyword& keyword, Block& block) {
    const std::string& name = keyword.name;
    if (name == "SUPA" || name == "G153") {
        machine_coordinates_ = true;
        return;
    }
    if (name == "TRAORI" || name == "TRAFOOF" || name == "CYCLE832" || name == "FFWON" || name == "FFWOF" ||
        name == "SOFT" || name == "BRISK" || name.starts_with("COMP")) {
        event(name == "TRAORI" || name == "TRAFOOF" ? "tool-centre-point" : name == "CYCLE832" ? "high-speed" : "mode",
              keyword.has_arguments ? name + "(" + keyword.arguments + ")" : name);
        return;
    }
    if (name == "MCALL") {
        modal_call_.clear();
        event("modal-call", "MCALL");
        return;
    }
    // What follows MCALL in the block is called after every motion.
    const bool after_mcall = std::any_of(block.keywords.begin(), block.keywords.end(),
                                         [&](const Keyword& k) { return k.name == "MCALL"; });
    if (after_mcall) {
        modal_call_ = name;
        note(Severity::warning, "program.modal-call",
             "MCALL " + name + ": the strokes at each position are not known, the positions are read", keyword.column);
        return;
    }
    if (name == "T=" || name == "TLPREP" ) {
        event("tool", "T=\"" + keyword.arguments + "\"");
        return;
    }
    static constexpr auto noted = std::to_array<std::string_view>({
        "CYCLE800", "MSG", "COMPOF", "COMPON", "FNORM", "FLIN", "FCUB", "FFWON", "G0", "STOPRE", "AMIRROR",
        "AROT", "ROT", "TRANS", "ATRANS", "SCALE", "ASCALE", "MIRROR", "ORIWKS", "ORIMKS", "ORIAXES", "ORIVECT",
        "OTOL", "CTOL", "UPATH", "SPATH", "DIAMOF", "DIAMON", "CDOF", "CUT2D", "CUT2DF", "ORISOF", "WORKPIECE"});
    const bool frame = name == "AROT" || name == "ROT" || name == "TRANS" || name == "ATRANS" || name == "SCALE" ||
                       name == "ASCALE" || name == "MIRROR" || name == "AMIRROR";
    if (frame) {
        // The words belong to the frame, not to a motion. Positions stay those of the programmed frame.
        event("frame", name + words_text(block, "XYZABC"));
        motion_suppressed_ = true;
        block.words.has = 0;
        return;
    }
    if (std::find(noted.begin(), noted.end(), name) != noted.end() || name.ends_with("=")) {
        event("mode", keyword.has_arguments ? name + "(" + keyword.arguments + ")" : name);
        return;
    }
    if (name.starts_with("CYCLE") || name.starts_with("HOLES") || name.starts_with("POCKET") || name.starts_with("SLOT")) {
        note(Severity::warning, "program.cycle", name + " is not carried out", keyword.column);
        return;
    }
    if (dialect_ == DialectId::siemens) {
        const int repeats = is(block, 'P') ? static_cast<int>(std::clamp(block.words.of('P'), 1.0, 9999.0)) : 1;
        if (indexed_[file_] || options_.load) {
            const bool here = index(file_).find(ControlKind::label, name) >= 0;
            if (here || (options_.load && options_.load(name))) {
                call(name, repeats, true, {});
                motion_suppressed_ = true;
                return;
            }
        }
    }
    note(Severity::warning, "program.unknown-word", "'" + name + "' is not known", keyword.column);
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

/// Words that no part of the interpreter has a meaning for.
void Interpreter::report_unused(const Block& block) {
    for (const UnknownWord& word : block.unknown) {
        note(Severity::warning, "program.unknown-word", "'" + word.text + "' is not known", word.column);
    }
    for (const char letter : {'V', 'W', 'U', 'E'}) {
        if (!is(block, letter) || motion_suppressed_) continue;
        const bool axis = letter != 'E';
        note(Severity::warning, axis ? "program.axis" : "program.unknown-word",
             axis ? fmt::format("axis {} is not carried on", letter) : fmt::format("word {} is not known", letter),
             block.words.column[static_cast<std::size_t>(letter - 'A')]);
    }
}

}  // namespace clsurf

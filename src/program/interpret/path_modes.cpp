// How corners are passed: exact stops, tolerances, CYCLE832.

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// `once`: for this block alone.
void Interpreter::set_path_mode(const std::string& name, const std::string& value, const PathMode& mode, bool once) {
    event(name, value);
    program_.events.back().path_mode = mode;
    if (once)
        path_mode_returns_ = true;
    else
        state_.path_mode = mode;
}

/// G60, G61, G61.1, G9, G64 and its kin: what each dialect means by them.
bool Interpreter::apply_path_mode(int code, Block& block, std::size_t column) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const auto set = [&](const PathMode& mode, bool once = false) {
        set_path_mode("path-mode", code_text(code) + words_text(block, "PQ"), mode, once);
        // Their words are theirs alone.
        block.words.has &= ~(Words::bit('P') | Words::bit('Q'));
        return true;
    };
    const bool exact_stop_once = code == 90;
    switch (dialect_) {
        case DialectId::linuxcnc:
            if (code == 610) return set({BlockEnd::exact_path, 0});
            if (code == 611) return set({BlockEnd::exact_stop, 0});
            break;
        case DialectId::fanuc:
            if (code == 610) return set({BlockEnd::exact_stop, 0});
            if (code == 611) return set({BlockEnd::exact_path, 0});
            if (exact_stop_once) return set({BlockEnd::exact_stop, 0}, true);
            break;
        case DialectId::siemens:
            if (code == 610 || code == 611)
                fail(code_text(code) + " is not a word of siemens", column,
                     "the exact stop of siemens is G60 or G9; fanuc and linuxcnc have G61 (--dialect)");
            if (code == 600) return set({BlockEnd::exact_stop, 0});
            if (exact_stop_once) return set({BlockEnd::exact_stop, 0}, true);
            if (code == 6410 || code == 6420 || code == 6430 || code == 6440 || code == 6450)
                return set({BlockEnd::rounded, contour_tolerance_});
            if (code == 640)
                return set({BlockEnd::rounded, std::isnan(contour_tolerance_) ? unlimited : contour_tolerance_});
            return false;
        case DialectId::heidenhain_iso: return false;
    }
    if (code != 640) return false;
    const double tolerance = block.words.given('P') ? block.words.of('P') * state_.unit_mm : 0;
    // LinuxCNC: without Q the blocks are merged within P.
    const double merging = block.words.given('Q') ? block.words.of('Q') * state_.unit_mm : tolerance;
    return set({BlockEnd::rounded, tolerance > 0 ? tolerance : unlimited, merging});
}

/// CYCLE832(tolerance, kind of machining, …): kind 0 (_OFF), or no tolerance, gives the machine its own back.
void Interpreter::high_speed_settings(const Keyword& keyword) {
    std::vector<std::optional<double>> values;
    try {
        values = arguments_of(keyword);
    } catch (const ReadError& error) {
        // A variable that the control alone knows: no axis moves by it.
        note(Severity::warning, "program.variable", error.what + ": the machine's own tolerance is taken",
             error.column);
    }
    const double tolerance = values.empty() ? 0 : values[0].value_or(0) * state_.unit_mm;
    const double kind = values.size() > 1 ? values[1].value_or(1) : 1;
    const bool off = !(tolerance > 0) || std::fmod(std::round(kind), 10) == 0;
    contour_tolerance_ = off ? std::numeric_limits<double>::quiet_NaN() : tolerance;
    set_path_mode("high-speed", "CYCLE832(" + keyword.arguments + ")", {BlockEnd::rounded, contour_tolerance_});
}

/// CTOL=: of compressors and of G642 … G645; less than 0 gives the machine its own back.
void Interpreter::contour_tolerance(const Block& block) {
    const std::optional<double> value = block.value_of("CTOL");
    if (!value) return;
    contour_tolerance_ = *value >= 0 ? *value * state_.unit_mm : std::numeric_limits<double>::quiet_NaN();
    if (state_.path_mode.block_end == BlockEnd::rounded)
        set_path_mode("path-mode", fmt::format("CTOL={:g}", *value), {BlockEnd::rounded, contour_tolerance_});
}

}  // namespace clsurf

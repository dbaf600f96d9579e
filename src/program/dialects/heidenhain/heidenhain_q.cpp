// Heidenhain DIN/ISO: the Q functions D00 to D13, and calls of labels.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "program/dialects/heidenhain/heidenhain_codes.h"
#include "program/interpret/flow.h"

namespace clsurf {
namespace {

constexpr int q_variables = 100'000;  ///< Q5 is variable 100005

/// `D01 Q5 P01 +Q2 P02 3`
struct QFunction {
    int code = 0;
    int target = -1;  ///< the variable; −1: none
    std::array<double, 3> p{};
    std::size_t column = 0;  ///< of the character after it
};

/// nullopt: the text is another statement.
std::optional<QFunction> read_q_function(std::string_view text, const Variables& variables, const TextRules& rules) {
    Cursor c{text, 0};
    if (upper(c.peek()) != 'D') return std::nullopt;
    ++c.at;
    double code = 0;
    const std::size_t next = read_decimal(c.text, c.at, code);
    if (next == c.at) return std::nullopt;
    c.at = next;
    QFunction function;
    function.code = static_cast<int>(std::min(code, 1e4));
    if (upper(c.peek()) == 'Q') {
        double number = 0;
        const std::size_t end = read_decimal(c.text, c.at + 1, number);
        if (end == c.at + 1) throw ReadError{"expected the number of Q", c.column(), {}};
        c.at = end;
        function.target = q_variables + static_cast<int>(std::clamp(number, 0.0, 9999.0));
    }
    while (upper(c.peek()) == 'P') {
        ++c.at;
        double place = 0;
        const std::size_t end = c.at + std::min<std::size_t>(2, c.text.size() - c.at);
        (void)read_decimal(c.text.substr(0, end), c.at, place);
        c.at = end;
        if (!(place >= 1 && place <= 3)) throw ReadError{"expected P01, P02 or P03", c.column(), {}};
        function.p.at(static_cast<std::size_t>(place) - 1) = evaluate(c, variables, rules);
    }
    function.column = c.column();
    return function;
}

}  // namespace

bool run_q_function(Interpreter& in, std::string_view text) {
    const std::optional<QFunction> function = read_q_function(text, in.variables_, in.rules_->text);
    if (!function) return false;
    const auto& p = function->p;
    const auto set = [&](double value) {
        if (function->target < 0) throw ReadError{"expected Q and its number", function->column, {}};
        if (!std::isfinite(value)) throw ReadError{"the value is not defined", function->column, {}};
        in.variables_.set(function->target, value);
    };
    const auto jump = [&](bool taken) {
        if (!taken) return;
        count_jump(in);
        const std::string label = fmt::format("{}", std::lround(p[2]));
        const int at = control_index(in, in.place_.file).find(ControlKind::sub, label);
        if (at < 0) in.fail(fmt::format("there is no label to go to: '{}'", label));
        in.go_to(in.place_.file, control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line);
    };
    switch (function->code) {
        case 0: set(p[0]); return true;
        case 1: set(p[0] + p[1]); return true;
        case 2: set(p[0] - p[1]); return true;
        case 3: set(p[0] * p[1]); return true;
        case 4:
            if (p[1] == 0) throw ReadError{"division by zero", function->column, {}};
            set(p[0] / p[1]);
            return true;
        case 5: set(std::sqrt(p[0])); return true;
        case 6: set(std::sin(p[0] * rad_per_deg)); return true;
        case 7: set(std::cos(p[0] * rad_per_deg)); return true;
        case 8: set(std::hypot(p[0], p[1])); return true;
        case 9: jump(std::abs(p[0] - p[1]) < 1e-9); return true;
        case 10: jump(std::abs(p[0] - p[1]) >= 1e-9); return true;
        case 11: jump(p[0] > p[1]); return true;
        case 12: jump(p[0] < p[1]); return true;
        case 13: set(std::atan2(p[0], p[1]) * deg_per_rad); return true;
        default:
            in.note(Severity::warning, "program.unknown-word", fmt::format("D{:02} is not carried out", function->code),
                    1);
            return true;
    }
}

bool run_label_line(Interpreter& in, std::string_view text) {
    Cursor c{text, 0};
    if (upper(c.peek()) != 'L') return false;
    ++c.at;
    double label = 0;
    const std::size_t next = read_decimal(c.text, c.at, label);
    if (next == c.at) return false;
    c.at = next;
    double times = 0;
    if (c.take(',')) {
        const std::size_t end = read_decimal(c.text, c.at, times);
        if (end == c.at) throw ReadError{"expected how often the label is repeated", c.column(), {}};
        c.at = end;
    }
    if (c.peek() != '\0') return false;
    const std::string name = fmt::format("{}", std::lround(std::clamp(label, 0.0, 1e6)));
    if (times < 1) {
        call_subprogram(in, name, 1, false, {});
        return true;
    }
    const int at = control_index(in, in.place_.file).find(ControlKind::sub, name);
    if (at < 0) in.fail(fmt::format("there is no label to repeat: '{}'", name));
    repeat_from(in, control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line + 1, times);
    return true;
}

}  // namespace clsurf

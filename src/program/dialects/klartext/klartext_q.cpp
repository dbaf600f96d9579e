// Q parameters of Klartext: formulas, and the functions FN 0 … FN 13.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "program/dialects/klartext/klartext.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/flow.h"

namespace clsurf::klartext {
namespace {

constexpr int first_q = 100'000;  ///< Q5 is variable 100005
constexpr int most_q = 9999;
constexpr double same_value = 1e-9;

struct Target {
    int number = -1;   ///< of Q
    std::string name;  ///< of QL, QR
};

/// Q5, QL5, QR5 at the cursor.
Target target_of(Line& line) {
    const std::size_t column = line.c.column();
    const std::string id = line.c.identifier();
    const std::size_t digits = id.find_first_of("0123456789");
    const bool known = digits != std::string::npos && id.find_first_not_of("0123456789", digits) == std::string::npos;
    if (!known || (id.substr(0, digits) != "Q" && id.substr(0, digits) != "QL" && id.substr(0, digits) != "QR"))
        throw ReadError{"expected Q and its number", column, {}};
    (void)line.c.take_word(id);
    if (digits == 2) return {.number = -1, .name = id};
    double number = 0;
    (void)read_decimal(id, 1, number);
    if (!(number <= most_q)) throw ReadError{"no such Q parameter", column, {}};
    return {.number = first_q + static_cast<int>(number), .name = {}};
}

void assign(Line& line, const Target& target, double value) {
    if (!std::isfinite(value)) throw ReadError{"the value is not defined", line.c.column(), {}};
    if (target.number >= 0)
        line.in.variables_.set(target.number, value);
    else
        line.in.variables_.set(target.name, value);
}

/// FN 9: IF +Q1 EQU +Q3 GOTO LBL 5
void jump_if(Line& line, int function) {
    static constexpr std::array<std::string_view, 4> words{"EQU", "NE", "GT", "LT"};
    Interpreter& in = line.in;
    if (!line.c.take_word("IF")) throw ReadError{"expected IF", line.c.column(), {}};
    const double a = line.value();
    const std::string_view word = words[static_cast<std::size_t>(function - 9)];
    if (!line.c.take_word(word)) throw ReadError{"expected " + std::string(word), line.c.column(), {}};
    const double b = line.value();
    if (!line.c.take_word("GOTO") || !line.c.take_word("LBL"))
        throw ReadError{"expected GOTO LBL", line.c.column(), {}};
    const std::string label = label_of(line.c);
    const bool equal = std::abs(a - b) < same_value;
    const std::array<bool, 4> taken{equal, !equal, a > b && !equal, a < b && !equal};
    if (!taken[static_cast<std::size_t>(function - 9)]) return;
    const int at = control_index(in, in.place_.file).find(ControlKind::sub, label);
    if (at < 0) in.fail(fmt::format("there is no label to go to: '{}'", label));
    count_jump(in);
    in.go_to(in.place_.file, control_index(in, in.place_.file).all()[static_cast<std::size_t>(at)].line);
}

double divided(Line& line, double a, double b) {
    if (b == 0) throw ReadError{"division by zero", line.c.column(), {}};
    return a / b;
}

}  // namespace

/// Q5 = formula; words of a cycle that continue over several lines.
void assign_formula(Line& line) {
    line.c.at = line.start;
    const Target target = target_of(line);
    if (!line.c.take('=')) throw ReadError{"expected '=' after the Q parameter", line.c.column(), {}};
    assign(line, target, evaluate(line.c, line.in.variables_, line.in.rules_->text));
    if (line.c.peek() != '\0') throw ReadError{"expected the end of the block after the formula", line.c.column(), {}};
}

/// FN 0: Q5 = +10, FN 1: Q5 = +Q1 + +2, … FN 13: Q5 = +Q1 ANG +Q2
void calculate(Line& line) {
    double code = 0;
    line.c.skip_blanks();
    const std::size_t column = line.c.column();
    const std::size_t next = read_decimal(line.c.text, line.c.at, code);
    if (next == line.c.at) throw ReadError{"expected the number of FN", column, {}};
    line.c.at = next;
    (void)line.c.take(':');
    const int function = static_cast<int>(std::min(code, 1e4));
    if (function >= 9 && function <= 12) return jump_if(line, function);
    if (function > 13) {
        line.in.note(Severity::warning, "program.unknown-word", fmt::format("FN {} is not carried out", function),
                     column);
        return;
    }
    const Target target = target_of(line);
    if (!line.c.take('=')) throw ReadError{"expected '=' after the Q parameter", line.c.column(), {}};
    const auto operand = [&] { return line.value(); };
    const auto operation = [&](std::string_view word) {
        const bool here = is_letter(word[0]) ? line.c.take_word(word) : line.c.take(word[0]);
        if (!here) throw ReadError{"expected " + std::string(word), line.c.column(), {}};
    };
    const auto of_one = [&](std::string_view word, double (*f)(double)) {
        operation(word);
        return f(operand());
    };
    const auto of_two = [&](std::string_view word, double (*f)(Line&, double, double)) {
        const double a = operand();
        operation(word);
        return f(line, a, operand());
    };
    double value = 0;
    switch (function) {
        case 0: value = operand(); break;
        case 1: value = of_two("+", [](Line&, double a, double b) { return a + b; }); break;
        case 2: value = of_two("-", [](Line&, double a, double b) { return a - b; }); break;
        case 3: value = of_two("*", [](Line&, double a, double b) { return a * b; }); break;
        case 4: value = of_two("DIV", divided); break;
        case 5: value = of_one("SQRT", [](double v) { return std::sqrt(v); }); break;
        case 6: value = of_one("SIN", [](double v) { return std::sin(v * rad_per_deg); }); break;
        case 7: value = of_one("COS", [](double v) { return std::cos(v * rad_per_deg); }); break;
        case 8: value = of_two("LEN", [](Line&, double a, double b) { return std::hypot(a, b); }); break;
        case 13: value = of_two("ANG", [](Line&, double a, double b) { return std::atan2(a, b) * deg_per_rad; }); break;
        default: throw ReadError{"no such function of Q parameters", column, {}};
    }
    assign(line, target, value);
}

}  // namespace clsurf::klartext

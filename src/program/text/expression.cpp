#include "program/text/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/units.h"
#include "program/text/functions.h"
#include "program/text/operators.h"

namespace clsurf {

namespace {

constexpr int deepest_nesting = 200;
constexpr double vacant = std::numeric_limits<double>::quiet_NaN();  ///< of Fanuc: a variable that was never set
class Reader {
public:
    Reader(Cursor& cursor, const Variables& variables, const TextRules& rules, double least_increment = 1)
        : c_(cursor), variables_(variables), rules_(rules), least_increment_(least_increment) {}

    double expression(int least_rank) {
        enter();
        double left = value();
        for (;;) {
            const std::size_t before = c_.at;
            const OperatorRow* row = take_operator();
            if (row == nullptr || row->rank_in(rules_.ranks) < least_rank) {
                c_.at = before;
                break;
            }
            const std::size_t column = c_.column();
            const double right = expression(row->rank_in(rules_.ranks) + 1);
            left = apply_operator(row->op, left, right, rules_, column);
        }
        --depth_;
        return left;
    }

    double value() {
        enter();
        const double result = unsigned_or_signed();
        --depth_;
        return result;
    }

private:
    void enter() {
        if (++depth_ > deepest_nesting) throw ReadError{"expression is nested too deeply", c_.column(), {}};
    }

    const OperatorRow* take_operator() {
        c_.skip_blanks();
        for (const OperatorRow& row : operator_table()) {
            if (row.text == "^" && !rules_.caret_power) continue;
            if (row.word ? take_operator_word(row.text) : take_symbol(row.text)) return &row;
        }
        return nullptr;
    }
    bool take_symbol(std::string_view symbol) {
        if (c_.text.substr(c_.at, symbol.size()) != symbol) return false;
        // "=" alone, "=>" and similar are no operators; "<" must not consume the start of "<=".
        c_.at += symbol.size();
        return true;
    }
    /// `#1EQ2` has no blanks: a digit or a bracket may follow a word operator directly.
    bool take_operator_word(std::string_view word) {
        if (c_.text.size() - c_.at < word.size()) return false;
        for (std::size_t i = 0; i < word.size(); ++i) {
            if (upper(c_.text[c_.at + i]) != word[i]) return false;
        }
        const std::size_t after = c_.at + word.size();
        if (after < c_.text.size() &&
            (c_.text[after] == '_' || (is_letter(c_.text[after]) && rules_.words == WordStyle::names))) {
            return false;
        }
        c_.at = after;
        return true;
    }

    double unsigned_or_signed() {
        const char next = c_.peek();
        if (next == '-' || next == '+') {
            ++c_.at;
            const double v = value();
            return next == '-' ? -v : v;
        }
        if (next == '[') return bracketed('[', ']');
        if (next == '(' && rules_.round_brackets) return bracketed('(', ')');
        if (next == '#') return hash_variable();
        if (is_digit(next) || next == '.') return number();
        if (is_letter(next) || next == '_' || next == '$') return name();
        throw ReadError{next == '\0' ? std::string("expected a value, found the end of the block")
                                     : std::string("expected a value, found '") + next + "'",
                        c_.column(),
                        {}};
    }

    double bracketed(char open, char close) {
        const std::size_t column = c_.column();
        c_.take(open);
        const double v = expression(0);
        if (!c_.take(close)) throw ReadError{std::string("'") + open + "' is not closed", column, {}};
        return v;
    }

    double number() {
        double v = 0;
        const std::size_t next = read_decimal(c_.text, c_.at, v);
        if (next == c_.at) throw ReadError{"malformed number", c_.column(), {}};
        c_.at = next;
        if (rules_.words == WordStyle::names && c_.text.substr(c_.at, 2) == "EX") {
            c_.at += 2;
            double exponent = 0;
            const std::size_t end = read_decimal(c_.text, c_.at, exponent);
            if (end == c_.at) throw ReadError{"malformed exponent", c_.column(), {}};
            c_.at = end;
            v *= std::pow(10.0, exponent);
        }
        return v;
    }

    double hash_variable() {
        const std::size_t column = c_.column();
        c_.take('#');
        if (c_.take('<')) {
            const std::size_t end = c_.text.find('>', c_.at);
            if (end == std::string_view::npos) throw ReadError{"'#<' is not closed by '>'", column, {}};
            const std::string key = folded_name(c_.text.substr(c_.at, end - c_.at));
            c_.at = end + 1;
            if (const std::optional<double> found = variables_.read(key)) return *found;
            throw ReadError{"variable #<" + key + "> was never set", column, {}};
        }
        const int number = variable_number(value(), column);
        if (!rules_.vacant_variables) return variables_.get(number);
        return number == 0 ? vacant : variables_.number(number).value_or(vacant);
    }

    static int variable_number(double v, std::size_t column) {
        if (!(v >= 0 && v < 1e6)) throw ReadError{"no such variable number", column, {}};
        return static_cast<int>(std::lround(v));
    }

    /// RS274 and Fanuc write ATAN[a]/[b] (Fanuc also ATAN[a,b]), Siemens ATAN2(a, b), Klartext ATAN Q1.
    double arc_tangent(std::size_t column) {
        const char open = c_.peek();
        const char close = open == '(' ? ')' : ']';
        if (open != '[' && open != '(') {
            if (rules_.divided_arc_tangent) throw ReadError{"expected '[' after ATAN", column, {}};
            return std::atan(value()) * deg_per_rad;
        }
        c_.take(open);
        const double a = expression(0);
        if (c_.take(',')) {
            const double b = expression(0);
            if (!c_.take(close)) throw ReadError{"ATAN is not closed", column, {}};
            return std::atan2(a, b) * deg_per_rad;
        }
        if (!c_.take(close)) throw ReadError{"ATAN is not closed", column, {}};
        if (rules_.divided_arc_tangent || c_.peek() == '/') {
            if (!c_.take('/')) throw ReadError{"expected '/' after ATAN[…]", c_.column(), {}};
            return std::atan2(a, value()) * deg_per_rad;
        }
        return std::atan(a) * deg_per_rad;
    }

    double name() {
        const std::size_t column = c_.column();
        const std::string id = c_.identifier();
        if (id == "ATAN" || id == "ATAN2") {
            c_.at += id.size();
            return arc_tangent(column);
        }
        if (id == "EXISTS") return exists();
        for (const ArgumentsRow& row : rules_.of_arguments) {
            if (id == row.name) return row.value(arguments(id, row.count));
        }
        if (id == "PI" || id == "$PI") {
            c_.at += id.size();
            return 180.0 * rad_per_deg;
        }
        if (id == "TRUE" || id == "FALSE") {
            c_.at += id.size();
            return id == "TRUE" ? 1 : 0;
        }
        if (const FunctionRow* row = find_function(id, rules_.functions)) {
            c_.at += id.size();
            const double given = value();
            const double argument = std::isnan(given) ? 0 : given;
            const double result = call_function(*row, argument, rules_.rounds_to_increment, least_increment_);
            if (std::isnan(result) && !std::isnan(argument)) {
                throw ReadError{
                    std::string(row->name) + " of " + std::to_string(argument) + " is not defined", column, {}};
            }
            return result;
        }
        return variable(id, column);
    }

    /// The values in brackets of a function of several values: POW[2,3], MINVAL(R1,R2).
    std::vector<double> arguments(const std::string& id, std::size_t count) {
        const std::size_t column = c_.column();
        c_.at += id.size();
        const char open = rules_.round_brackets ? '(' : '[';
        const char close = rules_.round_brackets ? ')' : ']';
        std::vector<double> values;
        if (!c_.take(open)) throw ReadError{std::string("expected '") + open + "' after " + id, c_.column(), {}};
        do { values.push_back(expression(0)); } while (c_.take(','));
        if (!c_.take(close) || values.size() != count)
            throw ReadError{id + " needs " + std::to_string(count) + " values in brackets", column, {}};
        return values;
    }

    double exists() {
        c_.take_word("EXISTS");
        if (!c_.take('[')) throw ReadError{"expected '[' after EXISTS", c_.column(), {}};
        const std::size_t column = c_.column();
        double result = 0;
        if (!c_.take('#')) throw ReadError{"expected a variable in EXISTS[…]", column, {}};
        if (c_.take('<')) {
            const std::size_t end = c_.text.find('>', c_.at);
            if (end == std::string_view::npos) throw ReadError{"'#<' is not closed by '>'", column, {}};
            result = variables_.read(folded_name(c_.text.substr(c_.at, end - c_.at))) ? 1 : 0;
            c_.at = end + 1;
        } else {
            // LinuxCNC's numbered parameters all exist from the start.
            const double number = value();
            const bool kept = rules_.numbered_parameters > 0;
            const bool is_parameter = kept && number >= 1 && number < rules_.numbered_parameters;
            result = (kept ? is_parameter : variables_.has(variable_number(number, column))) ? 1 : 0;
        }
        if (!c_.take(']')) throw ReadError{"EXISTS is not closed", column, {}};
        return result;
    }

    /// R5 (Siemens), Q5 (Heidenhain), or a declared name.
    double variable(const std::string& id, std::size_t column) {
        const bool numbered = id.size() > 1 && rules_.numbered_names.find(id[0]) != std::string_view::npos &&
                              id.find_first_not_of("0123456789", 1) == std::string::npos && id.size() < 7;
        if (numbered) {
            c_.at += id.size();
            return variables_.get(100000 + std::stoi(id.substr(1)));
        }
        if (id == "R" && rules_.words == WordStyle::names) {
            ++c_.at;
            return variables_.get(100000 + variable_number(bracketed('[', ']'), column));
        }
        if (rules_.words == WordStyle::names) return siemens_variable(id, column);
        if (const double* found = variables_.find(id)) {
            c_.at += id.size();
            return *found;
        }
        throw ReadError{"'" + id + "' is neither a function nor a variable that was set", column, {}};
    }

    /// A declared name, an element of a declared array (0 until it is set), or a variable that the control keeps.
    double siemens_variable(const std::string& id, std::size_t column) {
        c_.skip_blanks();
        c_.at += id.size();
        std::string key = id;
        if (c_.peek() == '[') {
            ++c_.at;
            key += '[';
            const std::string axis = c_.identifier();
            if (axis.size() == 1 && axis != "R") {
                ++c_.at;
                key += axis;
            } else {
                do {
                    if (key.back() != '[') key += ',';
                    key += std::to_string(std::lround(expression(0)));
                } while (c_.take(','));
            }
            if (!c_.take(']')) throw ReadError{"'[' is not closed", column, {}};
            key += ']';
        }
        if (const std::optional<double> found = variables_.read(key)) return *found;
        if (key.size() > id.size() && variables_.find(id) != nullptr) return 0;
        throw ReadError{
            "'" + id + "' is neither a function nor a variable that was set", column,
            "if it is a global variable of the control (GUD), declare it at the top: DEF REAL " + id + "=…"};
    }

    Cursor& c_;
    const Variables& variables_;
    const TextRules& rules_;
    double least_increment_;
    int depth_ = 0;
};

}  // namespace

double evaluate(Cursor& cursor, const Variables& variables, const TextRules& rules) {
    return evaluate_or_vacant(cursor, variables, rules).value_or(0.0);
}

std::optional<double> evaluate_or_vacant(Cursor& cursor, const Variables& variables, const TextRules& rules) {
    const double value = Reader(cursor, variables, rules).expression(0);
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> read_or_vacant(Cursor& cursor, const Variables& variables, const TextRules& rules,
                                     double least_increment) {
    const double value = Reader(cursor, variables, rules, least_increment).value();
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

double read_value(Cursor& cursor, const Variables& variables, const TextRules& rules) {
    return read_or_vacant(cursor, variables, rules).value_or(0.0);
}

}  // namespace clsurf

#include "program/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/units.h"

namespace clsurf {

bool Cursor::take_word(std::string_view word) {
    skip_blanks();
    if (text.size() - at < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (upper(text[at + i]) != word[i]) return false;
    }
    const std::size_t after = at + word.size();
    if (after < text.size() && (is_letter(text[after]) || is_digit(text[after]) || text[after] == '_')) {
        return false;
    }
    at = after;
    return true;
}

std::string Cursor::identifier() {
    skip_blanks();
    std::string name;
    for (std::size_t i = at; i < text.size(); ++i) {
        const char c = text[i];
        if (!is_letter(c) && !is_digit(c) && c != '_' && c != '$') break;
        name += upper(c);
    }
    if (!name.empty() && is_digit(name.front())) name.clear();
    return name;
}

double Variables::get(int number) const { return this->number(number).value_or(0.0); }

std::optional<double> Variables::number(int number) const {
    if (!is_local(number) && system_) {
        const double value = system_(number);
        if (value == value) return value;
    }
    const auto& numbers = is_local(number) ? locals_.back().numbers : numbers_;
    const auto found = numbers.find(number);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

void Variables::forget(int number) { (is_local(number) ? locals_.back().numbers : numbers_).erase(number); }

void Variables::set(int number, double value) {
    if (!is_local(number) && writer_ && writer_(number, value)) return;
    (is_local(number) ? locals_.back().numbers : numbers_)[number] = value;
}

bool Variables::has(int number) const {
    return is_local(number) ? locals_.back().numbers.contains(number) : numbers_.contains(number);
}

const double* Variables::find(const std::string& name) const {
    const auto& names = name.starts_with('_') ? names_ : locals_.back().names;
    const auto found = names.find(name);
    if (found != names.end()) return &found->second;
    // Names declared in a main program are seen in its subprograms where the dialect has it so.
    const auto global = names_.find(name);
    return global == names_.end() ? nullptr : &global->second;
}

std::optional<double> Variables::read(const std::string& name) const {
    if (const double* found = find(name)) return *found;
    if (!named_system_) return std::nullopt;
    const double value = named_system_(name);
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

void Variables::set(const std::string& name, double value) {
    (name.starts_with('_') ? names_ : locals_.back().names)[name] = value;
}

void Variables::push_locals() { locals_.emplace_back(); }
void Variables::pop_locals() { locals_.pop_back(); }

namespace {

constexpr int deepest_nesting = 200;
constexpr double vacant = std::numeric_limits<double>::quiet_NaN();  ///< of Fanuc: a variable that was never set
constexpr double equal_within = 1e-6;  ///< RS274/NGC tests for equality with this tolerance

enum class Operator : std::uint8_t {
    power, multiply, divide, modulo, integer_divide, add, subtract,
    equal, unequal, greater, greater_equal, less, less_equal, logical_and, logical_or, logical_xor,
    bit_and, bit_or, bit_xor,
};

struct OperatorRow {
    std::string_view text;
    Operator op;
    int rank;     ///< higher binds tighter: of RS274 and Heidenhain
    int fanuc;    ///< AND binds as tightly as *, OR and XOR as +
    int siemens;  ///< comparisons come last (Job Planning, "Priority of the operations")
    bool word;
};

constexpr std::array<OperatorRow, 26> operators{{
    {"**", Operator::power, 5, 5, 11, false},
    {"^", Operator::power, 5, 5, 11, false},  // heidenhain-iso
    {"*", Operator::multiply, 4, 4, 9, false},
    {"/", Operator::divide, 4, 4, 9, false},
    {"MOD", Operator::modulo, 4, 4, 9, true},
    {"DIV", Operator::integer_divide, 4, 4, 9, true},
    {"+", Operator::add, 3, 3, 8, false},
    {"-", Operator::subtract, 3, 3, 8, false},
    {"==", Operator::equal, 2, 2, 1, false},
    {"<>", Operator::unequal, 2, 2, 1, false},
    {">=", Operator::greater_equal, 2, 2, 1, false},
    {"<=", Operator::less_equal, 2, 2, 1, false},
    {">", Operator::greater, 2, 2, 1, false},
    {"<", Operator::less, 2, 2, 1, false},
    {"EQ", Operator::equal, 2, 2, 1, true},
    {"NE", Operator::unequal, 2, 2, 1, true},
    {"GT", Operator::greater, 2, 2, 1, true},
    {"GE", Operator::greater_equal, 2, 2, 1, true},
    {"LT", Operator::less, 2, 2, 1, true},
    {"LE", Operator::less_equal, 2, 2, 1, true},
    {"AND", Operator::logical_and, 1, 4, 4, true},
    {"OR", Operator::logical_or, 1, 3, 2, true},
    {"XOR", Operator::logical_xor, 1, 3, 3, true},
    {"B_AND", Operator::bit_and, 1, 4, 7, true},
    {"B_OR", Operator::bit_or, 1, 3, 5, true},
    {"B_XOR", Operator::bit_xor, 1, 3, 6, true},
}};

using Function = double (*)(double);
struct FunctionRow {
    std::string_view name;
    Function value;
};

double sine(double a) { return std::sin(a * rad_per_deg); }
double cosine(double a) { return std::cos(a * rad_per_deg); }
double tangent(double a) { return std::tan(a * rad_per_deg); }
double arc_sine(double v) { return std::asin(v) * deg_per_rad; }
double arc_cosine(double v) { return std::acos(v) * deg_per_rad; }
double round_half_away(double v) { return std::round(v); }

constexpr std::array<FunctionRow, 18> functions{{
    {"ABS", [](double v) { return std::abs(v); }},
    {"ACOS", arc_cosine},
    {"ASIN", arc_sine},
    {"COS", cosine},
    {"EXP", [](double v) { return std::exp(v); }},
    {"FIX", [](double v) { return std::floor(v); }},
    {"FUP", [](double v) { return std::ceil(v); }},
    {"LN", [](double v) { return std::log(v); }},
    {"ROUND", round_half_away},
    {"SIN", sine},
    {"SQRT", [](double v) { return std::sqrt(v); }},
    {"SQR", [](double v) { return std::sqrt(v); }},
    {"TAN", tangent},
    {"TRUNC", [](double v) { return std::trunc(v); }},
    {"POT", [](double v) { return v * v; }},
    {"ROUNDUP", [](double v) { return std::ceil(v); }},
    {"INT", [](double v) { return std::trunc(v); }},
    {"NOT", [](double v) { return v == 0 ? 1.0 : 0.0; }},
}};

/// Of Heidenhain's formulas alone.
constexpr std::array<FunctionRow, 5> heidenhain_functions{{
    {"SQ", [](double v) { return v * v; }},
    {"NEG", [](double v) { return -v; }},
    {"FRAC", [](double v) { return v - std::trunc(v); }},
    {"SGN", [](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; }},
    {"LOG", [](double v) { return std::log10(v); }},
}};

/// Fanuc keeps digits in four bits each: 18 stands for binary 0001'0010. BIN reads it as 12.
constexpr double most_digits = 1e15;
double from_decimal_digits(double v) {
    if (!(v >= 0 && v < most_digits)) return vacant;
    double value = 0;
    double ten = 1;
    for (auto rest = static_cast<std::uint64_t>(v); rest > 0; rest /= 16, ten *= 10) value += static_cast<double>(rest % 16) * ten;
    return value;
}
double to_decimal_digits(double v) {
    if (!(v >= 0 && v < most_digits)) return vacant;
    double value = 0;
    double sixteen = 1;
    for (auto rest = static_cast<std::uint64_t>(v); rest > 0; rest /= 10, sixteen *= 16) value += static_cast<double>(rest % 10) * sixteen;
    return value;
}
constexpr std::array<FunctionRow, 2> fanuc_functions{{{"BIN", from_decimal_digits}, {"BCD", to_decimal_digits}}};

class Reader {
public:
    Reader(Cursor& cursor, const Variables& variables, DialectId dialect, double least_increment = 1)
        : c_(cursor), variables_(variables), dialect_(dialect), least_increment_(least_increment) {}

    double expression(int least_rank) {
        enter();
        double left = value();
        for (;;) {
            const std::size_t before = c_.at;
            const OperatorRow* row = take_operator();
            if (row == nullptr || rank(*row) < least_rank) {
                c_.at = before;
                break;
            }
            const std::size_t column = c_.column();
            const double right = expression(rank(*row) + 1);
            left = apply(row->op, left, right, column);
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

    [[nodiscard]] int rank(const OperatorRow& row) const {
        return dialect_ == DialectId::fanuc ? row.fanuc : dialect_ == DialectId::siemens ? row.siemens : row.rank;
    }

    const OperatorRow* take_operator() {
        c_.skip_blanks();
        for (const OperatorRow& row : operators) {
            if (row.text == "^" && dialect_ != DialectId::heidenhain_iso) continue;
            if (row.word ? take_operator_word(row.text) : take_symbol(row.text)) return &row;
        }
        return nullptr;
    }
    bool take_symbol(std::string_view symbol) {
        if (c_.text.substr(c_.at, symbol.size()) != symbol) return false;
        // "=" alone, "=>" and the like are no operators; "<" must not eat the start of "<=".
        c_.at += symbol.size();
        return true;
    }
    /// `#1EQ2` has no blanks: a word operator may be followed by a digit or a bracket at once.
    bool take_operator_word(std::string_view word) {
        if (c_.text.size() - c_.at < word.size()) return false;
        for (std::size_t i = 0; i < word.size(); ++i) {
            if (upper(c_.text[c_.at + i]) != word[i]) return false;
        }
        const std::size_t after = c_.at + word.size();
        if (after < c_.text.size() && (c_.text[after] == '_' || (is_letter(c_.text[after]) && dialect_ == DialectId::siemens))) {
            return false;
        }
        c_.at = after;
        return true;
    }

    double apply(Operator op, double a, double b, std::size_t column) const {
        if (std::isnan(a) || std::isnan(b)) {
            // A vacant variable equals only another; everywhere else it is 0.
            const bool both = std::isnan(a) && std::isnan(b);
            if (op == Operator::equal) return both ? 1 : 0;
            if (op == Operator::unequal) return both ? 0 : 1;
            a = std::isnan(a) ? 0 : a;
            b = std::isnan(b) ? 0 : b;
        }
        switch (op) {
            case Operator::power: return std::pow(a, b);
            case Operator::multiply: return a * b;
            case Operator::divide:
                if (b == 0) throw ReadError{"division by zero", column, {}};
                return a / b;
            case Operator::modulo: {
                if (b == 0) throw ReadError{"division by zero", column, {}};
                const double rest = std::fmod(a, b);
                return rest < 0 && dialect_ == DialectId::linuxcnc ? rest + std::abs(b) : rest;
            }
            case Operator::integer_divide:
                if (b == 0) throw ReadError{"division by zero", column, {}};
                return std::trunc(a / b);
            case Operator::add: return a + b;
            case Operator::subtract: return a - b;
            case Operator::equal: return same(a, b) ? 1 : 0;
            case Operator::unequal: return same(a, b) ? 0 : 1;
            case Operator::greater: return a > b && !near(a, b) ? 1 : 0;
            case Operator::greater_equal: return a > b || near(a, b) ? 1 : 0;
            case Operator::less: return a < b && !near(a, b) ? 1 : 0;
            case Operator::less_equal: return a < b || near(a, b) ? 1 : 0;
            case Operator::logical_and:
                if (dialect_ == DialectId::fanuc) return bitwise(Operator::bit_and, a, b, column);
                return a != 0 && b != 0 ? 1 : 0;
            case Operator::logical_or:
                if (dialect_ == DialectId::fanuc) return bitwise(Operator::bit_or, a, b, column);
                return a != 0 || b != 0 ? 1 : 0;
            case Operator::logical_xor:
                if (dialect_ == DialectId::fanuc) return bitwise(Operator::bit_xor, a, b, column);
                return (a != 0) != (b != 0) ? 1 : 0;
            case Operator::bit_and:
            case Operator::bit_or:
            case Operator::bit_xor: return bitwise(op, a, b, column);
        }
        return 0;
    }
    /// Bit by bit on whole numbers: B_AND … of Siemens, AND, OR and XOR of Fanuc.
    static double bitwise(Operator op, double a, double b, std::size_t column) {
        constexpr double most = 9e15;  // whole numbers that a double holds
        if (!(std::abs(a) < most && std::abs(b) < most)) throw ReadError{"too large for an operation bit by bit", column, {}};
        const std::int64_t x = std::llround(a);
        const std::int64_t y = std::llround(b);
        return static_cast<double>(op == Operator::bit_and ? x & y : op == Operator::bit_or ? x | y : x ^ y);
    }
    static bool same(double a, double b) { return std::abs(a - b) < equal_within; }
    /// RS274 orders exactly: a loop that counts by tenths ends where its sum ends.
    [[nodiscard]] bool near(double a, double b) const { return dialect_ == DialectId::linuxcnc ? a == b : same(a, b); }

    double unsigned_or_signed() {
        const char next = c_.peek();
        if (next == '-' || next == '+') {
            ++c_.at;
            const double v = value();
            return next == '-' ? -v : v;
        }
        if (next == '[') return bracketed('[', ']');
        if (next == '(' && (dialect_ == DialectId::siemens || dialect_ == DialectId::heidenhain_iso)) return bracketed('(', ')');
        if (next == '#') return hash_variable();
        if (is_digit(next) || next == '.') return number();
        if (is_letter(next) || next == '_' || next == '$') return name();
        throw ReadError{next == '\0' ? std::string("expected a value, found the end of the block")
                                     : std::string("expected a value, found '") + next + "'",
                        c_.column(), {}};
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
        if (dialect_ == DialectId::siemens && c_.text.substr(c_.at, 2) == "EX") {
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
        if (dialect_ != DialectId::fanuc) return variables_.get(number);
        return number == 0 ? vacant : variables_.number(number).value_or(vacant);
    }

    static int variable_number(double v, std::size_t column) {
        if (!(v >= 0 && v < 1e6)) throw ReadError{"no such variable number", column, {}};
        return static_cast<int>(std::lround(v));
    }

    static std::string folded_name(std::string_view text) {
        std::string key;
        for (const char c : text) {
            if (!is_blank(c)) key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
        return key;
    }

    /// RS274 and Fanuc write ATAN[a]/[b] (Fanuc also ATAN[a,b]), Siemens ATAN2(a, b).
    double arc_tangent(std::size_t column) {
        const char open = c_.peek();
        const char close = open == '(' ? ')' : ']';
        if (open != '[' && open != '(') throw ReadError{"expected '[' after ATAN", column, {}};
        c_.take(open);
        const double a = expression(0);
        if (c_.take(',')) {
            const double b = expression(0);
            if (!c_.take(close)) throw ReadError{"ATAN is not closed", column, {}};
            return std::atan2(a, b) * deg_per_rad;
        }
        if (!c_.take(close)) throw ReadError{"ATAN is not closed", column, {}};
        if (dialect_ == DialectId::linuxcnc || c_.peek() == '/') {
            if (!c_.take('/') ) throw ReadError{"expected '/' after ATAN[…]", c_.column(), {}};
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
        if (id == "POW" && dialect_ == DialectId::fanuc) {
            const std::vector<double> v = arguments(id, 2);
            return std::pow(v[0], v[1]);
        }
        if ((id == "MINVAL" || id == "MAXVAL") && dialect_ == DialectId::siemens) {
            const std::vector<double> v = arguments(id, 2);
            return id == "MINVAL" ? std::min(v[0], v[1]) : std::max(v[0], v[1]);
        }
        if (id == "BOUND" && dialect_ == DialectId::siemens) {  // lower, upper, value
            const std::vector<double> v = arguments(id, 3);
            return std::max(v[0], std::min(v[2], v[1]));
        }
        if (id == "PI" || id == "$PI") {
            c_.at += id.size();
            return 180.0 * rad_per_deg;
        }
        if (id == "TRUE" || id == "FALSE") {
            c_.at += id.size();
            return id == "TRUE" ? 1 : 0;
        }
        if (const FunctionRow* row = function(id)) {
            c_.at += id.size();
            const double given = value();
            const double argument = std::isnan(given) ? 0 : given;
            double result = row->value(argument);
            if (dialect_ == DialectId::fanuc) {
                // FIX and FUP of Fanuc count by magnitude; ROUND in a word rounds to the least increment.
                if (id == "FIX" || id == "FUP") result = std::copysign(row->value(std::abs(argument)), argument);
                if (id == "ROUND") result = row->value(argument / least_increment_) * least_increment_;
            }
            if (std::isnan(result) && !std::isnan(argument)) {
                throw ReadError{std::string(row->name) + " of " + std::to_string(argument) + " is not defined", column, {}};
            }
            return result;
        }
        return variable(id, column);
    }

    [[nodiscard]] const FunctionRow* function(const std::string& id) const {
        const auto in = [&](std::span<const FunctionRow> table) {
            const auto found = std::find_if(table.begin(), table.end(), [&](const FunctionRow& row) { return row.name == id; });
            return found == table.end() ? nullptr : &*found;
        };
        if (const FunctionRow* found = in(functions)) return found;
        if (dialect_ == DialectId::fanuc) return in(fanuc_functions);
        return dialect_ == DialectId::heidenhain_iso ? in(heidenhain_functions) : nullptr;
    }

    /// The values between brackets of a function of several: POW[2,3], MINVAL(R1,R2).
    std::vector<double> arguments(const std::string& id, std::size_t count) {
        const std::size_t column = c_.column();
        c_.at += id.size();
        const char open = dialect_ == DialectId::siemens ? '(' : '[';
        const char close = dialect_ == DialectId::siemens ? ')' : ']';
        std::vector<double> values;
        if (!c_.take(open)) throw ReadError{std::string("expected '") + open + "' after " + id, c_.column(), {}};
        do {
            values.push_back(expression(0));
        } while (c_.take(','));
        if (!c_.take(close) || values.size() != count) throw ReadError{id + " needs " + std::to_string(count) + " values in brackets", column, {}};
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
            result = variables_.has(variable_number(value(), column)) ? 1 : 0;
        }
        if (!c_.take(']')) throw ReadError{"EXISTS is not closed", column, {}};
        return result;
    }

    /// R5 (Siemens), Q5 (Heidenhain), or a declared name.
    double variable(const std::string& id, std::size_t column) {
        const bool numbered = id.size() > 1 && (id[0] == 'R' || id[0] == 'Q') &&
                              id.find_first_not_of("0123456789", 1) == std::string::npos && id.size() < 7;
        if (numbered && (dialect_ == DialectId::siemens || dialect_ == DialectId::heidenhain_iso)) {
            c_.at += id.size();
            return variables_.get(100000 + std::stoi(id.substr(1)));
        }
        if (id == "R" && dialect_ == DialectId::siemens) {
            ++c_.at;
            return variables_.get(100000 + variable_number(bracketed('[', ']'), column));
        }
        if (dialect_ == DialectId::siemens) return siemens_variable(id, column);
        if (const double* found = variables_.find(id)) {
            c_.at += id.size();
            return *found;
        }
        throw ReadError{"'" + id + "' is neither a function nor a variable that was set", column, {}};
    }

    /// A declared name, an element of a declared array (0 until it is set), or what the control keeps.
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
        throw ReadError{"'" + id + "' is neither a function nor a variable that was set", column, {}};
    }

    Cursor& c_;
    const Variables& variables_;
    DialectId dialect_;
    double least_increment_;
    int depth_ = 0;
};

}  // namespace

double evaluate(Cursor& cursor, const Variables& variables, DialectId dialect) {
    return evaluate_or_vacant(cursor, variables, dialect).value_or(0.0);
}

std::optional<double> evaluate_or_vacant(Cursor& cursor, const Variables& variables, DialectId dialect) {
    const double value = Reader(cursor, variables, dialect).expression(0);
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> read_or_vacant(Cursor& cursor, const Variables& variables, DialectId dialect, double least_increment) {
    const double value = Reader(cursor, variables, dialect, least_increment).value();
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

double read_value(Cursor& cursor, const Variables& variables, DialectId dialect) {
    return read_or_vacant(cursor, variables, dialect).value_or(0.0);
}

}  // namespace clsurf

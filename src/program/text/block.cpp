#include "program/text/block.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace clsurf {

std::string words_text(const Block& block, const char* letters) {
    std::string text;
    for (const char* c = letters; *c != '\0'; ++c) {
        if (block.words.given(*c)) text += fmt::format(" {}{:g}", *c, block.words.of(*c));
    }
    return text;
}

std::string code_text(int code) {
    return code % 10 == 0 ? fmt::format("G{}", code / 10) : fmt::format("G{}.{}", code / 10, code % 10);
}

namespace {

/// RS274 allows blanks inside numbers: "1 0 . 5" is 10.5. The digits are joined, later text keeps its column.
void close_numbers(std::string& text) {
    const auto of_number = [](char c) { return is_digit(c) || c == '.'; };
    std::size_t to = 0;      // target of the next character
    std::size_t blanks = 0;  // after a number, pending
    bool in_number = false;
    for (const char c : text) {
        if (c == ' ' && in_number) {
            ++blanks;
            continue;
        }
        if (!of_number(c)) {
            for (; blanks > 0; --blanks) text[to++] = ' ';
        }
        in_number = of_number(c);
        text[to++] = c;
    }
    for (; blanks > 0; --blanks) text[to++] = ' ';
}

}  // namespace

namespace {

using Offset = std::string::difference_type;

/// Removes comments and characters that no controller reads, except in quotes. Returns whether there is a formula.
bool blank_comments(Statement& statement, const TextRules& rules) {
    std::string& text = statement.text;
    if (text.starts_with("\xef\xbb\xbf")) text.replace(0, 3, "   ");
    bool quoted = false;
    bool formula = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char& c = text[i];
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '\0' || c == '\r' || c == '\t') c = ' ';
        if (c == ';') {
            text.resize(i);
            break;
        }
        // Parentheses are those of expressions in siemens, and of formulas in heidenhain-iso: Q1 = 2 * ( Q2 + 1 ).
        formula = formula || (c == '=' && rules.formulas);
        const bool comment = c == '(' && rules.round_comments && !formula;
        if (!comment) continue;
        const std::size_t end = text.find(')', i);
        if (end == std::string::npos) statement.open_comment = true;
        const std::size_t stop = end == std::string::npos ? text.size() : end + 1;
        std::fill(text.begin() + static_cast<Offset>(i), text.begin() + static_cast<Offset>(stop), ' ');
        i = stop - 1;
    }
    return formula;
}

/// '*' ends a block; in a formula (Q1 = Q2 * 3 *) only the last one does; '~' continues it.
void blank_block_end(std::string& text, bool formula) {
    while (!text.empty() && text.back() == ' ') text.pop_back();
    if (!formula)
        std::replace(text.begin(), text.end(), '*', ' ');
    else if (text.back() == '*')
        text.pop_back();
    std::replace(text.begin(), text.end(), '~', ' ');
}

/// A block-delete sign, with a skip level (/1 … /9) if the dialect has them.
void take_skip(Statement& statement, std::size_t slash, const TextRules& rules) {
    std::string& text = statement.text;
    if (slash >= text.size() || text[slash] != '/') return;
    statement.deleted = true;
    text[slash] = ' ';
    if (slash + 1 < text.size() && is_digit(text[slash + 1]) && rules.skip_levels) text[slash + 1] = ' ';
}

/// "%" alone begins and ends a tape; "%name" is a program's name.
bool take_tape_mark(Statement& statement, const TextRules& rules) {
    std::string& text = statement.text;
    const std::size_t at = text.find_first_not_of(' ');
    if (at == std::string::npos || text[at] != '%') return false;
    statement.tape_mark = true;
    if (rules.named_titles) statement.title = text.substr(at + 1);
    text.clear();
    return true;
}

/// N10, or 10 if numbers need no N. Returns whether there was one.
bool take_block_number(Statement& statement, const TextRules& rules) {
    std::string& text = statement.text;
    const std::size_t at = text.find_first_not_of(' ');
    if (at == std::string::npos) return false;
    std::size_t end = at;
    if (rules.block_numbers && is_digit(text[at])) {
        while (end < text.size() && is_digit(text[end])) ++end;
        while (end < text.size() && text[end] == ' ') ++end;
    } else if (upper(text[at]) == 'N' && at + 1 < text.size() &&
               (is_digit(text[at + 1]) || text[at + 1] == '.' || text[at + 1] == ' ')) {
        ++end;
        while (end < text.size() && (is_digit(text[end]) || text[end] == '.' || text[end] == ' ')) ++end;
    } else {
        return false;
    }
    std::fill(text.begin() + static_cast<Offset>(at), text.begin() + static_cast<Offset>(end), ' ');
    take_skip(statement, end, rules);
    return true;
}

}  // namespace

Statement clean_line(std::string_view line, const TextRules& rules) {
    Statement statement;
    std::string& text = statement.text;
    text.assign(line);
    const bool formula = blank_comments(statement, rules);
    if (rules.star_ends_block) blank_block_end(text, formula);
    if (rules.blanks_in_numbers && text.find('"') == std::string::npos) close_numbers(text);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    const std::size_t at = text.find_first_not_of(' ');
    if (at == std::string::npos) {
        text.clear();
        return statement;
    }
    take_skip(statement, at, rules);
    if (text[at] == '%' && take_tape_mark(statement, rules)) return statement;
    if (take_block_number(statement, rules) && rules.named_titles) (void)take_tape_mark(statement, rules);
    return statement;
}

namespace {

struct NumberedAssignment {
    int number;
    std::optional<double> value;  ///< nullopt: vacant
};
struct NamedAssignment {
    std::string name;
    double value;
};

class BlockReader {
public:
    BlockReader(Cursor& cursor, Variables& variables, const TextRules& rules, double least_increment, Block& block)
        : c_(cursor), variables_(variables), rules_(rules), least_increment_(least_increment), block_(block) {}

    void read() {
        block_.clear();
        while (c_.peek() != '\0') {
            const char next = c_.peek();
            if (next == '#') {
                hash_assignment();
            } else if (rules_.words == WordStyle::names) {
                siemens_word();
            } else if (next == ',' && is_letter(c_.at + 1 < c_.text.size() ? c_.text[c_.at + 1] : ' ')) {
                // ,C and ,R: chamfer and corner radius between blocks.
                unknown(2);
            } else if ((next == '@' || next == '^') && rules_.polar_signs) {
                ++c_.at;
                (next == '@' ? block_.polar_radius : block_.polar_angle) = read_value(c_, variables_, rules_);
            } else if (is_letter(next)) {
                letter_word();
            } else {
                throw ReadError{std::string("expected a word, found '") + next + "'", c_.column(), {}};
            }
        }
        for (const NumberedAssignment& a : numbered_) {
            if (a.value)
                variables_.set(a.number, *a.value);
            else
                variables_.forget(a.number);
        }
        for (const NamedAssignment& a : named_) variables_.set(a.name, a.value);
    }

private:
    void hash_assignment() {
        const std::size_t column = c_.column();
        c_.take('#');
        if (c_.take('<')) {
            const std::size_t end = c_.text.find('>', c_.at);
            if (end == std::string_view::npos) throw ReadError{"'#<' is not closed by '>'", column, {}};
            const std::string name = folded_name(c_.text.substr(c_.at, end - c_.at));
            c_.at = end + 1;
            expect_equals();
            named_.push_back({name, right_side()});
            return;
        }
        const double number = read_value(c_, variables_, rules_);
        if (!(number >= 0 && number < 1e6)) throw ReadError{"no such variable number", column, {}};
        expect_equals();
        const std::optional<double> value =
            rules_.vacant_variables ? evaluate_or_vacant(c_, variables_, rules_) : right_side();
        numbered_.push_back({static_cast<int>(std::lround(number)), value});
    }
    void expect_equals() {
        if (!c_.take('=')) throw ReadError{"expected '=' after the variable", c_.column(), {}};
    }
    /// RS274 assigns a value (`#1=[#2+1]`), Fanuc and Siemens an expression (`#1=#2+1`).
    double right_side() {
        return rules_.assigns_expressions ? evaluate(c_, variables_, rules_) : read_value(c_, variables_, rules_);
    }

    void unknown(std::size_t least) {
        const std::size_t column = c_.column();
        std::size_t end = c_.at + least;
        while (end < c_.text.size() && !is_blank(c_.text[end]) && end < c_.at + 40) ++end;
        end = std::min(end, c_.text.size());
        block_.unknown.push_back({std::string(c_.text.substr(c_.at, end - c_.at)), column});
        c_.at = end;
    }

    void put(char letter, double value, std::size_t column) {
        if (letter == 'G') {
            if (!add_g(block_.words, value, column)) { block_.unknown.push_back({fmt::format("G{}", value), column}); }
        } else if (letter == 'M') {
            if (!add_m(block_.words, value)) block_.unknown.push_back({fmt::format("M{}", value), column});
        } else {
            if (block_.words.given(letter) && !rules_.repeated_words) {
                throw ReadError{std::string("word ") + letter + " is given twice", column, {}};
            }
            block_.words.set(letter, value, column);
            const bool counted = rules_.counts_centres && letter >= 'I' && letter <= 'K';
            if (counted) block_.centres.push_back({letter, value, column});
        }
    }

    void letter_word() {
        const std::size_t column = c_.column();
        const char letter = upper(c_.peek());
        if (letter == 'Q' && rules_.q_words) {
            if (q_assignment()) return;
        }
        ++c_.at;
        const char next = c_.peek();
        const bool value_follows = is_digit(next) || next == '.' || next == '-' || next == '+' || next == '[' ||
                                   next == '#' || (is_letter(next) && rules_.functions_after_words) ||
                                   (next == 'Q' && rules_.q_words);
        if (!value_follows) {
            c_.at = column - 1;
            unknown(1);
            return;
        }
        if (is_letter(next) && !function_follows()) {
            c_.at = column - 1;
            unknown(1);
            return;
        }
        // A word with a vacant variable of Fanuc is ignored.
        constexpr std::string_view lengths = "ABCIJKQRUVWXYZ";
        const double increment = lengths.find(letter) == std::string_view::npos ? 1.0 : least_increment_;
        if (const std::optional<double> value = read_or_vacant(c_, variables_, rules_, increment))
            put(letter, *value, column);
    }

    /// After a letter only a function's name may replace a value: `Xsin[30]`.
    bool function_follows() {
        static constexpr std::array<std::string_view, 14> names{
            "ABS", "ACOS", "ASIN", "ATAN", "COS", "EXP", "FIX", "FUP", "LN", "ROUND", "SIN", "SQRT", "TAN", "EXISTS"};
        if (rules_.q_words) return upper(c_.peek()) == 'Q';
        const std::string id = c_.identifier();
        return std::find(names.begin(), names.end(), id) != names.end();
    }

    /// `Q1 = 5` in the newer form.
    bool q_assignment() {
        Cursor ahead = c_;
        ++ahead.at;
        double number = 0;
        const std::size_t next = read_decimal(ahead.text, ahead.at, number);
        if (next == ahead.at) return false;
        ahead.at = next;
        if (!ahead.take('=')) return false;
        if (!(number < 1e4)) throw ReadError{"no such variable number", c_.column(), {}};
        c_ = ahead;
        numbered_.push_back({100000 + static_cast<int>(number), evaluate(c_, variables_, rules_)});
        return true;
    }

    /// Reads the word at the cursor: a name of letters, and digits where the syntax allows them.
    void siemens_word() {
        const std::size_t column = c_.column();
        const char first = upper(c_.peek());
        if (first == ':') {  // main block number
            ++c_.at;
            return;
        }
        if (first == '"' && !block_.keywords.empty()) {  // EXTCALL "NAME"
            const std::size_t end = c_.text.find('"', c_.at + 1);
            if (end == std::string_view::npos) throw ReadError{"'\"' is not closed", column, {}};
            block_.keywords.back().arguments = std::string(c_.text.substr(c_.at, end + 1 - c_.at));
            block_.keywords.back().has_arguments = true;
            c_.at = end + 1;
            return;
        }
        if (!is_letter(first) && first != '_' && first != '$') {
            throw ReadError{std::string("expected a word, found '") + first + "'", column, {}};
        }
        std::string id = c_.identifier();
        Cursor after = c_;
        after.at += id.size();
        if (id == "PO" && after.peek() == '[') {
            block_.polynomials.push_back(read_polynomial(c_ = after, variables_, rules_, column));
            return;
        }
        if (after.peek() == '[') id += element_index(after);
        // G1, X10, Z-5: a letter with its number.
        const std::size_t letters = static_cast<std::size_t>(
            std::find_if(id.begin(), id.end(), [](char ch) { return !is_letter(ch); }) - id.begin());
        const char following = after.peek();
        const bool single =
            letters == 1 && (id.size() == 1 || id.find_first_not_of("0123456789", 1) == std::string::npos);
        if (following == '=' && c_.text.substr(after.at, 2) != "==") {
            assign(id, after, column);
            return;
        }
        if (single && following != '(') {
            ++c_.at;
            const char next = c_.peek();
            if (is_digit(next) || next == '.' || next == '-' || next == '+') {
                double value = 0;
                const std::size_t end = read_decimal(c_.text, c_.at, value);
                if (end == c_.at) throw ReadError{"malformed number", c_.column(), {}};
                c_.at = end;
                put(first, value, column);
                return;
            }
            --c_.at;
        }
        keyword(id, after, column);
    }

    /// "[2,0]" of an array's element, evaluated; axis names are unchanged ("[X]").
    std::string element_index(Cursor& after) {
        const std::size_t column = after.column();
        const std::size_t close = after.text.find(']', after.at);
        if (close == std::string_view::npos) throw ReadError{"'[' is not closed", column, {}};
        Cursor inside = after;
        after.at = close + 1;
        ++inside.at;
        const std::string axis = inside.identifier();
        if (axis.size() == 1 && axis != "R") return "[" + axis + "]";
        std::string index = "[";
        do {
            if (index.size() > 1) index += ',';
            index += std::to_string(std::lround(evaluate(inside, variables_, rules_)));
        } while (inside.take(','));
        if (!inside.take(']')) throw ReadError{"'[' is not closed", column, {}};
        after.at = inside.at;
        return index + "]";
    }

    /// A value, with or without AC(…) or IC(…).
    double coordinate(std::optional<bool>& increment) {
        for (const auto& [name, adds] :
             {std::pair{std::string_view("IC"), true}, std::pair{std::string_view("AC"), false}}) {
            Cursor inside = c_;
            if (!inside.take_word(name) || inside.peek() != '(') continue;
            c_ = inside;
            increment = adds;
            return read_value(c_, variables_, rules_);
        }
        return evaluate(c_, variables_, rules_);
    }

    void keyword(const std::string& id, Cursor after, std::size_t column) {
        Keyword word{id, {}, false, column};
        if (after.peek() == '(') {
            int depth = 0;
            bool quoted = false;
            const std::size_t begin = after.at + 1;
            std::size_t end = after.at;
            for (; end < after.text.size(); ++end) {
                const char ch = after.text[end];
                if (ch == '"') quoted = !quoted;
                if (quoted) continue;
                if (ch == '(') ++depth;
                if (ch == ')' && --depth == 0) break;
            }
            if (end >= after.text.size()) throw ReadError{"'(' is not closed", after.column(), {}};
            word.arguments = std::string(after.text.substr(begin, end - begin));
            word.has_arguments = true;
            after.at = end + 1;
        }
        c_.at = after.at;
        block_.keywords.push_back(std::move(word));
    }

    /// `X=AC(5)`, `CR=10`, `TURN=2`, `R1=3`, `_Z_HOME=610.`, `T="MILL"`, `M1=3`.
    void assign(const std::string& id, Cursor after, std::size_t column) {
        c_ = after;
        c_.take('=');
        if (c_.peek() == '"') {
            const std::size_t end = c_.text.find('"', c_.at + 1);
            if (end == std::string_view::npos) throw ReadError{"'\"' is not closed", c_.column(), {}};
            block_.keywords.push_back(
                {id + "=", std::string(c_.text.substr(c_.at + 1, end - c_.at - 1)), true, column});
            c_.at = end + 1;
            return;
        }
        if (id.size() == 1 && id != "R" && is_letter(id[0])) {
            assign_letter(id[0], column);
            return;
        }
        assign_named(id, column);
    }

    /// `X=AC(5)`, `X=IC(5)`; of rotary axes DC, ACP, ACN, which are absolute modulo 360°.
    void assign_letter(char letter, std::size_t column) {
        for (const auto& [name, letters] : {std::pair{"AC", &block_.absolute}, std::pair{"IC", &block_.incremental},
                                            std::pair{"DC", &block_.shortest}, std::pair{"ACP", &block_.positive},
                                            std::pair{"ACN", &block_.negative}}) {
            Cursor inside = c_;
            if (!inside.take_word(name) || inside.peek() != '(') continue;
            c_ = inside;
            put(letter, read_value(c_, variables_, rules_), column);
            *letters |= Words::bit(letter);
            if (letters != &block_.incremental) block_.absolute |= Words::bit(letter);
            return;
        }
        put(letter, evaluate(c_, variables_, rules_), column);
    }

    void assign_named(const std::string& id, std::size_t column) {
        std::optional<bool> increment;
        if (id == "RP" || id == "AP") {
            const bool radius = id == "RP";
            (radius ? block_.polar_radius : block_.polar_angle) = coordinate(increment);
            (radius ? block_.polar_radius_incremental : block_.polar_angle_incremental) = increment.value_or(false);
            return;
        }
        static constexpr auto of_blocks =
            std::to_array<std::string_view>({"AR",   "RPL", "I1", "J1", "K1",   "RND",  "RNDM", "CHR", "CHF", "ANG",
                                             "DISR", "A3",  "B3", "C3", "CTOL", "OTOL", "ATOL", "PL",  "PW",  "SD"});
        const bool of_block = std::find(of_blocks.begin(), of_blocks.end(), id) != of_blocks.end();
        const double value = of_block ? coordinate(increment) : evaluate(c_, variables_, rules_);
        if (id == "CR") {
            put('R', value, column);
        } else if (id == "TURN") {
            block_.extra_turns = static_cast<int>(std::clamp(std::round(value), 0.0, 1e6));
        } else if (id.size() > 1 && id[0] == 'R' && id.find_first_not_of("0123456789", 1) == std::string::npos &&
                   id.size() < 7) {
            variables_.set(100000 + std::stoi(id.substr(1)), value);
        } else if (id.starts_with("R[")) {
            variables_.set(100000 + std::stoi(id.substr(2)), value);
        } else if (of_block) {
            block_.named.push_back({id, value, column, increment});
        } else if (variables_.find(id.substr(0, id.find('['))) != nullptr) {
            variables_.set(id, value);
        } else if (id[0] == 'S' || id[0] == 'M' || id[0] == 'H' || id == "LIMS" || id == "ADIS" || id == "ADISPOS" ||
                   id == "P") {
            block_.keywords.push_back({id + "=", std::to_string(value), true, column});  // S1=, M2=
        } else {
            // Declared nowhere in the program: a variable of the control, which has this value from now on.
            if (id.size() > 1 && id.find('[') == std::string::npos) variables_.set(id, value);
            block_.unknown.push_back({id + "=", column});
        }
    }

    Cursor& c_;
    Variables& variables_;
    const TextRules& rules_;
    double least_increment_;
    Block& block_;
    std::vector<NumberedAssignment> numbered_;
    std::vector<NamedAssignment> named_;
};

}  // namespace

void read_block(Cursor& cursor, Variables& variables, const TextRules& rules, double least_increment, Block& block) {
    BlockReader(cursor, variables, rules, least_increment, block).read();
}

}  // namespace clsurf

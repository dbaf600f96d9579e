#include "program/dialects/dialect_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/dialect_rules.h"
#include "program/text/lexer.h"

namespace clsurf {
namespace dialect_signs {
namespace {

constexpr std::size_t examined_bytes = 200'000;
constexpr int counted = 3;  ///< greatest number of times that a repeated sign counts
constexpr std::size_t shown_signs = 2;
constexpr std::size_t longest_shown_word = 20;

/// The words that follow LinuxCNC's O and its number or name.
constexpr auto o_word_names =
    std::to_array<std::string_view>({"SUB", "ENDSUB", "CALL", "WHILE", "ENDWHILE", "IF", "ELSEIF", "ELSE", "ENDIF",
                                     "REPEAT", "ENDREPEAT", "DO", "BREAK", "CONTINUE", "RETURN"});

struct Sign {
    std::size_t dialect;  ///< its index among all dialects
    int weight;
    int count;
    std::string word;  ///< as shown
    std::size_t line;  ///< line of the first occurrence; 0: the whole text
};

/// Reads lines and collects signs.
class SignReader {
public:
    void ending(std::string_view name) {
        std::string folded(name.substr(std::min(name.rfind('.'), name.size())));
        std::transform(folded.begin(), folded.end(), folded.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
        of_each([&](std::size_t dialect, const GuessSigns& signs) {
            for (const EndingSign& row : signs.endings) {
                if (folded == row.ending)
                    signs_.push_back({dialect, row.weight, 1, "the ending " + std::string(row.ending), 0});
            }
        });
    }

    void line(std::string_view text) {
        ++line_;
        text_ = text;
        at_ = 0;
        first_word_ = true;
        after_name_ = false;
        g_count_ = 0;
        letters_ = 0;
        while (!text_.empty() && is_blank(text_.back())) text_.remove_suffix(1);
        skip_blanks();
        if (at_ < text_.size()) ++lines_;
        if (!text_.empty() && text_.back() == '*') ++stars_;
        if (begins_program()) return;
        if (peek() == '%') {
            title();
            return;
        }
        while (at_ < text_.size()) {
            const std::size_t before = at_;
            word();
            if (at_ == before) ++at_;
            skip_blanks();
        }
        judge_codes();
    }

    [[nodiscard]] DialectGuess best() {
        // Blocks end in '*'.
        if (lines_ > 2 && stars_ * 2 > lines_) {
            line_ = 0;
            mark(Mark::stars, "blocks that end in '*'");
        }
        std::vector<int> score(dialects().size());
        for (const Sign& sign : signs_) score[sign.dialect] += sign.weight * std::min(sign.count, counted);
        const auto most = std::max_element(score.begin(), score.end());
        if (*most <= 0) return {&dialects().front(), "nothing in the text suggests another one"};
        const auto best = static_cast<std::size_t>(most - score.begin());
        const Dialect& dialect = dialects()[best];
        std::stable_sort(signs_.begin(), signs_.end(),
                         [](const Sign& a, const Sign& b) { return a.weight > b.weight; });
        std::string reason;
        std::size_t shown = 0;
        for (const Sign& sign : signs_) {
            if (sign.dialect != best || sign.weight <= 0 || shown == shown_signs) continue;
            reason += shown++ > 0 ? ", " : "";
            reason += sign.line == 0 ? sign.word : fmt::format("'{}' in line {}", sign.word, sign.line);
        }
        return {&dialect, reason};
    }

private:
    /// Calls `visit` with the index and the signs of each dialect.
    template <typename Visit>
    static void of_each(Visit&& visit) {
        const std::span<const Dialect> all = dialects();
        for (std::size_t k = 0; k < all.size(); ++k) visit(k, all[k].rules->signs);
    }

    /// Adds a mark of the text to the dialects that have it as a sign.
    void mark(Mark mark, std::string_view word) {
        of_each([&](std::size_t dialect, const GuessSigns& signs) {
            for (const MarkSign& row : signs.marks) {
                if (row.mark == mark) sign(dialect, row.weight, word);
            }
        });
    }

    void sign(std::size_t dialect, int weight, std::string_view word) {
        if (line_ != 0) word = word.substr(0, longest_shown_word);
        for (Sign& known : signs_) {
            if (known.dialect != dialect || known.word != word) continue;
            ++known.count;
            return;
        }
        signs_.push_back({dialect, weight, 1, std::string(word), line_});
    }

    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }
    void skip_blanks() {
        while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\0')) ++at_;
    }

    /// "0 BEGIN PGM PART MM"
    bool begins_program() {
        const std::size_t name = text_.find_first_not_of("0123456789 \t", at_);
        if (name == std::string_view::npos || !text_.substr(name).starts_with("BEGIN PGM ")) return false;
        mark(Mark::program_begin, "BEGIN PGM");
        return true;
    }

    /// "%_N_PART_MPF" of siemens, "%PART G71 *" of heidenhain-iso; "%" alone occurs in all dialects.
    void title() {
        if (text_.substr(at_).starts_with("%_N_")) mark(Mark::tape_name, "%_N_");
        const std::size_t unit = text_.find(" G7", at_);
        if (unit != std::string_view::npos && unit > at_ + 1 && text_.back() == '*')
            mark(Mark::title_with_unit, "% … G71 *");
    }

    void word() {
        const char c = peek();
        if (c == ';') {
            at_ = text_.size();
        } else if (c == '(') {
            comment();
        } else if (c == '"') {
            at_ = std::min(text_.size(), text_.find('"', at_ + 1)) + 1;
        } else if (c == '#') {
            variable();
        } else if (c == '^' || c == '@') {
            // Not the operators of expressions, which follow a value.
            ++at_;
            const char value = peek();
            if (is_digit(value) || value == '[' || value == '#' || value == '.' || value == '-' || value == '+')
                mark(Mark::polar_sign, std::string_view(&c, 1));
        } else if (c == ',' && (upper(peek(1)) == 'R' || upper(peek(1)) == 'C') &&
                   (is_digit(peek(2)) || peek(2) == '.')) {
            mark(Mark::comma_corner, text_.substr(at_, 2));
            at_ += 2;
        } else if (c == '[') {
            brackets();
        } else if (is_letter(c) || c == '_' || c == '$') {
            letters();
        }
    }

    /// "(MSG, …)" and similar comments are LinuxCNC's; siemens has no comments in parentheses.
    void comment() {
        // After a name it belongs to a call or a condition: CYCLE832(…), IF (…).
        const bool alone = !after_name_ && (at_ == 0 || is_blank(text_[at_ - 1])) &&
                           text_.substr(0, at_).find('=') == std::string_view::npos;
        const std::size_t end = std::min(text_.find(')', at_), text_.size());
        std::string inside(text_.substr(at_ + 1, std::max(end, at_ + 1) - at_ - 1));
        std::transform(inside.begin(), inside.end(), inside.begin(), [](char c) { return upper(c); });
        for (const std::string_view active : {"DEBUG,", "PRINT,", "AXIS,", "LOG,", "PROBEOPEN", "LOGOPEN,"}) {
            if (inside.starts_with(active)) mark(Mark::active_comment, "(" + std::string(active));
        }
        if (alone) mark(Mark::round_comment, "(");
        at_ = std::min(end + 1, text_.size());
    }

    void brackets() {
        for (int depth = 0; at_ < text_.size(); ++at_) {
            if (peek() == '#' && peek(1) == '<') mark(Mark::hash_name, "#<");
            if (peek() == '[') ++depth;
            if (peek() == ']' && --depth == 0) {
                ++at_;
                return;
            }
        }
    }

    void variable() {
        if (peek(1) == '<') {
            mark(Mark::hash_name, "#<");
            at_ = std::min(text_.find('>', at_), text_.size());
            return;
        }
        ++at_;
        while (is_digit(peek())) ++at_;
        skip_blanks();
        if (peek() != '=') return;
        ++at_;
        skip_blanks();
        // An expression without brackets is an assignment of fanuc: #1=#2+1.
        const std::string_view side = text_.substr(at_, std::min(text_.find('(', at_), text_.size()) - at_);
        if (side.starts_with('[') || side.find_first_of("+-*/", 1) == std::string_view::npos) return;
        if (side.find('[') == std::string_view::npos) mark(Mark::free_assignment, text_.substr(0, at_ + side.size()));
    }

    void letters() {
        const std::size_t begin = at_;
        std::string name;
        while (is_letter(peek()) || peek() == '_' || peek() == '$') name += upper(text_[at_++]);
        const bool first = std::exchange(first_word_, first_word_ && name == "N");
        if (name == "O") {
            o_word(begin);
            return;
        }
        after_name_ = name.size() > 1;
        if (!after_name_ || name == "GOTO") skip_blanks();
        const std::size_t number_at = at_;
        double number = 0;
        at_ = read_decimal(text_, at_, number);
        const bool has_number = at_ != number_at;
        const std::string_view shown = text_.substr(begin, at_ - begin);
        if (name.size() == 1) {
            letter_word(name.front(), has_number, number, shown);
            return;
        }
        long_word(name, has_number, first, begin);
    }

    void letter_word(char letter, bool has_number, double number, std::string_view shown) {
        skip_blanks();
        if (peek() == '=' && peek(1) != '=') {
            mark(letter == 'Q' ? Mark::q_equals : Mark::letter_equals, std::string(1, letter) + "=");
            return;
        }
        letters_ |= Words::bit(letter);
        if (letter == 'G' && has_number && g_count_ < g_.size() && number >= 0 && number < 1e4) {
            g_text_[g_count_] = shown;
            g_[g_count_++] = static_cast<int>(std::lround(number * 10));
        }
        const auto is = [&](double m) { return letter == 'M' && has_number && number == m; };
        if (is(98) || is(99)) mark(Mark::subprogram_m, shown);
        if (is(17)) mark(Mark::return_m, shown);
        if (letter == 'M' && number >= 62 && number <= 68) mark(Mark::output_m, shown);
        if (letter == 'M' && number >= 70 && number <= 73) mark(Mark::state_m, shown);
    }

    /// "o100 sub", "o<name> call"; "O1000" alone is a program number.
    void o_word(std::size_t begin) {
        if (peek() == '<') {
            mark(Mark::o_name, "o<");
            at_ = text_.size();
            return;
        }
        while (is_digit(peek())) ++at_;
        const std::string_view program = text_.substr(begin, at_ - begin);
        skip_blanks();
        const std::size_t number_end = at_;
        std::string name;
        while (is_letter(peek())) name += upper(text_[at_++]);
        if (std::find(o_word_names.begin(), o_word_names.end(), name) != o_word_names.end()) {
            mark(Mark::o_statement, text_.substr(begin, at_ - begin));
            at_ = text_.size();
        } else {
            at_ = number_end;
            if (number_end >= text_.size() || peek() == '(') mark(Mark::o_number, program);
        }
    }

    void long_word(const std::string& name, bool has_number, bool first, std::size_t begin) {
        const std::size_t end = at_;
        skip_blanks();
        const char next = peek();
        const std::string_view shown = text_.substr(begin, name.size());
        const std::string_view numbered = text_.substr(begin, end - begin);
        if (name == "GOTO") {
            const bool to_block = has_number || next == '#' || next == '[';
            mark(to_block ? Mark::jump_to_block : Mark::jump_to_label, shown);
        } else if (first && (name == "IF" || name == "WHILE")) {
            mark(next == '[' ? Mark::bracketed_if : Mark::open_if, shown);
        } else if (next == '=' && peek(1) != '=') {
            mark(Mark::name_equals, std::string(shown) + "=");
        } else if (first && next == ':') {
            mark(Mark::name_colon, std::string(shown) + ":");
        }
        of_each([&](std::size_t dialect, const GuessSigns& signs) {
            for (const WordSign& row : has_number ? signs.numbered_words : signs.words) {
                if (name == row.word) sign(dialect, row.weight, has_number ? numbered : shown);
            }
        });
    }

    void judge_codes() {
        const auto any_of = [&](std::string_view letters) {
            return std::any_of(letters.begin(), letters.end(),
                               [&](char letter) { return (letters_ & Words::bit(letter)) != 0; });
        };
        bool blank = false;
        for (std::size_t k = 0; k < g_count_; ++k) {
            of_each([&](std::size_t dialect, const GuessSigns& signs) {
                for (const CodeSign& row : signs.codes) {
                    if (g_[k] != row.code || (!row.with.empty() && !any_of(row.with)) || any_of(row.without)) continue;
                    const bool one = row.with.size() == 1;
                    sign(dialect, row.weight, std::string(g_text_[k]) + (one ? " " + std::string(row.with) : ""));
                }
            });
            blank = blank || g_[k] == 300;
        }
        // G30 G17 X Y Z: the minimum point of Heidenhain's blank.
        if (blank && std::find(g_.begin(), g_.begin() + g_count_, 170) != g_.begin() + g_count_)
            mark(Mark::blank_in_plane, "G30 G17");
    }

    std::vector<Sign> signs_;
    std::size_t line_ = 0, lines_ = 0, stars_ = 0;
    // Of the line.
    std::string_view text_;
    std::size_t at_ = 0;
    bool first_word_ = true, after_name_ = false;
    std::array<int, Words::most_codes> g_{};
    std::array<std::string_view, Words::most_codes> g_text_{};
    std::size_t g_count_ = 0;
    std::uint32_t letters_ = 0;
};

}  // namespace
}  // namespace dialect_signs

DialectGuess guess_dialect(std::string_view text, std::string_view name) {
    dialect_signs::SignReader reader;
    reader.ending(name);
    text = text.substr(0, dialect_signs::examined_bytes);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        reader.line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.best();
}

}  // namespace clsurf

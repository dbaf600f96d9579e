#include "program/dialects/dialect_guess.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/text/lexer.h"

namespace clsurf {
namespace dialect_signs {
namespace {

constexpr std::size_t looked_at = 200'000;  ///< bytes of the text
constexpr int counted = 3;                  ///< of a sign that comes again and again
constexpr std::size_t shown_signs = 2;
constexpr std::size_t longest_shown_word = 20;

using enum DialectId;

struct WordSign {
    std::string_view word;  ///< upper case
    DialectId dialect;
    int weight;
};

/// Words of two letters or more that stand alone.
constexpr auto word_signs = std::to_array<WordSign>({
    {"TRAORI", siemens, 10}, {"TRAFOOF", siemens, 10},   {"TRANSMIT", siemens, 8},  {"SUPA", siemens, 6},
    {"MCALL", siemens, 10},  {"MSG", siemens, 6},        {"FFWON", siemens, 8},     {"FFWOF", siemens, 8},
    {"SOFT", siemens, 4},    {"BRISK", siemens, 4},      {"GOTOF", siemens, 8},     {"GOTOB", siemens, 8},
    {"GOTOC", siemens, 8},   {"PROC", siemens, 8},       {"ENDPROC", siemens, 8},   {"RET", siemens, 4},
    {"COMPCAD", siemens, 8}, {"COMPCURV", siemens, 8},   {"COMPON", siemens, 8},    {"COMPSURF", siemens, 8},
    {"COMPOF", siemens, 8},  {"STOPRE", siemens, 8},     {"WORKPIECE", siemens, 8}, {"TRANS", siemens, 6},
    {"ATRANS", siemens, 8},  {"ROT", siemens, 6},        {"AROT", siemens, 8},      {"ASCALE", siemens, 8},
    {"AMIRROR", siemens, 8}, {"ASPLINE", siemens, 8},    {"BSPLINE", siemens, 8},   {"CSPLINE", siemens, 8},
    {"POLY", siemens, 8},    {"SPLINEPATH", siemens, 8}, {"FNORM", siemens, 6},     {"DIAMON", siemens, 6},
    {"DIAMOF", siemens, 6},  {"EXTCALL", siemens, 8},    {"ORIWKS", siemens, 8},    {"ORIMKS", siemens, 8},
    {"ORIVECT", siemens, 8}, {"ORIAXES", siemens, 8},    {"DEF", siemens, 8},       {"ENDFOR", siemens, 8},
    {"ENDLOOP", siemens, 8}, {"CIP", siemens, 6},        {"REPEATB", siemens, 8},   {"CASE", siemens, 6},
    {"EXISTS", linuxcnc, 8},
});

/// Words that go on with a number: CYCLE832, POCKET3, HOLES1.
constexpr auto numbered_word_signs = std::to_array<WordSign>({
    {"CYCLE", siemens, 10},
    {"POCKET", siemens, 8},
    {"HOLES", siemens, 8},
    {"SLOT", siemens, 8},
});

/// The words that follow LinuxCNC's O and its number or name.
constexpr auto o_word_names =
    std::to_array<std::string_view>({"SUB", "ENDSUB", "CALL", "WHILE", "ENDWHILE", "IF", "ELSEIF", "ELSE", "ENDIF",
                                     "REPEAT", "ENDREPEAT", "DO", "BREAK", "CONTINUE", "RETURN"});

struct CodeSign {
    int code;  ///< G, in tenths
    DialectId dialect;
    int weight;
    std::string_view with;     ///< letters of which one must stand in the block; empty: none
    std::string_view without;  ///< letters of which none may
};

constexpr auto code_signs = std::to_array<CodeSign>({
    {640, linuxcnc, 6, "P", ""},       {50, linuxcnc, 6, "IJQ", ""},  {51, linuxcnc, 6, "IJ", "Q"},
    {52, linuxcnc, 8, "", ""},         {53, linuxcnc, 8, "", ""},     {331, linuxcnc, 5, "", ""},
    {382, linuxcnc, 4, "", ""},        {383, linuxcnc, 4, "", ""},    {384, linuxcnc, 4, "", ""},
    {385, linuxcnc, 4, "", ""},        {411, linuxcnc, 4, "", ""},    {421, linuxcnc, 4, "", ""},
    {431, linuxcnc, 3, "", ""},        {610, linuxcnc, 2, "", ""},    {611, linuxcnc, 2, "", ""},
    {901, linuxcnc, 3, "", ""},        {911, linuxcnc, 3, "", ""},    {921, linuxcnc, 3, "", ""},
    {922, linuxcnc, 3, "", ""},        {923, linuxcnc, 3, "", ""},    {281, linuxcnc, 3, "", ""},
    {301, linuxcnc, 3, "", ""},        {50, fanuc, 8, "P", "IJQXYZ"}, {51, fanuc, 8, "Q", ""},
    {80, fanuc, 6, "P", ""},           {434, fanuc, 6, "", ""},       {435, fanuc, 6, "", ""},
    {531, fanuc, 4, "", ""},           {541, fanuc, 4, "P", ""},      {682, fanuc, 6, "", ""},
    {511, fanuc, 3, "", ""},           {501, fanuc, 3, "", ""},       {62, fanuc, 6, "", ""},
    {650, fanuc, 6, "P", ""},          {660, fanuc, 6, "P", ""},      {71, fanuc, 4, "", ""},
    {121, fanuc, 4, "", ""},           {680, fanuc, 4, "R", ""},      {160, fanuc, 2, "", ""},
    {510, fanuc, 3, "PIJK", ""},       {6410, siemens, 8, "", ""},    {6420, siemens, 8, "", ""},
    {6430, siemens, 8, "", ""},        {6440, siemens, 8, "", ""},    {6450, siemens, 8, "", ""},
    {6010, siemens, 6, "", ""},        {6020, siemens, 6, "", ""},    {6030, siemens, 6, "", ""},
    {600, siemens, 3, "", "XYZ"},      {5000, siemens, 5, "", ""},    {1530, siemens, 5, "", ""},
    {7000, siemens, 5, "", ""},        {7100, siemens, 5, "", ""},    {1110, siemens, 5, "", ""},
    {4500, siemens, 5, "", ""},        {4510, siemens, 5, "", ""},    {980, heidenhain_iso, 6, "L", "XYZ"},
    {990, heidenhain_iso, 5, "T", ""},
});

struct EndingSign {
    std::string_view ending;  ///< lower case
    DialectId dialect;
    int weight;
};
constexpr auto ending_signs = std::to_array<EndingSign>({
    {".ngc", linuxcnc, 4},
    {".mpf", siemens, 6},
    {".spf", siemens, 6},
    {".i", heidenhain_iso, 4},
});

struct Sign {
    DialectId dialect;
    int weight;
    int count;
    std::string word;  ///< as shown
    std::size_t line;  ///< the first; 0: of the whole text
};

/// Reads lines and gathers signs.
class SignReader {
public:
    void ending(std::string_view name) {
        std::string folded(name.substr(std::min(name.rfind('.'), name.size())));
        std::transform(folded.begin(), folded.end(), folded.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
        for (const EndingSign& row : ending_signs) {
            if (folded == row.ending)
                signs_.push_back({row.dialect, row.weight, 1, "the ending " + std::string(row.ending), 0});
        }
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
        if (lines_ > 2 && stars_ * 2 > lines_) signs_.push_back({heidenhain_iso, 60, 1, "blocks that end in '*'", 0});
        std::array<int, 4> score{};
        for (const Sign& sign : signs_) score[index_of(sign.dialect)] += sign.weight * std::min(sign.count, counted);
        const auto* most = std::max_element(score.begin(), score.end());
        if (*most <= 0) return {&dialects().front(), "nothing in the text tells another one"};
        const Dialect& dialect = dialects()[static_cast<std::size_t>(most - score.begin())];
        std::stable_sort(signs_.begin(), signs_.end(),
                         [](const Sign& a, const Sign& b) { return a.weight > b.weight; });
        std::string reason;
        std::size_t shown = 0;
        for (const Sign& sign : signs_) {
            if (sign.dialect != dialect.id || sign.weight <= 0 || shown == shown_signs) continue;
            reason += shown++ > 0 ? ", " : "";
            reason += sign.line == 0 ? sign.word : fmt::format("'{}' in line {}", sign.word, sign.line);
        }
        return {&dialect, reason};
    }

private:
    static std::size_t index_of(DialectId id) { return static_cast<std::size_t>(id); }

    void sign(DialectId dialect, int weight, std::string_view word) {
        word = word.substr(0, longest_shown_word);
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

    /// "%_N_PART_MPF" of siemens, "%PART G71 *" of heidenhain-iso; "%" alone is everybody's.
    void title() {
        if (text_.substr(at_).starts_with("%_N_")) sign(siemens, 15, "%_N_");
        const std::size_t unit = text_.find(" G7", at_);
        if (unit != std::string_view::npos && unit > at_ + 1 && text_.back() == '*')
            sign(heidenhain_iso, 15, "% … G71 *");
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
            // Not the operators of expressions: those follow a value.
            ++at_;
            const char value = peek();
            if (is_digit(value) || value == '[' || value == '#' || value == '.' || value == '-' || value == '+')
                sign(linuxcnc, 6, std::string_view(&c, 1));
        } else if (c == ',' && (upper(peek(1)) == 'R' || upper(peek(1)) == 'C') &&
                   (is_digit(peek(2)) || peek(2) == '.')) {
            sign(fanuc, 4, text_.substr(at_, 2));
            at_ += 2;
        } else if (c == '[') {
            brackets();
        } else if (is_letter(c) || c == '_' || c == '$') {
            letters();
        }
    }

    /// "(MSG, …)" and its like are LinuxCNC's; siemens has no comments in parentheses.
    void comment() {
        // Behind a name it is one of a call, or of a condition: CYCLE832(…), IF (…).
        const bool alone = !after_name_ && (at_ == 0 || is_blank(text_[at_ - 1])) &&
                           text_.substr(0, at_).find('=') == std::string_view::npos;
        const std::size_t end = std::min(text_.find(')', at_), text_.size());
        std::string inside(text_.substr(at_ + 1, std::max(end, at_ + 1) - at_ - 1));
        std::transform(inside.begin(), inside.end(), inside.begin(), [](char c) { return upper(c); });
        for (const std::string_view active : {"DEBUG,", "PRINT,", "AXIS,", "LOG,", "PROBEOPEN", "LOGOPEN,"}) {
            if (inside.starts_with(active)) sign(linuxcnc, 6, "(" + std::string(active));
        }
        if (alone) sign(siemens, -3, "(");
        at_ = std::min(end + 1, text_.size());
    }

    void brackets() {
        for (int depth = 0; at_ < text_.size(); ++at_) {
            if (peek() == '#' && peek(1) == '<') sign(linuxcnc, 10, "#<");
            if (peek() == '[') ++depth;
            if (peek() == ']' && --depth == 0) {
                ++at_;
                return;
            }
        }
    }

    void variable() {
        if (peek(1) == '<') {
            sign(linuxcnc, 10, "#<");
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
        if (side.find('[') == std::string_view::npos) sign(fanuc, 4, text_.substr(0, at_ + side.size()));
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
            sign(letter == 'Q' ? heidenhain_iso : siemens, 6, std::string(1, letter) + "=");
            return;
        }
        letters_ |= Words::bit(letter);
        if (letter == 'G' && has_number && g_count_ < g_.size() && number >= 0 && number < 1e4) {
            g_text_[g_count_] = shown;
            g_[g_count_++] = static_cast<int>(number * 10 + 0.5);
        }
        const auto is = [&](double m) { return letter == 'M' && has_number && number == m; };
        if (is(98) || is(99)) sign(fanuc, 2, shown);
        if (is(17)) sign(siemens, 4, shown);
        if (letter == 'M' && number >= 62 && number <= 68) sign(linuxcnc, 2, shown);
        if (letter == 'M' && number >= 70 && number <= 73) sign(linuxcnc, 2, shown);
    }

    /// "o100 sub", "o<name> call"; "O1000" alone is a program number.
    void o_word(std::size_t begin) {
        if (peek() == '<') {
            sign(linuxcnc, 10, "o<");
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
            sign(linuxcnc, 10, text_.substr(begin, at_ - begin));
            at_ = text_.size();
        } else {
            at_ = number_end;
            if (number_end >= text_.size() || peek() == '(') sign(fanuc, 3, program);
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
            sign(to_block ? fanuc : siemens, to_block ? 8 : 4, shown);
        } else if (first && (name == "IF" || name == "WHILE")) {
            sign(next == '[' ? fanuc : siemens, next == '[' ? 8 : 4, shown);
        } else if (next == '=' && peek(1) != '=') {
            sign(siemens, 6, std::string(shown) + "=");
        } else if (first && next == ':') {
            sign(siemens, 6, std::string(shown) + ":");
        }
        for (const WordSign& row : word_signs) {
            if (name == row.word && !has_number) sign(row.dialect, row.weight, shown);
        }
        for (const WordSign& row : numbered_word_signs) {
            if (name == row.word && has_number) sign(row.dialect, row.weight, numbered);
        }
    }

    void judge_codes() {
        const auto any_of = [&](std::string_view letters) {
            return std::any_of(letters.begin(), letters.end(),
                               [&](char letter) { return (letters_ & Words::bit(letter)) != 0; });
        };
        bool blank = false;
        for (std::size_t k = 0; k < g_count_; ++k) {
            for (const CodeSign& row : code_signs) {
                if (g_[k] != row.code || (!row.with.empty() && !any_of(row.with)) || any_of(row.without)) continue;
                const bool one = row.with.size() == 1;
                sign(row.dialect, row.weight, std::string(g_text_[k]) + (one ? " " + std::string(row.with) : ""));
            }
            blank = blank || g_[k] == 300;
        }
        // G30 G17 X Y Z: the least point of Heidenhain's blank.
        if (blank && std::find(g_.begin(), g_.begin() + g_count_, 170) != g_.begin() + g_count_)
            sign(heidenhain_iso, 2, "G30 G17");
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
    text = text.substr(0, dialect_signs::looked_at);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        reader.line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.best();
}

}  // namespace clsurf

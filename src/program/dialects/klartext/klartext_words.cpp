#include "program/dialects/klartext/klartext_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "program/text/expression.h"
#include "program/text/lexer.h"

namespace clsurf {
namespace {

/// Words with a value; longer names come before their own prefixes; a leading I makes most of them increments.
struct ValueWord {
    std::string_view name;
    bool may_be_incremental;
};
constexpr auto value_words = std::to_array<ValueWord>({
    {"PA", true},
    {"PR", true},
    {"NX", false},
    {"NY", false},
    {"NZ", false},
    {"TX", false},
    {"TY", false},
    {"TZ", false},
    {"X", true},
    {"Y", true},
    {"Z", true},
    {"A", true},
    {"B", true},
    {"C", true},
    {"U", true},
    {"V", true},
    {"W", true},
});

bool begins_value(char c) { return is_digit(c) || c == '+' || c == '-' || c == '.' || c == 'Q' || c == 'q'; }

class WordsReader {
public:
    WordsReader(Cursor& cursor, const Variables& variables, const TextRules& rules, bool radius_word)
        : c_(cursor), variables_(variables), rules_(rules), radius_word_(radius_word) {}

    KlartextWords read() {
        while (c_.peek() != '\0') {
            const bool known = feed_word() || direction_word() || m_word() || value_word() || radius_or_side();
            if (known) continue;
            const std::size_t column = c_.column();
            const std::string_view rest = c_.text.substr(c_.at);
            throw ReadError{"'" + std::string(rest.substr(0, std::min(rest.find(' '), std::size_t{20}))) +
                                "' is not a word of this block in klartext",
                            column,
                            {}};
        }
        return words_;
    }

private:
    [[nodiscard]] char at(std::size_t ahead) const {
        return c_.at + ahead < c_.text.size() ? upper(c_.text[c_.at + ahead]) : '\0';
    }
    [[nodiscard]] bool follows(std::string_view word) const {
        for (std::size_t k = 0; k < word.size(); ++k) {
            if (at(k) != word[k]) return false;
        }
        return true;
    }
    /// A word of letters that no letter follows.
    bool take(std::string_view word) {
        c_.skip_blanks();
        if (!follows(word) || is_letter(at(word.size()))) return false;
        c_.at += word.size();
        return true;
    }

    bool feed_word() {
        if (take("FMAX")) {
            words_.feed = KlartextFeed::rapid;
            return true;
        }
        if (take("FAUTO")) {
            words_.feed = KlartextFeed::automatic;
            return true;
        }
        c_.skip_blanks();
        if (!follows("F")) return false;
        const std::size_t column = c_.column();
        if (is_letter(at(1)) && at(1) != 'Q')
            throw ReadError{"a feed per tooth, per revolution or by time (FZ, FU, FT) is not supported", column,
                            "let the CAM system write F in mm/min"};
        ++c_.at;
        if (take("MAX")) {
            words_.feed = KlartextFeed::rapid;
        } else if (take("AUTO")) {
            words_.feed = KlartextFeed::automatic;
        } else {
            const double value = read_klartext_value(c_, variables_, rules_);
            if (value < 0) throw ReadError{"a feed below 0", column, {}};
            if (words_.m.empty()) {  // after M128, M103 it is their own feed
                words_.feed = KlartextFeed::number;
                words_.feed_value = value;
            }
        }
        return true;
    }

    bool direction_word() {
        if (!follows("DR")) return false;
        const char sign = at(2);
        if (sign != '+' && sign != '-') return false;
        words_.clockwise = sign == '-';
        c_.at += 3;
        return true;
    }

    bool m_word() {
        if (!follows("M") || !is_digit(at(1))) return false;
        const std::size_t column = c_.column();
        ++c_.at;
        double code = 0;
        c_.at = read_decimal(c_.text, c_.at, code);
        if (!(code < 1e4)) throw ReadError{"no such M function", column, {}};
        const int m = static_cast<int>(code);
        words_.m.push_back(m);
        operands_of(m);
        return true;
    }

    /// The operands of an M function: limits, lengths, a retract along the tool axis.
    void operands_of(int m) {
        if (m == 118) {
            for (c_.skip_blanks(); is_letter(at(0)) && begins_value(at(1)); c_.skip_blanks()) {
                ++c_.at;
                (void)read_klartext_value(c_, variables_, rules_);
            }
        } else if (m == 120) {
            c_.skip_blanks();
            if (!follows("LA")) return;
            c_.at += 2;
            (void)read_klartext_value(c_, variables_, rules_);
        } else if (m == 140) {
            c_.skip_blanks();
            if (!follows("MB")) return;
            const std::size_t column = c_.column();
            c_.at += 2;
            const double distance =
                take("MAX") ? std::numeric_limits<double>::infinity() : read_klartext_value(c_, variables_, rules_);
            words_.retract = KlartextValue{distance, true, column};
        }
    }

    bool value_word() {
        const std::size_t column = c_.column();
        const std::size_t increment = at(0) == 'I' ? 1 : 0;
        for (const ValueWord& row : value_words) {
            if (increment != 0 && !row.may_be_incremental) continue;
            bool here = true;
            for (std::size_t k = 0; k < row.name.size(); ++k) here = here && at(increment + k) == row.name[k];
            std::size_t next = increment + row.name.size();
            while (at(next) == ' ') ++next;
            if (!here || !begins_value(at(next))) continue;
            if (words_.find(row.name) != nullptr)
                throw ReadError{"word " + std::string(row.name) + " is given twice", column, {}};
            c_.at += increment + row.name.size();
            note_plane_angle(row.name);
            words_.values.emplace_back(
                row.name, KlartextValue{read_klartext_value(c_, variables_, rules_), increment != 0, column});
            return true;
        }
        return false;
    }

    /// Q120, Q121 and Q122 are the angles that PLANE has computed for A, B and C.
    void note_plane_angle(std::string_view name) {
        constexpr std::array<std::string_view, 3> angles{"Q120", "Q121", "Q122"};
        if (name.size() != 1 || name[0] < 'A' || name[0] > 'C') return;
        Cursor ahead = c_;
        if (ahead.peek() == '+') ++ahead.at;
        if (ahead.identifier() == angles[static_cast<std::size_t>(name[0] - 'A')]) words_.reads_plane_angles = true;
    }

    bool radius_or_side() {
        if (!follows("R")) return false;
        const std::size_t column = c_.column();
        const char next = at(1);
        if (radius_word_ && begins_value(next)) {
            ++c_.at;
            words_.values.emplace_back("R", KlartextValue{read_klartext_value(c_, variables_, rules_), false, column});
            return true;
        }
        if (next == '0' || next == 'L' || next == 'R') {
            words_.side = next == '0' ? KlartextSide::none : next == 'L' ? KlartextSide::left : KlartextSide::right;
            c_.at += 2;
            return true;
        }
        if (next == '+' || next == '-')
            throw ReadError{"compensation along one axis (R+, R-) is not supported", column, {}};
        return false;
    }

    Cursor& c_;
    const Variables& variables_;
    const TextRules& rules_;
    bool radius_word_;
    KlartextWords words_;
};

}  // namespace

const KlartextValue* KlartextWords::find(std::string_view name) const {
    const auto found = std::find_if(values.begin(), values.end(), [&](const auto& row) { return row.first == name; });
    return found == values.end() ? nullptr : &found->second;
}

KlartextWords read_klartext_words(Cursor& cursor, const Variables& variables, const TextRules& rules,
                                  bool radius_word) {
    return WordsReader(cursor, variables, rules, radius_word).read();
}

double read_klartext_value(Cursor& cursor, const Variables& variables, const TextRules& rules) {
    return read_value(cursor, variables, rules);
}

PlainResult read_plain_klartext(std::string_view line, Words& words) {
    words.clear();
    std::size_t at = 0;
    const std::size_t size = line.size();
    const auto skip = [&] {
        while (at < size && is_blank(line[at])) ++at;
    };
    skip();
    while (at < size && is_digit(line[at])) ++at;
    skip();
    if (at + 1 >= size || upper(line[at]) != 'L' || !is_blank(line[at + 1])) return PlainResult::complex;
    ++at;
    bool rapid = false;
    for (skip(); at < size; skip()) {
        const char letter = upper(line[at]);
        const std::size_t column = ++at;
        if (letter == 'R' && at < size && line[at] == '0') {
            ++at;
        } else if (letter == 'F' && size - at >= 3 && line.substr(at, 3) == "MAX") {
            at += 3;
            rapid = true;
        } else if ((letter >= 'X' && letter <= 'Z') || letter == 'F') {
            double value = 0;
            const std::size_t next = read_decimal(line, at, value);
            if (next == at || words.given(letter)) return PlainResult::complex;
            words.set(letter, value, column);
            at = next;
        } else {
            return PlainResult::complex;
        }
        if (at < size && !is_blank(line[at])) return PlainResult::complex;
    }
    if ((words.has & Words::xyz) == 0 || (rapid && words.given('F'))) return PlainResult::complex;
    (void)add_g(words, rapid ? 0 : 1, 1);
    return PlainResult::plain;
}

}  // namespace clsurf

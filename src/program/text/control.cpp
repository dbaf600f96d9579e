#include "program/text/control.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "program/text/block.h"
#include "program/text/cursor.h"

namespace clsurf {
namespace {

struct OWord {
    std::string_view text;
    ControlKind kind;
};
constexpr std::array<OWord, 16> o_words{{
    {"SUB", ControlKind::sub},
    {"ENDSUB", ControlKind::end_sub},
    {"CALL", ControlKind::call},
    {"RETURN", ControlKind::leave},
    {"WHILE", ControlKind::while_begin},
    {"ENDWHILE", ControlKind::while_end},
    {"DO", ControlKind::do_begin},
    {"IF", ControlKind::if_begin},
    {"ELSEIF", ControlKind::else_if},
    {"ELSE", ControlKind::else_branch},
    {"ENDIF", ControlKind::if_end},
    {"REPEAT", ControlKind::repeat_begin},
    {"ENDREPEAT", ControlKind::repeat_end},
    {"BREAK", ControlKind::break_loop},
    {"CONTINUE", ControlKind::continue_loop},
    {"PROGRAM", ControlKind::label},
}};

std::string lower(std::string_view text) {
    std::string folded;
    for (const char c : text) {
        if (!is_blank(c)) folded += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return folded;
}

/// O100, O<name>; an indirect label (O[#1], O#1) keeps its text and is resolved by the interpreter.
std::string o_label(Cursor& c) {
    if (c.take('<')) {
        const std::size_t end = c.text.find('>', c.at);
        if (end == std::string_view::npos) throw ReadError{"'o<' is not closed by '>'", c.column(), {}};
        std::string name = lower(c.text.substr(c.at, end - c.at));
        c.at = end + 1;
        return name;
    }
    const char next = c.peek();
    if (next == '[' || next == '#') {
        const std::size_t begin = c.at;
        int depth = 0;
        while (c.at < c.text.size()) {
            const char ch = c.text[c.at];
            if (ch == '[') ++depth;
            if (ch == ']') --depth;
            if (depth == 0 && is_blank(ch)) break;
            ++c.at;
            if (depth == 0 && ch == ']') break;
        }
        return std::string(c.text.substr(begin, c.at - begin));
    }
    std::string digits;
    while (c.at < c.text.size() && is_digit(c.text[c.at])) digits += c.text[c.at++];
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return digits.empty() ? "0" : digits;
}

Control parse_o_word(std::string_view statement, DialectId dialect) {
    Cursor c{statement, 0};
    Control control;
    const char first = upper(c.peek());
    if (first != 'O' && !(first == ':' && dialect == DialectId::fanuc)) return control;
    ++c.at;
    control.label = o_label(c);
    const std::string word = c.identifier();
    if (word.empty() || dialect != DialectId::linuxcnc) {
        control.kind = ControlKind::label;
        control.rest = c.at;
        return control;
    }
    for (const OWord& row : o_words) {
        if (word != row.text) continue;
        c.take_word(row.text);
        control.kind = row.kind;
        control.rest = c.at;
        return control;
    }
    throw ReadError{"unknown O-word '" + word + "'", c.column(), "sub, call, while, if, repeat, do …"};
}

std::string number_label(Cursor& c) {
    c.skip_blanks();
    std::string digits;
    while (c.at < c.text.size() && is_digit(c.text[c.at])) digits += c.text[c.at++];
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

/// Finds a word outside brackets; npos: not there.
std::size_t find_word(std::string_view text, std::string_view word, std::size_t from) {
    for (std::size_t at = from; at + word.size() <= text.size(); ++at) {
        const bool starts = at == 0 || !is_letter(text[at - 1]);
        if (!starts) continue;
        std::size_t k = 0;
        while (k < word.size() && upper(text[at + k]) == word[k]) ++k;
        if (k == word.size()) return at;
    }
    return std::string_view::npos;
}

Control parse_fanuc(std::string_view statement) {
    Control control = parse_o_word(statement, DialectId::fanuc);
    if (control.kind != ControlKind::none) return control;
    Cursor c{statement, 0};
    const std::string id = c.identifier();
    if (id.empty()) return control;
    if (id == "IF") {
        c.take_word("IF");
        control.rest = c.at;
        std::size_t at = find_word(statement, "GOTO", c.at);
        if (at != std::string_view::npos) {
            control.kind = ControlKind::if_go_to;
            control.target = at + 4;
            Cursor target{statement, at + 4};
            control.label = number_label(target);
            return control;
        }
        at = find_word(statement, "THEN", c.at);
        if (at == std::string_view::npos) throw ReadError{"expected GOTO or THEN after IF […]", c.column(), {}};
        control.kind = ControlKind::if_then;
        control.label = std::to_string(at + 4);
        return control;
    }
    if (id.starts_with("GOTO")) {
        c.skip_blanks();
        c.at += 4;
        control.kind = ControlKind::go_to;
        control.target = c.at;
        control.label = number_label(c);
        return control;
    }
    if (id == "WHILE") {
        c.take_word("WHILE");
        control.rest = c.at;
        const std::size_t at = find_word(statement, "DO", c.at);
        if (at == std::string_view::npos) throw ReadError{"expected DO after WHILE […]", c.column(), {}};
        control.kind = ControlKind::while_begin;
        Cursor target{statement, at + 2};
        control.label = number_label(target);
        return control;
    }
    const auto numbered = [&](std::string_view word) {
        return id.starts_with(word) && id.find_first_not_of("0123456789", word.size()) == std::string::npos;
    };
    if (numbered("DO")) {
        c.skip_blanks();
        c.at += 2;
        control.kind = ControlKind::while_begin;
        control.label = number_label(c);
        control.rest = std::string_view::npos;  // no condition
    } else if (numbered("END")) {
        c.skip_blanks();
        c.at += 3;
        control.kind = ControlKind::while_end;
        control.label = number_label(c);
    }
    return control;
}

struct SiemensWord {
    std::string_view text;
    ControlKind kind;
};
constexpr std::array<SiemensWord, 17> siemens_words{{
    {"IF", ControlKind::if_begin},
    {"ELSE", ControlKind::else_branch},
    {"ENDIF", ControlKind::if_end},
    {"WHILE", ControlKind::while_begin},
    {"ENDWHILE", ControlKind::while_end},
    {"FOR", ControlKind::for_begin},
    {"ENDFOR", ControlKind::for_end},
    {"LOOP", ControlKind::while_begin},
    {"ENDLOOP", ControlKind::while_end},
    {"REPEAT", ControlKind::do_begin},
    {"UNTIL", ControlKind::do_while},
    {"RET", ControlKind::leave},
    {"M17", ControlKind::leave},
    {"PROC", ControlKind::label},
    {"ENDPROC", ControlKind::leave},
    {"REPEATB", ControlKind::repeat_block},
    {"CASE", ControlKind::choice},
}};

/// GOTO, GOTOF, GOTOB, GOTOC with its label, behind the letters GOTO.
void read_go_to(Cursor& c, Control& control) {
    const char way = c.at < c.text.size() ? upper(c.text[c.at]) : ' ';
    const bool named = way == 'F' || way == 'B' || way == 'C';
    if (named) ++c.at;
    control.direction = way == 'F' ? 1 : way == 'B' ? -1 : 0;
    control.may_miss = way == 'C';
    control.label = c.identifier();
}

Control parse_siemens(std::string_view statement) {
    Control control;
    Cursor c{statement, 0};
    const std::string id = c.identifier();
    if (id.empty()) return control;
    Cursor after = c;
    after.at += id.size();
    if (after.peek() == ':' && id.size() > 1) {
        control.kind = ControlKind::label;
        control.label = id;
        control.rest = after.at + 1;
        return control;
    }
    if (id == "GOTO" || id == "GOTOF" || id == "GOTOB" || id == "GOTOC") {
        control.kind = ControlKind::go_to;
        c.skip_blanks();
        c.at += 4;
        read_go_to(c, control);
        return control;
    }
    for (const SiemensWord& row : siemens_words) {
        if (id != row.text) continue;
        control.kind = row.kind;
        control.rest = after.at;
        if (id == "LOOP") control.rest = std::string_view::npos;
        if (id == "REPEATB" || (id == "REPEAT" && !after.identifier().empty())) {
            control.kind = id == "REPEATB" ? ControlKind::repeat_block : ControlKind::repeat_section;
            control.label = after.identifier();
            control.rest = after.at + after.text.substr(after.at).find_first_not_of(' ') + control.label.size();
            return control;
        }
        if (row.kind == ControlKind::if_begin) {
            const std::size_t at = find_word(statement, "GOTO", after.at);
            if (at != std::string_view::npos) {
                control.kind = ControlKind::if_go_to;
                Cursor target{statement, at + 4};
                read_go_to(target, control);
            }
        }
        return control;
    }
    return control;
}

Control parse_heidenhain(std::string_view statement) {
    Control control;
    Cursor c{statement, 0};
    // G98 L5 is a label, G98 L0 the end of a subprogram.
    if (upper(c.peek()) != 'G') return control;
    ++c.at;
    double code = 0;
    const std::size_t next = read_decimal(c.text, c.at, code);
    if (next == c.at || code != 98) return control;
    c.at = next;
    if (upper(c.peek()) != 'L') return control;
    ++c.at;
    control.label = number_label(c);
    control.kind = control.label.empty() ? ControlKind::end_sub : ControlKind::sub;
    control.rest = c.at;
    return control;
}

}  // namespace

Control parse_control(std::string_view statement, DialectId dialect) {
    switch (dialect) {
        case DialectId::linuxcnc: return parse_o_word(statement, dialect);
        case DialectId::fanuc: return parse_fanuc(statement);
        case DialectId::siemens: return parse_siemens(statement);
        case DialectId::heidenhain_iso: return parse_heidenhain(statement);
    }
    return {};
}

ControlIndex::ControlIndex(const SourceText& text, DialectId dialect) {
    Statement statement;
    std::string_view rest = text.text();
    for (LineNumber line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view here = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        statement = clean_line(here, dialect);
        if (statement.text.empty()) continue;
        Control control;
        try {
            control = parse_control(statement.text, dialect);
        } catch (const ReadError&) {
            continue;  // said where it is carried out, if ever
        }
        if (control.kind == ControlKind::none) continue;
        control.line = line;
        if (control.kind == ControlKind::sub || control.kind == ControlKind::label)
            named_[control.label].push_back(static_cast<int>(controls_.size()));
        controls_.push_back(std::move(control));
    }
    match();
}

void ControlIndex::match() {
    std::vector<int> open;
    const auto pop = [&](std::initializer_list<ControlKind> kinds, const std::string& label) {
        for (int k = static_cast<int>(open.size()) - 1; k >= 0; --k) {
            const Control& candidate = controls_[static_cast<std::size_t>(open[static_cast<std::size_t>(k)])];
            if (std::find(kinds.begin(), kinds.end(), candidate.kind) == kinds.end() || candidate.label != label)
                continue;
            const int found = open[static_cast<std::size_t>(k)];
            open.resize(static_cast<std::size_t>(k));
            return found;
        }
        return -1;
    };
    std::vector<std::vector<int>> branches(controls_.size());
    for (int i = 0; i < static_cast<int>(controls_.size()); ++i) {
        Control& control = controls_[static_cast<std::size_t>(i)];
        int partner = -1;
        switch (control.kind) {
            case ControlKind::sub:
            case ControlKind::do_begin:
            case ControlKind::if_begin:
            case ControlKind::repeat_begin:
            case ControlKind::for_begin: open.push_back(i); break;
            case ControlKind::while_begin:
                // `o1 while` closes an open `o1 do`.
                partner = pop({ControlKind::do_begin}, control.label);
                if (partner >= 0 && !control.label.empty()) {
                    control.kind = ControlKind::do_while;
                } else {
                    if (partner >= 0) open.push_back(partner);
                    partner = -1;
                    open.push_back(i);
                }
                break;
            case ControlKind::end_sub: partner = pop({ControlKind::sub}, control.label); break;
            case ControlKind::while_end: partner = pop({ControlKind::while_begin}, control.label); break;
            case ControlKind::do_while: partner = pop({ControlKind::do_begin}, control.label); break;
            case ControlKind::repeat_end: partner = pop({ControlKind::repeat_begin}, control.label); break;
            case ControlKind::for_end: partner = pop({ControlKind::for_begin}, control.label); break;
            case ControlKind::else_if:
            case ControlKind::else_branch:
            case ControlKind::if_end: {
                const int begin = pop({ControlKind::if_begin}, control.label);
                if (begin < 0) break;
                std::vector<int>& chain = branches[static_cast<std::size_t>(begin)];
                const int last = chain.empty() ? begin : chain.back();
                controls_[static_cast<std::size_t>(last)].next_branch = i;
                chain.push_back(i);
                if (control.kind == ControlKind::if_end) {
                    controls_[static_cast<std::size_t>(begin)].partner = i;
                    for (const int k : chain) controls_[static_cast<std::size_t>(k)].partner = i;
                } else {
                    open.push_back(begin);
                }
                break;
            }
            default: break;
        }
        if (partner >= 0) {
            control.partner = partner;
            controls_[static_cast<std::size_t>(partner)].partner = i;
        }
    }
}

int ControlIndex::at_line(LineNumber line) const {
    const auto found = std::lower_bound(controls_.begin(), controls_.end(), line,
                                        [](const Control& c, LineNumber l) { return c.line < l; });
    return found != controls_.end() && found->line == line ? static_cast<int>(found - controls_.begin()) : -1;
}

int ControlIndex::find(ControlKind kind, const std::string& label, LineNumber line, int direction) const {
    const auto named = named_.find(label);
    if (named == named_.end()) return -1;
    int before = -1;
    int first = -1;
    for (const int i : named->second) {
        const Control& c = controls_[static_cast<std::size_t>(i)];
        if (c.kind != kind) continue;
        if (first < 0) first = i;
        if (c.line < line) before = i;
        if (c.line > line && direction >= 0) return i;
    }
    return direction < 0 ? before : direction == 0 && line != 0 ? first : -1;
}

int ControlIndex::loop_around(LineNumber line, const std::string& label) const {
    int best = -1;
    for (int i = 0; i < static_cast<int>(controls_.size()); ++i) {
        const Control& c = controls_[static_cast<std::size_t>(i)];
        const bool loop = c.kind == ControlKind::while_begin || c.kind == ControlKind::do_begin ||
                          c.kind == ControlKind::repeat_begin || c.kind == ControlKind::for_begin;
        if (!loop || c.partner < 0 || c.line > line || c.label != label) continue;
        if (controls_[static_cast<std::size_t>(c.partner)].line >= line) best = i;
    }
    return best;
}

BlockNumbers::BlockNumbers(const SourceText& text) {
    LineNumber at = 0;
    std::string_view rest = text.text();
    while (!rest.empty()) {
        ++at;
        const std::size_t end = rest.find('\n');
        std::string_view here = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        while (!here.empty() && (is_blank(here.front()) || here.front() == '/')) here.remove_prefix(1);
        if (here.empty() || upper(here.front()) != 'N') continue;
        double value = 0;
        if (read_decimal(here, 1, value) != 1) lines_.emplace_back(value, at);
    }
    std::sort(lines_.begin(), lines_.end());
}

LineNumber BlockNumbers::find(double number, LineNumber line, int direction) const {
    const auto after = std::upper_bound(lines_.begin(), lines_.end(), std::pair(number, line));
    if (direction >= 0 && after != lines_.end() && after->first == number) return after->second;
    if (direction > 0) return 0;
    if (direction == 0) {
        const auto first = std::lower_bound(lines_.begin(), lines_.end(), std::pair(number, LineNumber{0}));
        return first != lines_.end() && first->first == number ? first->second : 0;
    }
    const auto before = std::lower_bound(lines_.begin(), lines_.end(), std::pair(number, line));
    return before != lines_.begin() && std::prev(before)->first == number ? std::prev(before)->second : 0;
}

}  // namespace clsurf

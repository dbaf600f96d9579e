#include "program/text/control.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "program/text/block.h"
#include "program/text/cursor.h"

namespace clsurf {

std::string number_label(Cursor& c) {
    c.skip_blanks();
    std::string digits;
    while (c.at < c.text.size() && is_digit(c.text[c.at])) digits += c.text[c.at++];
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

std::size_t find_control_word(std::string_view text, std::string_view word, std::size_t from) {
    for (std::size_t at = from; at + word.size() <= text.size(); ++at) {
        const bool starts = at == 0 || !is_letter(text[at - 1]);
        if (!starts) continue;
        std::size_t k = 0;
        while (k < word.size() && upper(text[at + k]) == word[k]) ++k;
        if (k == word.size()) return at;
    }
    return std::string_view::npos;
}

Control parse_control(std::string_view statement, const TextRules& rules) {
    return rules.control == nullptr ? Control{} : rules.control(statement);
}

namespace {

bool begins_loop(ControlKind kind) {
    return kind == ControlKind::while_begin || kind == ControlKind::do_begin || kind == ControlKind::repeat_begin ||
           kind == ControlKind::for_begin;
}

/// Finds the partner of each statement: the end of a loop or of a subprogram, the branches of an IF, the loop of a break.
class PartnerSearch {
public:
    explicit PartnerSearch(std::vector<Control>& controls) : controls_(controls), branches_(controls.size()) {}

    void run() {
        for (int i = 0; i < static_cast<int>(controls_.size()); ++i) visit(i);
    }

private:
    struct Closing {
        ControlKind end, begin;
    };
    static constexpr std::array<Closing, 5> closings{{{ControlKind::end_sub, ControlKind::sub},
                                                      {ControlKind::while_end, ControlKind::while_begin},
                                                      {ControlKind::do_while, ControlKind::do_begin},
                                                      {ControlKind::repeat_end, ControlKind::repeat_begin},
                                                      {ControlKind::for_end, ControlKind::for_begin}}};

    Control& at(int i) { return controls_[static_cast<std::size_t>(i)]; }

    void visit(int i) {
        switch (at(i).kind) {
            case ControlKind::sub:
            case ControlKind::do_begin:
            case ControlKind::if_begin:
            case ControlKind::repeat_begin:
            case ControlKind::for_begin: open_.push_back(i); return;
            case ControlKind::while_begin: begin_while(i); return;
            case ControlKind::else_if:
            case ControlKind::else_branch:
            case ControlKind::if_end: branch(i); return;
            case ControlKind::break_loop:
            case ControlKind::continue_loop: at(i).partner = loop_around(i); return;
            default: break;
        }
        for (const Closing& closing : closings) {
            if (closing.end == at(i).kind) join(i, close(closing.begin, at(i).label));
        }
    }

    /// The innermost open loop with the label of a break or continue; −1: none.
    int loop_around(int i) {
        const auto found = std::find_if(open_.rbegin(), open_.rend(),
                                        [&](int k) { return begins_loop(at(k).kind) && at(k).label == at(i).label; });
        return found == open_.rend() ? -1 : *found;
    }

    /// The innermost open statement of this kind and label, closed with everything inside it; −1: none.
    int close(ControlKind kind, const std::string& label) {
        const auto found = std::find_if(open_.rbegin(), open_.rend(),
                                        [&](int k) { return at(k).kind == kind && at(k).label == label; });
        if (found == open_.rend()) return -1;
        const int begin = *found;
        open_.erase(std::next(found).base(), open_.end());
        return begin;
    }

    void join(int i, int partner) {
        if (partner < 0) return;
        at(i).partner = partner;
        at(partner).partner = i;
    }

    /// `o1 while` closes an open `o1 do`; any other begins a loop.
    void begin_while(int i) {
        const int begin = close(ControlKind::do_begin, at(i).label);
        if (begin >= 0 && !at(i).label.empty()) {
            at(i).kind = ControlKind::do_while;
            join(i, begin);
            return;
        }
        if (begin >= 0) open_.push_back(begin);
        open_.push_back(i);
    }

    void branch(int i) {
        const int begin = close(ControlKind::if_begin, at(i).label);
        if (begin < 0) return;
        std::vector<int>& chain = branches_[static_cast<std::size_t>(begin)];
        at(chain.empty() ? begin : chain.back()).next_branch = i;
        chain.push_back(i);
        if (at(i).kind != ControlKind::if_end) {
            open_.push_back(begin);
            return;
        }
        at(begin).partner = i;
        for (const int k : chain) at(k).partner = i;
    }

    std::vector<Control>& controls_;
    std::vector<int> open_;                   ///< statements without their end, the innermost last
    std::vector<std::vector<int>> branches_;  ///< branches of each IF
};

}  // namespace

ControlIndex::ControlIndex(const SourceText& text, const TextRules& rules) {
    Statement statement;
    std::string_view rest = text.text();
    for (LineNumber line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view here = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        statement = clean_line(here, rules);
        if (statement.text.empty()) continue;
        Control control;
        try {
            control = parse_control(statement.text, rules);
        } catch (const ReadError&) {
            continue;  // reported if it is ever executed
        }
        if (control.kind == ControlKind::none) continue;
        control.line = line;
        if (control.kind == ControlKind::sub || control.kind == ControlKind::label)
            named_[control.label].push_back(static_cast<int>(controls_.size()));
        controls_.push_back(std::move(control));
    }
    PartnerSearch(controls_).run();
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

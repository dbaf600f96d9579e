#include "io/readers/tool_table_file.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "program/text/lexer.h"

namespace clsurf::io {
namespace {

constexpr double highest_number = 1e6;  ///< highest number of tools and pockets
constexpr int most_orientation = 9;

/// One line of the table, and its error messages.
class ToolLine {
public:
    ToolLine(const Source& source, std::string_view text, std::uint32_t number)
        : source_(source), text_(text), number_(number) {}

    /// False: the line has no tool.
    bool read(Tool& tool) {
        std::size_t at = 0;
        std::uint32_t seen = 0;
        for (;;) {
            while (at < text_.size() && is_blank(text_[at])) ++at;
            if (at == text_.size() || text_[at] == ';') break;
            const char letter = upper(text_[at]);
            if (!is_letter(letter)) fail(fmt::format("expected a letter, found '{}'", text_[at]), at);
            double value = 0;
            const std::size_t next = read_decimal(text_, at + 1, value);
            if (next == at + 1) fail(fmt::format("expected a number after {}", letter), at + 1);
            if (next < text_.size() && !is_blank(text_[next]) && text_[next] != ';' && !is_letter(text_[next]))
                fail("malformed number", next);
            if ((seen & Words::bit(letter)) != 0) fail(fmt::format("{} is given twice", letter), at);
            seen |= Words::bit(letter);
            put(tool, letter, value, at);
            at = next;
        }
        if (seen != 0 && (seen & Words::bit('T')) == 0) fail("a tool needs its number (T)", 0);
        if (at < text_.size()) tool.remark = std::string(text_.substr(at + 1));
        return seen != 0;
    }

    [[noreturn]] void fail(const std::string& what, std::size_t at) const {
        constexpr std::size_t shown = 200;
        Place place = Place::of_line(source_.name, number_, static_cast<std::uint32_t>(at + 1));
        place.source = std::string(text_.substr(0, shown));
        throw InputError(std::move(place), what, "a line is like 'T1 P1 D6.0 Z12.3 ; remark', lengths in mm");
    }

private:
    void put(Tool& tool, char letter, double value, std::size_t at) const {
        switch (letter) {
            case 'T': tool.number = whole(letter, value, highest_number, at); return;
            case 'P': (void)whole(letter, value, highest_number, at); return;  // the pocket does not matter for cutting
            case 'D': tool.diameter = value; return;
            case 'X':
            case 'Y':
            case 'Z': tool.offset[letter - 'X'] = value; return;
            case 'I': tool.front_angle = value; return;
            case 'J': tool.back_angle = value; return;
            case 'Q': tool.orientation = whole(letter, value, most_orientation, at); return;
            case 'A':
            case 'B':
            case 'C':
            case 'U':
            case 'V':
            case 'W':
                if (value != 0) fail(fmt::format("an offset of axis {} is not supported", letter), at);
                return;
            default: fail(fmt::format("word {} is not known", letter), at);
        }
    }
    [[nodiscard]] int whole(char letter, double value, double most, std::size_t at) const {
        if (!(value >= 0 && value <= most) || value != std::floor(value)) {
            fail(fmt::format("{} must be a whole number from 0 to {:g}", letter, most), at);
        }
        return static_cast<int>(value);
    }

    const Source& source_;
    std::string_view text_;
    std::uint32_t number_;
};

}  // namespace

ToolTable read_tool_table(const Source& source) {
    ToolTable table;
    std::string_view rest = source.text();
    for (std::uint32_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = rest.find('\n');
        ToolLine line(source, rest.substr(0, end), number);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        Tool tool;
        if (!line.read(tool)) continue;
        if (!table.tools.emplace(tool.number, tool).second)
            line.fail(fmt::format("tool {} is given twice", tool.number), 0);
    }
    if (table.tools.empty())
        throw InputError(Place::of_file(source.name), "holds no tools", "a line is like 'T1 P1 D6.0 Z12.3 ; remark'");
    return table;
}

}  // namespace clsurf::io

#include "io/formats/text_head.h"

#include <algorithm>

namespace clsurf::io {
namespace {

bool has_value(const std::vector<std::string>& fields) { return std::any_of(fields.begin(), fields.end(), is_value); }

bool has_word(const std::vector<std::string>& fields) {
    return std::any_of(fields.begin(), fields.end(), [](const std::string& f) { return !f.empty() && !is_value(f); });
}

/// The text of a comment without its mark.
std::string_view comment_text(std::string_view comment) {
    const std::size_t at = comment.find_first_not_of("#%/ \t");
    return at == std::string_view::npos ? std::string_view() : comment.substr(at);
}

void name_columns(const std::vector<std::string>& titles, TextHead& head) {
    head.named = true;
    head.titles = titles;
    head.columns.clear();
    for (const std::string& title : titles) head.columns.push_back(plan_from_header(title));
}

/// Takes a line of units below the names, "s;mm;mm" or "[s],[mm],[mm]": none of its fields is a number.
bool take_units(const std::vector<std::string>& units, std::vector<ColumnPlan>& columns) {
    if (has_value(units) || !has_word(units) || units.size() != columns.size()) return false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::string_view unit = units[i];
        if (unit.size() >= 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
        if (columns[i].unit.empty() && unit != "-") columns[i].unit = std::string(unit);
    }
    return true;
}

struct Comment {
    std::string_view text;
    std::uint64_t line = 0;
};

/// The position of a reader of lines.
struct LineReader {
    std::string_view rest;
    std::uint64_t number = 1;  ///< number of the next line

    std::string_view take() {
        ++number;
        return first_line(rest);
    }
    /// Reads the comments before the next line; returns the last that is not empty.
    Comment take_comments() {
        Comment last;
        while (!rest.empty()) {
            LineReader ahead = *this;
            const std::string_view line = ahead.take();
            if (!is_comment(line)) break;
            if (!comment_text(line).empty()) last = {line, number};
            *this = ahead;
        }
        return last;
    }
};

}  // namespace

TextHead read_head(std::string_view text, char separator) {
    LineReader reader{text};
    if (reader.rest.starts_with("\xef\xbb\xbf")) reader.rest.remove_prefix(3);
    const Comment comment = reader.take_comments();
    TextHead head;
    head.line = reader.number;
    LineReader below = reader;
    const std::string_view line = below.take();
    head.separator = separator != '\0' ? separator : detect_separator(line);
    const std::vector<std::string> fields = split(line, head.separator);
    const auto take_record = [&] {
        (void)reader.take_comments();
        head.data_begin = text.size() - reader.rest.size();
        head.first_data_line = reader.number;
        head.first = split(LineReader(reader).take(), head.separator);
    };
    if (has_word(fields)) {
        name_columns(fields, head);
        reader = below;
        take_record();
        below = reader;
        (void)below.take();
        if (!below.rest.empty() && take_units(head.first, head.columns)) {
            reader = below;
            take_record();
        }
        return head;
    }
    take_record();
    head.columns.resize(fields.size());
    head.titles.resize(fields.size());
    const std::vector<std::string> said = split(comment_text(comment.text), head.separator);
    if (said.size() == fields.size() && !has_value(said) && has_word(said)) {
        name_columns(said, head);
        head.line = comment.line;
    }
    return head;
}

}  // namespace clsurf::io

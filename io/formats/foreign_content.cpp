#include "io/formats/foreign_content.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "io/formats/text_head.h"

namespace clsurf::io {
namespace {

constexpr std::size_t head_bytes = 65536;

std::string_view head_of(const Source& source) { return source.text().substr(0, head_bytes); }

/// Whether at least half of the fields, and two, are numbers or times.
bool is_record(const std::vector<std::string>& fields) {
    const auto values = std::count_if(fields.begin(), fields.end(), is_value);
    return values >= 2 && 2 * values >= static_cast<std::ptrdiff_t>(fields.size());
}

/// Whether the text has control characters other than those of paper tape, line ends and ends of files.
bool is_binary(std::string_view head) {
    constexpr std::string_view of_texts = "\t\n\v\f\r\x11\x12\x13\x14\x1a";
    const auto strange = std::count_if(head.begin(), head.end(), [&](char c) {
        return static_cast<unsigned char>(c) < 0x20 && of_texts.find(c) == std::string_view::npos;
    });
    // Paper tape has leaders of NUL, and a damaged line may contain some: a few are accepted.
    constexpr std::ptrdiff_t harmless = 16;
    return strange > harmless && 20 * strange > static_cast<std::ptrdiff_t>(head.size());
}

/// An interrupted recorder or transfer leaves control characters.
void refuse_control_characters(const Source& source, std::string_view head) {
    const auto found = std::find_if(head.begin(), head.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
    });
    if (found == head.end()) return;
    const auto line = static_cast<std::uint64_t>(std::count(head.begin(), found, '\n')) + 1;
    throw InputError(Place::of_line(source.name, line),
                     fmt::format("a table with a control character (byte {:02x})", static_cast<unsigned char>(*found)),
                     "the file is damaged: export or transfer the log again");
}

}  // namespace

std::optional<ForeignTable> recognise_table(const Source& source) {
    const std::string_view head = head_of(source);
    if (head.empty() || is_binary(head)) return std::nullopt;
    const TextHead read = read_head(head);
    if (!is_record(read.first) || read.columns.size() != read.first.size()) return std::nullopt;
    refuse_control_characters(source, head);
    ForeignTable table{read.separator, read.titles, read.first, {}};
    std::string_view rest = head.substr(std::min(read.data_begin, head.size()));
    (void)first_line(rest);
    const std::string_view next = first_line(rest);
    // The last line of the head may be incomplete.
    if (next.empty() || rest.empty()) return read.named ? std::optional(table) : std::nullopt;
    table.second = split(next, read.separator);
    if (table.second.size() != table.first.size() || !is_record(table.second)) return std::nullopt;
    return table;
}

std::string describe(const ForeignTable& table) {
    constexpr std::size_t shown = 12;
    std::string names;
    for (std::size_t i = 0; i < std::min(shown, table.titles.size()); ++i) {
        if (!table.titles[i].empty()) names += (names.empty() ? ": " : ", ") + table.titles[i];
    }
    if (table.titles.size() > shown) names += ", …";
    return fmt::format("{} columns{}", table.titles.size(), names.empty() ? " without names" : names);
}

void require_program_text(const Source& source) {
    const Place place = Place::of_file(source.name);
    const std::string_view head = head_of(source);
    if (const LogFormat* format = recognise_log(source, {}))
        throw InputError(place, fmt::format("is a log (format {}), not an NC program", format->name),
                         "the program comes before the log: PROGRAM LOG");
    if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff"))
        throw InputError(place, "is UTF-16 text, expected ASCII or UTF-8",
                         "convert it first, as with iconv -f UTF-16 -t UTF-8");
    if (is_binary(head))
        throw InputError(place, "is binary data, not an NC program",
                         "to read a binary log of fixed records, use --layout FILE");
    if (const std::optional<ForeignTable> table = recognise_table(source))
        throw InputError(
            place, fmt::format("is a table of {}, not an NC program", describe(*table)),
            fmt::format("to read it as a log, use --mapping FILE; clsurf info --suggest-mapping {} -o mapping.toml "
                        "writes a first version",
                        source.name));
}

}  // namespace clsurf::io

#include "io/readers/measured_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "io/files/compressed.h"
#include "io/formats/text_head.h"
#include "io/readers/surface_data_file.h"

namespace clsurf::io {
namespace {

constexpr std::size_t fewest_places = 3;

struct LengthUnit {
    std::string_view name;
    double mm;
};
// Micro is U+00B5 or U+03BC in UTF-8, or 0xB5 in the Latin-1 of instruments under Windows.
constexpr LengthUnit length_units[] = {{"mm", 1},    {"µm", 1e-3},        {"μm", 1e-3},         {"\xb5m", 1e-3},
                                       {"um", 1e-3}, {"micron", 1e-3},    {"nm", 1e-6},         {"m", 1e3},
                                       {"cm", 10},   {"in", mm_per_inch}, {"inch", mm_per_inch}};

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

/// A column to read.
struct ReadColumn {
    std::size_t index = 0;
    double mm = 1;  ///< per its unit
    std::string name;
};

/// Finds columns in the head of a text.
class ColumnFinder {
public:
    ColumnFinder(const Source& source, const TextHead& head) : source_(source), head_(head) {}

    /// x and z, or x, y and z. Of two columns, the one that is not z is x, whatever its name.
    [[nodiscard]] std::vector<ReadColumn> find(const MeasuredColumns& wanted) const {
        std::vector<ReadColumn> found;
        if (!wanted.empty()) {
            for (const std::string& name : wanted) found.push_back(column(asked(name)));
            return found;
        }
        if (!head_.named) return by_count();
        const std::optional<std::size_t> x = named("x");
        const std::optional<std::size_t> y = named("y");
        const std::optional<std::size_t> z = named("z") ? named("z") : named("height");
        if (!x || !z) {
            if (said_by_comment()) return by_count();
            // A second column with another name may be depths.
            if (head_.columns.size() != 2 || !z) fail("no columns are named x and z");
            return {column(1 - *z), column(*z)};
        }
        found.push_back(column(*x));
        if (y) found.push_back(column(*y));
        found.push_back(column(*z));
        return found;
    }

private:
    /// By number of columns: two are x and z, three are x, y and z.
    [[nodiscard]] std::vector<ReadColumn> by_count() const {
        const std::size_t count = head_.columns.size();
        if (count != 2 && count != 3)
            fail(fmt::format("has {} columns without names: two are x and z, three x, y and z", count));
        std::vector<ReadColumn> found;
        for (std::size_t k = 0; k < count; ++k) {
            found.push_back(said_by_comment() ? ReadColumn{k, 1, fmt::format("{}", k)} : column(k));
        }
        return found;
    }
    /// Whether a comment with as many words as columns was taken for their names.
    [[nodiscard]] bool said_by_comment() const {
        std::string_view rest = source_.text();
        std::string_view line;
        for (std::uint64_t number = 0; number < head_.line; ++number) line = first_line(rest);
        return head_.named && is_comment(line);
    }
    [[noreturn]] void fail(const std::string& what) const {
        constexpr std::size_t most_names = 12;
        std::string names;
        for (std::size_t k = 0; k < std::min(most_names, head_.columns.size()); ++k)
            names += (k == 0 ? "" : ", ") + head_.columns[k].name.substr(0, 40);
        if (head_.columns.size() > most_names) names += fmt::format(" and {} more", head_.columns.size() - most_names);
        throw InputError(Place::of_line(source_.name, head_.line), what,
                         head_.named ? "its columns are: " + names + "; choose by name or number: x,z or x,y,z"
                                     : "choose columns by number: 0,1 are x and z, 0,1,2 are x, y and z");
    }
    [[nodiscard]] std::optional<std::size_t> named(std::string_view name) const {
        for (std::size_t k = 0; k < head_.columns.size(); ++k) {
            if (lower(head_.columns[k].name) == lower(name)) return k;
        }
        return std::nullopt;
    }
    [[nodiscard]] std::size_t asked(const std::string& name) const {
        if (const std::optional<std::size_t> column = named(name)) return *column;
        std::size_t number = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (error == std::errc() && end == name.data() + name.size() && number < head_.columns.size()) return number;
        fail(fmt::format("has no column '{}'", name.substr(0, 40)));
    }
    [[nodiscard]] ReadColumn column(std::size_t index) const {
        const ColumnPlan& plan = head_.columns[index];
        const std::string name = plan.name.empty() ? fmt::format("{}", index) : plan.name;
        if (plan.unit.empty()) return {index, 1, name};
        for (const LengthUnit& unit : length_units) {
            if (unit.name == plan.unit) return {index, unit.mm, name};
        }
        throw InputError(Place::of_line(source_.name, head_.line),
                         fmt::format("the unit '{}' of column '{}' is not a length", plan.unit.substr(0, 40), name),
                         "known units: mm, µm, nm, m, cm, in");
    }

    const Source& source_;
    const TextHead& head_;
};

/// Reads points line by line.
class PlaceReader {
public:
    PlaceReader(const Source& source, const TextHead& head, std::vector<ReadColumn> columns)
        : source_(source), head_(head), columns_(std::move(columns)) {}

    void read(MeasuredData& data) {
        std::string_view rest = source_.text().substr(std::min(head_.data_begin, source_.text().size()));
        for (std::uint64_t number = head_.first_data_line; !rest.empty(); ++number) {
            const std::string_view line = first_line(rest);
            if (is_comment(line)) continue;
            if (const std::optional<Vec3> place = read_line(line, number))
                data.points.push_back(*place);
            else
                ++data.missing;
        }
    }

private:
    [[nodiscard]] std::optional<Vec3> read_line(std::string_view line, std::uint64_t number) const {
        const std::vector<std::string> fields = split(line, head_.separator);
        std::array<double, 3> values{};
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            const ReadColumn& column = columns_[k];
            bool bad = column.index >= fields.size();
            double value = 0;
            if (!bad) value = parse_number(fields[column.index], head_.separator != ',', bad);
            if (bad) {
                constexpr std::size_t shown = 200;
                Place place = Place::of_line(source_.name, number);
                place.source = std::string(line.substr(0, shown));
                throw InputError(std::move(place),
                                 column.index >= fields.size()
                                     ? fmt::format("has {} fields: column '{}' is missing", fields.size(), column.name)
                                     : fmt::format("'{}' in column '{}' is not a number",
                                                   fields[column.index].substr(0, 40), column.name));
            }
            if (!std::isfinite(value)) return std::nullopt;
            values[k] = value * column.mm;
        }
        return columns_.size() == 2 ? Vec3(values[0], 0, values[1]) : Vec3(values[0], values[1], values[2]);
    }

    const Source& source_;
    const TextHead& head_;
    std::vector<ReadColumn> columns_;
};

/// Replaces line ends of CR alone, as some instruments write them, by line feeds.
Source with_line_feeds(const Source& source) {
    const std::string_view text = source.text();
    if (text.find('\n') != std::string_view::npos || text.find('\r') == std::string_view::npos) return source;
    const auto changed = std::make_shared<std::string>(text);
    std::ranges::replace(*changed, '\r', '\n');
    return {source.name, std::as_bytes(std::span(changed->data(), changed->size())), changed};
}

MeasuredData read_places(const Source& source, const MeasuredColumns& wanted) {
    constexpr std::size_t looked_at = 4096;
    if (!is_text(source.bytes.first(std::min(looked_at, source.bytes.size()))))
        throw InputError(Place::of_file(source.name), "is binary data, and not a surface data file",
                         "profiles and points are read as delimited text, areal maps as ISO 25178-71 (.sdf)");
    const TextHead head = read_head(source.text());
    if (head.first.empty()) throw InputError(Place::of_file(source.name), "holds no measured places");
    const std::vector<ReadColumn> columns = ColumnFinder(source, head).find(wanted);
    MeasuredData data;
    data.name = source.name;
    data.kind = columns.size() == 2 ? MeasuredKind::profile : MeasuredKind::points;
    PlaceReader(source, head, columns).read(data);
    if (data.points.size() < fewest_places)
        throw InputError(Place::of_file(source.name), fmt::format("holds {} measured places: at least {} are needed",
                                                                  data.points.size(), fewest_places));
    if (data.kind == MeasuredKind::profile)
        std::stable_sort(data.points.begin(), data.points.end(),
                         [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    return data;
}

}  // namespace

MeasuredData read_measured(const Source& source, const MeasuredColumns& columns) {
    if (!is_surface_data(source)) return read_places(with_line_feeds(source), columns);
    if (!columns.empty())
        throw InputError(Place::of_file(source.name), "is a surface data file, which has no columns to choose from");
    return read_surface_data(source);
}

MeasuredData read_measured(const std::string& path, const MeasuredColumns& columns) {
    return read_measured(open_source(path), columns);
}

}  // namespace clsurf::io

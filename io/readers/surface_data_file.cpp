#include "io/readers/surface_data_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "io/formats/text_table.h"

namespace clsurf::io {
namespace {

constexpr double mm_per_m = 1000;
constexpr std::size_t magic_bytes = 8;
constexpr std::string_view versions[] = {"ISO-1.0", "ISO-2.0", "BCR-1.0"};

/// What a header says.
struct Header {
    std::int64_t columns = 0, rows = 0;
    double x = 0, y = 0, z = 0;  ///< [m] spacings, and a height's unit
    int compression = 0, type = 0;
};

[[noreturn]] void refuse(Place place, const std::string& what, const char* hint = "") {
    throw InputError(std::move(place), what, hint);
}

/// An empty map of the header's size. `most`: of values that the file can hold.
MeasuredData map_of(const Source& source, const Header& header, std::size_t most) {
    const Place place = Place::of_file(source.name);
    if (header.compression != 0) refuse(place, "is compressed: only data without compression are read");
    if (header.columns < 2 || header.rows < 2)
        refuse(place, fmt::format("has {} × {} heights: a map has at least 2 × 2", header.columns, header.rows),
               "a profile is read as delimited text: x and z");
    if (!(header.x > 0 && header.y > 0 && std::isfinite(header.x) && std::isfinite(header.y)))
        refuse(place, "Xscale and Yscale must be above 0");
    if (!std::isfinite(header.z) || header.z == 0) refuse(place, "Zscale must be a number other than 0");
    if (header.columns > static_cast<std::int64_t>(most) / header.rows)
        refuse(place, fmt::format("is cut: {} × {} heights do not fit into it", header.columns, header.rows));
    MeasuredData map;
    map.kind = MeasuredKind::areal;
    map.name = source.name;
    map.columns = header.columns;
    map.rows = header.rows;
    map.spacing = mm_per_m * Vec2(header.x, header.y);
    map.points.reserve(static_cast<std::size_t>(header.columns * header.rows));
    return map;
}

/// The next height of a map [in units of the header], NaN: not measured.
void put(MeasuredData& map, const Header& header, double value) {
    const auto k = static_cast<std::int64_t>(map.points.size());
    const std::int64_t column = k % map.columns, row = k / map.columns;
    if (!std::isfinite(value)) ++map.missing;
    map.points.emplace_back(static_cast<double>(column) * map.spacing.x(), static_cast<double>(row) * map.spacing.y(),
                            value * header.z * mm_per_m);
}

// ---- text ----

/// Lines of a text with their numbers.
class TextLines {
public:
    explicit TextLines(const Source& source) : source_(source), rest_(source.text()) {}

    [[nodiscard]] bool done() const { return rest_.empty(); }
    std::string_view next() {
        ++number_;
        line_ = first_line(rest_);
        return line_;
    }
    [[noreturn]] void fail(const std::string& what, const char* hint = "") const {
        constexpr std::size_t shown = 200;
        Place place = Place::of_line(source_.name, number_);
        place.source = std::string(line_.substr(0, shown));
        refuse(std::move(place), what, hint);
    }

private:
    const Source& source_;
    std::string_view rest_, line_;
    std::uint64_t number_ = 0;
};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

double number_in(const TextLines& lines, std::string_view field, std::string_view what) {
    bool bad = false;
    const double value = parse_number(field, false, bad);
    if (bad || !std::isfinite(value)) lines.fail(fmt::format("{} '{}' is not a number", what, field.substr(0, 40)));
    return value;
}

Header text_header(TextLines& lines) {
    std::map<std::string, double, std::less<>> found{{"NumPoints", 0}, {"NumProfiles", 0}, {"Xscale", 0},
                                                     {"Yscale", 0},    {"Zscale", 0},      {"Compression", 0},
                                                     {"DataType", 0}};
    std::size_t seen = 0;
    for (;;) {
        if (lines.done()) lines.fail("the header does not end: expected a line '*'");
        const std::string_view line = trimmed(lines.next());
        if (line == "*") break;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) {
            if (!line.empty()) lines.fail("expected 'name = value', or '*' after the header");
            continue;
        }
        const auto field = found.find(trimmed(line.substr(0, equals)));
        if (field == found.end()) continue;  // dates, the manufacturer
        field->second = number_in(lines, trimmed(line.substr(equals + 1)), field->first);
        ++seen;
    }
    if (seen < found.size())
        lines.fail("the header lacks one of NumPoints, NumProfiles, Xscale, Yscale, Zscale, Compression, DataType");
    constexpr double most = 1e9;
    for (const char* name : {"NumPoints", "NumProfiles"}) {
        const double value = found.find(name)->second;
        if (!(value >= 0 && value <= most) || value != std::floor(value))
            lines.fail(fmt::format("{} {:g} is not a number of heights", name, value));
    }
    const auto get = [&](const char* name) { return found.find(name)->second; };
    return {static_cast<std::int64_t>(get("NumPoints")),
            static_cast<std::int64_t>(get("NumProfiles")),
            get("Xscale"),
            get("Yscale"),
            get("Zscale"),
            static_cast<int>(get("Compression")),
            static_cast<int>(get("DataType"))};
}

MeasuredData read_text(const Source& source) {
    TextLines lines(source);
    (void)lines.next();
    const Header header = text_header(lines);
    MeasuredData map = map_of(source, header, source.bytes.size());
    const auto wanted = static_cast<std::size_t>(header.columns * header.rows);
    while (map.points.size() < wanted) {
        if (lines.done()) lines.fail(fmt::format("is cut: {} of {} heights are there", map.points.size(), wanted));
        for (const std::string& field : split(lines.next(), ' ')) {
            if (field == "*") lines.fail(fmt::format("{} of {} heights are there", map.points.size(), wanted));
            if (map.points.size() == wanted) lines.fail(fmt::format("has more than {} heights", wanted));
            put(map, header, field == "BAD" ? missing<double> : number_in(lines, field, "the height"));
        }
    }
    return map;
}

// ---- binary ----

/// Fixed fields of a binary file, in their order.
class Fields {
public:
    explicit Fields(const Source& source) : source_(source) {}

    void skip(std::size_t bytes) { at_ += bytes; }
    template <typename Value>
    Value take() {
        if (at_ + sizeof(Value) > source_.bytes.size()) refuse(Place::of_byte(source_.name, at_), "the header is cut");
        Value value;
        std::memcpy(&value, source_.bytes.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    [[nodiscard]] std::size_t at() const { return at_; }

private:
    const Source& source_;
    std::size_t at_ = 0;
};

/// Values of one type from a byte on. `has_bad`: the lowest value says that nothing was measured.
template <typename Value>
void take_values(const Source& source, std::size_t first, bool has_bad, const Header& header, MeasuredData& map) {
    const auto count = static_cast<std::size_t>(header.columns * header.rows);
    const std::byte* bytes = source.bytes.data() + first;
    for (std::size_t k = 0; k < count; ++k) {
        Value value;
        std::memcpy(&value, bytes + k * sizeof value, sizeof value);
        const bool bad = has_bad && value == std::numeric_limits<Value>::lowest();
        put(map, header, bad ? missing<double> : static_cast<double>(value));
    }
}

using ValueReader = void (*)(const Source&, std::size_t, bool, const Header&, MeasuredData&);

/// A type of values, by its number.
struct ValueType {
    std::size_t bytes;
    bool has_bad;
    ValueReader read;
};
constexpr ValueType value_types[] = {
    {1, false, take_values<std::uint8_t>},  {2, false, take_values<std::uint16_t>},
    {4, false, take_values<std::uint32_t>}, {4, true, take_values<float>},
    {1, true, take_values<std::int8_t>},    {2, true, take_values<std::int16_t>},
    {4, true, take_values<std::int32_t>},   {8, true, take_values<double>},
};

MeasuredData read_binary(const Source& source) {
    constexpr std::size_t maker_and_dates = 10 + 12 + 12;
    const bool wide = source.text().substr(1, 5) == "ISO-2";
    Fields fields(source);
    fields.skip(magic_bytes + maker_and_dates);
    Header header;
    header.columns = wide ? static_cast<std::int64_t>(fields.take<std::uint32_t>()) : fields.take<std::uint16_t>();
    header.rows = wide ? static_cast<std::int64_t>(fields.take<std::uint32_t>()) : fields.take<std::uint16_t>();
    header.x = fields.take<double>();
    header.y = fields.take<double>();
    header.z = fields.take<double>();
    (void)fields.take<double>();  // the resolution of the instrument
    header.compression = fields.take<std::uint8_t>();
    header.type = fields.take<std::uint8_t>();
    (void)fields.take<std::uint8_t>();  // of a checksum; the standard has none
    if (static_cast<std::size_t>(header.type) >= std::size(value_types))
        refuse(Place::of_byte(source.name, fields.at() - 2), fmt::format("DataType {} is not known", header.type));
    const ValueType& type = value_types[header.type];
    MeasuredData map = map_of(source, header, (source.bytes.size() - fields.at()) / type.bytes);
    type.read(source, fields.at(), type.has_bad, header, map);
    return map;
}

}  // namespace

bool is_surface_data(const Source& source) {
    const std::string_view text = source.text();
    if (text.size() < magic_bytes || (text[0] != 'a' && text[0] != 'b')) return false;
    const std::string_view version = text.substr(1, magic_bytes - 1);
    return std::find(std::begin(versions), std::end(versions), version) != std::end(versions);
}

MeasuredData read_surface_data(const Source& source) {
    MeasuredData map = source.text()[0] == 'a' ? read_text(source) : read_binary(source);
    constexpr std::size_t fewest = 3;
    if (map.points.size() - map.missing < fewest) refuse(Place::of_file(source.name), "has fewer than three heights");
    return map;
}

}  // namespace clsurf::io

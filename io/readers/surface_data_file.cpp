#include "io/readers/surface_data_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/letter_case.h"
#include "core/not_finite.h"
#include "io/formats/text_table.h"

namespace clsurf::io {
namespace {

constexpr double mm_per_m = 1000;
constexpr std::size_t magic_bytes = 8;
constexpr std::string_view versions[] = {"ISO-1.0", "ISO-2.0", "BCR-1.0"};
constexpr std::string_view text_versions[] = {"NIST-1.0", "NPL-V1.0"};  ///< these have no binary files

/// The values of a header.
struct Header {
    std::int64_t columns = 0, rows = 0;
    double x = 0, y = 0, z = 0;  ///< [m] spacings, and the unit of height
    int compression = 0, type = 7;
    bool decimal_comma = false;
};

[[noreturn]] void refuse(Place place, const std::string& what, const char* hint = "") {
    throw InputError(std::move(place), what, hint);
}

/// An empty map with the size in the header. `most`: the number of values that the file can contain.
MeasuredData map_of(const Source& source, const Header& header, std::size_t most) {
    const Place place = Place::of_file(source.name);
    if (header.compression != 0) refuse(place, "is compressed: only data without compression are read");
    if (header.columns < 2 || header.rows < 1)
        refuse(place, fmt::format("has {} × {} heights: a profile has at least 2", header.columns, header.rows));
    const auto is_spacing = [](double value) { return value > 0 && std::isfinite(value); };
    if (!is_spacing(header.x) || (header.rows > 1 && !is_spacing(header.y)))
        refuse(place, "Xscale and Yscale must be above 0");
    if (!std::isfinite(header.z) || header.z == 0) refuse(place, "Zscale must be a number other than 0");
    if (header.columns > static_cast<std::int64_t>(most) / header.rows)
        refuse(place, fmt::format("is cut: {} × {} heights do not fit into it", header.columns, header.rows));
    MeasuredData map;
    map.kind = header.rows == 1 ? MeasuredKind::profile : MeasuredKind::areal;
    map.name = source.name;
    map.columns = header.columns;
    map.rows = header.rows;
    map.spacing = mm_per_m * Vec2(header.x, header.rows == 1 ? 0 : header.y);
    map.points.reserve(static_cast<std::size_t>(header.columns * header.rows));
    return map;
}

/// Adds the next height of a map [in units of the header], NaN: not measured.
void put(MeasuredData& map, const Header& header, double value) {
    const auto k = static_cast<std::int64_t>(map.points.size());
    const std::int64_t column = k % map.columns, row = k / map.columns;
    if (!std::isfinite(value)) ++map.missing;
    map.points.emplace_back(static_cast<double>(column) * map.spacing.x(), static_cast<double>(row) * map.spacing.y(),
                            value * header.z * mm_per_m);
}

/// The value of each type that means "not measured", by type number. NaN has the same meaning.
template <typename Value>
constexpr double lowest_of = static_cast<double>(std::numeric_limits<Value>::lowest());
template <typename Value>
constexpr double highest_of = static_cast<double>(std::numeric_limits<Value>::max());
constexpr std::optional<double> marks[] = {
    std::nullopt,           highest_of<std::uint16_t>, highest_of<std::uint32_t>, lowest_of<float>,
    lowest_of<std::int8_t>, lowest_of<std::int16_t>,   lowest_of<std::int32_t>,   lowest_of<double>,
};
std::optional<double> mark_of(int type) {
    return type >= 0 && static_cast<std::size_t>(type) < std::size(marks) ? marks[type] : std::nullopt;
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

/// A number in the header, with a decimal point or comma.
double number_in(const TextLines& lines, std::string_view field, std::string_view what) {
    bool bad = false;
    const double value = parse_number(field, true, bad);
    if (bad || !std::isfinite(value)) lines.fail(fmt::format("{} '{}' is not a number", what, field.substr(0, 40)));
    return value;
}

/// The text before a comment.
std::string_view without_comment(std::string_view line) { return trimmed(line.substr(0, line.find(';'))); }

Header text_header(TextLines& lines) {
    constexpr std::array names{"NumPoints", "NumProfiles", "Xscale", "Zscale", "Yscale", "Compression", "DataType"};
    constexpr std::size_t needed =
        4;  // the others have usual values: no compression, any type; a profile has no Yscale
    constexpr double most = 1e9;
    Header header;
    std::map<std::string, double, std::less<>> found;
    for (;;) {
        if (lines.done()) lines.fail("the header does not end: expected a line '*'");
        const std::string_view line = without_comment(lines.next());
        if (line == "*") break;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) {
            if (!line.empty()) lines.fail("expected 'name = value', or '*' after the header");
            continue;
        }
        const std::string key = lower_case(trimmed(line.substr(0, equals)));
        const auto name = std::ranges::find_if(names, [&](const char* each) { return lower_case(each) == key; });
        if (name == names.end()) continue;  // dates, the manufacturer
        const std::string_view value = trimmed(line.substr(equals + 1));
        const double number = found[*name] = number_in(lines, value, *name);
        if (key.ends_with("scale") && value.find(',') != std::string_view::npos) header.decimal_comma = true;
        if (key.starts_with("num") && (!(number >= 0 && number <= most) || number != std::floor(number)))
            lines.fail(fmt::format("{} {:g} is not a number of heights", *name, number));
    }
    for (std::size_t k = 0; k < needed; ++k) {
        if (!found.contains(names[k])) lines.fail(fmt::format("the header lacks {}", names[k]));
    }
    const auto get = [&](const char* name, double otherwise) {
        const auto at = found.find(name);
        return at == found.end() ? otherwise : at->second;
    };
    header.columns = static_cast<std::int64_t>(get("NumPoints", 0));
    header.rows = static_cast<std::int64_t>(get("NumProfiles", 0));
    header.x = get("Xscale", 0);
    header.y = get("Yscale", 0);
    header.z = get("Zscale", 0);
    header.compression = static_cast<int>(std::clamp(get("Compression", 0), -1.0, 255.0));
    header.type = static_cast<int>(std::clamp(get("DataType", header.type), -1.0, 255.0));
    return header;
}

/// The next field of a line of heights; empty: there is none.
std::string_view next_field(std::string_view& rest, bool decimal_comma) {
    const std::string_view blanks = decimal_comma ? " \t\r" : " \t\r,";
    const std::size_t first = std::min(rest.find_first_not_of(blanks), rest.size());
    const std::size_t last = std::min(rest.find_first_of(blanks, first), rest.size());
    const std::string_view field = rest.substr(first, last - first);
    rest.remove_prefix(last);
    return field;
}

/// A height as text; NaN: not measured.
double height_in(const TextLines& lines, std::string_view field, const Header& header) {
    if (lower_case(field) == "bad") return missing<double>;
    bool bad = false;
    const double value = parse_number(field, header.decimal_comma, bad);
    if (bad || std::isinf(value)) lines.fail(fmt::format("the height '{}' is not a number", field.substr(0, 40)));
    return value;
}

MeasuredData read_text(const Source& source) {
    TextLines lines(source);
    (void)lines.next();
    const Header header = text_header(lines);
    MeasuredData map = map_of(source, header, source.bytes.size());
    const std::optional<double> mark = mark_of(header.type);
    const auto wanted = static_cast<std::size_t>(header.columns * header.rows);
    while (map.points.size() < wanted) {
        if (lines.done()) lines.fail(fmt::format("is cut: {} of {} heights are there", map.points.size(), wanted));
        std::string_view rest = without_comment(lines.next());
        for (;;) {
            const std::string_view field = next_field(rest, header.decimal_comma);
            if (field.empty()) break;
            if (field == "*") lines.fail(fmt::format("{} of {} heights are there", map.points.size(), wanted));
            if (map.points.size() == wanted) lines.fail(fmt::format("has more than {} heights", wanted));
            const double height = height_in(lines, field, header);
            put(map, header, mark && height == *mark ? missing<double> : height);
        }
    }
    return map;
}

// ---- binary ----

/// A value with the opposite byte order.
template <typename Value>
Value reversed(Value value) {
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(Value)>>(value);
    std::ranges::reverse(bytes);
    return std::bit_cast<Value>(bytes);
}

/// Fixed fields of a binary file, in their order.
class Fields {
public:
    Fields(const Source& source, bool big_endian) : source_(source), big_endian_(big_endian) {}

    void skip(std::size_t bytes) { at_ += bytes; }
    template <typename Value>
    Value take() {
        if (at_ + sizeof(Value) > source_.bytes.size()) refuse(Place::of_byte(source_.name, at_), "the header is cut");
        Value value;
        std::memcpy(&value, source_.bytes.data() + at_, sizeof value);
        at_ += sizeof value;
        return big_endian_ ? reversed(value) : value;
    }
    [[nodiscard]] std::size_t at() const { return at_; }

private:
    const Source& source_;
    bool big_endian_;
    std::size_t at_ = 0;
};

/// Values of one type, from a byte offset on.
template <typename Value>
void take_values(const Source& source, std::size_t first, bool big_endian, const Header& header, MeasuredData& map) {
    const auto count = static_cast<std::size_t>(header.columns * header.rows);
    const std::optional<double> mark = mark_of(header.type);
    const std::byte* bytes = source.bytes.data() + first;
    for (std::size_t k = 0; k < count; ++k) {
        Value value;
        std::memcpy(&value, bytes + k * sizeof value, sizeof value);
        if (big_endian) value = reversed(value);
        const auto height = static_cast<double>(value);
        put(map, header, mark && height == *mark ? missing<double> : height);
    }
}

using ValueReader = void (*)(const Source&, std::size_t, bool, const Header&, MeasuredData&);

/// The reader of a type of values, by type number.
struct ValueType {
    std::size_t bytes;
    ValueReader read;
};
constexpr ValueType value_types[] = {
    {1, take_values<std::uint8_t>}, {2, take_values<std::uint16_t>}, {4, take_values<std::uint32_t>},
    {4, take_values<float>},        {1, take_values<std::int8_t>},   {2, take_values<std::int16_t>},
    {4, take_values<std::int32_t>}, {8, take_values<double>},
};
static_assert(std::size(value_types) == std::size(marks));

Header binary_header(const Source& source, Fields& fields) {
    constexpr std::size_t maker_and_dates = 10 + 12 + 12;
    const bool wide = source.text().substr(1, 5) == "ISO-2";
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
    (void)fields.take<std::uint8_t>();  // a checksum type; the standard defines none
    return header;
}

/// Whether an instrument can have such a spacing [m]; the wrong byte order rarely gives a plausible value.
bool is_likely_spacing(double metres) { return metres >= 1e-12 && metres <= 1; }

/// Some microscope programs add two numbers, 5 and 1, to the header of version 1.0.
std::size_t added_bytes(const Source& source, std::size_t at, std::size_t expected, bool big_endian) {
    constexpr std::uint32_t added[] = {5, 1};
    if (source.text().substr(1, 7) != "ISO-1.0" || source.bytes.size() != at + expected + sizeof added) return 0;
    Fields fields(source, big_endian);
    fields.skip(at);
    for (const std::uint32_t value : added) {
        if (fields.take<std::uint32_t>() != value) return 0;
    }
    return sizeof added;
}

MeasuredData read_binary(const Source& source) {
    Fields fields(source, false);
    Header header = binary_header(source, fields);
    bool big_endian = false;
    if (!is_likely_spacing(header.x)) {
        Fields other(source, true);
        const Header turned = binary_header(source, other);
        big_endian = is_likely_spacing(turned.x);
        if (big_endian) header = turned;
    }
    if (static_cast<std::size_t>(header.type) >= std::size(value_types))
        refuse(Place::of_byte(source.name, fields.at() - 2), fmt::format("DataType {} is not known", header.type));
    const ValueType& type = value_types[header.type];
    MeasuredData map = map_of(source, header, (source.bytes.size() - fields.at()) / type.bytes);
    const std::size_t expected = static_cast<std::size_t>(header.columns * header.rows) * type.bytes;
    const std::size_t first = fields.at() + added_bytes(source, fields.at(), expected, big_endian);
    type.read(source, first, big_endian, header, map);
    return map;
}

/// Removes points that were not measured from a profile.
void drop_missing(MeasuredData& profile) {
    std::erase_if(profile.points, [](const Vec3& p) { return !std::isfinite(p.z()); });
}

/// The first word of a text: "aISO-1.0".
std::string_view first_word(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\n;")); }

}  // namespace

bool is_surface_data(const Source& source) {
    const std::string_view text = source.text();
    if (text.size() < magic_bytes || (text[0] != 'a' && text[0] != 'b')) return false;
    const auto is_one_of = [](std::string_view version, const auto& known) {
        return std::find(std::begin(known), std::end(known), version) != std::end(known);
    };
    if (text[0] == 'b') return is_one_of(text.substr(1, magic_bytes - 1), versions);
    const std::string_view version = first_word(text.substr(1));
    return is_one_of(version, versions) || is_one_of(version, text_versions);
}

MeasuredData read_surface_data(const Source& source) {
    MeasuredData map = source.text()[0] == 'a' ? read_text(source) : read_binary(source);
    constexpr std::size_t fewest = 3;
    if (map.points.size() - map.missing < fewest) refuse(Place::of_file(source.name), "has fewer than three heights");
    if (map.kind == MeasuredKind::profile) drop_missing(map);
    return map;
}

}  // namespace clsurf::io

#include "cli/tables/export_columns.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/block.h"
#include "core/error.h"
#include "mapping/line_agreement.h"
#include "pipeline/part_fields.h"

namespace clsurf::cli {
namespace {

constexpr std::array<std::array<std::string_view, 3>, 8> own_columns{{{"point", "", "Number of the point, from 0"},
                                                                      {"time", "s", "Time since the first point"},
                                                                      {"line", "", "Program line, 0: none"},
                                                                      {"pass", "", "Pass, from 1, 0: none"},
                                                                      {"confidence", "", "Confidence of the line"},
                                                                      {"x", "mm", "X of the tool tip"},
                                                                      {"y", "mm", "Y of the tool tip"},
                                                                      {"z", "mm", "Z of the tool tip"}}};

/// Columns at some points that are not fields; nullopt: the name is not such a column.
std::optional<io::ExportColumn> own_column(const std::string& name, const Part& part, const ClSurface& surface,
                                           const PointRange& points) {
    const auto count = static_cast<std::size_t>(points.size());
    io::ExportColumn column;
    column.name = name;
    if (name == "point") {
        column.counts.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            column.counts[i] = static_cast<std::uint32_t>(points.first + static_cast<PointIndex>(i));
    } else if (name == "line") {
        column.counts.resize(count);
        for_each_block(points.size(), [&](PointIndex first, PointIndex last) {
            const std::span<std::uint32_t> lines(column.counts.data() + first, static_cast<std::size_t>(last - first));
            part.lines->read(points.first + first, lines);
            // A log without lines and without a program: 0, as at any point without a line.
            std::ranges::replace(lines, no_line, 0U);
        });
    } else if (name == "pass") {
        column.counts = Column<std::uint32_t>(count, 0);
        std::uint32_t number = 0;
        for (const Pass& pass : surface.passes) {
            if (pass.kind != PassKind::cut) continue;
            ++number;
            for (PointIndex i = std::max(pass.first, points.first); i <= std::min(pass.last, points.last); ++i)
                column.counts[static_cast<std::size_t>(i - points.first)] = number;
        }
    } else if (name == "time") {
        column.unit = "s";
        column.exact.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            column.exact[i] = part.log.time_of(points.first + static_cast<PointIndex>(i));
    } else if (name == "x" || name == "y" || name == "z") {
        const auto axis = static_cast<std::size_t>(name[0] - 'x');
        constexpr std::size_t block = 4096;
        column.unit = "mm";
        column.exact.resize(count);
        std::vector<double> others(2 * block);
        for (std::size_t first = 0; first < count; first += block) {
            const std::size_t n = std::min(block, count - first);
            std::array<std::span<double>, 3> xyz;
            for (std::size_t k = 0, other = 0; k < 3; ++k)
                xyz[k] = std::span(k == axis ? column.exact.data() + first : others.data() + block * other++, n);
            part.path.read(points.first + static_cast<PointIndex>(first), xyz[0], xyz[1], xyz[2]);
        }
    } else if (name == "confidence") {
        std::vector<double> confidences(count);
        read_confidences(part.path, part.program, *part.lines, points.first, confidences);
        column.values.resize(count);
        std::transform(confidences.begin(), confidences.end(), column.values.begin(),
                       [](double c) { return static_cast<float>(c); });
    } else {
        return std::nullopt;
    }
    return column;
}

io::ExportColumn column_of(Field field) {
    io::ExportColumn column;
    column.name = field.info.name;
    column.unit = field.info.unit.name;
    column.values = std::move(field.values);
    if (field.info.unit.per_inside != 1) {
        for (float& v : column.values) v = static_cast<float>(v * field.info.unit.per_inside);
    }
    return column;
}

}  // namespace

std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                               const ClSurface& surface) {
    std::vector<io::ExportColumn> columns;
    std::vector<std::string> fields;
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        std::optional<io::ExportColumn> own = own_column(name, part, surface, {0, part.log.records - 1});
        if (!own) {
            fields.push_back(name);
            places.push_back(columns.size());
        }
        columns.push_back(own ? std::move(*own) : io::ExportColumn());
    }
    if (fields.empty()) return columns;
    std::vector<Field> computed = fields_of(part, surface).get_all(fields);
    for (std::size_t i = 0; i < places.size(); ++i) columns[places[i]] = column_of(std::move(computed[i]));
    return columns;
}

std::vector<io::ExportColumn> exported_channels(const std::vector<std::string>& names, const Log& log) {
    std::vector<std::string> known{"time"};
    for (const Channel& channel : log.channels)
        if (channel.name != "time") known.push_back(channel.name);
    std::vector<io::ExportColumn> columns;
    for (const std::string& name : names.empty() ? known : names) {
        io::ExportColumn column;
        column.name = name;
        const auto count = static_cast<std::size_t>(log.records);
        if (name == "point") {
            column.counts.resize(count);
            std::iota(column.counts.begin(), column.counts.end(), 0U);
        } else if (name == "time") {
            column.unit = "s";
            column.exact.resize(count);
            for (std::size_t i = 0; i < count; ++i) column.exact[i] = log.time_of(static_cast<PointIndex>(i));
        } else if (const Channel* channel = log.find(name)) {
            column.unit = channel->unit;
            column.exact.resize(count);
            copy_block(channel->values, 0, column.exact);
            if (channel->values.type == ScalarType::f32) {  // no more digits than the type has
                column.values.resize(count);
                std::ranges::transform(column.exact, column.values.begin(),
                                       [](double v) { return static_cast<float>(v); });
                column.exact = {};
            }
        } else {
            throw UsageError(
                fmt::format("--columns: '{}' is not a channel of {}, which has no positions", name, log.name),
                fmt::format("one of point, {}", fmt::join(known, ", ")));
        }
        columns.push_back(std::move(column));
    }
    return columns;
}

namespace {

/// Copies the values at some points from a column that begins with point `first`.
template <typename T>
void pick(const Column<T>& from, PointIndex first, std::span<const PointIndex> points, Column<T>& to) {
    if (from.empty()) return;
    for (const PointIndex point : points) to.push_back(from[static_cast<std::size_t>(point - first)]);
}

/// Restores the original order: value k becomes value order[k].
template <typename T>
void put_back(const std::vector<std::size_t>& order, Column<T>& values) {
    if (values.empty()) return;
    Column<T> back(values.size());
    for (std::size_t k = 0; k < order.size(); ++k) back[order[k]] = values[k];
    values = std::move(back);
}

/// Passes completely inside a range, for derivatives inside it.
Passes passes_within(const Passes& passes, const PointRange& range) {
    Passes inside;
    for (const Pass& pass : passes) {
        if (pass.first >= range.first && pass.last <= range.last) inside.push_back(pass);
    }
    return inside;
}

io::ExportColumn column_of(const std::string& name, const Part& part, const ClSurface& surface, const FieldSet& fields,
                           const PointRange& range) {
    if (std::optional<io::ExportColumn> own = own_column(name, part, surface, range)) return std::move(*own);
    if (!fields.has(name) && fields_of(part, surface).has(name))
        throw UsageError("--columns: '" + name + "' is a field of the whole log, not of a shard");
    return column_of(std::move(fields.get_all({name}, range).front()));
}

}  // namespace

std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                               const ClSurface& surface, const std::vector<PointRange>& ranges,
                                               std::span<const PointIndex> points) {
    std::vector<io::ExportColumn> columns(names.size());
    // With sorted points each range is processed once; the order is restored afterwards.
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    std::vector<PointIndex> rising(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) rising[k] = points[order[k]];
    for (const PointRange& range : ranges) {
        const auto begin = std::lower_bound(rising.begin(), rising.end(), range.first);
        const auto end = std::upper_bound(begin, rising.end(), range.last);
        if (begin == end) continue;
        const FieldSet fields(part.log, part.path, passes_within(surface.passes, range));
        const std::span<const PointIndex> here(begin, end);
        for (std::size_t c = 0; c < names.size(); ++c) {
            const io::ExportColumn all = column_of(names[c], part, surface, fields, range);
            columns[c].name = all.name;
            columns[c].unit = all.unit;
            pick(all.values, range.first, here, columns[c].values);
            pick(all.exact, range.first, here, columns[c].exact);
            pick(all.counts, range.first, here, columns[c].counts);
        }
    }
    for (io::ExportColumn& column : columns) {
        put_back(order, column.values);
        put_back(order, column.exact);
        put_back(order, column.counts);
    }
    return columns;
}

std::vector<io::ListingRow> exportable_columns(const Part& part, const ClSurface& surface) {
    std::vector<io::ListingRow> rows;
    for (const auto& [name, unit, summary] : own_columns)
        rows.push_back({std::string(name), std::string(unit), std::string(summary)});
    const FieldSet fields = fields_of(part, surface);
    for (const FieldInfo& field : fields.fields()) {
        const bool own = std::ranges::any_of(own_columns, [&](const auto& column) { return column[0] == field.name; });
        if (!own && fields.can_compute(field.name))
            rows.push_back({field.name, std::string(field.unit.name), field.label});
    }
    return rows;
}

}  // namespace clsurf::cli

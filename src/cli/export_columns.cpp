#include "cli/export_columns.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/block.h"
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

/// What is exported as it is, not as a field; nullopt: none of these.
std::optional<io::ExportColumn> own_column(const std::string& name, const Part& part, const ClSurface& surface) {
    const auto count = static_cast<std::size_t>(part.log.records);
    io::ExportColumn column;
    column.name = name;
    if (name == "point") {
        column.counts.resize(count);
        for (std::size_t i = 0; i < count; ++i) column.counts[i] = static_cast<std::uint32_t>(i);
    } else if (name == "line") {
        column.counts.resize(count);
        for_each_block(part.log.records, [&](PointIndex first, PointIndex last) {
            const std::span<std::uint32_t> lines(column.counts.data() + first, static_cast<std::size_t>(last - first));
            part.lines->read(first, lines);
            // A log without lines and without a program: 0 as of any point that has none.
            std::ranges::replace(lines, no_line, 0U);
        });
    } else if (name == "pass") {
        column.counts = Column<std::uint32_t>(count, 0);
        std::uint32_t number = 0;
        for (const Pass& pass : surface.passes) {
            if (pass.kind != PassKind::cut) continue;
            ++number;
            for (PointIndex i = pass.first; i <= pass.last; ++i) column.counts[static_cast<std::size_t>(i)] = number;
        }
    } else if (name == "time") {
        column.unit = "s";
        column.exact.resize(count);
        for (std::size_t i = 0; i < count; ++i) column.exact[i] = part.log.time_of(static_cast<PointIndex>(i));
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
            part.path.read(static_cast<PointIndex>(first), xyz[0], xyz[1], xyz[2]);
        }
    } else if (name == "confidence") {
        std::vector<double> confidences(count);
        read_confidences(part.path, part.program, *part.lines, 0, confidences);
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
        std::optional<io::ExportColumn> own = own_column(name, part, surface);
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

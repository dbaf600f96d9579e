// clsurf export: per-point columns as CSV, BIIP, VTK.

#include <algorithm>

#include <fmt/format.h>

#include "cli/fields.h"
#include "cli/output_format.h"
#include "core/block.h"
#include "io/files/atomic_file.h"
#include "io/reports/export_table.h"
#include "viz/export_vtk.h"

namespace clsurf::cli {
namespace {

io::ExportColumn column_of(const std::string& name, const Part& part, const ClSurface& surface, Fields& fields) {
    const auto count = static_cast<std::size_t>(part.log.records);
    io::ExportColumn column;
    column.name = name;
    if (name == "point") {
        column.counts.resize(count);
        for (std::size_t i = 0; i < count; ++i) column.counts[i] = static_cast<std::uint32_t>(i);
    } else if (name == "line") {
        column.counts.resize(count);
        for_each_block(part.log.records, [&](PointIndex first, PointIndex last) {
            part.lines->read(first, {column.counts.data() + first, static_cast<std::size_t>(last - first)});
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
        Field field = fields.get(name);
        column.name = field.info.name;
        column.unit = std::string(field.info.unit.name);
        column.values = std::move(field.values);
        if (field.info.unit.per_inside != 1) {
            for (float& v : column.values) v = static_cast<float>(v * field.info.unit.per_inside);
        }
    }
    return column;
}

/// Columns as 32-bit point data for VTK.
Column<float> as_floats(const io::ExportColumn& column) {
    Column<float> values(static_cast<std::size_t>(column.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = !column.counts.empty()  ? static_cast<float>(column.counts[i])
                    : !column.exact.empty() ? static_cast<float>(column.exact[i])
                                            : column.values[i];
    }
    return values;
}

void write_vtk(const std::string& path, bool hdf, const ClSurface& surface,
               const std::vector<io::ExportColumn>& columns) {
    std::vector<Column<float>> values;
    for (const io::ExportColumn& column : columns) values.push_back(as_floats(column));
    std::vector<viz::PointData> data;
    for (std::size_t i = 0; i < columns.size(); ++i) data.push_back({columns[i].name, &values[i]});
    io::AtomicFile file(path);
    (hdf ? viz::write_vtkhdf : viz::write_vtp)(file.temporary_path(), surface, data);
    file.commit();
}

ExitCode run_export(const po::variables_map& values) {
    const std::string output = required(values, "output");
    const std::vector<std::string> names =
        split_names(values.count("columns") > 0 ? values["columns"].as<std::string>() : "point,time,line,x,y,z,speed");
    if (names.empty()) throw UsageError("--columns: no names");
    const std::string_view format = output_format(output, table_formats()).name;
    StageClock clock(read_common(values), 5);
    const Part part = load_part(read_part_or_log_options(values), clock);
    print(part.diagnostics, values);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    clock.begin("write the columns");
    std::vector<io::ExportColumn> columns;
    Fields fields(part, surface);
    for (const std::string& name : names) columns.push_back(column_of(name, part, surface, fields));
    if (format == "csv")
        io::write_csv(output, columns);
    else if (format == "biip")
        io::write_biip_table(output, columns, part.log.period, "{}");
    else
        write_vtk(output, format == "vtkhdf", surface, columns);
    return ExitCode::done;
}

}  // namespace

Subcommand export_subcommand() {
    return {
        .name = "export",
        .arguments = "[PROGRAM] LOG -o FILE",
        .summary = "per-point columns as .csv, .biip, .vtp, .vtkhdf",
        .description =
            "The file's ending chooses the form. Columns: point, time, line, pass, confidence, x, y, z and every\n"
            "field of `clsurf help fields`. VTK files hold the passes as polylines and the stitched surface;\n"
            ".hdf is .vtkhdf by the ending that ParaView 5.11 knows. Without a program, lines are those of the log.\n\n"
            "  clsurf export part.nc run.biip -o points.csv --columns line,x,y,z,speed,acceleration",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the file: .csv, .biip, .vtp, .vtkhdf or .hdf")
                    ("columns", po::value<std::string>()->value_name("A,B,…"), "what is written (default: point,time,line,x,y,z,speed)");
                // clang-format on
                declare_part(options);
                declare_derivative(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_export,
    };
}

}  // namespace clsurf::cli

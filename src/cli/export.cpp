// clsurf export: per-point columns as CSV, BIIP, VTK.

#include "cli/export_columns.h"
#include "cli/output_format.h"
#include "cli/part.h"
#include "io/files/atomic_file.h"
#include "io/reports/export_table.h"
#include "mapping/line_agreement.h"
#include "viz/export_vtk.h"

namespace clsurf::cli {
namespace {

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
    values.reserve(columns.size());
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
    const std::vector<io::ExportColumn> columns = exported_columns(names, part, surface);
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
            "The file's ending chooses the format. Columns: point, time, line, pass, confidence, x, y, z and\n"
            "every field of `clsurf help fields`. VTK files hold the passes as polylines and the stitched\n"
            "surface; .hdf is .vtkhdf with the ending that ParaView 5.11 recognises. Without a program, lines\n"
            "are those of the log.\n\n"
            "  clsurf export part.nc run.biip -o points.csv --columns line,x,y,z,speed,acceleration",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the file: .csv, .biip, .vtp, .vtkhdf or .hdf")
                    ("columns", po::value<std::string>()->value_name("A,B,…"), "columns to write (default: point,time,line,x,y,z,speed)");
                // clang-format on
                declare_part(options);
                declare_derivative(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_export,
    };
}

}  // namespace clsurf::cli

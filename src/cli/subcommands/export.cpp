// clsurf export: per-point columns as CSV, BIIP, VTK.

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/manual/help_text.h"
#include "cli/options/output_format.h"
#include "cli/options/part.h"
#include "cli/tables/export_columns.h"
#include "cli/tables/export_shards.h"
#include "io/files/atomic_file.h"
#include "io/formats/log_format.h"
#include "io/reports/export_table.h"
#include "mapping/line_agreement.h"
#include "viz/export_vtk.h"
#include "viz/vtkhdf.h"

namespace clsurf::cli {
namespace {

void write_vtk(const std::string& path, bool hdf, const ClSurface& surface,
               const std::vector<io::ExportColumn>& columns) {
    const std::vector<viz::PointData> data = point_data_of(columns);
    io::AtomicFile file(path);
    write_named(path, [&] {
        if (hdf)
            viz::write_vtkhdf(file.temporary_path(), surface, data);
        else
            viz::write_vtp(file.temporary_path(), surface, data);
    });
    file.commit();
}

/// `--list`: the columns that the part can export.
ExitCode list_columns(const po::variables_map& values, const Part& part, StageClock& clock) {
    clock.begin("stitch the surface");
    const std::vector<io::ListingRow> rows = exportable_columns(part, stitch(part));
    write_to_stdout(values.count("json") > 0 ? io::listing_json("columns", rows) : listing_text(rows));
    return ExitCode::done;
}

std::vector<std::string> requested_columns(const po::variables_map& values) {
    std::vector<std::string> names =
        split_names(given(values, "columns") ? values["columns"].as<std::string>() : "point,time,line,x,y,z,speed");
    if (names.empty()) throw UsageError("--columns: no names");
    return names;
}

bool has_positions(const Log& log) {
    return log.has(Role::commanded) || log.has(Role::feedback) || log.has(Role::actual);
}

/// Exports slow signals (`clsurf record`), which have no positions.
ExitCode write_channels(const Log& log, const std::string& output, std::string_view format,
                        const po::variables_map& values) {
    print(log.diagnostics, values);
    const std::vector<io::ExportColumn> columns =
        exported_channels(given(values, "columns") ? requested_columns(values) : std::vector<std::string>(), log);
    if (format == "csv")
        io::write_csv(output, columns);
    else if (format == "biip")
        io::write_biip_table(output, columns, log.period, "{}");
    else
        throw UsageError(fmt::format("{} has no positions, which VTK files need", log.name), "-o FILE.csv");
    return ExitCode::done;
}

ExitCode run_export(const po::variables_map& values) {
    if (values.count("merge") > 0) return merge_pieces(values);
    if (values.count("list") > 0) {
        if (values.count("output") > 0) throw UsageError("--list writes no file: -o must not be given");
        StageClock clock(read_common(values), 4);
        const Part part = load_part(read_part_or_log_options(values), clock);
        print(part.diagnostics, values);
        return list_columns(values, part, clock);
    }
    if (values.count("json") > 0) throw UsageError("--json needs --list", "add --list");
    const std::string output = required(values, "output");
    const std::vector<std::string> names = requested_columns(values);
    const PartOptions options = read_part_or_log_options(values);
    if (const std::optional<ShardNumber> shard = read_shard_number(values))
        return write_shard(options, *shard, names, values);
    if (given(values, "survey")) throw UsageError("--survey needs --shard");
    const std::string_view format = output_format(output, table_formats()).name;
    StageClock clock(read_common(values), 5);
    std::optional<Log> alone;
    if (options.program.empty()) {
        clock.begin("open the log");
        alone = io::open_log(options.log, options.log_options);
        if (!has_positions(*alone)) {
            clock.end();
            return write_channels(*alone, output, format, values);
        }
    }
    const Part part = alone ? assemble(std::move(*alone), rules_of(options)) : load_part(options, clock);
    clock.end();
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
        .summary = "writes columns per point as .csv, .biip, .vtp or .vtkhdf",
        .description =
            "The file's ending chooses the format. Columns: point, time, line, pass, confidence, x, y, z and\n"
            "every field of `clsurf help fields`. VTK files hold the passes as polylines and the stitched\n"
            "surface; .hdf is .vtkhdf with the ending that ParaView 5.11 recognises. Lines, points and passes are\n"
            "32-bit integers there, times and positions 64-bit numbers. Without a program, lines are those of\n"
            "the log.\n"
            "The surface of a log that is too large for memory is written in pieces (`clsurf survey`, docs/howto/shards.md):\n"
            "--shard writes one piece, and --merge combines all of them into a file that ParaView opens: a .pvtp file that names\n"
            "the .vtp pieces, or one .vtkhdf file with a partition for each .vtkhdf piece. A shard has the channels, and the fields\n"
            "that are computed from positions alone.\n\n"
            "  clsurf export part.nc run.biip -o points.csv --columns line,x,y,z,speed,acceleration\n"
            "  clsurf export part.nc run.biip --list",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the file: .csv, .biip, .vtp, .vtkhdf or .hdf")
                    ("columns", po::value<std::string>()->value_name("A,B,…"), "columns to write (default: point,time,line,x,y,z,speed)")
                    ("list", "list the columns that this part has, fields and channels included, and write no file")
                    ("json", "--list as one JSON object");
                // clang-format on
                declare_part(options);
                declare_derivative(options);
                declare_export_shards(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_export,
    };
}

}  // namespace clsurf::cli

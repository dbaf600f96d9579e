#include "cli/tables/export_shards.h"

#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "cli/options/output_format.h"
#include "cli/tables/export_columns.h"
#include "io/files/atomic_file.h"
#include "io/files/mapped_file.h"
#include "io/reports/vtk_pieces.h"
#include "surface/surface_part.h"
#include "viz/vtkhdf.h"

namespace clsurf::cli {

std::vector<viz::PointData> point_data_of(const std::vector<io::ExportColumn>& columns) {
    std::vector<viz::PointData> data;
    for (const io::ExportColumn& column : columns) {
        if (!column.counts.empty())
            data.push_back({column.name, &column.counts});
        else if (!column.exact.empty())
            data.push_back({column.name, &column.exact});
        else
            data.push_back({column.name, &column.values});
    }
    return data;
}

void declare_export_shards(po::options_description& options) {
    declare_shard(options, "write one of N parts of the surface, cut at passes, as .vtp or .vtkhdf");
    options.add_options()(
        "merge", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE…"),
        "write a .pvtp file that names these .vtp pieces of --shard, or a .vtkhdf file with a partition for each .vtkhdf piece");
}

ExitCode merge_pieces(const po::variables_map& values) {
    const std::string output = required(values, "output");
    const bool hdf = output.ends_with(".vtkhdf") || output.ends_with(".hdf");
    if (!hdf && !output.ends_with(".pvtp"))
        throw UsageError("-o " + output + ": --merge writes a .pvtp file, or a .vtkhdf file");
    const auto pieces = values["merge"].as<std::vector<std::string>>();
    io::AtomicFile file(output);
    if (hdf) {
        for (const std::string& piece : pieces)
            (void)io::map_file(piece);  // refuses an input that is the output, or is unreadable
        write_named(output, [&] { viz::merge_vtkhdf(file.temporary_path(), pieces); });
    } else {
        file.write(io::pvtp_text(pieces, std::filesystem::path(output).parent_path().string()));
    }
    file.commit();
    return ExitCode::done;
}

ExitCode write_shard(const PartOptions& options, const ShardNumber& shard, const std::vector<std::string>& names,
                     const po::variables_map& values) {
    const std::string output = required(values, "output");
    if (options.program.empty()) throw UsageError("a shard needs the program: clsurf export part.nc run.biip …");
    const std::string_view format = output_format(output, table_formats()).name;
    if (format != "vtp" && format != "vtkhdf") throw UsageError("--shard writes a .vtp or a .vtkhdf file");
    if (options.role)
        throw UsageError("--surface does not apply to --shard, which writes the positions that were surveyed");
    StageClock clock(read_common(values), 5);
    const SurveyedLog log = read_surveyed_log(options, values);
    const Part part = load_surveyed_part(options, log.survey, clock);
    clock.begin("write the shard");
    const ClSurface surface = surveyed_surface(part, log.survey);
    const PointRange own = points_of_shard(surface.passes, log.survey.points, shard);
    if (own.size() <= 0) throw UsageError("--shard: no pass begins in this shard", "fewer shards are enough");
    const SurfacePart with_neighbours = part_with_neighbours(surface, own);
    viz::VtkPiece piece = viz::piece_of(with_neighbours);
    const std::vector<io::ExportColumn> columns = exported_columns(names, part, surface, with_neighbours.ranges,
                                                                   std::span(piece.points.data(), piece.points.size()));
    const std::vector<viz::PointData> data = point_data_of(columns);
    io::AtomicFile file(output);
    write_named(output, [&] {
        if (format == "vtkhdf")
            viz::write_vtkhdf(file.temporary_path(), std::move(piece), own, log.survey.points, data);
        else
            viz::write_vtp(file.temporary_path(), std::move(piece), data);
    });
    file.commit();
    return ExitCode::done;
}

}  // namespace clsurf::cli

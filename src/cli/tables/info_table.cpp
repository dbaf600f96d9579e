#include "cli/tables/info_table.h"

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/terminal.h"
#include "core/file_name.h"
#include "io/files/atomic_file.h"
#include "io/files/compressed.h"
#include "io/formats/foreign_content.h"
#include "io/reports/json_text.h"

namespace clsurf::cli {

void declare_suggestion(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("suggest-mapping", "write a mapping file to start from for a table whose columns are not known")
        ("output,o", po::value<std::string>()->value_name("FILE"), "the mapping file, .toml (default: standard output)");
    // clang-format on
}

bool suggest_mapping_asked(const po::variables_map& values) {
    if (values.count("suggest-mapping") == 0) {
        if (given(values, "output"))
            throw UsageError("-o needs --suggest-mapping", "clsurf info --suggest-mapping log.csv -o mapping.toml");
        return false;
    }
    const auto files = values["FILE"].as<std::vector<std::string>>();
    if (files.size() != 1) throw UsageError("--suggest-mapping needs one file");
    const std::string path = values.count("output") > 0 ? required(values, "output") : "-";
    (void)output_format(path, toml_formats());
    const io::Source source = io::open_source(files.front());
    const std::optional<io::ForeignTable> table = io::recognise_table(source);
    if (!table) throw InputError(Place::of_file(source.name), "is not a table of numbers: no mapping can be suggested");
    io::AtomicFile file(path);
    file.write(io::suggest_mapping(*table, file_name(source.name)));
    file.commit();
    return true;
}

bool describe_table(const io::Source& source, const po::variables_map& values, std::vector<std::string>& objects) {
    const std::optional<io::ForeignTable> table = io::recognise_table(source);
    if (!table) return false;
    if (read_json(values)) {
        objects.push_back(io::table_json(source.name, *table));
    } else if (!read_common(values).quiet) {
        std::string columns;
        for (std::size_t i = 0; i < table->titles.size(); ++i) {
            const std::string& title = table->titles[i];
            columns += fmt::format("  {:>3}  {}{}{}\n", i, title, title.empty() ? "" : ", such as ", table->first[i]);
        }
        write_to_stdout(
            fmt::format("{}: a table that is not recognised as a log\n{}  a mapping file to start from:\n\n{}",
                        source.name, columns, io::suggest_mapping(*table, file_name(source.name))));
    }
    write_message(to_text({Severity::error, "log.unknown-table", Place::of_file(source.name),
                           "no column name is that of a position",
                           "write a mapping file with clsurf info --suggest-mapping " + source.name +
                               " -o mapping.toml, correct it, and pass it as --mapping"}));
    return true;
}

}  // namespace clsurf::cli

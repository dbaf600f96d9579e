#include "cli/report/report_shards.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/survey_options.h"
#include "core/column_file.h"
#include "core/error.h"

namespace clsurf::cli {
namespace {

/// [bytes] A page has up to 32 fields; columns up to this size stay in memory.
constexpr std::size_t least_in_files = std::size_t{16} << 20U;

std::string folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace

void declare_report_with_shards(po::options_description& options) {
    declare_report(options);
    declare_shard(
        options,
        "judge one of N parts of the log, cut at passes, and write what is found to -o FILE for --merge, as `clsurf check --shard` does");
    // clang-format off
    options.add_options()
        ("merge", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE…"), "the page from what was found in all shards")
        ("shards", po::value<int>()->default_value(8)->value_name("N"), "with --survey alone: how many parts the log is cut into, which are judged here one after the other; also the number of pieces of the map")
        ("scratch", po::value<std::string>()->value_name("FOLDER"), "with --survey: columns of the whole log are kept in files in this folder (default: that of the page)");
    // clang-format on
}

void read_report_shards(const po::variables_map& values, ReportOptions& options) {
    if (values.count("survey") == 0) {
        refuse_without_survey(values, {"shards", "merge", "scratch"});
        return;
    }
    refuse_with_survey(values, {"before", "follow"});
    options.shards = read_shard_count(values);
    SurveyedLog log = read_surveyed_log(options.part, values);
    options.merged = given(values, "merge")
                         ? shards_of_files(std::move(log), values["merge"].as<std::vector<std::string>>())
                         : shards_judged_here(std::move(log), options.shards, options.measured);
    options.merged->in_files = true;
    keep_columns_in(given(values, "scratch") ? values["scratch"].as<std::string>() : folder_of(options.output),
                    least_in_files);
}

}  // namespace clsurf::cli

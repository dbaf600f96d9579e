#include "cli/runs/followed_check.h"

#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "cli/terminal.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"

namespace clsurf::cli {
namespace {

constexpr PointIndex least_records = 1000;      ///< number of records needed to align program and log
constexpr PointIndex records_to_warn = 10'000;  ///< number of records after which a foreign log is reported

}  // namespace

std::unique_ptr<FollowedCheck> read_followed(const po::variables_map& values, const std::string& format,
                                             std::size_t logs) {
    const std::optional<FollowOptions> follow = read_follow(values);
    if (!follow) return nullptr;
    if (logs > 1) throw UsageError("--follow accepts one log");
    if (format != "text" && format != "json" && values.count("output") == 0)
        throw UsageError("--follow writes its findings to standard output, as text or JSON",
                         "give the " + format + " report a file with -o");
    const bool json = format == "json" && values.count("output") == 0;
    return std::make_unique<FollowedCheck>(*follow, json, read_common(values).quiet);
}

void FollowedCheck::follow(PartOptions& options, std::optional<Role> measured) {
    if (options.log == "-" && options.program == "-")
        throw UsageError("program and log cannot both come from standard input");
    const io::Source program = io::open_source(options.program);
    io::ProgramOptions as_programmed = options.program_options;
    as_programmed.coordinates.reset();
    std::optional<Program> read = io::read_program(program, as_programmed);
    bool warned = false;
    const auto look = [&](io::GrowingLog& log) {
        if (log.end() < least_records) return;
        Log window = log.window();
        const double period = window.period;
        if (!run_) {
            FollowRules rules;
            rules.part = rules_of(options);
            rules.measured = measured;
            Diagnostics final_diagnostics;
            rules.part.identity = io::check_identity(program, window, final_diagnostics);
            rules.part.tool = find_tool(options.tool, &window, &*read, final_diagnostics);
            run_.emplace(std::move(*read), window, std::move(rules));
            read.reset();
        }
        for (const ProvisionalDefect& found : run_->judge(std::move(window), log.first()))
            write(json_ ? io::finding_json(found, period) : io::finding_text(found, period));
        log.forget(run_->kept_from());
        if (!warned && log.end() >= records_to_warn && !run_->foreign().empty()) {
            warned = true;
            write_message(fmt::format("{}: warning: does not belong to {} so far: {}\n", options.log, options.program,
                                      run_->foreign()));
        }
    };
    PointIndex records = 0;
    io::Source bytes;
    const io::FollowEnd end = follow_log(
        options, follow_, {},
        [&](io::GrowingLog& log) {
            look(log);
            records = log.end();
        },
        bytes);
    write(json_ ? io::end_json(end, records) : io::end_text(end, records, follow_.timeout));
    options.log_source = std::move(bytes);
}

ResolvedFindings FollowedCheck::resolve(const QualityReport& complete) const {
    if (run_) return run_->resolve(complete);
    ResolvedFindings none;
    for (std::size_t k = 0; k < complete.defects.size(); ++k) none.late.push_back(k);
    return none;
}

void FollowedCheck::write_end(const ResolvedFindings& resolved, const std::string& report, ExitCode code) const {
    write(json_ ? io::resolved_json(resolved) + io::verdict_json(resolved, report, code)
                : io::resolved_text(resolved) + "\n");
}

void FollowedCheck::write(const std::string& text) const {
    if (quiet_ && !json_) return;
    write_to_stdout(json_ ? text : fit_terminal(text));
    std::fflush(stdout);
}

}  // namespace clsurf::cli

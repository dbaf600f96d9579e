// clsurf info: the content of a program or a log, and whether it can be trusted.

#include "cli/options/options.h"
#include "cli/options/work_frames.h"
#include "cli/tables/info_table.h"
#include "cli/tables/info_text.h"
#include "core/file_name.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/program_file.h"
#include "io/reports/json_text.h"
#include "log/health.h"
#include "mapping/line_agreement.h"
#include "mapping/map_lines.h"
#include "pipeline/log_match.h"
#include "pipeline/log_verdict.h"
#include "toolpath/toolpath_summary.h"

namespace clsurf::cli {
namespace {

void note_foreign(const Log& log, const Program& program, const ProgramMatch& match, bool forced,
                  Diagnostics& diagnostics) {
    diagnostics.add({forced ? Severity::warning : Severity::error, "map.foreign", Place::of_file(log.name),
                     "does not belong to " + program.main().name() + ": " + match.foreign,
                     match.foreign_hint.empty() ? "--work-offset or --machine may be missing" : match.foreign_hint});
}

/// A program with its motions as programmed.
struct ReadProgram {
    Program program;
    io::Source source;
};

struct CheckedLog {
    Log log;
    Diagnostics diagnostics;
    LogVerdict verdict;
};

/// Reads a log and checks it, also against the program if there is one.
CheckedLog check_log(const io::Source& source, const io::LogOptions& options, const std::optional<ReadProgram>& read,
                     const std::shared_ptr<const Kinematics>& kinematics, const po::variables_map& values) {
    CheckedLog checked{io::open_log(source, options), {}, {}};
    const Log& log = checked.log;
    Diagnostics& diagnostics = checked.diagnostics;
    diagnostics = log.diagnostics;
    diagnostics.append(check_health(log, read ? read->program.main().line_count() : 0));
    if (!read) {
        checked.verdict = log_verdict(log, diagnostics, {}, ProgramIdentity::unknown);
        return checked;
    }
    const Program& program = read->program;
    const ProgramIdentity identity = io::check_identity(read->source, log, diagnostics);
    const ProgramMatch match = match_log(program, log, read_work_offset(values), kinematics, identity, diagnostics);
    if (!match.foreign.empty() && (kinematics || diagnostics.count("path.rotary") == 0))
        note_foreign(log, program, match, values.count("force") > 0, diagnostics);
    checked.verdict = log_verdict(log, diagnostics, file_name(program.main().name()), identity);
    return checked;
}

ExitCode run_info(const po::variables_map& values) {
    if (values.count("FILE") == 0) throw UsageError("missing argument: FILE");
    if (suggest_mapping_asked(values)) return ExitCode::done;
    const bool json = read_json(values);
    const bool quiet = read_common(values).quiet;
    std::vector<std::string> objects;
    std::optional<ReadProgram> program;
    bool unusable = false;
    const std::shared_ptr<const Kinematics> kinematics =
        load_kinematics(values.count("machine") > 0 ? values["machine"].as<std::string>() : std::string());
    for (const std::string& path : values["FILE"].as<std::vector<std::string>>()) {
        const io::LogOptions log_options = read_log_options(values);
        const io::Source source = io::open_source(path);
        if (source.bytes.empty())
            throw InputError(Place::of_file(source.name), "is empty, expected a program or a log");
        // A layout or a mapping determines how a log is read: with them, any file could be a log.
        const bool is_log = io::recognise_log(source, log_options) != nullptr &&
                            !(io::forces_log(log_options) && io::looks_like_program(source));
        if (!is_log && describe_table(source, values, objects)) {
            unusable = true;
            continue;
        }
        if (!is_log) {
            io::ProgramOptions options = read_program_options(values);
            options.coordinates.reset();
            program = {io::read_program(source, options), source};
            const Program& read = program->program;
            Program placed = read;
            (void)place_motions(placed);
            const ToolpathSummary summary = summarise(placed.motions);
            if (json)
                objects.push_back(io::program_json(read, summary, read.diagnostics));
            else if (!quiet)
                print_program(read, summary, read.diagnostics);
            continue;
        }
        const CheckedLog checked = check_log(source, log_options, program, kinematics, values);
        unusable = unusable || checked.diagnostics.has_errors();
        print_errors(checked.diagnostics);
        if (json)
            objects.push_back(io::log_json(checked.log, checked.verdict, checked.diagnostics));
        else if (!quiet)
            print_log(checked.log, checked.verdict, checked.diagnostics);
    }
    if (json) write_to_stdout(io::list_json("files", objects));
    return unusable ? ExitCode::bad_input : ExitCode::done;
}

}  // namespace

Subcommand info_subcommand() {
    return {
        .name = "info",
        .arguments = "FILE…",
        .summary = "describes programs and logs, and lists their problems",
        .description =
            "The content decides whether a file is a program or a log. A log that is given after its program is\n"
            "checked against it: wrong program, lines that do not exist, a missing work offset. Exit code 3\n"
            "means that a log has errors or does not belong to the program.\n"
            "For a table with unknown columns, it lists the columns and prints a mapping file to start from; the exit\n"
            "code is 3.\n\n"
            "  clsurf info part.nc run.biip\n"
            "  clsurf info --suggest-mapping own.csv -o mapping.toml",
        .declare =
            [](po::options_description& options) {
                options.add_options()(
                    "json", "one JSON object: {\"files\": […]}, and for a single file its keys at the top level, too");
                declare_suggestion(options);
                declare_program_options(options);
                declare_log_options(options);
                declare_work_offset(options);
                declare_force(options);
                declare_kinematics(options);
            },
        .positional = {"FILE…"},
        .run = run_info,
    };
}

}  // namespace clsurf::cli

#include "cli/programs/controller_runs.h"

#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/options/output_format.h"
#include "cli/options/part.h"
#include "cli/stage_clock.h"
#include "core/error.h"
#include "core/file_name.h"
#include "io/files/atomic_file.h"
#include "io/files/compressed.h"
#include "io/formats/log_format.h"
#include "pipeline/part.h"

namespace clsurf::cli {
namespace {

/// The first sentence of a message, without the name of the temporary file and without hints.
std::string first_sentence(const std::string& message) {
    constexpr std::string_view mark = "error: ";
    const std::size_t at = message.find(mark);
    const std::size_t begin = at == std::string::npos ? 0 : at + mark.size();
    return message.substr(begin, message.find('\n', begin) - begin);
}

}  // namespace

ControllerRuns::ControllerRuns(ControllerCommand command, const io::TextReader& reader)
    : command_(std::move(command)), reader_(reader) {}

ControllerOutcome ControllerRuns::run(const std::string& text) const {
    const std::filesystem::path program = folder_.path() / file_name(reader_.source.name);
    const std::filesystem::path log_path = folder_.path() / "run.biip";
    io::AtomicFile file(program.string());
    file.write(text);
    file.commit();
    if (std::string failure = command_.run(program, log_path); !failure.empty())
        return {std::nullopt, std::move(failure)};
    try {
        Log log = io::open_log(log_path.string(), {});
        PartRules rules;
        rules.poses = reader_.poses;
        const Part part = assemble(reader_.as_programmed(text), Log(log), rules);
        if (!part.log.has(Role::commanded)) return {std::nullopt, "the log has no commanded positions"};
        return {std::move(log), {}};
    } catch (const InputError& error) {
        return {std::nullopt, "its log cannot be used: " + first_sentence(error.what())};
    }
}

ExitCode record_on_controller(const ControllerCommand& command, const std::string& program, const std::string& output,
                              const po::variables_map& values) {
    for (const char* name : {"machine", "start", "work-offset", "json"}) {
        if (given(values, name)) throw UsageError(fmt::format("--{} does not apply to --controller", name));
    }
    (void)io::open_source(program);
    const RunFolder folder;
    const std::string recorded = (folder.path() / "run.biip").string();
    io::AtomicFile file(output);
    if (const std::string failure = command.run(program, recorded); !failure.empty())
        throw InputError(Place::of_file(program), "the controller did not run it: " + failure);
    io::Source bytes = io::map_file(recorded);
    bytes.name = output;
    PartOptions options;
    options.program = program;
    options.log = output;
    options.program_options = read_program_options(values);
    options.log_source = bytes;
    options.accept_unknown_tips = true;
    StageClock clock(read_common(values), 3);
    const Part part = load_part(options, clock);
    file.write(bytes.text());
    file.commit();
    print(part.diagnostics, values);
    write_answer(fmt::format("{} records, {:.3f} s, from the controller\n", part.log.records,
                             static_cast<double>(part.log.records) * part.log.period),
                 values);
    return ExitCode::done;
}

}  // namespace clsurf::cli

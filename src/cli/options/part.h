#pragma once
// Options for reading a program and its log and assembling them (pipeline/part.h).

#include <optional>
#include <string>

#include "cli/options/known_tool.h"
#include "cli/options/options.h"
#include "cli/stage_clock.h"
#include "pipeline/part.h"

namespace clsurf::cli {

struct PartOptions {
    std::string program, log;
    io::ProgramOptions program_options;
    io::LogOptions log_options;
    std::optional<Role> role;  ///< --surface
    bool as_machined = false;  ///< --surface formed
    FramePoses poses;          ///< --work-offset
    std::string machine;       ///< machine file with the kinematics; empty: three axes
    bool use_line_channel = true;
    bool force = false;                ///< accept a log that does not belong to the program
    bool accept_unknown_tips = false;  ///< see PartRules
    ToolChoice tool;
    DerivativeMethod derivative = DerivativeMethod::savgol;
    std::optional<io::Source> log_source = std::nullopt;  ///< content of a followed log; nullopt: read the file `log`
};

/// --dialect, --block-delete, --tools, --layout, --mapping, --period, --surface, --work-offset, --machine, --ignore-lines.
/// If a program without a log is simulated (`render`), --surface also accepts `formed`.
void declare_part(po::options_description& options, MachineUse use = MachineUse::kinematics);
/// --derivative, for subcommands that derive speeds.
void declare_derivative(po::options_description& options);
[[nodiscard]] DerivativeMethod read_derivative(const po::variables_map& values);
[[nodiscard]] PartOptions read_part_options(const po::variables_map& values);
/// The same if a log may be the only argument; `program` is then empty.
[[nodiscard]] PartOptions read_part_or_log_options(const po::variables_map& values);

/// Whether a file is a log and not a program, by its content, or because a layout or a mapping is given.
[[nodiscard]] bool is_log(const io::Source& source, const io::LogOptions& options);
/// Options of PROGRAM [LOG]. The content of a single argument decides whether it is a program (`log` is empty) or a log
/// (`program` is empty).
[[nodiscard]] PartOptions read_part_or_program_options(const po::variables_map& values);

/// "commanded", "feedback" or "actual". Throws UsageError.
[[nodiscard]] Role parse_role(const std::string& text);

/// Reads and assembles both. Without a program, the lines are those of the log's channel. Throws InputError (also if
/// the log does not belong to the program, unless forced), UsageError.
[[nodiscard]] Part load_part(const PartOptions& options, StageClock& clock);

/// How a part is assembled, from the options. Throws InputError.
[[nodiscard]] PartRules rules_of(const PartOptions& options);

/// The tool of a part. Throws UsageError if it is not known, with what needs it and an example.
[[nodiscard]] CuttingTool required_tool(const Part& part, const std::string& what, const std::string& example);

/// For comparing passes at their commanded positions: --surface then selects the positions from which heights are
/// measured. Returns that role and removes it from the options; nullopt: the most truthful one.
[[nodiscard]] std::optional<Role> take_measured_role(PartOptions& options);

}  // namespace clsurf::cli

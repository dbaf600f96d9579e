#pragma once
// Options that say how a program and a log of it are read and put together (pipeline/part.h).

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
    bool force = false;                ///< go on with a log that does not belong to the program
    bool accept_unknown_tips = false;  ///< see PartRules
    ToolChoice tool;
    DerivativeMethod derivative = DerivativeMethod::savgol;
    std::optional<io::Source> log_source = std::nullopt;  ///< what was followed; nullopt: the file `log`
};

/// --dialect, --block-delete, --tools, --layout, --mapping, --period, --surface, --work-offset, --machine, --ignore-lines.
/// Where a program without a log is simulated (`render`), --surface may be `formed`, too.
void declare_part(po::options_description& options, MachineUse use = MachineUse::kinematics);
/// --derivative, of what derives speeds.
void declare_derivative(po::options_description& options);
[[nodiscard]] DerivativeMethod read_derivative(const po::variables_map& values);
[[nodiscard]] PartOptions read_part_options(const po::variables_map& values);
/// The same where a log may come alone, as the only argument: `program` is empty then.
[[nodiscard]] PartOptions read_part_or_log_options(const po::variables_map& values);

/// Whether a file is a log, not a program, by its content; a layout or a mapping says that it is one.
[[nodiscard]] bool is_log(const io::Source& source, const io::LogOptions& options);
/// Options of PROGRAM [LOG]. The content of a single argument says whether it is a program, with an empty `log`, or a log, with
/// an empty `program`.
[[nodiscard]] PartOptions read_part_or_program_options(const po::variables_map& values);

/// "commanded", "feedback" or "actual". Throws UsageError.
[[nodiscard]] Role parse_role(const std::string& text);

/// Reads both and assembles them. Without a program the lines are those of the log's channel. Throws InputError (also where
/// the log does not belong to the program, unless forced), UsageError.
[[nodiscard]] Part load_part(const PartOptions& options, StageClock& clock);

/// How a part is put together, as the options say. Throws InputError.
[[nodiscard]] PartRules rules_of(const PartOptions& options);

/// The tool of a part, or a UsageError that says what needs it, with an example.
[[nodiscard]] CuttingTool required_tool(const Part& part, const std::string& what, const std::string& example);

/// For passes that are compared where they were commanded: --surface names what heights are measured from. Returns that
/// role and takes it out of the options; nullopt: the most truthful one.
[[nodiscard]] std::optional<Role> take_measured_role(PartOptions& options);

}  // namespace clsurf::cli

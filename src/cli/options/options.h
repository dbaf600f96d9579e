#pragma once
// Option groups that several subcommands share, declared and read in one place each, so that an
// option means the same everywhere.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/subcommand.h"
#include "core/diagnostic.h"
#include "core/geometry.h"
#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "machine/kinematics.h"

namespace clsurf::cli {

/// -q, -v, --threads, --progress: common to all subcommands.
struct CommonOptions {
    bool quiet = false;
    bool verbose = false;
    int threads = 0;  ///< 0: the number of cores
    std::string progress = "auto";
};
void declare_common(po::options_description& options);
[[nodiscard]] CommonOptions read_common(const po::variables_map& values);

/// --dialect, --block-delete, --tools
void declare_program_options(po::options_description& options);
/// Also reads --start if the subcommand has it.
[[nodiscard]] io::ProgramOptions read_program_options(const po::variables_map& values);

/// --layout, --mapping, --period
void declare_log_options(po::options_description& options);
[[nodiscard]] io::LogOptions read_log_options(const po::variables_map& values);

/// --force, for logs that must belong to their program
void declare_force(po::options_description& options);

/// The use of a machine file by a subcommand, besides its kinematics.
enum class MachineUse : std::uint8_t {
    kinematics,  ///< no other use
    simulation,  ///< to simulate a program without a log
    limits,      ///< to compare the commanded motion with its limits
    known,       ///< for values that the runs do not determine
};
/// --machine, for its kinematics
void declare_kinematics(po::options_description& options, MachineUse use = MachineUse::kinematics);
/// The kinematics of a machine file; nullptr: no file, or three axes.
[[nodiscard]] std::shared_ptr<const Kinematics> load_kinematics(const std::string& path);

/// --machine, --start: how a program is simulated.
void declare_simulation(po::options_description& options);
[[nodiscard]] Vec3 read_start(const po::variables_map& values);

/// --json
void declare_json(po::options_description& options);
[[nodiscard]] bool read_json(const po::variables_map& values);

/// Whether the option is on the command line, not in a configuration (cli/options/config.h).
[[nodiscard]] bool given(const po::variables_map& values, const char* name);
/// Throws UsageError if one of `options` is given but something that it needs is missing.
void refuse_given(const po::variables_map& values, const po::options_description& options, const std::string& needed,
                  const std::string& hint);
/// The same for the options for reading a program.
void refuse_program_options(const po::variables_map& values, const std::string& hint);

/// The options of a group that have values, except `except`, as words of a command line that gives the same values.
[[nodiscard]] std::vector<std::string> words_of(const po::options_description& group, const po::variables_map& values,
                                                const std::vector<std::string>& except = {});

/// Adds a note that a value in a log overrides a different one of the configuration for `option`.
void note_overruled(Diagnostics& diagnostics, const Log& log, const std::string& option, const std::string& configured,
                    const std::string& recorded);

/// A required positional argument or option; a UsageError names it if it is missing.
[[nodiscard]] std::string required(const po::variables_map& values, const char* name);

/// --json of a subcommand whose output is another file. Throws UsageError if both go to standard output.
[[nodiscard]] bool read_json_with_output(const po::variables_map& values);

/// Writes messages of a subcommand for the user: nothing with -q, and to standard error if its output goes to
/// standard output. Throws SystemError.
void write_answer(std::string_view text, const po::variables_map& values);

/// required() for an argument that may be repeated: the first value.
[[nodiscard]] std::string first_value(const po::variables_map& values, const char* name);

/// "5um", "0.005mm" → [mm]. Throws UsageError, naming `option`.
[[nodiscard]] double parse_length(const std::string& text, const std::string& option);

/// Writes to standard output. Throws SystemError (a full disk; a closed pipe ends the program).
void write_to_stdout(std::string_view text);

/// Exactly `count` numbers separated by commas or blanks (0: one or more). Throws UsageError, naming `option`.
[[nodiscard]] std::vector<double> parse_numbers(const std::string& text, const std::string& option, std::size_t count);

/// Names separated by commas; empty ones are left out.
[[nodiscard]] std::vector<std::string> split_names(const std::string& text);

/// "1600x1200", "hd" (1920x1080), "4k" (3840x2160): two whole numbers of pixels. Throws UsageError.
[[nodiscard]] std::vector<double> read_size(const std::string& text);

/// Prints diagnostics to stderr: errors and warnings, notes with -v, nothing but errors with -q.
void print(const Diagnostics& diagnostics, const po::variables_map& values);

}  // namespace clsurf::cli

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

/// -q, -v, --threads, --progress: every subcommand has them.
struct CommonOptions {
    bool quiet = false;
    bool verbose = false;
    int threads = 0;  ///< 0: as many as cores
    std::string progress = "auto";
};
void declare_common(po::options_description& options);
[[nodiscard]] CommonOptions read_common(const po::variables_map& values);

/// --dialect, --block-delete, --tools
void declare_program_options(po::options_description& options);
/// With --start, where a subcommand has it.
[[nodiscard]] io::ProgramOptions read_program_options(const po::variables_map& values);

/// --layout, --mapping, --period
void declare_log_options(po::options_description& options);
[[nodiscard]] io::LogOptions read_log_options(const po::variables_map& values);

/// --force, of what takes a log that must belong to its program
void declare_force(po::options_description& options);

/// What a subcommand takes from a machine file, besides its kinematics.
enum class MachineUse : std::uint8_t {
    kinematics,  ///< nothing else
    simulation,  ///< a program without a log is simulated on it
    limits,      ///< the commanded motion is compared with its limits
    known,       ///< what the runs do not determine
};
/// --machine, for its kinematics
void declare_kinematics(po::options_description& options, MachineUse use = MachineUse::kinematics);
/// The kinematics of a machine file; nullptr: no file, or three axes.
[[nodiscard]] std::shared_ptr<const Kinematics> load_kinematics(const std::string& path);

/// --machine, --start: how a program is run where it is simulated.
void declare_simulation(po::options_description& options);
[[nodiscard]] Vec3 read_start(const po::variables_map& values);

/// --json
void declare_json(po::options_description& options);
[[nodiscard]] bool read_json(const po::variables_map& values);

/// The option is on the command line, not in a configuration (cli/options/config.h).
[[nodiscard]] bool given(const po::variables_map& values, const char* name);
/// Throws UsageError where one of `options` is given, which needs something that is not there.
void refuse_given(const po::variables_map& values, const po::options_description& options, const std::string& needed,
                  const std::string& hint);
/// The same of the options that say how a program is read.
void refuse_program_options(const po::variables_map& values, const std::string& hint);

/// The options of a group that have values, but `except`, as words of a command line that gives the same values.
[[nodiscard]] std::vector<std::string> words_of(const po::options_description& group, const po::variables_map& values,
                                                const std::vector<std::string>& except = {});

/// A note that what a log says of itself came before another value that the configuration has for `option`.
void note_overruled(Diagnostics& diagnostics, const Log& log, const std::string& option, const std::string& configured,
                    const std::string& recorded);

/// A positional argument or an option that must be there; UsageError names it otherwise.
[[nodiscard]] std::string required(const po::variables_map& values, const char* name);

/// --json of a subcommand whose output is another file. Throws UsageError where both go to standard output.
[[nodiscard]] bool read_json_beside_output(const po::variables_map& values);

/// What a subcommand has to say to people: nothing with -q, and to standard error where its output goes to
/// standard output. Throws SystemError.
void write_answer(std::string_view text, const po::variables_map& values);

/// required() of an argument that may be repeated: the first.
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

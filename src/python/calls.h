#pragma once
// The calls of the module that make parts and compare them.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/loaded_part.h"

namespace clsurf::python {

/// How a program and a log are read: the options of the subcommands. Empty texts: not given.
struct PartOptions {
    std::string program;  ///< empty: the log comes alone
    std::string log;
    std::string tool;  ///< "ball:D", "bull:D,R", "flat:D" [mm], "none"
    std::string machine;
    std::string surface;  ///< "commanded", "feedback", "actual"
    std::string dialect;
    std::string tools;
    bool block_delete = true;
    std::string layout, mapping;
    std::optional<double> period;                      ///< [s]
    std::optional<std::array<double, 4>> work_offset;  ///< x, y, z [mm] and rotation about Z [deg]
    bool ignore_lines = false;
    bool force = false;
    std::string derivative = "savgol";
};

[[nodiscard]] io::ProgramOptions program_options_of(const PartOptions& options);
/// Throws UsageError.
[[nodiscard]] io::LogOptions log_options_of(const PartOptions& options);
[[nodiscard]] FramePoses poses_of(const PartOptions& options);

/// Throws InputError, UsageError.
[[nodiscard]] std::shared_ptr<LoadedPart> read_part(const PartOptions& options);

/// The run of a program on a simulated machine (`log` is not asked), from where the axes stand [mm].
[[nodiscard]] std::shared_ptr<LoadedPart> simulate_part(const PartOptions& options, const std::array<double, 3>& start);

/// The report of `clsurf identify`, as JSON, and the text of a machine file. `machine`: a file with what is known already; empty: none. Throws InputError.
[[nodiscard]] std::pair<std::string, std::string> identify_machine(
    const std::vector<std::shared_ptr<LoadedPart>>& parts, const std::vector<std::shared_ptr<LoadedPart>>& tests,
    const std::string& machine);

/// The report of `clsurf diff`, as JSON: runs compared with the first one, by path. Throws InputError: nothing of a run lies on
/// the path of the first one.
[[nodiscard]] std::string diff_parts(const std::vector<std::shared_ptr<LoadedPart>>& parts);

}  // namespace clsurf::python

#include "cli/runs/followed_output.h"

#include <filesystem>
#include <limits>
#include <utility>

#include "cli/terminal.h"

namespace clsurf::cli {
namespace {

constexpr double least_seconds = 2;  ///< shortest time between two pictures
constexpr double pause_share = 2;

}  // namespace

ExitCode update_while_growing(PartOptions& part, const FollowOptions& follow, const std::string& output,
                              const std::function<ExitCode(bool last)>& make) {
    std::error_code error;
    const auto status = std::filesystem::status(output, error);
    if (output == "-" || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)))
        throw UsageError("--follow rewrites its output: -o needs a file, not " + output);
    if (part.log.empty()) throw UsageError("--follow needs a LOG, not a program alone");
    if (part.program == "-") throw UsageError("--follow rereads the program: it cannot come from standard input");
    LookRules rules{least_seconds, pause_share, std::numeric_limits<PointIndex>::max(), false, false};
    std::string said;
    io::Source complete;
    (void)follow_log(
        part, follow, rules,
        [&](io::GrowingLog& log) {
            part.log_source = log.whole_records();
            try {
                (void)make(false);
            } catch (const InputError& too_early) {
                if (std::exchange(said, too_early.what()) != too_early.what())
                    write_message(part.log + ": note: nothing is shown yet: " + too_early.diagnostic().text + "\n");
            }
        },
        complete);
    part.log_source = std::move(complete);
    return make(true);
}

}  // namespace clsurf::cli

#pragma once
// --tradeoff and --weight: the file of a Pareto front, and the choice from it.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "cli/pictures/picture_output.h"
#include "cli/subcommand.h"
#include "core/diagnostic.h"
#include "io/files/atomic_file.h"
#include "tradeoff/front.h"
#include "tradeoff/plan_settings.h"

namespace clsurf::cli {

/// --tradeoff, --weight. `of`: the subject of the front, and the effect of --weight.
void declare_front(po::options_description& options, const char* of, const char* choice);
/// Whether --tradeoff or --weight is given.
[[nodiscard]] bool trades_off(const po::variables_map& values);
/// --weight. Throws UsageError: not 0 to 1.
[[nodiscard]] std::optional<double> read_weight(const po::variables_map& values);

/// The file of --tradeoff, a picture or a table; without the option nothing is written. It is opened early, so that a name
/// that cannot be written fails before the work.
class FrontOutput {
public:
    /// Throws UsageError, SystemError.
    explicit FrontOutput(const po::variables_map& values);
    /// `settings`: one per row, or none. `title`: "Time against surface: part.nc". Throws SystemError.
    void write(const TradeoffFront& front, std::span<const PlanSettings> settings, const std::string& title,
               const Diagnostics& diagnostics);

private:
    std::string format_;
    std::unique_ptr<io::AtomicFile> table_;
    std::unique_ptr<PictureOutput> picture_;
};

}  // namespace clsurf::cli

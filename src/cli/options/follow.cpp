#include "cli/options/follow.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "cli/stop_signal.h"

namespace clsurf::cli {
namespace {

constexpr double seconds_between_reads = 0.02;
constexpr PointIndex most_read = 50'000;  ///< records per read

/// Seconds since an arbitrary time.
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void wait_for_file(const std::string& path, double timeout) {
    const double since = now();
    std::error_code error;
    while (path != "-" && !std::filesystem::exists(path, error) && !stop_asked()) {
        if (timeout > 0 && now() - since >= timeout) return;  // opening it reports the error
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds_between_reads));
    }
}

/// Decides when to process new records of a log.
class LookClock {
public:
    explicit LookClock(const LookRules& rules) : rules_(rules) {}

    /// Whether new records of `log` are due.
    [[nodiscard]] bool due(const io::GrowingLog& log) const {
        return has_new(log) && (now() >= next_ || log.end() - seen_ >= rules_.most_unseen);
    }
    [[nodiscard]] bool has_new(const io::GrowingLog& log) const { return log.known() && log.end() > seen_; }

    void look(io::GrowingLog& log, const std::function<void(io::GrowingLog&)>& body) {
        const double begin = now();
        seen_ = log.end();
        body(log);
        const double end = now();
        next_ = end + std::max(rules_.least_pause, rules_.pause_share * (end - begin));
    }

private:
    const LookRules& rules_;
    PointIndex seen_ = 0;
    double next_ = 0;
};

}  // namespace

void declare_follow(po::options_description& options, const char* meaning) {
    // clang-format off
    options.add_options()
        ("follow", meaning)
        ("follow-timeout", po::value<double>()->value_name("S")->default_value(30, "30"), "seconds without growth that end --follow; 0: only the end of the log or Ctrl-C does");
    // clang-format on
}

std::optional<FollowOptions> read_follow(const po::variables_map& values) {
    if (values.count("follow") == 0) {
        if (given(values, "follow-timeout")) throw UsageError("--follow-timeout needs --follow");
        return std::nullopt;
    }
    FollowOptions options{values["follow-timeout"].as<double>()};
    if (!(options.timeout >= 0)) throw UsageError("--follow-timeout must not be negative");
    return options;
}

io::FollowEnd follow_log(const PartOptions& options, const FollowOptions& follow, const LookRules& rules,
                         const std::function<void(io::GrowingLog&)>& look, io::Source& bytes) {
    catch_stop_signals();
    wait_for_file(options.log, follow.timeout);
    io::GrowingLog log(options.log, options.log_options);
    LookClock clock(rules);
    double grown = now();
    std::optional<io::FollowEnd> end;
    while (!end) {
        const std::size_t got = log.read(most_read);
        if (got > 0) grown = now();
        if (clock.due(log)) clock.look(log, look);
        if (!rules.keeps_records) log.forget(log.end());
        if (stop_asked()) {
            end = io::FollowEnd::interrupted;
        } else if (got == 0 && log.ended()) {
            end = io::FollowEnd::closed;
        } else if (got == 0 && follow.timeout > 0 && now() - grown >= follow.timeout) {
            end = io::FollowEnd::timeout;
        } else if (got == 0) {
            log.wait(seconds_between_reads);
        }
    }
    if (rules.at_end && clock.has_new(log)) clock.look(log, look);
    bytes = log.whole();
    return *end;
}

}  // namespace clsurf::cli

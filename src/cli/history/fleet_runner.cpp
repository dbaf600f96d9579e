#include "cli/history/fleet_runner.h"

#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>

#include "cli/child_process.h"
#include "cli/command_line.h"
#include "cli/programs/controller_command.h"
#include "cli/runs/run_recorder.h"
#include "core/parallel.h"
#include "core/version.h"
#include "history/memory_plan.h"
#include "io/files/utc.h"
#include "io/formats/run_parameters.h"

namespace clsurf::cli {
namespace {

using FleetClock = std::chrono::steady_clock;

bool is_packed(const std::string& name) {
    return name.ends_with(".xz") || name.ends_with(".gz") || name.ends_with(".zst");
}

/// The first error that a unit printed, otherwise its last line.
std::string message_in(const std::filesystem::path& output) {
    std::ifstream file(output);
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (line.find("error: ") != std::string::npos || line.find("out of memory") != std::string::npos) return line;
        if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    }
    return last;
}

std::string time_text(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

/// A running process of the fleet.
struct Child {
    PlannedRun plan;
    std::filesystem::path output;
};

class FleetRunner {
public:
    FleetRunner(const std::vector<FleetUnit>& units, const FleetRules& rules, const CommonOptions& common)
        : units_(units),
          rules_(rules),
          history_(rules.database),
          plan_(rules.jobs, rules.memory),
          bar_(common),
          progress_(bar_.callback()) {
        const int threads =
            common.threads > 0 ? common.threads : std::max(1, thread_count() / static_cast<int>(rules.jobs));
        common_words_ = {"--threads", fmt::format("{}", threads), "--progress", "never", "-q"};
    }

    FleetResult run() {
        for (std::size_t i = 0; i < units_.size(); ++i) consider(i);
        result_.runs = units_.size() - result_.repeated;
        show();
        while (!plan_.done()) {
            while (const std::optional<PlannedRun> next = plan_.start()) begin(*next);
            wait_for_one();
            show();
        }
        bar_.clear();
        std::ranges::sort(result_.failed, {}, &FailedUnit::unit);
        return std::move(result_);
    }

private:
    /// Plans a unit, unless the history has it or an earlier unit is the same.
    void consider(std::size_t i) {
        const FleetUnit& unit = units_[i];
        try {
            RunRecord run = record_of_unit(unit);
            if (!identities_.insert(identity_text(run)).second) {
                ++result_.repeated;
                return;
            }
            if (unit.program.empty()) return fail(i, "no program was found for this log");
            // Only a log that is already recorded is opened for its parameters.
            if (history_.has_log(run.log_sha256)) add_log_parameters(run, unit);
            const std::optional<RunRecord> known = history_.find_same(run);
            if (known && known->settings == settings_of(values_of(unit)) && (!known->failed() || !rules_.retry_failed))
                return skip(i, *known);
        } catch (const UsageError& error) {  // the options of this unit are wrong
            return fail(i, error.what());
        }
        all_bytes_ += unit.bytes;
        plan_.add(i, expected_memory(unit.bytes, is_packed(unit.log)));
    }

    /// Counts a run as recorded.
    void skip(std::size_t i, const RunRecord& known) {
        ++result_.skipped;
        if (known.failed())
            result_.failed.push_back({i, known.failure});
        else if (!known.judged)
            ++result_.not_judged;
        else
            ++result_.judged;
        if (known.judged && !known.within_budget) ++result_.over_budget;
    }

    po::variables_map values_of(const FleetUnit& unit) const {
        return parse_words(find_subcommand("history"), words_of_unit(unit, rules_.database));
    }

    /// The record of a unit without its verdict, without opening its log.
    RunRecord record_of_unit(const FleetUnit& unit) const {
        RunRecord run;
        run.program = unit.program;
        run.log = unit.log;
        run.program_sha256 = hash_of(unit.program);
        run.log_sha256 = hash_of(unit.log);
        run.version = version;
        const po::variables_map values = values_of(unit);
        run.settings = settings_of(values);
        const RunRecorder recorder(rules_.database, values);
        run.parameters = recorder.parameters();
        run.time = !recorder.time().empty() ? recorder.time()
                   : unit.bytes > 0         ? io::utc_of_file(unit.log)
                                            : io::utc_now();
        return run;
    }

    /// Adds the parameters of the log, as they are recorded with the run.
    void add_log_parameters(RunRecord& run, const FleetUnit& unit) const {
        if (run.log_sha256.empty()) return;
        const po::variables_map values = values_of(unit);
        const RunRecorder recorder(rules_.database, values);
        try {
            run.parameters = recorder.parameters_with(io::parameters_of_log(unit.log, read_log_options(values)));
        } catch (const InputError&) {  // unreadable: the run itself will fail, with --param only
        } catch (const UsageError&) {  // parameters that are not allowed: the run itself will fail
        }
    }

    /// A failure is also recorded as a row.
    void fail(std::size_t i, const std::string& cause) {
        const FleetUnit& unit = units_[i];
        RunRecord run;
        try {
            run = record_of_unit(unit);
            add_log_parameters(run, unit);
        } catch (const UsageError&) {  // its parameters are the cause
            run = RunRecord{};
            run.program = unit.program;
            run.log = unit.log;
            run.program_sha256 = hash_of(unit.program);
            run.log_sha256 = hash_of(unit.log);
            run.time = unit.bytes > 0 ? io::utc_of_file(unit.log) : io::utc_now();
            run.version = version;
        }
        run.failure = cause;
        history_.add(run);
        result_.failed.push_back({i, cause});
    }

    void begin(const PlannedRun& run) {
        std::vector<std::string> words{"clsurf", "history"};
        words.insert(words.end(), common_words_.begin(), common_words_.end());
        const std::vector<std::string> own = words_of_unit(units_[run.number], rules_.database);
        words.insert(words.end(), own.begin(), own.end());
        const std::filesystem::path output = folder_.path() / fmt::format("{}", run.number);
        const std::uint64_t memory = rules_.memory > 0 ? run.reserve : 0;
        const pid_t child = start_child({"/proc/self/exe", std::move(words), output.string(), memory}, "a process");
        children_[child] = {run, output};
    }

    void wait_for_one() {
        int status = 0;
        const pid_t child = ::waitpid(-1, &status, 0);
        const auto at = children_.find(child);
        if (at == children_.end()) throw SystemError(std::string("cannot wait for a process: ") + std::strerror(errno));
        const Child ended = at->second;
        children_.erase(at);
        const std::string message = message_in(ended.output);
        std::error_code none;
        std::filesystem::remove(ended.output, none);
        const bool by_signal = WIFSIGNALED(status);
        const int code = by_signal ? -1 : WEXITSTATUS(status);
        const bool too_little = by_signal || message.find("out of memory") != std::string::npos;
        if (plan_.finish(ended.plan, code != 0 && too_little)) return;
        done_bytes_ += units_[ended.plan.number].bytes;
        switch (code) {
            case static_cast<int>(ExitCode::done): ++result_.judged; break;
            case static_cast<int>(ExitCode::check_failed): ++result_.judged, ++result_.over_budget; break;
            case static_cast<int>(ExitCode::not_judged): ++result_.not_judged; break;
            default: fail(ended.plan.number, cause_of(by_signal, status, message));
        }
    }

    [[nodiscard]] std::string cause_of(bool by_signal, int status, const std::string& message) const {
        if (by_signal) return fmt::format("ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
        if (message.find("out of memory") != std::string::npos && rules_.memory > 0)
            return fmt::format("needs more memory than the {:.1f} GiB of --memory",
                               static_cast<double>(rules_.memory) / (1 << 30));
        return message.empty() ? fmt::format("exit code {}", WEXITSTATUS(status)) : message;
    }

    void show() {
        if (!progress_) return;
        const std::size_t ended = result_.judged + result_.not_judged + result_.failed.size();
        const double share = all_bytes_ > 0 ? static_cast<double>(done_bytes_) / static_cast<double>(all_bytes_) : 1;
        const double took = std::chrono::duration<double>(FleetClock::now() - began_).count();
        std::string words = fmt::format("{} of {} runs", ended, result_.runs);
        if (!result_.failed.empty()) words += fmt::format(", {} failed", result_.failed.size());
        if (share > 0 && share < 1) words += fmt::format(", about {} left", time_text(took * (1 - share) / share));
        progress_(words, share);
    }

    const std::vector<FleetUnit>& units_;
    const FleetRules& rules_;
    io::HistoryWriter history_;
    MemoryPlan plan_;
    ProgressBar bar_;
    Progress progress_;
    RunFolder folder_;
    std::vector<std::string> common_words_;
    std::map<pid_t, Child> children_;
    std::uint64_t all_bytes_ = 0, done_bytes_ = 0;  ///< sizes of the planned logs
    FleetClock::time_point began_ = FleetClock::now();
    std::set<std::string> identities_;  ///< identities of the units considered so far
    FleetResult result_;
};

}  // namespace

FleetResult run_fleet(const std::vector<FleetUnit>& units, const FleetRules& rules, const CommonOptions& common) {
    return FleetRunner(units, rules, common).run();
}

}  // namespace clsurf::cli

#pragma once
// HistoryDatabase: the runs of a shop in one SQLite file. Several programs may read and write it at the same time. Each
// run is added completely or not at all, even if the program is killed.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "history/history_quantity.h"
#include "history/parameter_rules.h"
#include "history/run_record.h"

namespace clsurf::io {

class SqliteConnection;

/// Selects the runs to read. Empty: all.
struct RunFilter {
    std::optional<std::int64_t> id = {};
    std::string program = {};  ///< its name, with or without folders
    std::string log_sha256 = {};
    std::vector<RunParameter> parameters = {};  ///< all of them must match
    std::string since = {};                     ///< UTC; runs from this time on
    bool failed = false;                        ///< only runs that could not be judged
    std::size_t last = 0;                       ///< number of latest runs to read; 0: all
};

struct AddedRun {
    std::int64_t id = 0;
    bool replaced = false;  ///< the same run existed already
};

/// The number of defects of one cause in a run.
struct CauseCount {
    std::int64_t run = 0;
    std::string cause;
    std::int64_t defects = 0;
    double area_mm2 = 0;
};

/// Reads a history. Throws InputError: missing, not a history, written by a newer version; SystemError.
class HistoryDatabase {
public:
    explicit HistoryDatabase(const std::string& path);
    HistoryDatabase(HistoryDatabase&&) noexcept;
    ~HistoryDatabase();

    [[nodiscard]] const std::string& path() const;
    /// The runs in order of time, without defects. O(runs).
    [[nodiscard]] std::vector<RunRecord> runs(const RunFilter& filter = {}) const;
    /// The run with the same identity, without defects and parameters; nothing: there is none.
    [[nodiscard]] std::optional<RunRecord> find_same(const RunRecord& run) const;
    /// Whether a judged run exists that replaces the failed one (supersedes()); false for a run that did not fail.
    [[nodiscard]] bool has_verdict(const RunRecord& failed) const;
    /// Whether there is a run of a log with this content.
    [[nodiscard]] bool has_log(const std::string& log_sha256) const;
    /// Adds the matching defects to each of the runs. O(defects).
    void read_defects(std::vector<RunRecord>& runs, const DefectFilter& filter = {}) const;
    /// The counts of all runs, in the order of their ids.
    [[nodiscard]] std::vector<CauseCount> causes() const;
    [[nodiscard]] ParameterRules parameter_rules() const;

protected:
    explicit HistoryDatabase(std::unique_ptr<SqliteConnection> connection);
    [[nodiscard]] const SqliteConnection& connection() const { return *connection_; }

private:
    std::unique_ptr<SqliteConnection> connection_;
};

/// Reads and writes. A missing file is created, older tables are upgraded.
class HistoryWriter : public HistoryDatabase {
public:
    explicit HistoryWriter(const std::string& path);

    /// Adds a run with its defects in one transaction. A run with the same identity is replaced and keeps its id; failed
    /// runs that the new one supersedes() are also replaced. Sets `recorded`. O(defects + runs).
    AddedRun add(const RunRecord& run);
    /// Adds the runs of other histories that are missing here, in order of time, as recorded. If both have a run,
    /// the judged one is kept, and of two judged ones the later. Parameter rules are copied if there are
    /// none. One transaction. Returns the number of runs added or replaced. Throws InputError: rules that differ. O(defects).
    std::size_t merge(std::span<const HistoryDatabase> others);
    /// Replaces the rules; existing rows are not changed.
    void set_parameter_rules(const ParameterRules& rules);

private:
    /// Adds or replaces a run unchanged, in the transaction of the caller. `failed`: the failed runs in this history,
    /// updated.
    AddedRun put(const RunRecord& run, std::vector<RunRecord>& failed);
};

/// The rules shared by all these histories that have any and by the target of the merge (nullptr: a new one). Throws
/// InputError: two of them differ.
[[nodiscard]] ParameterRules common_rules(const HistoryDatabase* into, std::span<const HistoryDatabase> histories);

}  // namespace clsurf::io

#pragma once
// HistoryDatabase: the runs of a shop in one SQLite file. Several programs may read and write it at the same time; each
// run is added whole or not at all, whatever ends the program.

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

/// Which runs are read. Empty: all.
struct RunFilter {
    std::optional<std::int64_t> id = {};
    std::string program = {};  ///< its name, with folders or without
    std::string log_sha256 = {};
    std::vector<RunParameter> parameters = {};  ///< each of them
    std::string since = {};                     ///< UTC; not before that
    bool failed = false;                        ///< only those that could not be judged
    std::size_t last = 0;                       ///< that many at most, the latest ones; 0: all
};

struct AddedRun {
    std::int64_t id = 0;
    bool replaced = false;  ///< the same run was there already
};

/// How many defects of one cause a run has.
struct CauseCount {
    std::int64_t run = 0;
    std::string cause;
    std::int64_t defects = 0;
    double area_mm2 = 0;
};

/// Reads. Throws InputError: missing, no history, of a newer version; SystemError.
class HistoryDatabase {
public:
    explicit HistoryDatabase(const std::string& path);
    HistoryDatabase(HistoryDatabase&&) noexcept;
    ~HistoryDatabase();

    [[nodiscard]] const std::string& path() const;
    /// In the order of their times, without defects. O(runs).
    [[nodiscard]] std::vector<RunRecord> runs(const RunFilter& filter = {}) const;
    /// The run of the same identity, without defects and parameters; nothing: there is none.
    [[nodiscard]] std::optional<RunRecord> find_same(const RunRecord& run) const;
    /// A run that was judged has what a failed one could not judge (supersedes()); false for one that did not fail.
    [[nodiscard]] bool has_verdict(const RunRecord& failed) const;
    /// A run of a log with this content is there.
    [[nodiscard]] bool has_log(const std::string& log_sha256) const;
    /// Adds the defects that match to each of the runs. O(defects).
    void read_defects(std::vector<RunRecord>& runs, const DefectFilter& filter = {}) const;
    /// Of all runs, in the order of their ids.
    [[nodiscard]] std::vector<CauseCount> causes() const;
    [[nodiscard]] ParameterRules parameter_rules() const;

protected:
    explicit HistoryDatabase(std::unique_ptr<SqliteConnection> connection);
    [[nodiscard]] const SqliteConnection& connection() const { return *connection_; }

private:
    std::unique_ptr<SqliteConnection> connection_;
};

/// Reads and writes. The file is made where it is missing, older tables are brought up to date.
class HistoryWriter : public HistoryDatabase {
public:
    explicit HistoryWriter(const std::string& path);

    /// Adds a run with its defects in one transaction; a run of the same identity is replaced and keeps its id, and so are
    /// failed ones that it supersedes(). Sets `recorded`. O(defects + runs).
    AddedRun add(const RunRecord& run);
    /// Adds the runs of other histories that are not here yet, in the order of their times, as they were recorded; where both
    /// have a run, the one that was judged counts, and of two the later one. Rules of parameters are taken where there are
    /// none. All in one transaction. Returns how many were added or replaced. Throws InputError: rules that differ. O(defects).
    std::size_t merge(std::span<const HistoryDatabase> others);
    /// Replaces the rules; rows that are there already stay as they are.
    void set_parameter_rules(const ParameterRules& rules);

private:
    /// Adds or replaces a run as it is, in the transaction of the caller. `failed`: the runs here that failed, kept up to date.
    AddedRun put(const RunRecord& run, std::vector<RunRecord>& failed);
};

/// The rules of all these histories that have any, and of the one that they are merged into (nullptr: a new one). Throws
/// InputError: two of them differ.
[[nodiscard]] ParameterRules common_rules(const HistoryDatabase* into, std::span<const HistoryDatabase> histories);

}  // namespace clsurf::io

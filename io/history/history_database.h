#pragma once
// HistoryDatabase: the runs of a shop in one SQLite file. Several programs may read and write it at the same time; each
// run is added whole or not at all, whatever ends the program.

#include <memory>
#include <optional>
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
    std::string program = {};                   ///< its name, with folders or without
    std::vector<RunParameter> parameters = {};  ///< each of them
    std::string since = {};                     ///< UTC; not before that
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

    /// Adds a run with its defects in one transaction; a run of the same identity is replaced and keeps its id. Sets
    /// `recorded`. O(defects).
    AddedRun add(const RunRecord& run);
    /// Adds the runs of another history that are not here yet, in the order of their times; where both have a run, the
    /// one that was judged counts, and of two the later one. Returns how many were added or replaced. O(defects).
    std::size_t merge(const HistoryDatabase& other);
    /// Replaces the rules; rows that are there already stay as they are.
    void set_parameter_rules(const ParameterRules& rules);
};

}  // namespace clsurf::io

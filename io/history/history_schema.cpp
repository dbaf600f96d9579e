#include "io/history/history_schema.h"

#include <array>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf::io {
namespace {

// NULL: not known. Times are UTC as ISO 8601, whose text order is the order of time.
constexpr const char* version_1 = R"(
CREATE TABLE runs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  identity TEXT NOT NULL UNIQUE,
  time TEXT NOT NULL, recorded TEXT NOT NULL,
  program TEXT NOT NULL, program_sha256 TEXT NOT NULL, log TEXT NOT NULL, log_sha256 TEXT NOT NULL,
  machine TEXT NOT NULL, tool TEXT NOT NULL, version TEXT NOT NULL,
  duration_s REAL, points INTEGER NOT NULL, passes INTEGER NOT NULL,
  judged INTEGER NOT NULL, not_judged_reasons TEXT NOT NULL, within_budget INTEGER NOT NULL, coverage_percent REAL,
  speed_p50_percent REAL, speed_p99_percent REAL,
  acceleration_p50_mm_s2 REAL, acceleration_p99_mm_s2 REAL, lag_p50_um REAL, lag_p99_um REAL,
  defects INTEGER NOT NULL, worst_severity INTEGER NOT NULL, worst_score REAL NOT NULL, deepest_um REAL NOT NULL,
  area_mm2 REAL NOT NULL, ra_um REAL, rz_um REAL);
CREATE INDEX runs_by_time ON runs (time, id);
CREATE TABLE parameters (
  run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE,
  name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (run, name)) WITHOUT ROWID;
CREATE TABLE defects (
  run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE, rank INTEGER NOT NULL,
  cause TEXT NOT NULL, quantity TEXT NOT NULL, severity INTEGER NOT NULL, score REAL NOT NULL,
  depth_um REAL NOT NULL, pit INTEGER NOT NULL, systematic INTEGER NOT NULL, speed_jump_percent REAL,
  length_mm REAL, area_mm2 REAL,
  tip_x REAL, tip_y REAL, tip_z REAL, x REAL, y REAL, z REAL, PRIMARY KEY (run, rank)) WITHOUT ROWID;
CREATE TABLE sections (
  run INTEGER NOT NULL, rank INTEGER NOT NULL, number INTEGER NOT NULL,
  pass INTEGER NOT NULL, first_line INTEGER NOT NULL, last_line INTEGER NOT NULL,
  PRIMARY KEY (run, rank, number),
  FOREIGN KEY (run, rank) REFERENCES defects ON DELETE CASCADE) WITHOUT ROWID;
CREATE INDEX sections_by_pass ON sections (pass, run, rank);
CREATE TABLE parameter_rules (
  name TEXT PRIMARY KEY, kind TEXT NOT NULL, unit TEXT NOT NULL, low REAL, high REAL, required INTEGER NOT NULL);
CREATE TABLE parameter_values (
  name TEXT NOT NULL REFERENCES parameter_rules ON DELETE CASCADE, number INTEGER NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY (name, number)) WITHOUT ROWID;
)";

constexpr const char* version_2 = R"(
ALTER TABLE runs ADD COLUMN settings TEXT NOT NULL DEFAULT '';
ALTER TABLE runs ADD COLUMN failure TEXT NOT NULL DEFAULT '';
)";

/// Step k upgrades version k to k + 1; version 0 has no tables.
constexpr std::array history_steps{version_1, version_2};

/// The version of the tables; 0: there are none yet.
int version_of(const SqliteConnection& connection) {
    // One statement, for a consistent state: between two statements another writer may create the tables.
    SqliteStatement state(connection,
                          "SELECT user_version, application_id, (SELECT count(*) FROM sqlite_master) "
                          "FROM pragma_user_version, pragma_application_id");
    static_cast<void>(state.step());
    const std::int64_t version = state.integer(0);
    const std::int64_t application = state.integer(1);
    const bool empty = state.integer(2) == 0;
    if (empty && version == 0 && application == 0) return 0;
    if (application != history_application)
        throw InputError(Place::of_file(connection.path()),
                         "is an SQLite database of another program, not a history of clsurf");
    if (version > history_version())
        throw InputError(
            Place::of_file(connection.path()),
            fmt::format("is a history of version {}; this clsurf reads versions up to {}", version, history_version()),
            "use a newer clsurf");
    return static_cast<int>(version);
}

void take_steps(const SqliteConnection& connection) {
    SqliteTransaction transaction(connection);
    // The version is read again: another writer may have upgraded the tables.
    for (int version = version_of(connection); version < history_version(); ++version)
        connection.execute(history_steps[static_cast<std::size_t>(version)]);
    connection.execute(
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", history_application, history_version()));
    transaction.commit();
}

}  // namespace

int history_version() { return static_cast<int>(history_steps.size()); }

void prepare_history(const SqliteConnection& connection) {
    const int version = version_of(connection);
    SqliteStatement mode(connection, "PRAGMA journal_mode = WAL");
    static_cast<void>(mode.step());
    mode.reset();
    connection.execute("PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON");
    if (version < history_version()) take_steps(connection);
}

SqliteConnection readable_history(const std::string& path) {
    SqliteConnection file(path, DatabaseAccess::read);
    if (version_of(file) == history_version()) return file;
    SqliteConnection copy = file.copy_in_memory();
    take_steps(copy);
    return copy;
}

}  // namespace clsurf::io

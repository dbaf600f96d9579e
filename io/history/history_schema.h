#pragma once
// The tables of a history, and the upgrade of older versions. Used inside io/history only.
//
// `PRAGMA application_id` distinguishes a history from other SQLite databases, `PRAGMA user_version` is its version. A
// released version is never changed: a new one adds a step to `history_steps`.

#include "io/history/sqlite.h"

namespace clsurf::io {

constexpr std::int64_t history_application = 0x636C7368;  ///< "clsh"

/// The version that this program writes.
[[nodiscard]] int history_version();

/// Creates the tables of an empty database, or upgrades older ones, in one transaction; enables the write-ahead log.
/// Throws InputError: another program's database, or a newer version.
void prepare_history(const SqliteConnection& connection);

/// The database for readers: the database itself or, if it has an older version, an upgraded copy in memory.
/// Throws InputError as prepare_history() does.
[[nodiscard]] SqliteConnection readable_history(const std::string& path);

}  // namespace clsurf::io

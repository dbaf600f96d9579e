#pragma once
// The tables of a history, and how those of older versions become the ones of today. Used inside io/history only.
//
// `PRAGMA application_id` tells a history from other SQLite databases, `PRAGMA user_version` its version. A version is
// never changed once it is released: a new one adds a step to `history_steps`.

#include "io/history/sqlite.h"

namespace clsurf::io {

constexpr std::int64_t history_application = 0x636C7368;  ///< "clsh"

/// The version that this clsurf writes.
[[nodiscard]] int history_version();

/// Makes the tables of an empty database, or brings older ones up to date, in one transaction; sets the write-ahead log.
/// Throws InputError: another program's database, or a newer version.
void prepare_history(const SqliteConnection& connection);

/// What readers read: the database itself, or, where it is of an older version, a copy of it in memory that was brought up
/// to date. Throws InputError as prepare_history() does.
[[nodiscard]] SqliteConnection readable_history(const std::string& path);

}  // namespace clsurf::io

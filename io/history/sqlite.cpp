#include "io/history/sqlite.h"

#include <sqlite3.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf::io {
namespace {

constexpr int patience_ms = 60'000;  // wait for another writer: a row takes milliseconds

/// A URI that lets SQLite read a database on a read-only medium.
std::string immutable_uri(const std::string& path) {
    std::string uri = "file:";
    for (const char c : path)
        uri += c == '?' || c == '#' || c == '%' ? fmt::format("%{:02X}", static_cast<unsigned char>(c))
                                                : std::string(1, c);
    return uri + "?immutable=1";
}

/// Retries a call while the database is busy. SQLite does not wait when it creates the write-ahead log, nor while the log is
/// recovered after another writer was killed.
template <typename Call>
int patiently(const Call& call) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience_ms);
    for (;;) {
        const int code = call();
        if ((code & 0xff) != SQLITE_BUSY || std::chrono::steady_clock::now() >= end) return code;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void require_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        throw InputError(Place::of_file(path), std::string("cannot open: ") + std::strerror(errno));
    if (S_ISDIR(status.st_mode)) throw InputError(Place::of_file(path), "is a folder, expected a history");
}

}  // namespace

void SqliteConnection::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }
void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

SqliteConnection::SqliteConnection(const std::string& path, DatabaseAccess access) : path_(path) {
    const bool writes = access == DatabaseAccess::write;
    struct stat status {};
    if (!writes || ::stat(path.c_str(), &status) == 0) require_file(path);
    const auto open = [&](const std::string& name, int flags) {
        sqlite3* handle = nullptr;
        const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
        handle_.reset(handle);
        sqlite3_extended_result_codes(handle, 1);
        sqlite3_busy_timeout(handle, patience_ms);
        // SQLite reads the file only now.
        return code != SQLITE_OK ? code : patiently([&] {
            return sqlite3_exec(handle, "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr);
        });
    };
    int code = open(path, writes ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE);
    // Readers of a database with a write-ahead log create files next to it if they may.
    if (!writes && (code & 0xff) != SQLITE_OK && (code & 0xff) != SQLITE_NOTADB && (code & 0xff) != SQLITE_BUSY)
        code = open(immutable_uri(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    if (code != SQLITE_OK) fail(code);
}

SqliteConnection::SqliteConnection(std::string path) : path_(std::move(path)) {}

SqliteConnection SqliteConnection::copy_in_memory() const {
    SqliteConnection copy(path_);
    sqlite3* handle = nullptr;
    const int code = sqlite3_open(":memory:", &handle);
    copy.handle_.reset(handle);
    if (code != SQLITE_OK) copy.fail(code);
    sqlite3_backup* backup = sqlite3_backup_init(handle, "main", get(), "main");
    if (backup == nullptr) copy.fail(sqlite3_errcode(handle));
    sqlite3_backup_step(backup, -1);
    const int finished = sqlite3_backup_finish(backup);
    if (finished != SQLITE_OK) copy.fail(finished);
    return copy;
}

void SqliteConnection::fail(int code) const {
    const int kind = code & 0xff;
    const std::string message = handle_ != nullptr ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code);
    if (kind == SQLITE_NOTADB)
        throw InputError(Place::of_file(path_), "is not a history of clsurf: not an SQLite database");
    if (kind == SQLITE_CORRUPT) throw InputError(Place::of_file(path_), "is damaged: " + message);
    if (kind == SQLITE_BUSY || kind == SQLITE_LOCKED)
        throw SystemError(
            fmt::format("{}: another program has been writing to it for {} s", path_, patience_ms / 1000));
    throw SystemError(fmt::format("{}: {}", path_, message));
}

void SqliteConnection::execute(const std::string& sql) const {
    const int code = patiently([&] { return sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr); });
    if (code != SQLITE_OK) fail(code);
}

std::int64_t SqliteConnection::last_row() const { return sqlite3_last_insert_rowid(handle_.get()); }

SqliteStatement::SqliteStatement(const SqliteConnection& connection, std::string_view sql) : connection_(connection) {
    sqlite3_stmt* statement = nullptr;
    // Preparing reads the schema, so it also has to wait.
    const int code = patiently([&] {
        return sqlite3_prepare_v2(connection.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
    });
    statement_.reset(statement);
    if (code != SQLITE_OK) connection.fail(code);
}

SqliteStatement& SqliteStatement::bind(double value) {
    ++bound_;
    const int code = std::isnan(value) ? sqlite3_bind_null(statement_.get(), bound_)
                                       : sqlite3_bind_double(statement_.get(), bound_, value);
    if (code != SQLITE_OK) connection_.fail(code);
    return *this;
}

SqliteStatement& SqliteStatement::bind(std::int64_t value) {
    const int code = sqlite3_bind_int64(statement_.get(), ++bound_, value);
    if (code != SQLITE_OK) connection_.fail(code);
    return *this;
}

SqliteStatement& SqliteStatement::bind(const std::string& value) {
    const int code =
        sqlite3_bind_text(statement_.get(), ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    if (code != SQLITE_OK) connection_.fail(code);
    return *this;
}

bool SqliteStatement::step() {
    const int code = patiently([&] { return sqlite3_step(statement_.get()); });
    if (code != SQLITE_ROW && code != SQLITE_DONE) connection_.fail(code);
    return code == SQLITE_ROW;
}

void SqliteStatement::run() {
    while (step()) {}
    reset();
}

void SqliteStatement::reset() {
    sqlite3_reset(statement_.get());
    bound_ = 0;
}

std::int64_t SqliteStatement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

double SqliteStatement::number(int column) const {
    if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
    return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    if (bytes == nullptr) return {};
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

SqliteTransaction::SqliteTransaction(const SqliteConnection& connection) : connection_(connection) {
    connection.execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
    // If this also fails, the database rolls back when it is opened next.
    if (open_) sqlite3_exec(connection_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void SqliteTransaction::commit() {
    connection_.execute("COMMIT");
    open_ = false;
}

}  // namespace clsurf::io

#pragma once
// RAII wrappers of SQLite: a connection, and statements that throw the project's errors. Used inside io/history only.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace clsurf::io {

enum class DatabaseAccess : std::uint8_t { read, write };

class SqliteConnection {
public:
    /// Opens a file. `write`: a missing file is created. Throws InputError (missing, not a database), SystemError.
    SqliteConnection(const std::string& path, DatabaseAccess access);
    SqliteConnection(const SqliteConnection&) = delete;
    SqliteConnection& operator=(const SqliteConnection&) = delete;
    SqliteConnection(SqliteConnection&& other) noexcept = default;
    SqliteConnection& operator=(SqliteConnection&& other) noexcept = default;

    /// A copy in memory; changes to it do not change the file.
    [[nodiscard]] SqliteConnection copy_in_memory() const;
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] sqlite3* get() const { return handle_.get(); }
    /// Runs one or more statements without parameters.
    void execute(const std::string& sql) const;
    [[nodiscard]] std::int64_t last_row() const;

    /// Throws the error for an SQLite code: InputError if the file is not a database, otherwise SystemError.
    [[noreturn]] void fail(int code) const;

private:
    explicit SqliteConnection(std::string path);
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::string path_;
    std::unique_ptr<sqlite3, Close> handle_;
};

/// A statement that may be run several times.
class SqliteStatement {
public:
    SqliteStatement(const SqliteConnection& connection, std::string_view sql);

    /// Binds the next parameter; NaN becomes NULL.
    SqliteStatement& bind(double value);
    SqliteStatement& bind(std::int64_t value);
    SqliteStatement& bind(const std::string& value);
    /// Advances to the next row; false: there is none.
    [[nodiscard]] bool step();
    /// Runs the statement to its end and resets it for new values.
    void run();
    void reset();

    // Values of the row, columns from 0.
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double number(int column) const;  ///< NULL: NaN
    [[nodiscard]] std::string text(int column) const;

private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    const SqliteConnection& connection_;
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    int bound_ = 0;
};

/// Locks out other writers from its beginning; rolled back if commit() was not reached.
class SqliteTransaction {
public:
    explicit SqliteTransaction(const SqliteConnection& connection);
    SqliteTransaction(const SqliteTransaction&) = delete;
    SqliteTransaction& operator=(const SqliteTransaction&) = delete;
    ~SqliteTransaction();
    void commit();

private:
    const SqliteConnection& connection_;
    bool open_ = true;
};

}  // namespace clsurf::io

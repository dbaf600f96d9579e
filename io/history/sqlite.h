#pragma once
// SQLite as values: a connection, and statements whose errors are ours. Used inside io/history only.

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
    /// Opens a file. `write`: it is made where it is missing. Throws InputError (missing, no database), SystemError.
    SqliteConnection(const std::string& path, DatabaseAccess access);
    SqliteConnection(const SqliteConnection&) = delete;
    SqliteConnection& operator=(const SqliteConnection&) = delete;
    SqliteConnection(SqliteConnection&& other) noexcept = default;
    SqliteConnection& operator=(SqliteConnection&& other) noexcept = default;

    /// A copy in memory: what is changed in it changes no file.
    [[nodiscard]] SqliteConnection copy_in_memory() const;
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] sqlite3* get() const { return handle_.get(); }
    /// One or more statements without values.
    void execute(const std::string& sql) const;
    [[nodiscard]] std::int64_t last_row() const;

    /// Throws what an error code of SQLite means: InputError where the file is no database, SystemError otherwise.
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

    /// Gives the next parameter its value; NaN is NULL.
    SqliteStatement& bind(double value);
    SqliteStatement& bind(std::int64_t value);
    SqliteStatement& bind(const std::string& value);
    /// The next row is there.
    [[nodiscard]] bool step();
    /// Runs it to its end, and makes it ready for other values.
    void run();
    void reset();

    // Of the row, from the left.
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

/// From its beginning nobody else writes; undone unless commit() was reached.
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

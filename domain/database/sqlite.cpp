#include "domain/database/sqlite.hpp"

#include "domain/errors.hpp"

#include <sqlite3.h>

#include <utility>

namespace rough {

Sqlite::Sqlite(std::filesystem::path file, Access access)
    : file_(std::move(file)), handle_(nullptr, sqlite3_close) {
    // SQLite opens a file that may not be written for reading.
    const int flags = SQLITE_OPEN_READWRITE | (access == Access::create ? SQLITE_OPEN_CREATE : 0);
    if (const std::string name = file_.string();
        name.empty() || name == ":memory:" || name.starts_with("file:"))
        throw InputError((name.empty() ? "database" : name) +
                         ": is not the name of a file; give a database file");
    sqlite3* handle = nullptr;
    const int result = sqlite3_open_v2(file_.c_str(), &handle, flags, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK)
        fail();
    sqlite3_busy_timeout(handle, 120'000); // another builder writes its batch in far less
    // The file may come from a stranger: nothing in its schema is run, and cells larger than this program
    // writes are refused.
    for (const auto& [option, on] : {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
                                     {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                     {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                     {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
        sqlite3_db_config(handle, option, on, nullptr);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, 100'000'000);
}

void Sqlite::fail() const {
    const int code = handle_ ? sqlite3_errcode(handle_.get()) : SQLITE_NOMEM;
    const std::string problem = code == SQLITE_NOTADB ? "is not a genome database"
                                : handle_             ? sqlite3_errmsg(handle_.get())
                                                      : "out of memory";
    throw InputError(file_.string() + ": " + problem + "; give a database file that can be used");
}

void Sqlite::run(const std::string& sql) {
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        fail();
}

std::uint64_t Sqlite::number(const std::string& sql) {
    Statement statement(*this, sql);
    return statement.step() ? statement.number(0) : 0;
}

void Statement::prepare(const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    expect_done(sqlite3_prepare_v2(sqlite_.handle_.get(), sql.c_str(), -1, &statement, nullptr));
    statement_ = {statement, sqlite3_finalize};
}

void Statement::expect_done(int result) {
    if (result != SQLITE_OK)
        sqlite_.fail();
}

void Statement::bind(int parameter, std::uint64_t value) {
    expect_done(sqlite3_bind_int64(statement_.get(), parameter, static_cast<sqlite3_int64>(value)));
}

void Statement::bind(int parameter, std::string_view text) {
    expect_done(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT,
                                    SQLITE_UTF8));
}

void Statement::bind(int parameter, Blob blob) {
    expect_done(sqlite3_bind_blob64(statement_.get(), parameter, blob.bytes.data(), blob.bytes.size(),
                                    SQLITE_TRANSIENT));
}

bool Statement::step() {
    const int result = sqlite3_step(statement_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        sqlite_.fail();
    return result == SQLITE_ROW;
}

std::uint64_t Statement::number(int column) const {
    return static_cast<std::uint64_t>(sqlite3_column_int64(statement_.get(), column));
}

std::string_view Statement::bytes(int column) const {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Transaction::~Transaction() { // after a commit, or if SQLite has rolled back by itself, this does nothing
    sqlite3_exec(sqlite_.handle_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

} // namespace rough

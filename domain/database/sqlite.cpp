#include "domain/database/sqlite.hpp"

#include "domain/errors.hpp"

#include <sqlite3.h>

#include <utility>

namespace rough {

void Sqlite::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }
void Statement::Finalise::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Sqlite::Sqlite(std::filesystem::path file, Access access) : file_(std::move(file)) {
    // A file that may not be written is opened for reading all the same.
    const int flags = SQLITE_OPEN_READWRITE | (access == Access::create ? SQLITE_OPEN_CREATE : 0);
    if (const std::string name = file_.string();
        name.empty() || name == ":memory:" || name.starts_with("file:"))
        throw InputError((name.empty() ? "database" : name) + ": names no file, expected a database file");
    sqlite3* handle = nullptr;
    const int result = sqlite3_open_v2(file_.c_str(), &handle, flags, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK)
        fail();
    sqlite3_busy_timeout(handle, 120'000); // another builder's batch is written in far less
    // The file may be a stranger's: nothing that its schema says is run, and no cell is larger than any of
    // ours.
    for (const auto& [option, on] : {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
                                     {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                     {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                     {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
        sqlite3_db_config(handle, option, on, nullptr);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, 100'000'000);
}

void Sqlite::fail() const {
    const int code = handle_ ? sqlite3_errcode(handle_.get()) : SQLITE_NOMEM;
    std::string what = handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
    if (code == SQLITE_NOTADB)
        what = "is no genome database";
    throw InputError(file_.string() + ": " + what + ", expected a database file that can be used");
}

void Sqlite::run(const std::string& sql) {
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        fail();
}

std::int64_t Sqlite::number(const std::string& sql) {
    Statement statement(*this, sql);
    return statement.step() ? statement.number(0) : 0;
}

Statement::Statement(Sqlite& sqlite, const std::string& sql) : sqlite_(sqlite) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(sqlite.handle_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
        sqlite_.fail();
    statement_.reset(statement);
}

Statement& Statement::expect_done(int result) {
    if (result != SQLITE_OK)
        sqlite_.fail();
    return *this;
}

Statement& Statement::bind(std::int64_t value) {
    return expect_done(sqlite3_bind_int64(statement_.get(), ++bound_, value));
}

Statement& Statement::bind_text(std::string_view value) {
    return expect_done(sqlite3_bind_text64(statement_.get(), ++bound_, value.data(), value.size(),
                                           SQLITE_TRANSIENT, SQLITE_UTF8));
}

Statement& Statement::bind_blob(std::string_view bytes) {
    return expect_done(
        sqlite3_bind_blob64(statement_.get(), ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
}

bool Statement::step() {
    const int result = sqlite3_step(statement_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        sqlite_.fail();
    return result == SQLITE_ROW;
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string_view Statement::bytes(int column) const {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

void Statement::reset() {
    sqlite3_reset(statement_.get());
    bound_ = 0;
}

Transaction::~Transaction() {
    if (!open_)
        return;
    try {
        sqlite_.run("ROLLBACK");
    } catch (const InputError&) {
        // SQLite has rolled back by itself, or will when the file is next opened
    }
}

void Transaction::commit() {
    sqlite_.run("COMMIT");
    open_ = false;
}

} // namespace rough

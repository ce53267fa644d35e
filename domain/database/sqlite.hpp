#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace rough {

/// An open SQLite file that waits for other processes' locks. Its errors are InputErrors that begin with the
/// file.
class Sqlite {
  public:
    /// Opens an existing file; `create` also makes a new one.
    enum class Access { existing, create };
    /// Throws InputError if `file` cannot be opened.
    Sqlite(std::filesystem::path file, Access access);

    void run(const std::string& sql);                           ///< runs statements and ignores their rows
    std::uint64_t number(const std::string& sql);               ///< the first column of the first row, or 0
    const std::filesystem::path& file() const { return file_; } ///< as it was given

  private:
    friend class Statement;
    friend class Transaction;
    [[noreturn]] void fail() const;
    std::filesystem::path file_;
    std::unique_ptr<sqlite3, int (*)(sqlite3*)> handle_;
};

/// Bytes to store as a blob. (A string_view is stored as text.)
struct Blob {
    std::string_view bytes; ///< copied when they are bound
};

/// A prepared statement with its values, whose rows are read one by one.
class Statement {
  public:
    /// Binds the values to the parameters in order: whole numbers, UTF-8 text or a Blob. Throws InputError,
    /// naming the file, if SQLite refuses the SQL. `sqlite` must outlive the statement.
    template <class... Values>
    explicit Statement(Sqlite& sqlite, const std::string& sql, const Values&... values) : sqlite_(sqlite) {
        prepare(sql);
        int parameter = 0;
        (bind(++parameter, values), ...);
    }
    bool step();                              ///< goes to the next row; false after the last one
    std::uint64_t number(int column) const;   ///< a cell of the row; columns count from 0
    std::string_view bytes(int column) const; ///< text or blob, valid until the next step

  private:
    void prepare(const std::string& sql);
    void bind(int parameter, std::uint64_t value);
    void bind(int parameter, std::string_view text);
    void bind(int parameter, Blob blob);
    void expect_done(int result);
    Sqlite& sqlite_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_{nullptr, nullptr};
};

/// A write transaction: it begins at once and is rolled back unless it is committed.
class Transaction {
  public:
    /// Waits for other writers, then locks the file.
    explicit Transaction(Sqlite& sqlite) : sqlite_(sqlite) { sqlite_.run("BEGIN IMMEDIATE"); }
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    /// Makes permanent what was written since the start.
    void commit() { sqlite_.run("COMMIT"); }

  private:
    Sqlite& sqlite_;
};

} // namespace rough

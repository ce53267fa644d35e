#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace rough {

/// An open SQLite file that waits for other processes' locks. Errors are thrown as InputError that begins
/// with the file.
class Sqlite {
  public:
    /// a file that is there, or one made where there is none
    enum class Access { existing, create };
    /// Throws InputError where `file` cannot be opened so.
    Sqlite(std::filesystem::path file, Access access);

    void run(const std::string& sql);            ///< statements whose rows do not matter
    std::int64_t number(const std::string& sql); ///< the first column of the first row; 0 without a row
    const std::filesystem::path& file() const { return file_; } ///< as it was given

  private:
    friend class Statement;
    [[noreturn]] void fail() const;
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::filesystem::path file_;
    std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement: bind in order, then step through the rows.
class Statement {
  public:
    /// Throws InputError, naming the file, on SQL that SQLite refuses. `sqlite` must outlive the statement.
    Statement(Sqlite& sqlite, const std::string& sql);
    /// Binds the next parameter to a whole number.
    Statement& bind(std::int64_t value);
    /// Binds the next parameter to UTF-8 text, which is copied.
    Statement& bind_text(std::string_view value);
    /// Binds the next parameter to bytes, which are copied.
    Statement& bind_blob(std::string_view bytes);
    bool step();                              ///< false when done
    std::int64_t number(int column) const;    ///< of the row, columns from 0
    std::string_view bytes(int column) const; ///< text or blob, valid until the next step
    void reset();                             ///< to be bound and stepped again

  private:
    struct Finalise {
        void operator()(sqlite3_stmt* statement) const;
    };
    Statement& expect_done(int result);
    Sqlite& sqlite_;
    std::unique_ptr<sqlite3_stmt, Finalise> statement_;
    int bound_ = 0;
};

/// A write transaction: taken at once, rolled back unless committed.
class Transaction {
  public:
    /// Waits for other writers, then holds the file.
    explicit Transaction(Sqlite& sqlite) : sqlite_(sqlite) { sqlite_.run("BEGIN IMMEDIATE"); }
    ~Transaction();
    /// Makes what was written since the start last.
    void commit();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

  private:
    Sqlite& sqlite_;
    bool open_ = true;
};

} // namespace rough

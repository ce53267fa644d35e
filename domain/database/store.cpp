#include "domain/database/store.hpp"

#include "domain/errors.hpp"

#include <sqlite3.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <bit>

namespace rough {
namespace {

/// Calls `work`. Throws InputError that begins with the file if SQLite reports an error.
template <class Work>
auto guarded(const std::filesystem::path& file, const Work& work) {
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        const bool other = error.getErrorCode() == SQLITE_NOTADB;
        refuse(file.string(), ": ", other ? "is not a genome database" : error.what(),
               "; give a database file that can be used");
    }
}

/// Opens the file, read-only if it may not be written. The flag SQLite::OPEN_CREATE also makes a new one.
std::unique_ptr<SQLite::Database> opened(const std::filesystem::path& file, int flags = 0) {
    const std::string name = file.string();
    if (name.empty() || name == ":memory:" || name.starts_with("file:"))
        refuse(name.empty() ? "database" : name, ": is not the name of a file; give a database file");
    constexpr int wait = 120'000; // milliseconds; another builder writes its batch in far less
    auto sqlite =
        guarded(file, [&] { return std::make_unique<SQLite::Database>(name, flags | SQLite::OPEN_READWRITE, wait); });
    // The file may be forged: nothing in its schema is run, and cells larger than usual ones are refused.
    for (const auto& [option, on] : {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
                                     {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                     {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                     {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
        sqlite3_db_config(sqlite->getHandle(), option, on, nullptr);
    sqlite3_limit(sqlite->getHandle(), SQLITE_LIMIT_LENGTH, 100'000'000);
    return sqlite;
}

std::uint64_t number_in(const SQLite::Statement& row, int column) {
    return static_cast<std::uint64_t>(row.getColumn(column).getInt64());
}

/// Text or blob of a row, valid until the next row.
std::string_view bytes_in(const SQLite::Statement& row, int column) {
    const SQLite::Column cell = row.getColumn(column);
    return {static_cast<const char*>(cell.getBlob()), static_cast<std::size_t>(cell.getBytes())};
}

template <class Value>
void bind(SQLite::Statement& statement, int parameter, const Value& value) {
    if constexpr (std::is_same_v<Value, std::uint64_t>)
        statement.bind(parameter, static_cast<std::int64_t>(value));
    else if constexpr (std::is_same_v<Value, std::vector<double>>)
        statement.bind(parameter, value.data(), static_cast<int>(value.size() * sizeof(double)));
    else
        statement.bind(parameter, value);
}

/// Runs a statement with its values. Calls `take` with each row.
template <class Take, class... Values>
void each(SQLite::Database& sqlite, const std::string& sql, const Take& take, const Values&... values) {
    guarded(sqlite.getFilename(), [&] {
        SQLite::Statement statement(sqlite, sql);
        int parameter = 0;
        (bind(statement, ++parameter, values), ...);
        while (statement.executeStep()) take(statement);
    });
}

/// Runs a statement with its values. Returns the first column of its last row, or 0 without rows.
template <class... Values>
std::uint64_t run(SQLite::Database& sqlite, const std::string& sql, const Values&... values) {
    std::uint64_t first = 0;
    each(
        sqlite, sql, [&](const SQLite::Statement& row) { first = number_in(row, 0); }, values...);
    return first;
}

// The numbers by which SQLite recognises a file's program and format.
constexpr std::uint64_t application = 0x52554741; // "RUGA"
constexpr std::uint64_t form = 2;

/// The statements that make a database, in alphabetic order. Each kind of blob has a table, so that scoring
/// reads only pressures.
std::vector<std::string> schema() {
    const std::string blobs = "(first INTEGER PRIMARY KEY, numbers BLOB NOT NULL, checksum INTEGER NOT NULL)";
    return {"CREATE TABLE batch(first INTEGER PRIMARY KEY, count INTEGER NOT NULL)",
            "CREATE TABLE contact" + blobs,
            "CREATE TABLE genome" + blobs,
            "CREATE TABLE pressure" + blobs,
            "CREATE TABLE setup(name TEXT PRIMARY KEY, value TEXT NOT NULL)",
            "CREATE TABLE taken(first INTEGER PRIMARY KEY)"};
}

static_assert(std::endian::native == std::endian::little, "genome databases hold little-endian numbers");

std::string_view packed(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

void append(std::vector<double>& list, const auto& values) { list.insert(list.end(), values.begin(), values.end()); }

/// A genome as numbers: series, and for each A, H, gamma, lambda, chromosomes, and for each of those n,
/// ridges and the phases.
std::vector<double> numbers_of(const Genome& genome) {
    std::vector<double> values{static_cast<double>(genome.series.size())};
    for (const Series& series : genome.series) {
        values.insert(values.end(), {series.A, series.H, series.gamma, series.lambda,
                                     static_cast<double>(series.chromosomes.size())});
        for (const Chromosome& chromosome : series.chromosomes) {
            values.push_back(chromosome.n);
            values.push_back(static_cast<double>(chromosome.phases.size()));
            values.insert(values.end(), chromosome.phases.begin(), chromosome.phases.end());
        }
    }
    return values;
}

bool holds_anything(SQLite::Database& sqlite) { return run(sqlite, "SELECT count(*) FROM sqlite_master") > 0; }

template <class... Parts>
[[noreturn]] void refuse_changed(const SQLite::Database& sqlite, const Parts&... parts) {
    refuse(sqlite.getFilename(), ": ", parts..., "; give a file that only this program has written");
}

/// Refuses a file that holds anything besides the tables of a genome database: views, triggers, columns.
void expect_ours(SQLite::Database& sqlite) {
    if (run(sqlite, "PRAGMA application_id") != application)
        refuse(sqlite.getFilename(), ": is not a genome database; give one made by 'rugosa database build'");
    if (const auto version = run(sqlite, "PRAGMA user_version"); version != form)
        refuse(sqlite.getFilename(), ": a genome database of form ", version, ", not ", form, "; build it again");
    std::vector<std::string> there;
    each(sqlite, "SELECT sql FROM sqlite_master WHERE name <> 'sqlite_autoindex_setup_1' ORDER BY sql",
         [&](const SQLite::Statement& row) { there.emplace_back(bytes_in(row, 0)); });
    if (there != schema()) refuse_changed(sqlite, "holds other tables than a genome database");
    if (run(sqlite, "SELECT count(*) FROM batch WHERE typeof(count) <> 'integer' OR count < 1 OR count > "
                    "1000000 OR first < 0") > 0)
        refuse_changed(sqlite, "a batch of an impossible size");
}

std::uint64_t checksum_of(const NamedValues& fields) {
    std::string text;
    for (const auto& [name, value] : fields) text += name + "=" + value + "\n";
    return checksum(text);
}

/// The set-up and the version, as they were written.
NamedValues stored_values(SQLite::Database& sqlite) {
    NamedValues fields;
    std::string sum;
    each(sqlite, "SELECT name, value FROM setup ORDER BY name", [&](const SQLite::Statement& row) {
        if (bytes_in(row, 0) == "checksum")
            sum = bytes_in(row, 1);
        else
            fields.emplace_back(bytes_in(row, 0), bytes_in(row, 1));
    });
    if (sum != std::to_string(checksum_of(fields))) refuse_changed(sqlite, "its set-up was altered");
    return fields;
}

/// A batch's checksum depends on its table, its place and its numbers.
std::uint64_t checksum_of(const std::string& table, const Span& span, std::string_view numbers) {
    return checksum(numbers, checksum(table, span.first * ga::golden_step + span.count));
}

} // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t seed) {
    std::uint64_t sum = ga::mix(seed + bytes.size());
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(sum)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        sum = ga::mix(sum ^ word) + ga::golden_step;
    }
    return sum;
}

GenomeStore::GenomeStore(std::unique_ptr<SQLite::Database> sqlite) : sqlite_(std::move(sqlite)) {
    expect_ours(*sqlite_);
    const NamedValues fields = stored_values(*sqlite_);
    setup_ = setup_from(fields, file().string());
    validate(setup_.law);
    for (const auto& [name, value] : fields)
        if (name == "version") version_ = value;
}

GenomeStore::GenomeStore(GenomeStore&&) noexcept = default;
GenomeStore::~GenomeStore() = default;

std::filesystem::path GenomeStore::file() const { return sqlite_->getFilename(); }

GenomeStore GenomeStore::create(const std::filesystem::path& file, const DatabaseSetup& setup) {
    if (!setup.model.body.layering.layers.empty())
        throw InputError(file.string() + ": a body with layers was given; give a half-space, because a "
                                         "database's responses are scaled to other lengths");
    validate(setup.law);
    const NamedValues wanted = named_values(setup);
    setup_from(wanted, file.string()); // throws before a file is made
    auto sqlite = opened(file, SQLite::OPEN_CREATE);
    guarded(file, [&] {
        SQLite::Transaction transaction(*sqlite, SQLite::TransactionBehavior::IMMEDIATE);
        if (!holds_anything(*sqlite)) {
            sqlite->exec("PRAGMA application_id = " + std::to_string(application));
            sqlite->exec("PRAGMA user_version = " + std::to_string(form));
            for (const std::string& statement : schema()) sqlite->exec(statement);
            NamedValues named = wanted;
            named.emplace_back("version", RUGOSA_VERSION);
            std::sort(named.begin(), named.end());
            named.emplace_back("checksum", std::to_string(checksum_of(named)));
            for (const auto& [name, value] : named) run(*sqlite, "INSERT INTO setup VALUES(?, ?)", name, value);
        }
        expect_ours(*sqlite);
        transaction.commit();
    });
    const std::string differs = difference(stored_values(*sqlite), wanted);
    if (!differs.empty())
        throw InputError(file.string() + ": a database of another set-up: its " + differs + "; use another");
    return GenomeStore(std::move(sqlite));
}

GenomeStore GenomeStore::open(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw InputError(file.string() + ": does not exist; give a genome database");
    return GenomeStore(opened(file));
}

bool GenomeStore::begun(const std::filesystem::path& file) {
    return std::filesystem::is_regular_file(file) && holds_anything(*opened(file));
}

std::uint64_t GenomeStore::stored() const { return run(*sqlite_, "SELECT sum(count) FROM batch"); }

std::vector<Span> GenomeStore::gaps(const Span& of) const {
    std::vector<Span> found;
    const std::uint64_t end = of.first + of.count;
    std::uint64_t next = of.first;
    const auto skip_to = [&](std::uint64_t first) {
        if (first > next) found.push_back({next, first - next});
    };
    // The batch before the span may reach into it.
    each(
        *sqlite_,
        "SELECT first, count FROM batch WHERE first >= (SELECT ifnull(max(first), 0) FROM batch WHERE first "
        "<= ?) AND first < ? ORDER BY first",
        [&](const SQLite::Statement& row) {
            skip_to(number_in(row, 0));
            next = std::max(next, number_in(row, 0) + number_in(row, 1));
        },
        of.first, end);
    skip_to(end);
    return found;
}

std::optional<Span> GenomeStore::take(Span& wanted, std::uint64_t batch,
                                      const std::function<bool(std::uint64_t first)>& is_own) {
    return guarded(file(), [&] {
        SQLite::Transaction transaction(*sqlite_, SQLite::TransactionBehavior::IMMEDIATE);
        const std::vector<Span> open = gaps(wanted);
        const std::uint64_t end = wanted.first + wanted.count;
        wanted.first = open.empty() ? end : open.front().first;
        wanted.count = end - wanted.first;
        // Without a fresh batch: the last one that another builder took. That builder was killed or still
        // works; computing its batch twice does no harm.
        std::optional<Span> left;
        for (const Span& gap : open)
            for (std::uint64_t next = gap.first, stop = gap.first + gap.count; next < stop;) {
                const Span piece{next, std::min(stop, (next / batch + 1) * batch) - next};
                next += piece.count;
                if (run(*sqlite_, "SELECT count(*) FROM taken WHERE first = ?", piece.first) == 0) {
                    run(*sqlite_, "INSERT INTO taken VALUES(?)", piece.first);
                    transaction.commit();
                    return std::optional(piece);
                }
                if (!is_own || !is_own(piece.first)) left = piece;
            }
        return left;
    });
}

bool GenomeStore::add(const Span& span, const std::vector<Response>& responses) {
    std::vector<double> pressure, contact, genomes;
    for (std::uint64_t i = 0; i < span.count; ++i) append(genomes, numbers_of(drawn(setup_.law, span.first + i)));
    for (const Response& response : responses) {
        pressure.push_back(response.range);
        append(pressure, response.pressure);
        append(contact, response.contact_fraction);
        append(contact, response.tangent_stiffness);
    }
    return guarded(file(), [&] {
        SQLite::Transaction transaction(*sqlite_, SQLite::TransactionBehavior::IMMEDIATE);
        const bool there = run(*sqlite_, "SELECT count(*) FROM batch WHERE first = ?", span.first) > 0;
        if (!there) {
            run(*sqlite_, "INSERT INTO batch VALUES(?, ?)", span.first, span.count);
            const auto put = [&](const std::string& table, const std::vector<double>& values) {
                run(*sqlite_, "INSERT INTO " + table + " VALUES(?, ?, ?)", span.first, values,
                    checksum_of(table, span, packed(values)));
            };
            put("pressure", pressure);
            put("contact", contact);
            put("genome", genomes);
        }
        run(*sqlite_, "DELETE FROM taken WHERE first = ?", span.first);
        transaction.commit();
        return !there;
    });
}

std::vector<Span> GenomeStore::batches() const {
    std::vector<Span> all;
    each(*sqlite_, "SELECT first, count FROM batch ORDER BY first", [&](const SQLite::Statement& row) {
        all.push_back({number_in(row, 0), number_in(row, 1)});
    });
    return all;
}

Span GenomeStore::batch_of(std::uint64_t index) const {
    Span span;
    each(
        *sqlite_, "SELECT first, count FROM batch WHERE first <= ? ORDER BY first DESC LIMIT 1",
        [&](const SQLite::Statement& row) {
            span = {number_in(row, 0), number_in(row, 1)};
        },
        index);
    if (index < span.first + span.count) return span;
    refuse(file().string(), ": genome ", index, " is not stored; give a smaller number");
}

/// A batch's row in a table: one column of numbers for each of its genomes.
Eigen::MatrixXd GenomeStore::numbers(const std::string& table, const Span& span, Index per_genome) const {
    Eigen::MatrixXd values;
    const std::size_t size = span.count * static_cast<std::size_t>(per_genome) * sizeof(double);
    const auto read = [&](const SQLite::Statement& row) {
        if (number_in(row, 1) != checksum_of(table, span, bytes_in(row, 0))) return;
        if (bytes_in(row, 0).size() != size)
            refuse_changed(*sqlite_, "a batch of ", bytes_in(row, 0).size(), " bytes in place of ", size);
        values.resize(per_genome, static_cast<Index>(span.count));
        std::memcpy(values.data(), bytes_in(row, 0).data(), size);
    };
    each(*sqlite_, "SELECT numbers, checksum FROM " + table + " WHERE first = ?", read, span.first);
    if (values.size() == 0)
        refuse_changed(*sqlite_, "the ", table, " of genomes ", span.first, " to ", span.first + span.count - 1,
                       " was altered");
    for (const auto& genome : values.colwise()) // all NaN without a response (response_for)
        if (!genome.array().isFinite().all() && !genome.array().isNaN().all())
            refuse_changed(*sqlite_, "the ", table, " of genomes from ", span.first,
                           " has numbers that are not finite");
    return values;
}

/// Refuses stored genomes that differ from those that this program draws by the law. They are drawn one by
/// one, because a forged file may state more than fit into memory.
void GenomeStore::expect_genomes(const Span& span) const {
    bool there = false;
    const auto compare = [&](const SQLite::Statement& row) {
        std::string_view rest = bytes_in(row, 0);
        for (std::uint64_t genome = span.first; genome < span.first + span.count; ++genome) {
            const auto numbers = numbers_of(drawn(setup_.law, genome));
            if (!rest.starts_with(packed(numbers))) refuse_changed(*sqlite_, "genome ", genome, " is not its law's");
            rest.remove_prefix(packed(numbers).size());
        }
        if (!rest.empty()) refuse_changed(*sqlite_, "more genomes are stored than the batch has");
        there = true;
    };
    each(*sqlite_, "SELECT numbers FROM genome WHERE first = ?", compare, span.first);
    if (!there) refuse_changed(*sqlite_, "no genomes are stored for the batch at ", span.first);
}

std::vector<Response> GenomeStore::responses(const Span& span) const {
    expect_genomes(span);
    const Index steps = setup_.model.loading.steps;
    const Eigen::MatrixXd pressure = numbers("pressure", span, steps + 1),
                          contact = numbers("contact", span, 2 * steps);
    std::vector<Response> responses(span.count);
    for (Index i = 0; i < pressure.cols(); ++i) {
        Response& response = responses[static_cast<std::size_t>(i)];
        response.range = pressure(0, i);
        response.pressure = pressure.col(i).tail(steps);
        response.contact_fraction = contact.col(i).head(steps);
        response.tangent_stiffness = contact.col(i).tail(steps);
    }
    return responses;
}

StoredCurves GenomeStore::curves(bool with_fractions) const {
    const Index steps = setup_.model.loading.steps;
    StoredCurves curves;
    for (const Span& span : batches()) {
        const Eigen::MatrixXd pressure = numbers("pressure", span, steps + 1);
        append(curves.range, pressure.row(0));
        append(curves.pressure, pressure.bottomRows(steps).reshaped());
        if (with_fractions) append(curves.fraction, numbers("contact", span, 2 * steps).topRows(steps).reshaped());
        for (std::uint64_t g = span.first; g < span.first + span.count; ++g) curves.index.push_back(g);
    }
    return curves;
}

Genome GenomeStore::genome(std::uint64_t index) const {
    expect_genomes(batch_of(index));
    return drawn(setup_.law, index);
}

} // namespace rough

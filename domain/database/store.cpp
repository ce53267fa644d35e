#include "domain/database/store.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/database/codec.hpp"
#include "domain/database/sqlite.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace rough {
namespace {

// SQLite's own marks of whose file it is and in which form.
constexpr std::int64_t application = 0x52554741; // "RUGA"
constexpr std::int64_t form = 2;

std::int64_t as_key(std::uint64_t index) { return static_cast<std::int64_t>(index); }
std::uint64_t as_index(std::int64_t key) { return static_cast<std::uint64_t>(key); }

/// Blobs in tables of their own, so that scoring reads the pressures alone; each row with its checksum.
const std::vector<std::string>& schema() {
    static const std::vector<std::string> statements = [] {
        std::vector<std::string> all{"CREATE TABLE setup(name TEXT PRIMARY KEY, value TEXT NOT NULL)",
                                     "CREATE TABLE batch(first INTEGER PRIMARY KEY, count INTEGER NOT NULL)",
                                     "CREATE TABLE taken(first INTEGER PRIMARY KEY)"};
        for (const char* table : {"pressure", "contact", "genome"})
            all.push_back(std::string("CREATE TABLE ") + table +
                          "(first INTEGER PRIMARY KEY, numbers BLOB NOT NULL, checksum INTEGER NOT NULL)");
        std::sort(all.begin(), all.end());
        return all;
    }();
    return statements;
}

void make_tables(Sqlite& sqlite) {
    sqlite.run("PRAGMA application_id = " + std::to_string(application));
    sqlite.run("PRAGMA user_version = " + std::to_string(form));
    for (const std::string& statement : schema())
        sqlite.run(statement);
}

bool holds_anything(Sqlite& sqlite) { return sqlite.number("SELECT count(*) FROM sqlite_master") > 0; }

[[noreturn]] void refuse_changed(const Sqlite& sqlite, const std::string& what) {
    throw InputError(sqlite.file().string() + ": " + what +
                     ", expected a file that nothing else has changed");
}

/// Ours is what this program writes and nothing beside it: no view, no trigger, no other column.
void expect_ours(Sqlite& sqlite) {
    if (sqlite.number("PRAGMA application_id") != application)
        throw InputError(sqlite.file().string() +
                         ": is no genome database, expected one made by 'rugosa database build'");
    const std::int64_t version = sqlite.number("PRAGMA user_version");
    if (version != form)
        throw InputError(sqlite.file().string() + ": a genome database of form " + std::to_string(version) +
                         ", expected form " + std::to_string(form) + " (build it anew)");
    std::vector<std::string> there;
    Statement rows(sqlite,
                   "SELECT sql FROM sqlite_master WHERE name <> 'sqlite_autoindex_setup_1' ORDER BY sql");
    while (rows.step())
        there.emplace_back(rows.bytes(0));
    if (there != schema())
        refuse_changed(sqlite, "holds other tables than a genome database");
    if (sqlite.number("SELECT count(*) FROM batch WHERE typeof(count) <> 'integer' OR count < 1 OR count > "
                      "1000000 OR first < 0") > 0)
        refuse_changed(sqlite, "a batch of an impossible size");
}

std::uint64_t checksum_of(const Fields& fields) {
    std::string text;
    for (const auto& [name, value] : fields)
        text += name + "=" + value + "\n";
    return checksum(text);
}

/// The set-up and the version, as they were written.
Fields stored_fields(Sqlite& sqlite) {
    Fields fields;
    std::string sum;
    Statement rows(sqlite, "SELECT name, value FROM setup ORDER BY name");
    while (rows.step())
        if (rows.bytes(0) == "checksum")
            sum = rows.bytes(1);
        else
            fields.emplace_back(rows.bytes(0), rows.bytes(1));
    if (sum != std::to_string(checksum_of(fields)))
        refuse_changed(sqlite, "its set-up was altered");
    return fields;
}

/// A batch's checksum is that of its table, its place and its numbers.
std::int64_t checksum_of(const std::string& table, const Span& span, std::string_view numbers) {
    const std::uint64_t place = checksum(table, span.first * 0x9E3779B97F4A7C15ULL + span.count);
    return as_key(checksum(numbers, place));
}

/// The numbers of a row (…, first, count, numbers, checksum) from `column` on.
std::vector<double> checked_numbers(const Sqlite& sqlite, const Statement& row, int column,
                                    const char* table) {
    const Span span{as_index(row.number(column)), as_index(row.number(column + 1))};
    const std::string_view bytes = row.bytes(column + 2);
    if (row.number(column + 3) != checksum_of(table, span, bytes))
        refuse_changed(sqlite, std::string("the ") + table + " of genomes " + std::to_string(span.first) +
                                   " to " + std::to_string(span.first + span.count - 1) + " was altered");
    return unpacked(bytes);
}

void expect_size(const Sqlite& sqlite, const std::vector<double>& values, std::uint64_t wanted) {
    if (values.size() != wanted)
        refuse_changed(sqlite, "a batch of " + std::to_string(values.size()) + " numbers in place of " +
                                   std::to_string(wanted));
}

/// Shows what is missing of a span, cut at the multiples of `batch`, until `visit` gives true. Gives where
/// the first gap begins.
template <class Visit>
std::uint64_t visit_gaps(Sqlite& sqlite, const Span& of, std::uint64_t batch, Visit visit) {
    const std::uint64_t end = of.first + of.count;
    std::uint64_t next = of.first, filled = of.first;
    bool found = false, done = false;
    const auto fill_to = [&](std::uint64_t stop) {
        while (next < stop && !done) {
            const std::uint64_t cut = std::min(stop, (next / batch + 1) * batch);
            found = true;
            done = visit(Span{next, cut - next});
            next = cut;
        }
    };
    // The batch before may reach into the span.
    Statement rows(sqlite, "SELECT first, count FROM batch WHERE first >= (SELECT ifnull(max(first), 0) FROM "
                           "batch WHERE first <= ?) ORDER BY first");
    rows.bind(as_key(of.first));
    while (!done && next < end && rows.step()) {
        const std::uint64_t first = as_index(rows.number(0));
        fill_to(std::min(first, end));
        next = std::max(next, first + as_index(rows.number(1)));
        if (!found)
            filled = std::min(next, end);
    }
    fill_to(end);
    return filled;
}

Eigen::VectorXd displacements(const Model& model, double range) {
    const auto steps = load_displacements(range, model.loading, model.body.kernel);
    return Eigen::Map<const Eigen::VectorXd>(steps.data(), static_cast<Index>(steps.size()));
}

struct Place {
    std::vector<double> numbers;
    std::size_t within, count; ///< of the batch
};

Place look_up(Sqlite& sqlite, const char* table, std::uint64_t index) {
    Statement row(sqlite, std::string("SELECT batch.first, count, numbers, checksum FROM batch JOIN ") +
                              table +
                              " USING(first) WHERE batch.first <= ? ORDER BY batch.first DESC LIMIT 1");
    if (row.bind(as_key(index)).step() && index < as_index(row.number(0)) + as_index(row.number(1)))
        return {checked_numbers(sqlite, row, 0, table),
                static_cast<std::size_t>(index - as_index(row.number(0))),
                static_cast<std::size_t>(row.number(1))};
    throw InputError(sqlite.file().string() + ": genome " + std::to_string(index) + " is not stored");
}

std::vector<Genome> genomes_of(const Sqlite& sqlite, const Place& place) {
    std::vector<Genome> genomes = genomes_from(place.numbers);
    if (genomes.size() != place.count)
        refuse_changed(sqlite, "a batch of " + std::to_string(genomes.size()) + " genomes in place of " +
                                   std::to_string(place.count));
    return genomes;
}

/// The responses' numbers of a batch, side by side.
struct Columns {
    Columns(Sqlite& sqlite, std::uint64_t index, Index steps)
        : pressure(look_up(sqlite, "pressure", index)), contact(look_up(sqlite, "contact", index)),
          steps(steps) {
        expect_size(sqlite, pressure.numbers, pressure.count * static_cast<std::size_t>(steps + 1));
        expect_size(sqlite, contact.numbers, contact.count * static_cast<std::size_t>(2 * steps));
    }
    Response of(std::size_t within) const {
        const double* p = pressure.numbers.data() + within * static_cast<std::size_t>(steps + 1);
        const double* c = contact.numbers.data() + within * static_cast<std::size_t>(2 * steps);
        Response response;
        response.range = p[0];
        response.pressure = Eigen::Map<const Eigen::VectorXd>(p + 1, steps);
        response.contact_fraction = Eigen::Map<const Eigen::VectorXd>(c, steps);
        response.tangent_stiffness = Eigen::Map<const Eigen::VectorXd>(c + steps, steps);
        return response;
    }

    Place pressure, contact;
    Index steps;
};

} // namespace

GenomeStore::GenomeStore(Sqlite sqlite) : sqlite_(std::make_unique<Sqlite>(std::move(sqlite))) {
    expect_ours(*sqlite_);
    const Fields fields = stored_fields(*sqlite_);
    setup_ = setup_from(fields, file().string());
    validate(setup_.law);
    for (const auto& [name, value] : fields)
        if (name == "version")
            version_ = value;
}

GenomeStore::GenomeStore(GenomeStore&&) noexcept = default;
GenomeStore::~GenomeStore() = default;

const std::filesystem::path& GenomeStore::file() const { return sqlite_->file(); }

GenomeStore GenomeStore::create(const std::filesystem::path& file, const DatabaseSetup& setup) {
    if (!setup.model.body.layering.layers.empty())
        throw InputError(file.string() +
                         ": a body with layers given, expected a half-space: databases scale its "
                         "responses to other lengths");
    validate(setup.law);
    const Fields wanted = fields(setup);
    Sqlite sqlite(file, Sqlite::Access::create);
    Transaction transaction(sqlite);
    if (!holds_anything(sqlite)) {
        make_tables(sqlite);
        Fields named = wanted;
        named.emplace_back("version", RUGOSA_VERSION);
        std::sort(named.begin(), named.end());
        named.emplace_back("checksum", std::to_string(checksum_of(named)));
        Statement insert(sqlite, "INSERT INTO setup VALUES(?, ?)");
        for (const auto& [name, value] : named) {
            insert.bind_text(name).bind_text(value).step();
            insert.reset();
        }
    }
    expect_ours(sqlite);
    transaction.commit();
    const std::string differs = difference(stored_fields(sqlite), wanted);
    if (!differs.empty())
        throw InputError(file.string() + ": a database of another set-up: its " + differs);
    return GenomeStore(std::move(sqlite));
}

GenomeStore GenomeStore::open(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw InputError(file.string() + ": there is no such file, expected a genome database");
    return GenomeStore(Sqlite(file, Sqlite::Access::existing));
}

bool GenomeStore::begun(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        return false;
    Sqlite sqlite(file, Sqlite::Access::existing);
    return holds_anything(sqlite);
}

std::uint64_t GenomeStore::stored() const {
    return as_index(sqlite_->number("SELECT sum(count) FROM batch"));
}

std::vector<Span> GenomeStore::gaps(const Span& of) const {
    std::vector<Span> found;
    visit_gaps(*sqlite_, of, of.first + of.count,
               [&](const Span& gap) { return found.push_back(gap), false; });
    return found;
}

std::optional<Span> GenomeStore::take(const Span& of, std::uint64_t batch,
                                      const std::function<bool(std::uint64_t first)>& is_own) {
    Transaction transaction(*sqlite_);
    std::vector<std::uint64_t> taken;
    {
        Statement rows(*sqlite_, "SELECT first FROM taken ORDER BY first");
        while (rows.step())
            taken.push_back(as_index(rows.number(0)));
    }
    // What was stored once stays: the next look begins behind it.
    if (!(of.first <= filled_ && filled_from_ == of.first))
        filled_ = filled_from_ = of.first;
    const std::uint64_t end = of.first + of.count, from = std::min(filled_, end);
    std::optional<Span> fresh, left;
    filled_ = visit_gaps(*sqlite_, {from, end - from}, batch, [&](const Span& span) {
        if (!std::binary_search(taken.begin(), taken.end(), span.first))
            fresh = span;
        else if (!is_own || !is_own(span.first))
            left = span;
        return fresh.has_value();
    });
    if (fresh) {
        Statement(*sqlite_, "INSERT INTO taken VALUES(?)").bind(as_key(fresh->first)).step();
        transaction.commit();
        return fresh;
    }
    // What is left was taken by builders that still work or were killed: computing it again does no harm,
    // from the end, where those that still work come last.
    return left;
}

bool GenomeStore::add(const Span& span, const std::vector<Genome>& genomes,
                      const std::vector<Response>& responses) {
    std::vector<double> pressure, contact;
    for (const Response& response : responses) {
        pressure.push_back(response.range);
        pressure.insert(pressure.end(), response.pressure.begin(), response.pressure.end());
        contact.insert(contact.end(), response.contact_fraction.begin(), response.contact_fraction.end());
        contact.insert(contact.end(), response.tangent_stiffness.begin(), response.tangent_stiffness.end());
    }
    Transaction transaction(*sqlite_);
    Statement known(*sqlite_, "SELECT 1 FROM batch WHERE first = ?");
    const bool there = known.bind(as_key(span.first)).step();
    known.reset();
    if (!there) {
        Statement(*sqlite_, "INSERT INTO batch VALUES(?, ?)")
            .bind(as_key(span.first))
            .bind(as_key(span.count))
            .step();
        const auto put = [&](const char* table, const std::vector<double>& values) {
            const std::string bytes = packed(values);
            Statement(*sqlite_, std::string("INSERT INTO ") + table + " VALUES(?, ?, ?)")
                .bind(as_key(span.first))
                .bind_blob(bytes)
                .bind(checksum_of(table, span, bytes))
                .step();
        };
        put("pressure", pressure);
        put("contact", contact);
        put("genome", numbers(genomes));
    }
    Statement(*sqlite_, "DELETE FROM taken WHERE first = ?").bind(as_key(span.first)).step();
    transaction.commit();
    return !there;
}

StoredCurves GenomeStore::curves(bool with_fractions) const {
    const auto steps = static_cast<std::size_t>(setup_.model.loading.steps);
    StoredCurves curves;
    const auto append = [&](std::vector<double>& list, const double* values) {
        list.insert(list.end(), values, values + steps);
    };
    Statement rows(*sqlite_,
                   with_fractions
                       ? "SELECT first, count, pressure.numbers, pressure.checksum, first, count, "
                         "contact.numbers, contact.checksum FROM batch JOIN pressure USING(first) JOIN "
                         "contact USING(first) ORDER BY first"
                       : "SELECT first, count, numbers, checksum FROM batch JOIN pressure USING(first) "
                         "ORDER BY first");
    while (rows.step()) {
        const std::uint64_t first = as_index(rows.number(0)), count = as_index(rows.number(1));
        const auto values = checked_numbers(*sqlite_, rows, 0, "pressure");
        expect_size(*sqlite_, values, count * (steps + 1));
        const auto contact =
            with_fractions ? checked_numbers(*sqlite_, rows, 4, "contact") : std::vector<double>{};
        if (with_fractions)
            expect_size(*sqlite_, contact, count * 2 * steps);
        for (std::size_t g = 0; g < count; ++g) {
            curves.index.push_back(first + g);
            curves.range.push_back(values[g * (steps + 1)]);
            append(curves.pressure, &values[g * (steps + 1) + 1]);
            if (with_fractions)
                append(curves.fraction, &contact[g * 2 * steps]);
        }
    }
    if (curves.index.size() != stored())
        refuse_changed(*sqlite_, "a batch without its curves");
    return curves;
}

Genome GenomeStore::genome(std::uint64_t index) const {
    const Place place = look_up(*sqlite_, "genome", index);
    std::vector<Genome> genomes = genomes_of(*sqlite_, place);
    validate(genomes[place.within], file().string() + ": genome " + std::to_string(index));
    return std::move(genomes[place.within]);
}

Response GenomeStore::response(std::uint64_t index) const {
    const Model& model = setup_.model;
    const Columns columns(*sqlite_, index, model.loading.steps);
    Response response = columns.of(columns.pressure.within);
    response.displacement = displacements(model, response.range);
    response.full_stiffness = full_contact_stiffness(model.grid.nodes, model.grid.spacing(), model.body);
    return response;
}

std::vector<Span> GenomeStore::batches() const {
    std::vector<Span> all;
    Statement rows(*sqlite_, "SELECT first, count FROM batch ORDER BY first");
    while (rows.step())
        all.push_back({as_index(rows.number(0)), as_index(rows.number(1))});
    return all;
}

StoredBatch GenomeStore::batch(const Span& span) const {
    const Columns columns(*sqlite_, span.first, setup_.model.loading.steps);
    StoredBatch batch{genomes_of(*sqlite_, look_up(*sqlite_, "genome", span.first)), {}};
    for (std::size_t i = 0; i < batch.genomes.size(); ++i)
        batch.responses.push_back(columns.of(i));
    return batch;
}

} // namespace rough

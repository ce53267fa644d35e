#pragma once

#include "domain/database/setup.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace rough {

class Sqlite;

/// Genomes first .. first + count - 1 of a law.
struct Span {
    std::uint64_t first = 0; ///< index, from 0
    std::uint64_t count = 0; ///< how many
};

/// The responses' numbers that scoring needs, one genome after another.
struct StoredCurves {
    std::vector<std::uint64_t> index; ///< the genomes' numbers
    std::vector<double>
        range; ///< height range (periodic: to full contact), mm; NaN where there is no response
    std::vector<double> pressure; ///< genomes x steps, MPa
    std::vector<double> fraction; ///< genomes x steps, contact fractions; empty unless asked for
};

/// A batch's genomes and of their responses range, pressures, contact fractions and tangents.
struct StoredBatch {
    std::vector<Genome> genomes;     ///< scale 1
    std::vector<Response> responses; ///< one a genome
};

/// A genome database: an SQLite file with the genomes of a law and their responses, in batches. A batch is
/// written whole or not at all, whatever ends the program; several programs may read and build one file at
/// once.
class GenomeStore {
  public:
    /// Opens a database; where there is none, makes one. Throws InputError on a file of another set-up,
    /// naming the first difference, and on one that is no genome database.
    static GenomeStore create(const std::filesystem::path& file, const DatabaseSetup& setup);
    /// Opens one that exists, to read or to go on building.
    static GenomeStore open(const std::filesystem::path& file);

    ///@{
    /// Moves as a file handle does.
    GenomeStore(GenomeStore&&) noexcept;
    ~GenomeStore();
    ///@}

    /// Whether there is such a file with anything in it: a program killed while it makes one leaves it empty.
    static bool begun(const std::filesystem::path& file);

    const DatabaseSetup& setup() const { return setup_; }   ///< as the file says it
    const std::string& version() const { return version_; } ///< of the program that made the file
    std::uint64_t stored() const;                           ///< genomes
    const std::filesystem::path& file() const;              ///< where it lies

    /// The next genomes of `of` to compute, at most `batch`: first such that no other builder has taken, then
    /// those taken and never delivered, but the taker's own. Nothing when all are stored.
    std::optional<Span> take(const Span& of, std::uint64_t batch,
                             const std::function<bool(std::uint64_t first)>& is_own = {});
    std::vector<Span> gaps(const Span& of) const; ///< what is not stored of these genomes
    /// Stores a batch; where another builder was faster, its copy stays, and this gives false.
    bool add(const Span& span, const std::vector<Genome>& genomes, const std::vector<Response>& responses);

    std::vector<Span> batches() const; ///< as they are stored, in order
    /// One of batches(). Throws InputError where it was altered.
    StoredBatch batch(const Span& span) const;
    /// Every stored genome's curve, read in one pass; contact fractions where asked for.
    StoredCurves curves(bool with_fractions = false) const;
    Genome genome(std::uint64_t index) const;     ///< throws InputError when it is not stored
    Response response(std::uint64_t index) const; ///< displacement, pressure, contact fraction and tangents

  private:
    explicit GenomeStore(Sqlite sqlite);
    std::unique_ptr<Sqlite> sqlite_;
    DatabaseSetup setup_;
    std::string version_;
    std::uint64_t filled_ = 0,
                  filled_from_ = 0; ///< from this number up to that, all were stored when last seen
};

} // namespace rough

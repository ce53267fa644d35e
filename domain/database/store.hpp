#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/response.hpp"

#include <memory>
#include <optional>

namespace SQLite {
class Database;
}

namespace rough {

/// The distribution of the genomes of a database. Each genome is a sum of `series` series. H and gamma of a
/// series are uniform in their ranges, and phases are uniform in [0, 2 pi). Chromosomes are n = 1 .. n_f (Eq.
/// 4, wavelengths down to `shortest`). A is 1 in the first series, and uniform in (0, 1] in others.
struct GenomeDistribution {
    int series = 1;           ///< number of series, >= 1
    int ridges = 1;           ///< number of ridges M of each chromosome, >= 1
    double H_from = 0.5;      ///< lowest Hurst exponent
    double H_to = 1.5;        ///< highest Hurst exponent
    double gamma_from = 1.4;  ///< lowest ratio of neighbouring wavenumbers, > 1
    double gamma_to = 2.0;    ///< highest ratio of neighbouring wavenumbers
    double lambda = 0.84942;  ///< longest wavelength, mm
    double shortest = 0.0133; ///< shortest wavelength, mm
    std::uint64_t seed = 1;   ///< seed; genome i depends only on the distribution and on i
};

/// Throws InputError on a range in the wrong order, gamma <= 1, no wave, or more than a million phases.
void validate(const GenomeDistribution& law);

/// The largest number of phases that a genome of the distribution can have.
double max_phases(const GenomeDistribution& law);

/// Genome number `index` of a distribution. It does not depend on other genomes.
Genome drawn(const GenomeDistribution& law, std::uint64_t index);

/// The set-up of all genomes and responses of a database.
struct DatabaseSetup {
    Model model = completed(Model()); ///< grid, body, load steps and contact options; complete
    GenomeDistribution law = {};      ///< distribution of the genomes
};

NamedValues named_values(const DatabaseSetup& setup); ///< names with units and values, the model first
/// The inverse of named_values(). Throws InputError that begins with `where` on a missing or wrong field.
DatabaseSetup setup_from(const NamedValues& fields, const std::string& where);

/// The first difference in words, e.g. "nodes is 512, not 256"; empty if `there` has all fields of `wanted`.
std::string difference(const NamedValues& there, const NamedValues& wanted);

/// The genomes first .. first + count - 1 of a distribution.
struct Span {
    std::uint64_t first = 0; ///< index of the first genome, from 0
    std::uint64_t count = 0; ///< number of genomes
};

/// The values of all stored responses from which similarities are computed, one genome after another.
struct StoredCurves {
    std::vector<std::uint64_t> index; ///< the genomes' numbers
    std::vector<double> range;        ///< Response::range of each genome, mm; NaN: no response
    std::vector<double> pressure;     ///< genomes x steps, MPa
    std::vector<double> fraction;     ///< genomes x steps, contact fractions; empty unless requested
};

/// A checksum of 64 bits. It changes if one byte of `bytes` changes, and with nearly every other change.
std::uint64_t checksum(std::string_view bytes, std::uint64_t seed = 0);

/// A genome database (README.md): an SQLite file with the genomes of a distribution and their responses, in
/// batches. A batch is written as a whole or not at all. Several programs may read and build one file.
class GenomeStore {
  public:
    /// Opens an existing database, or makes a new one. Throws InputError on a file of another set-up, naming
    /// the first difference, and on a file that is not a genome database.
    static GenomeStore create(const std::filesystem::path& file, const DatabaseSetup& setup);
    /// Opens an existing database, to read it or to continue its build.
    static GenomeStore open(const std::filesystem::path& file);

    ///@{
    /// A store can be moved, but not copied.
    GenomeStore(GenomeStore&&) noexcept;
    ~GenomeStore();
    ///@}

    /// Whether the file exists and is not empty. It is empty if a program was killed while it made the file.
    static bool begun(const std::filesystem::path& file);

    const DatabaseSetup& setup() const { return setup_; }   ///< the set-up in the file
    const std::string& version() const { return version_; } ///< version of the program that made the file
    std::uint64_t stored() const;                           ///< number of stored genomes
    std::filesystem::path file() const;                     ///< the database's path

    /// Reserves the next genomes of `wanted` to compute, at most `batch`; nothing if all are stored. Genomes
    /// that no builder has reserved come first, then those of batches for which `is_own` is not true. Stored
    /// genomes are removed from the beginning of `wanted`.
    std::optional<Span> take(Span& wanted, std::uint64_t batch,
                             const std::function<bool(std::uint64_t first)>& is_own = {});
    std::vector<Span> gaps(const Span& of) const; ///< spans of these genomes that are not stored, in order
    /// Stores the genomes of a span and their responses. Returns false if another builder has already stored
    /// them; the earlier copy is then kept.
    bool add(const Span& span, const std::vector<Response>& responses);

    std::vector<Span> batches() const; ///< all stored batches, in order
    /// Ranges, pressures, contact fractions and tangents of a batch from batches(). Throws InputError if the
    /// batch was altered or its genomes differ from the distribution.
    std::vector<Response> responses(const Span& span) const;
    /// The curves of all stored genomes, with contact fractions if requested.
    StoredCurves curves(bool with_fractions = false) const;
    /// A stored genome. Throws InputError if it is not stored, or differs from its distribution.
    Genome genome(std::uint64_t index) const;

  private:
    explicit GenomeStore(std::unique_ptr<SQLite::Database> sqlite);
    Span batch_of(std::uint64_t index) const;
    Eigen::MatrixXd numbers(const std::string& table, const Span& span, Index per_genome) const;
    void expect_genomes(const Span& span) const;

    std::unique_ptr<SQLite::Database> sqlite_;
    DatabaseSetup setup_;
    std::string version_;
};

} // namespace rough

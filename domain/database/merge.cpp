#include "domain/database/merge.hpp"

#include "domain/database/codec.hpp"
#include "domain/errors.hpp"

#include <unistd.h>

namespace rough {
namespace {

/// What is missing in `to` of a batch of `from`.
void copy(const GenomeStore& from, const Span& span, GenomeStore& to) {
    const StoredBatch batch = from.batch(span);
    for (std::uint64_t i = 0; i < span.count; ++i)
        if (numbers({batch.genomes[i]}) != numbers({drawn(from.setup().law, span.first + i)}))
            refuse(from.file().string(), ": genome ", span.first + i,
                   " is not its law's, expected a file that nothing else has changed");
    const auto at = [&](const auto& list, const Span& part) {
        const auto begin = list.begin() + static_cast<std::ptrdiff_t>(part.first - span.first);
        return std::vector(begin, begin + static_cast<std::ptrdiff_t>(part.count));
    };
    for (const Span& part : to.gaps(span))
        to.add(part, at(batch.genomes, part), at(batch.responses, part));
}

} // namespace

std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out) {
    std::vector<GenomeStore> all;
    for (const auto& file : files) {
        all.push_back(GenomeStore::open(file));
        const GenomeStore &first = all.front(), &last = all.back();
        if (const std::string other = difference(fields(last.setup()), fields(first.setup())); !other.empty())
            refuse(file.string(), ": its ", other, " as that of ", files.front().string());
        if (last.version() != first.version())
            refuse(file.string(), ": made by version ", last.version(), ", expected ", first.version(),
                   " as ", files.front().string());
    }
    const std::filesystem::path draft = out.string() + "." + std::to_string(::getpid()) + ".tmp";
    const struct Draft {
        const std::filesystem::path& file;
        ~Draft() {
            std::error_code none;
            std::filesystem::remove(file, none); // one that has its name is no more
            std::filesystem::remove(file.string() + "-journal", none);
        }
    } ending{draft};
    std::filesystem::remove(draft);
    std::uint64_t count = 0;
    {
        GenomeStore merged = GenomeStore::create(draft, all.front().setup());
        for (const GenomeStore& one : all)
            for (const Span& span : one.batches())
                copy(one, span, merged);
        count = merged.stored();
    }
    std::filesystem::rename(draft, out);
    return count;
}

} // namespace rough

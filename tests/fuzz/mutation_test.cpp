#include "domain/text/atomic_file.hpp"
#include "domain/text/zip.hpp"
#include "ga/base/random.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz/reader.hpp"

#include <iostream>

namespace fs = std::filesystem;

namespace {

constexpr std::size_t mutants_per_seed = 1000;
constexpr std::size_t max_bytes = 100'000;

/// Bytes that may break readers: extreme numbers, parts of words, brackets, invalid text.
constexpr std::array<std::string_view, 20> pieces{
    "0",        "-1",  "1e9", "1e308", "1e-320", "nan",  "99999999999999999999",
    "[[[[[[[[", "}",   "\"",  "\\u",   "\xFF",   "\xFE", "\xF0\x9F",
    "\r\n\r\n", ",,;", "= ",  "#",     "(",      "|"};

/// The first and the end of the word at a place: characters between separators of text formats.
std::pair<std::size_t, std::size_t> word_at(const std::string& bytes, std::size_t at) {
    constexpr const char* separators = " \t\r\n,;:=<>\"[]{}()|";
    const std::size_t before = bytes.find_last_of(separators, at);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    return {first, std::max(first, std::min(bytes.find_first_of(separators, at), bytes.size()))};
}

/// One to four changes. Those of bytes: a bit, a byte, an inserted piece, a removed or repeated part, an
/// early end. Those of structure: a word in another's place, a line removed or repeated, a binary number that
/// is extreme.
std::string mutant(std::string bytes, ga::Stream& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.below(n)); };
    for (std::size_t change = 0, changes = 1 + below(4); change < changes; ++change) {
        const std::size_t at = below(bytes.size() + 1), length = std::min(below(64) + 1, bytes.size() - at);
        switch (at == bytes.size() ? 2 : below(9)) {
        case 0:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 2:
            bytes.insert(at, pieces[below(pieces.size())]);
            break;
        case 3:
            bytes.erase(at, length);
            break;
        case 4:
            bytes.insert(at, bytes.substr(at, length));
            break;
        case 5:
            if (below(4) == 0) bytes.resize(at);
            break;
        case 6: {
            const auto [first, end] = word_at(bytes, at);
            const auto [from, to] = word_at(bytes, below(bytes.size()));
            bytes.replace(first, end - first,
                          below(2) == 0 ? bytes.substr(from, to - from) : pieces[below(pieces.size())]);
            break;
        }
        case 7: {
            const std::size_t first = bytes.rfind('\n', at) + 1, end = std::min(bytes.find('\n', at), bytes.size());
            if (first < end)
                below(2) == 0 ? bytes.erase(first, end - first)
                              : bytes.insert(first, bytes.substr(first, end - first) + "\n");
            break;
        }
        case 8: {
            constexpr std::array<std::uint64_t, 6> extremes{0, 1, 0x7fffffff, 0x80000000, ~0ULL, 0x7ff8000000000000};
            const std::size_t size = 1ULL << below(4), place = at / size * size;
            const std::uint64_t value = extremes[below(extremes.size())];
            for (std::size_t i = 0; i < size && place + i < bytes.size(); ++i)
                bytes[place + i] = static_cast<char>(value >> 8 * i & 0xff);
            break;
        }
        }
    }
    bytes.resize(std::min(bytes.size(), max_bytes));
    return bytes;
}

/// A mutant of a file. An archive is mostly packed again with one altered entry, as its check sums refuse
/// other changes.
std::string altered(const std::string& bytes, ga::Stream& random) {
    if (!bytes.starts_with("PK") || random.chance(0.2)) return mutant(bytes, random);
    const rough::Zip archive(bytes, "seed");
    std::vector<std::pair<std::string, std::string>> entries;
    for (const std::string name : {"main.xml", "bindata/data.bin", "bindata/valid.bin", "xl/workbook.xml",
                                   "xl/sharedStrings.xml", "xl/worksheets/sheet1.xml"})
        if (auto entry = archive.entry(name, max_bytes)) entries.emplace_back(name, std::move(*entry));
    std::string& entry = entries[random.below(entries.size())].second;
    entry = mutant(entry, random);
    return rough::zipped(entries);
}

} // namespace

// RUGOSA_FUZZ=N gives N mutants to each reader instead of 1,000 of each seed, and prints the counts.
TEST_CASE("a reader reads altered bytes or refuses them with its error") {
    const char* const requested = std::getenv("RUGOSA_FUZZ");
    REQUIRE(fuzz::readers().size() == 11);
    for (const fuzz::Reader& reader : fuzz::readers()) {
        std::vector<fs::path> seeds;
        for (const auto& entry : fs::directory_iterator(RUGOSA_SOURCE "/tests/fuzz/corpus/" + reader.name))
            seeds.push_back(entry.path());
        REQUIRE_FALSE(seeds.empty());
        std::sort(seeds.begin(), seeds.end());
        std::vector<std::string> files;
        for (const fs::path& seed : seeds) {
            INFO(seed.string());
            files.push_back(rough::read_whole(seed));
            CHECK_NOTHROW(reader.read(files.back()));
        }
        const std::size_t runs = requested ? std::stoul(requested) : mutants_per_seed * files.size();
        std::size_t read = 0;
        for (std::size_t run = 0; run < runs; ++run) {
            const std::string name = seeds[run % files.size()].filename();
            ga::Stream random(ga::fold(ga::fold(std::uint64_t{1}, name), std::uint64_t{run / files.size()}));
            const std::string bytes = altered(files[run % files.size()], random);
            try {
                read += fuzz::feed(reader, bytes);
            } catch (const std::exception& error) {
                FAIL_CHECK(reader.name << ", run " << run << ", a mutant of " << name << ": " << error.what());
            }
        }
        if (requested)
            std::cout << reader.name << ": " << runs << " runs, " << read << " read, " << runs - read << " refused\n";
    }
}

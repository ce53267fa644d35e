#include "domain/text/atomic_file.hpp"
#include "ga/base/random.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz/reader.hpp"

namespace fs = std::filesystem;

namespace {

constexpr int mutants_per_seed = 1000;
constexpr std::size_t max_bytes = 100'000;

/// Bytes that may break readers: extreme numbers, parts of words, brackets, invalid text.
constexpr std::array<std::string_view, 20> pieces{
    "0",        "-1",  "1e9", "1e308", "1e-320", "nan",  "99999999999999999999",
    "[[[[[[[[", "}",   "\"",  "\\u",   "\xFF",   "\xFE", "\xF0\x9F",
    "\r\n\r\n", ",,;", "= ",  "#",     "(",      "|"};

/// One to four changes: a bit, a byte, an inserted piece, a removed or repeated part, an early end.
std::string mutant(std::string bytes, ga::Stream& random) {
    const auto below = [&](std::size_t n) {
        return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(n)), n - 1);
    };
    for (std::size_t change = 0, changes = 1 + below(4); change < changes; ++change) {
        const std::size_t at = below(bytes.size() + 1), length = std::min(below(64) + 1, bytes.size() - at);
        switch (below(6)) {
        case 0:
            if (at < bytes.size())
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            if (at < bytes.size())
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
            if (below(4) == 0)
                bytes.resize(at);
            break;
        }
    }
    bytes.resize(std::min(bytes.size(), max_bytes));
    return bytes;
}

} // namespace

TEST_CASE("a reader reads altered bytes or refuses them with its error") {
    REQUIRE(fuzz::readers().size() == 11);
    for (const fuzz::Reader& reader : fuzz::readers()) {
        std::vector<fs::path> seeds;
        for (const auto& entry : fs::directory_iterator(RUGOSA_SOURCE "/tests/fuzz/corpus/" + reader.name))
            seeds.push_back(entry.path());
        REQUIRE_FALSE(seeds.empty());
        std::sort(seeds.begin(), seeds.end());
        for (const fs::path& seed : seeds) {
            const std::string bytes = rough::read_whole(seed);
            INFO(seed.string());
            CHECK_NOTHROW(reader.read(bytes));
            for (int i = 0; i < mutants_per_seed; ++i) {
                ga::Stream random(ga::fold(ga::fold(std::uint64_t{1}, seed.filename().string()),
                                           static_cast<std::uint64_t>(i)));
                const std::string altered = mutant(bytes, random);
                try {
                    fuzz::feed(reader, altered);
                } catch (const std::exception& error) {
                    FAIL_CHECK(reader.name << ", mutant " << i << " of " << seed.filename() << ": "
                                           << error.what());
                }
            }
        }
    }
}

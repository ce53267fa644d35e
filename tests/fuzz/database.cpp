#include "domain/database/store.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(database) {
    const rough::GenomeStore store = rough::GenomeStore::open(fuzz::as_file(bytes));
    const rough::StoredCurves curves = store.curves(true);
    for (const std::uint64_t index : curves.index) {
        store.genome(index);
        store.response(index);
    }
}

#pragma once

#include "domain/errors.hpp"
#include "ga/base/errors.hpp"
#include "tests/folder.hpp"

#include <functional>
#include <string_view>

namespace fuzz {

/// A reader to test. It may read given bytes or throw InputError or UsageError, and nothing else.
struct Reader {
    std::string name; ///< also the name of the folder of its seeds
    std::function<void(std::string_view)> read;
};

/// The readers of this program: one under libFuzzer, else all.
inline std::vector<Reader>& readers() {
    static std::vector<Reader> all;
    return all;
}

inline bool add(const char* name, void (*read)(std::string_view)) {
    readers().push_back({name, read});
    return true;
}

/// Gives bytes to a reader. Returns whether it read them. Other exceptions than the allowed ones are not
/// caught.
inline bool feed(const Reader& reader, std::string_view bytes) {
    try {
        reader.read(bytes);
        return true;
    } catch (const rough::InputError&) {
    } catch (const ga::UsageError&) {
    }
    return false;
}

/// The bytes as a file, always at the same place.
inline std::filesystem::path as_file(std::string_view bytes) {
    static const tests::Folder folder;
    return folder.write("input", std::string(bytes));
}

} // namespace fuzz

#ifdef RUGOSA_LIBFUZZER
#define RUGOSA_FUZZ_ENTRY                                                                                              \
    extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {                               \
        fuzz::feed(fuzz::readers().front(), {reinterpret_cast<const char*>(data), size});                              \
        return 0;                                                                                                      \
    }
#else
#define RUGOSA_FUZZ_ENTRY
#endif

/// FUZZ(name) { … bytes … }: a reader of that name, with seeds in corpus/name.
#define FUZZ(name)                                                                                                     \
    static void read_##name(std::string_view bytes);                                                                   \
    [[maybe_unused]] static const bool added_##name = fuzz::add(#name, read_##name);                                   \
    RUGOSA_FUZZ_ENTRY                                                                                                  \
    static void read_##name(std::string_view bytes)

#pragma once

#include "domain/errors.hpp"
#include "ga/base/errors.hpp"
#include "tests/folder.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// A reader under attack: it is given bytes, and takes them or throws InputError or UsageError, nothing else.
struct Reader {
    std::string name; ///< of its seeds' folder too
    std::function<void(std::string_view)> read;
};

/// All of this program: one where libFuzzer drives it, else every one.
inline std::vector<Reader>& readers() {
    static std::vector<Reader> all;
    return all;
}

inline bool add(const char* name, void (*read)(std::string_view)) {
    readers().push_back({name, read});
    return true;
}

/// Gives bytes to a reader; what it throws beyond its word goes on.
inline void feed(const Reader& reader, std::string_view bytes) {
    try {
        reader.read(bytes);
    } catch (const rough::InputError&) {
    } catch (const ga::UsageError&) {
    }
}

/// The bytes as a file, for readers of files; the same place each time.
inline std::filesystem::path as_file(std::string_view bytes) {
    static const tests::Folder folder;
    return folder.write("input", std::string(bytes));
}

} // namespace fuzz

#ifdef RUGOSA_LIBFUZZER
#define RUGOSA_FUZZ_ENTRY                                                                                    \
    extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {                     \
        fuzz::feed(fuzz::readers().front(), {reinterpret_cast<const char*>(data), size});                    \
        return 0;                                                                                            \
    }
#else
#define RUGOSA_FUZZ_ENTRY
#endif

/// FUZZ(name) { … bytes … }: a reader by that name, with seeds in corpus/name.
#define FUZZ(name)                                                                                           \
    static void read_##name(std::string_view bytes);                                                         \
    [[maybe_unused]] static const bool added_##name = fuzz::add(#name, read_##name);                         \
    RUGOSA_FUZZ_ENTRY                                                                                        \
    static void read_##name(std::string_view bytes)

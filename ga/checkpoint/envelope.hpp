#pragma once

#include "ga/base/errors.hpp"
#include "ga/problem/fingerprint.hpp"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace ga {

/// A sealed file: its mark, the length of what it holds, its fingerprint, and then that. A file that was cut
/// short or altered anywhere is known by it.
inline const std::string seal_mark = "rugosa checkpoint 2\n";

/// The mark, length and fingerprint of what is to be sealed.
inline std::string seal_of(std::string_view bytes) {
    const Fingerprint print = fingerprint(bytes);
    std::string seal = seal_mark;
    for (const std::uint64_t word : {static_cast<std::uint64_t>(bytes.size()), print.high, print.low})
        for (int shift = 0; shift < 64; shift += 8)
            seal += static_cast<char>(word >> shift & 0xff);
    return seal;
}

/// What a sealed file holds. Throws UsageError, naming the file, where it cannot be read or is not as it was
/// sealed.
inline std::string opened(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t head = seal_of({}).size();
    if (!stream.is_open() || all.size() < head ||
        all.compare(0, head, seal_of(std::string_view(all).substr(head))) != 0)
        throw UsageError("checkpoint '" + file.string() +
                         "' is damaged or none; expected a file as this version wrote it");
    return all.substr(head);
}

/// Writes a sealed file in the place of the one there, which is kept as "FILE.before": to a new file of its
/// own, no link followed, on the disk before it gets the name. What went wrong, in words; empty when nothing
/// did.
inline std::string seal(const std::filesystem::path& file, std::string_view bytes) {
    const std::filesystem::path draft = file.string() + ".tmp", before = file.string() + ".before";
    ::unlink(draft.c_str());
    const int descriptor = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return std::strerror(errno);
    std::string error;
    const std::string head = seal_of(bytes);
    for (std::string_view part : {std::string_view(head), bytes})
        while (!part.empty() && error.empty()) {
            const ssize_t written = ::write(descriptor, part.data(), part.size());
            if (written > 0)
                part.remove_prefix(static_cast<std::size_t>(written));
            else if (errno != EINTR)
                error = std::strerror(errno);
        }
    if (error.empty() && ::fsync(descriptor) != 0)
        error = std::strerror(errno);
    if (::close(descriptor) != 0 && error.empty())
        error = std::strerror(errno);
    if (!error.empty()) {
        ::unlink(draft.c_str());
        return error;
    }
    ::unlink(before.c_str());
    if (::link(file.c_str(), before.c_str()) != 0)
        ::rename(file.c_str(), before.c_str()); // on file systems without links
    if (::rename(draft.c_str(), file.c_str()) != 0) {
        error = std::strerror(errno);
        ::unlink(draft.c_str());
        return error;
    }
    const std::filesystem::path folder = file.parent_path();
    if (const int at = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        at >= 0) {
        ::fsync(at); // so that the name outlasts a loss of power
        ::close(at);
    }
    return "";
}

/// JSON of bytes, no deeper than a checkpoint is. Throws UsageError, naming the file, on anything deeper, and
/// nlohmann's exceptions on what is no CBOR.
inline nlohmann::json read_cbor(const std::string& bytes, const std::filesystem::path& file) {
    /// Builds the value as nlohmann's own reader does, and counts how deep it is.
    struct Bounded : nlohmann::detail::json_sax_dom_parser<nlohmann::json> {
        using Base = nlohmann::detail::json_sax_dom_parser<nlohmann::json>;
        using Base::Base;
        std::size_t depth = 0;
        bool start_object(std::size_t n) { return ++depth <= 64 && Base::start_object(n); }
        bool start_array(std::size_t n) { return ++depth <= 64 && Base::start_array(n); }
        bool end_object() { return --depth, Base::end_object(); }
        bool end_array() { return --depth, Base::end_array(); }
    };
    nlohmann::json j;
    Bounded reader(j, true);
    if (!nlohmann::json::sax_parse(bytes, &reader, nlohmann::json::input_format_t::cbor))
        throw UsageError("checkpoint '" + file.string() + "' nests too deep; expected one that a run wrote");
    return j;
}

} // namespace ga

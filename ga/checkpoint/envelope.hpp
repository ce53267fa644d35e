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

/// A sealed file has this mark, then the length and the fingerprint of its content, then the content. So a
/// file that was cut or altered is detected.
inline const std::string seal_mark = "rugosa checkpoint 2\n";

/// The mark, length and fingerprint for a content.
inline std::string seal_of(std::string_view bytes) {
    const Fingerprint print = fingerprint(bytes);
    std::string seal = seal_mark;
    for (const std::uint64_t word : {static_cast<std::uint64_t>(bytes.size()), print.high, print.low})
        for (int shift = 0; shift < 64; shift += 8)
            seal += static_cast<char>(word >> shift & 0xff);
    return seal;
}

/// Reads the content of a sealed file. Throws UsageError, with the file's name, if it cannot be read or was
/// altered.
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

/// Writes a sealed file and keeps the previous one as "FILE.before". The new file is on the disk before it
/// gets the name; symbolic links are not followed. Returns the error in words, or an empty text.
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
        ::rename(file.c_str(), before.c_str()); // if the file system has no hard links
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

/// Reads CBOR that is nested at most as deep as a checkpoint. Throws UsageError, with the file's name, if it
/// is deeper, and nlohmann's exceptions if it is not CBOR.
inline nlohmann::json read_cbor(const std::string& bytes, const std::filesystem::path& file) {
    /// Builds the value like nlohmann's reader, and counts the depth.
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

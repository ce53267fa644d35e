#include "ga/checkpoint/checkpoint.hpp"

#include "ga/base/held_folder.hpp"
#include "ga/base/json.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>

namespace ga {

std::string seal_of(std::string_view bytes) {
    const Fingerprint print = fingerprint(bytes);
    std::string seal = "rugosa checkpoint 2\n";
    for (const std::uint64_t word : {static_cast<std::uint64_t>(bytes.size()), print.high, print.low})
        for (int shift = 0; shift < 64; shift += 8) seal += static_cast<char>(word >> shift & 0xff);
    return seal;
}

std::string opened(const std::filesystem::path& file) {
    std::ifstream stream(held_path(file), std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t head = seal_of({}).size();
    if (!stream.is_open() || all.size() < head ||
        all.compare(0, head, seal_of(std::string_view(all).substr(head))) != 0)
        throw UsageError("checkpoint '" + file.string() +
                         "' is damaged or not a checkpoint; give a file that this version wrote");
    return all.substr(head);
}

std::string seal(const std::filesystem::path& name, std::string_view bytes) {
    const std::filesystem::path file = held_path(name), draft = file.string() + ".tmp",
                                before = file.string() + ".before";
    ::unlink(draft.c_str());
    std::FILE* const stream = std::fopen(draft.c_str(), "wbxe"); // x: a new file, e: not for child processes
    if (!stream) return std::strerror(errno);
    std::string error;
    const std::string head = seal_of(bytes);
    if (std::fwrite(head.data(), 1, head.size(), stream) < head.size() ||
        std::fwrite(bytes.data(), 1, bytes.size(), stream) < bytes.size() || std::fflush(stream) != 0 ||
        ::fsync(::fileno(stream)) != 0)
        error = std::strerror(errno);
    if (std::fclose(stream) != 0 && error.empty()) error = std::strerror(errno);
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
    if (const int at = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); at >= 0) {
        ::fsync(at); // so that the name outlasts a loss of power
        ::close(at);
    }
    return "";
}

nlohmann::json read_cbor(const std::string& bytes, const std::filesystem::path& file) {
    auto read = bounded_json(bytes, nlohmann::json::input_format_t::cbor);
    if (read.is_discarded())
        throw UsageError("checkpoint '" + file.string() + "' nests too deep; give one that a run wrote");
    return read;
}

void to_json(json& j, const Permutation& permutation) { j = permutation.order; }

void from_json(const json& j, Permutation& permutation) { j.get_to(permutation.order); }

void to_json(json& j, const Counters& c) {
    j = {c.requested, c.evaluations, c.remembered, c.gradients, c.failures, c.requested_price, c.price};
}

void from_json(const json& j, Counters& c) {
    read_parts(j, c.requested, c.evaluations, c.remembered, c.gradients, c.failures, c.requested_price, c.price);
}

json scored(const Fitness& fitness) {
    if (fitness.has_failed()) return {fitness.objective(), fitness.reason()};
    if (fitness.several()) return {fitness.objective(), fitness.values(), fitness.violation(), fitness.violations()};
    if (fitness.known())
        return {fitness.objective(),  fitness.value(),     fitness.violation(),
                fitness.violations(), fitness.minimises(), fitness.replicates()};
    return nullptr;
}
Fitness read_scored(const json& scored) {
    if (scored.is_null()) return {};
    const Name policy(scored.at(0).get<std::string>());
    if (scored.size() == 2) return Fitness::failed(policy, reason(scored.at(1).get<std::string>()));
    Fitness fitness;
    std::size_t replicates = 1;
    if (scored.size() == 4) {
        fitness = Fitness(policy, scored.at(1).get<Point>());
    } else {
        fitness = Fitness(policy, scored.at(1).get<double>(), scored.at(4).get<bool>());
        scored.at(5).get_to(replicates);
    }
    return fitness.constrained(scored.at(3), scored.at(2).get<double>()).averaged(replicates);
}

} // namespace ga

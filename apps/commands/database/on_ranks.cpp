#include "apps/cluster/crew.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/kinds.hpp"
#include "apps/commands/database/parts.hpp"
#include "domain/database/codec.hpp"

#include <nlohmann/json.hpp>

#include <deque>

namespace app {

using rough::Response;

namespace {

/// What a database keeps of a response.
std::string bytes_of(const Response& response) {
    std::vector<double> numbers{response.range};
    for (const auto* column : {&response.pressure, &response.contact_fraction, &response.tangent_stiffness})
        numbers.insert(numbers.end(), column->begin(), column->end());
    return rough::packed(numbers);
}

Response response_from(const std::string& bytes) {
    const std::vector<double> numbers = rough::unpacked(bytes);
    const auto steps = static_cast<rough::Index>((numbers.size() - 1) / 3);
    const Eigen::Map<const Eigen::MatrixXd> columns(numbers.data() + 1, steps, 3);
    Response response;
    response.range = numbers[0];
    response.pressure = columns.col(0);
    response.contact_fraction = columns.col(1);
    response.tangent_stiffness = columns.col(2);
    return response;
}

} // namespace

Work responses_under(const std::string& setting) {
    const auto fields = nlohmann::json::parse(setting).get<rough::Fields>();
    return [setup = rough::setup_from(fields, "the genome database")](const std::string& task) {
        return bytes_of(rough::response_for(setup, number_of<std::uint64_t>(task)));
    };
}

rough::Computing computing_on_ranks(int threads) {
    return [threads](const rough::DatabaseSetup& setup, const rough::Orders& orders) {
        std::deque<std::uint64_t> genomes; // by task, from the first that is not answered
        std::size_t first = 0;
        const std::uint64_t taken = ~std::uint64_t{0};
        crew::hand_out({.kind = "responses",
                        .setting = nlohmann::json(fields(setup)).dump(),
                        .threads = threads,
                        .count = orders.count,
                        .next = [&]() -> std::optional<std::string> {
                            const auto genome = orders.next();
                            if (!genome)
                                return std::nullopt;
                            genomes.push_back(*genome);
                            return number_bytes(*genome);
                        },
                        .take =
                            [&](std::size_t task, const std::string& answer) {
                                orders.take(std::exchange(genomes[task - first], taken),
                                            response_from(answer));
                                for (; !genomes.empty() && genomes.front() == taken; ++first)
                                    genomes.pop_front();
                            },
                        .ended = orders.ended});
    };
}

} // namespace app

#include "apps/commands/database/parts.hpp"
#include "domain/problem/stored.hpp"

namespace app {

using nlohmann::json;

cluster::Work responses_under(const json& setting) {
    const rough::DatabaseSetup setup = rough::setup_from(setting.get<rough::Fields>(), "the genome database");
    return [setup](const json& genome) {
        const rough::Response response = rough::response_for(setup, genome.get<std::uint64_t>());
        return json::array({genome, response.range, rough::numbers_of(response.pressure),
                            rough::numbers_of(response.contact_fraction),
                            rough::numbers_of(response.tangent_stiffness)});
    };
}

rough::Computing computing_on_ranks(int threads) {
    return [threads](const rough::DatabaseSetup& setup, const rough::Orders& orders) {
        cluster::hand_out({.kind = "responses",
                           .setting = rough::fields(setup),
                           .threads = threads,
                           .count = orders.count,
                           .task = [&](std::size_t) -> std::optional<json> {
                               const auto genome = orders.next();
                               return genome ? std::optional<json>(*genome) : std::nullopt;
                           },
                           .take =
                               [&](std::size_t, const json& answer) {
                                   rough::Response response;
                                   response.range = answer.at(1);
                                   response.pressure = rough::vector_from(answer.at(2));
                                   response.contact_fraction = rough::vector_from(answer.at(3));
                                   response.tangent_stiffness = rough::vector_from(answer.at(4));
                                   orders.take(answer.at(0), std::move(response));
                               },
                           .stopped = orders.ended});
    };
}

} // namespace app

#include "domain/accuracy/reduced.hpp"

#include "domain/errors.hpp"

namespace rough {

namespace {

ChromosomePlace place(const Genome& genome, std::size_t s, std::size_t c) {
    const Series& series = genome.series[s];
    const Chromosome& chromosome = series.chromosomes[c];
    return {s, chromosome.n, wave_length(series, chromosome.n),
            std::abs(genome.scale * wave(series, chromosome).amplitude)};
}

} // namespace

std::vector<ChromosomePlace> places(const Genome& genome) {
    std::vector<ChromosomePlace> all;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c)
            all.push_back(place(genome, s, c));
    return all;
}

Selection without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest) {
    std::vector<ChromosomePlace> order = places(genome);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.wave_length_mm < b.wave_length_mm; });
    Selection best{genome, places(genome)};
    double amplitude = 0;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        amplitude += order[k].amplitude_mm;
        if (amplitude > 2 * widest) // hopeless: the window is about twice the amplitudes' sum
            break;
        const double shortest = order[k + 1].wave_length_mm;
        if (shortest == order[k].wave_length_mm) // waves of equal length stay or go together
            continue;
        const auto stays = [&](std::size_t s, std::size_t c) {
            return place(genome, s, c).wave_length_mm >= shortest;
        };
        Profile reduced = whole;
        reduced.heights -= sample(filtered(genome, std::not_fn(stays)), grid).heights;
        const Window window = window_between(whole, reduced);
        if (window.width() <= widest) {
            const auto cut = order.begin() + static_cast<std::ptrdiff_t>(k) + 1;
            best = {filtered(genome, stays), {cut, order.end()}, {order.begin(), cut}, window};
        }
    }
    return best;
}

LineOfMap line_of_map(const Profile& map) {
    if (!map.is_2d())
        refuse("line of a map: the surface is a line; give a map");
    const auto [columns, rows] = map.shape();
    const Eigen::Map<const Eigen::MatrixXd> z(map.heights.data(), columns, rows);
    LineOfMap along_x{{z.rowwise().mean(), map.spacing}, true, {}},
        along_y{{z.colwise().mean().transpose(), map.row_spacing}, false, {}};
    Profile drawn_out = map;
    drawn_out.heights = along_x.line.heights.replicate(rows, 1);
    along_x.window = window_between(map, drawn_out);
    drawn_out.heights = along_y.line.heights.transpose().replicate(columns, 1).reshaped();
    along_y.window = window_between(map, drawn_out);
    return along_x.window.width() <= along_y.window.width() ? along_x : along_y;
}

std::optional<ByLine> respond_by_line(const Profile& map, const Model& model) {
    const Loading& loading = model.loading;
    const bool by_reach = loading.pressures.empty() && loading.to_pressure == 0;
    const LineOfMap of = line_of_map(map);
    try {
        const auto displacements =
            step_displacements(by_reach ? map : of.line, model.body, loading, model.contact);
        ContactCurve curve = solve_contact(of.line, model.body, displacements, model.contact);
        ByLine result{
            of, response_of(curve.steps, curve.solver, displacement_range(map, model.body.kernel), HUGE_VAL),
            std::move(curve.last_contact), HUGE_VAL};
        const Bounds bounds = pressure_bounds(of.line, of.window, model.body, displacements, model.contact);
        const Eigen::VectorXd& pressure = result.response.pressure;
        const Eigen::VectorXd errors =
            relative(doubt_of(pressure, bounds.lower, bounds.upper), error_scale(pressure));
        if (errors.allFinite())
            result.bound = errors.maxCoeff();
        return result;
    } catch (const InputError&) { // flat, or in full contact before the map is
        return std::nullopt;
    }
}

} // namespace rough

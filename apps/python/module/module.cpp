#include "apps/python/module/python.hpp"
#include "domain/errors.hpp"
#include "ga/base/errors.hpp"

#include <csignal>
#include <thread>

namespace rugosa::python {

namespace {

const std::thread::id importing = std::this_thread::get_id(); ///< Python handles signals in its main thread
Interruptible* current = nullptr;

void ask(int) {
    if (current)
        current->stop() = true;
}

} // namespace

Interruptible::Interruptible() {
    if (std::this_thread::get_id() != importing || current)
        return;
    current = this;
    holds_ = true;
    before_ = std::signal(SIGINT, ask);
}

Interruptible::~Interruptible() {
    if (!holds_)
        return;
    std::signal(SIGINT, before_);
    current = nullptr;
}

bool Interruptible::asked() const { return holds_ && stop_; }

namespace {

/// What only a profile has.
void expect_for_areas(const Keywords& keywords) {
    for (const char* name : {"datum", "strip_width", "accuracy"})
        if (keywords.has(name))
            throw rough::InputError(std::string(name) + ": given with an area, expected none: it is for "
                                                        "profiles alone");
}

rough::Model model_on(Keywords& keywords, const std::function<rough::Grid(bool wraps)>& grid) {
    rough::Model model;
    rough::Body& body = model.body;
    body.kernel = rough::kernel_named(keywords.take<std::string>("kernel", "free"));
    model.grid = grid(body.kernel == rough::Kernel::periodic);
    if (model.grid.is_2d()) {
        expect_for_areas(keywords);
        if (body.kernel == rough::Kernel::strip)
            throw rough::InputError("kernel: strip given with an area, expected free or periodic");
    }
    body.effective_modulus =
        rough::effective_modulus(keywords.take("modulus", 1.0), keywords.take("poisson", 0.0));
    body.datum = keywords.take("datum", 0.0);
    body.strip_width = keywords.take("strip_width", 0.0);
    body.hardness = keywords.take("hardness", body.hardness);
    rough::Loading& loading = model.loading;
    loading.steps = keywords.take("steps", loading.steps);
    loading.reach = keywords.take("reach", 0.0);
    loading.to_pressure = keywords.take("to_pressure", 0.0);
    if (auto pressures = keywords.take<std::vector<double>>("pressures")) {
        loading.pressures = std::move(*pressures);
        loading.steps = static_cast<int>(loading.pressures.size());
    }
    model.contact.solver = rough::solver_named(keywords.take<std::string>("solver", "auto"));
    model.contact.tolerance = keywords.take("tolerance", model.contact.tolerance);
    model.accuracy = keywords.take("accuracy", 0.0);
    model = completed(model);
    validate(model);
    return model;
}

} // namespace

rough::Grid grid_of(const OneOrTwo<rough::Index>& nodes, const OneOrTwo<double>& length) {
    rough::Grid grid;
    std::tie(grid.nodes, grid.rows) = both(nodes);
    std::tie(grid.length, grid.width) = both(length);
    if (grid.nodes < 2 || grid.rows < 2 || !(grid.length > 0 && grid.width > 0))
        throw rough::InputError("nodes, length: expected 2 nodes at least and a length above 0");
    if (nodes.index() + length.index() == 0) { // a line
        grid.rows = 1;
        grid.width = 0;
    } else if (static_cast<double>(grid.nodes) * static_cast<double>(grid.rows) > 1e7) {
        throw rough::InputError("nodes: " + std::to_string(grid.nodes) + " x " + std::to_string(grid.rows) +
                                " given, expected at most 1e7 in all");
    }
    return grid;
}

rough::Model model_from(Keywords& keywords) {
    const rough::Grid usual;
    const auto nodes = keywords.take("nodes", OneOrTwo<rough::Index>(usual.nodes));
    const rough::Grid grid = grid_of(nodes, keywords.take("length", OneOrTwo<double>(usual.length)));
    return model_on(keywords, [&](bool) { return grid; });
}

rough::Model model_from(Keywords& keywords, const rough::Profile& surface) {
    const auto [columns, rows] = surface.shape();
    return model_on(keywords, [&, columns = columns, rows = rows](bool wraps) {
        const auto length = [&](double spacing, rough::Index n) {
            return spacing * static_cast<double>(wraps ? n : n - 1);
        };
        rough::Grid grid{columns, length(surface.spacing, columns)};
        if (surface.is_2d()) {
            grid.rows = rows;
            grid.width = length(surface.row_spacing, rows);
        }
        return grid;
    });
}

} // namespace rugosa::python

PYBIND11_MODULE(_rugosa, module) {
    using namespace rugosa::python;
    module.attr("__version__") = RUGOSA_VERSION;
    py::register_exception<rough::InputError>(module, "InputError", PyExc_ValueError);
    py::register_exception<rough::NotConverged>(module, "NotConverged", PyExc_RuntimeError);
    py::register_exception<ga::UsageError>(module, "UsageError", PyExc_ValueError);
    add_genome(module);
    add_profile(module);
    add_contact(module);
    add_target(module);
    add_design(module);
    add_database(module);
    add_engine(module);
}

#include "apps/python/module/python.hpp"
#include "domain/errors.hpp"
#include "ga/errors.hpp"

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

rough::Model model_on(Keywords& keywords, const std::function<rough::Grid(bool wraps)>& grid) {
    rough::Model model;
    rough::Body& body = model.body;
    body.kernel = rough::kernel_named(keywords.take<std::string>("kernel", "free"));
    body.effective_modulus =
        rough::effective_modulus(keywords.take("modulus", 1.0), keywords.take("poisson", 0.0));
    body.datum = keywords.take("datum", 0.0);
    body.strip_width = keywords.take("strip_width", 0.0);
    body.hardness = keywords.take("hardness", body.hardness);
    model.grid = grid(body.kernel == rough::Kernel::periodic);
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

rough::Model model_from(Keywords& keywords) {
    rough::Grid grid;
    grid.nodes = keywords.take("nodes", grid.nodes);
    grid.length = keywords.take("length", grid.length);
    return model_on(keywords, [&](bool) { return grid; });
}

rough::Model model_from(Keywords& keywords, const rough::Profile& profile) {
    const rough::Index n = profile.nodes();
    return model_on(keywords, [&](bool wraps) {
        return rough::Grid{n, profile.spacing * static_cast<double>(wraps ? n : n - 1)};
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

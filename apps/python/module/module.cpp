#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"

#include <csignal>

namespace rugosa::python {
namespace {

const std::thread::id main_thread = std::this_thread::get_id(); ///< handles Python's signals
Interruptible* current = nullptr;

void request_stop(int) {
    if (current) current->stop() = true;
}

/// A value as in the program's flags and keys: "on", "1e-3", "64x48" or, between commas, "1,2". A list of
/// layers has one line each, "T:E:NU".
std::string text_of(const py::handle& value, const std::string& between) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "on" : "off";
    if (py::isinstance<py::str>(value) || !py::hasattr(value, "__len__")) return py::str(value);
    std::string text;
    for (const py::handle each : value)
        text += (text.empty() ? "" : between) + text_of(each, between == "\n" ? ":" : between);
    return text;
}

rough::Model with_load(rough::Model model, const app::Settings& settings) {
    settings.take("accuracy", model.accuracy);
    model = loaded(std::move(model), settings);
    validate(model);
    return model;
}

} // namespace

Interruptible::Interruptible() {
    if (std::this_thread::get_id() != main_thread || current) return;
    current = this;
    holds_ = true;
    before_ = std::signal(SIGINT, request_stop);
}

Interruptible::~Interruptible() {
    if (!holds_) return;
    std::signal(SIGINT, before_);
    current = nullptr;
}

void Interruptible::rethrow() const {
    if (!requested()) return;
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
}

app::Settings Keywords::settings(const std::vector<app::Setting>& known, const std::vector<std::string>& except) {
    std::map<std::string, std::string> given;
    for (const app::Setting& setting : known) {
        const std::string keyword = app::keyword(setting.name);
        if (std::find(except.begin(), except.end(), keyword) == except.end())
            if (const auto value = take<py::object>(keyword))
                given[setting.name] = text_of(*value, setting.between ? std::string(1, setting.between) : "x");
    }
    return {app::Settings::keywords, known, given};
}

rough::Model model_from(Keywords& keywords) {
    const app::Settings settings = keywords.settings(response_settings());
    return with_load(surface_model_from(settings), settings);
}

rough::Model model_from(Keywords& keywords, const rough::Profile& surface) {
    const app::Settings settings = keywords.settings(response_settings(), {"nodes", "length"});
    return with_load(model_of(surface, settings), settings);
}

const std::vector<app::Setting>& response_settings() {
    static const auto all = app::joined(
        {app::model_settings(), {app::accuracy_setting("the response of the whole model")}, app::loading_settings()});
    return all;
}

std::string documented(std::string text, const std::vector<app::Setting>& settings,
                       const std::vector<std::string>& except) {
    for (const app::Setting& setting : settings)
        if (const std::string keyword = app::keyword(setting.name);
            std::find(except.begin(), except.end(), keyword) == except.end())
            text += "\n" + keyword + ": " + setting.meaning +
                    (setting.fallback.empty() ? "" : " [" + setting.fallback + "]");
    return text;
}

} // namespace rugosa::python

PYBIND11_MODULE(_rugosa, module) {
    using namespace rugosa::python;
    module.attr("__version__") = RUGOSA_VERSION;
    py::register_exception<rough::InputError>(module, "InputError", PyExc_ValueError);
    py::register_exception<rough::NotConverged>(module, "NotConverged", PyExc_RuntimeError);
    py::register_exception<ga::UsageError>(module, "UsageError", PyExc_ValueError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const py::cast_error&) { // its message is about C++
            PyErr_SetString(PyExc_TypeError, "a value has the wrong type; give another type");
        }
    });
    add_genome(module);
    add_profile(module);
    add_contact(module);
    add_target(module);
    add_design(module);
    add_database(module);
    add_engine(module);
}

#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/domain.hpp"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rugosa::python {

namespace py = pybind11;

///@{
/// Each adds its classes and functions to the module.
void add_genome(py::module_& module);
void add_profile(py::module_& module);
void add_contact(py::module_& module);
void add_target(py::module_& module);
void add_design(py::module_& module);
void add_database(py::module_& module);
void add_engine(py::module_& module);
///@}

/// What a Python caller says of a model set-up and a search, each word taken once.
class Keywords {
  public:
    Keywords(const py::dict& given, std::string of) : of_(std::move(of)) {
        for (const auto& [name, value] : given)
            if (!value.is_none())
                left_[py::cast<std::string>(name)] = py::reinterpret_borrow<py::object>(value);
    }
    /// The value, if it was given (None is not).
    template <class T>
    std::optional<T> take(const std::string& name) {
        const auto found = left_.find(name);
        if (found == left_.end())
            return {};
        const py::object value = std::move(found->second);
        left_.erase(found);
        try {
            return py::cast<T>(value);
        } catch (const py::cast_error&) {
            throw py::type_error(of_ + ": " + name + "=" + std::string(py::repr(value)) +
                                 " given, expected another type");
        }
    }
    /// The value, or what stands for it.
    template <class T>
    T take(const std::string& name, T otherwise) {
        return take<T>(name).value_or(std::move(otherwise));
    }
    /// The keywords with the names of these settings ('_' for '-'), to be read as the program reads its
    /// flags.
    app::Settings settings(const std::vector<app::Setting>& known, const std::vector<std::string>& but = {});
    /// Throws TypeError that names a keyword nobody took.
    void expect_none_left() const {
        if (!left_.empty())
            throw py::type_error(of_ + ": unknown keyword '" + left_.begin()->first + "'");
    }

  private:
    std::string of_;
    std::map<std::string, py::object> left_;
};

/// A number, or one along x and one along y.
template <class Number>
using OneOrTwo = std::variant<Number, std::pair<Number, Number>>;
template <class Number>
std::pair<Number, Number> both(const OneOrTwo<Number>& given) {
    const Number* one = std::get_if<Number>(&given);
    return one ? std::pair(*one, *one) : std::get<std::pair<Number, Number>>(given);
}
/// Distance of nodes, mm, where it is given.
using Spacing = std::optional<OneOrTwo<double>>;

/// A response as Python holds it, with what was asked for beside it.
struct Curve {
    rough::Response response;
    Eigen::MatrixXd pressure_gradient;     ///< steps x heights or genes; empty unless asked for
    Eigen::VectorXd displacement_gradient; ///< of the last step's displacement
    Eigen::VectorXd smooth_fraction;       ///< contact fraction that has a gradient, and that; empty likewise
    Eigen::MatrixXd fraction_gradient;
    std::string account;        ///< within an accuracy, in words
    rough::ResolutionBand band; ///< empty unless it was asked for and computed
};

/// Heights over an area; Python has them in two dimensions.
struct Surface : rough::Profile {};

/// The model that keywords named like the program's flags describe, for a genome: on 512 nodes over 0.84942
/// mm unless `nodes` and `length` say otherwise.
rough::Model model_from(Keywords& keywords);
/// The same on a surface's own nodes.
rough::Model model_from(Keywords& keywords, const rough::Profile& surface);

/// How a response is computed: keywords of contact(), named like the program's flags.
const std::vector<app::Setting>& response_settings();
/// A docstring with a line for each setting, but these keywords.
std::string documented(std::string text, const std::vector<app::Setting>& settings,
                       const std::vector<std::string>& but = {});

/// Heights (mm) and their distance as a caller gives them: a Profile or Surface, or an array of one or two
/// dimensions and a spacing.
rough::Profile surface_from(const py::object& heights, const Spacing& spacing, const std::string& of);
/// The same where only a profile will do.
rough::Profile profile_from(const py::object& heights, const Spacing& spacing, const std::string& of);
/// As Python has it: a Surface where it is an area, else a Profile.
py::object as_python(rough::Profile surface);

/// From its construction on, Ctrl-C asks the C++ work of the main thread to stop instead of raising
/// KeyboardInterrupt later; in other threads it does nothing.
class Interruptible {
  public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    bool asked() const;                         ///< whether Ctrl-C was pressed
    std::atomic<bool>& stop() { return stop_; } ///< for budgets; whoever else wants an end sets it, too

  private:
    std::atomic<bool> stop_ = false;
    void (*before_)(int) = nullptr;
    bool holds_ = false;
};

/// A callable's exception, carried through C++ work that it ends.
class Callback {
  public:
    explicit Callback(std::atomic<bool>& stop) : stop_(stop) {}
    /// Calls with the interpreter's lock; an exception is kept and asks the work to stop.
    template <class Call>
    void operator()(Call call) {
        const py::gil_scoped_acquire lock;
        if (error_)
            return;
        try {
            call();
        } catch (...) {
            error_ = std::current_exception();
            stop_ = true;
        }
    }
    bool failed() const { return error_ != nullptr; }
    void rethrow() const {
        if (error_)
            std::rethrow_exception(error_);
    }

  private:
    std::atomic<bool>& stop_;
    std::exception_ptr error_;
};

} // namespace rugosa::python

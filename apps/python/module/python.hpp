#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/accuracy/resolution.hpp"
#include "domain/scan/scan.hpp"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rugosa::python {

namespace py = pybind11;

///@{
/// Adds classes and functions to the module.
void add_genome(py::module_& module);
void add_profile(py::module_& module);
void add_contact(py::module_& module);
void add_target(py::module_& module);
void add_design(py::module_& module);
void add_database(py::module_& module);
void add_engine(py::module_& module);
///@}

/// The keyword arguments of a call. Each is taken once.
class Keywords {
  public:
    /// `where` begins the messages.
    Keywords(const py::dict& given, std::string where) : where_(std::move(where)) {
        for (const auto& [name, value] : given)
            if (!value.is_none()) left_[py::cast<std::string>(name)] = py::reinterpret_borrow<py::object>(value);
    }
    /// The value, or nothing if it was not given or is None. Throws TypeError if it has another type.
    template <class T>
    std::optional<T> take(const std::string& name) {
        const auto found = left_.find(name);
        if (found == left_.end()) return {};
        const py::object value = std::move(found->second);
        left_.erase(found);
        try {
            return py::cast<T>(value);
        } catch (const py::cast_error&) {
            throw py::type_error(where_ + ": " + name + "=" + std::string(py::repr(value)) +
                                 " has the wrong type; give another type");
        }
    }
    /// The value, or `fallback` if it was not given or is None.
    template <class T>
    T take(const std::string& name, T fallback) {
        return take<T>(name).value_or(std::move(fallback));
    }
    /// The numbers of a list or an array of one dimension, or nothing as by take(). Throws InputError.
    std::optional<Eigen::VectorXd> take_numbers(const std::string& name);
    /// The keywords with the names of these settings ('_' for '-') except some, read as the program reads its flags.
    app::Settings settings(const std::vector<app::Setting>& known, const std::vector<std::string>& except = {});
    /// The keywords as by `settings` of a call that takes no others.
    app::Settings only(const std::vector<app::Setting>& known) {
        app::Settings all = settings(known);
        expect_none_left();
        return all;
    }
    /// Throws TypeError that names a keyword that was not taken.
    void expect_none_left() const {
        if (!left_.empty()) throw py::type_error(where_ + ": unknown keyword '" + left_.begin()->first + "'");
    }

  private:
    std::string where_;
    std::map<std::string, py::object> left_;
};

/// Real numbers in the order of rows.
using RealArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// The numbers of an array or of lists, NaN at masked points. Throws InputError that begins with `where` on
/// text, complex numbers, rows of different lengths and other objects.
RealArray array_from(const py::object& given, const std::string& where);
/// The numbers of an array or a list of one dimension. Throws InputError.
Eigen::VectorXd numbers_from(const py::object& given, const std::string& where);

/// A number, or one along x and one along y.
using OneOrTwo = std::variant<double, std::pair<double, double>>;
/// Distance of the nodes, mm, if it is given.
using Spacing = std::optional<OneOrTwo>;

/// A response, with its resolution band and derivatives, each empty unless it was requested.
struct Curve : rough::Response, rough::ResolutionBand {
    Eigen::MatrixXd pressure_gradient;         ///< steps x heights or genes
    Eigen::VectorXd displacement_gradient;     ///< derivative of the last displacement, heights or genes
    Eigen::VectorXd smooth_contact_fraction;   ///< contact fraction that has a gradient, one per step
    Eigen::MatrixXd contact_fraction_gradient; ///< its derivative, steps x heights or genes
    std::string account;                       ///< how it was modelled within an accuracy, in words
    rough::Profile surface;                    ///< heights that were pressed
    rough::Body body;                          ///< body of the contact
};

/// Heights on a 2-D grid.
struct Surface : rough::Profile {};

/// The model that keywords describe for a genome, by default on 512 nodes over 0.84942 mm.
rough::Model model_from(Keywords& keywords);
/// The model that keywords describe on the nodes of a surface.
rough::Model model_from(Keywords& keywords, const rough::Profile& surface);

/// The keywords of contact(), named like the program's flags.
const std::vector<app::Setting>& response_settings();
/// A docstring with a line for each setting except some.
std::string documented(std::string text, const std::vector<app::Setting>& settings,
                       const std::vector<std::string>& except = {});

/// Whether missing points are filled, and how many may be.
struct Filling {
    bool fill = false;
    double max_filled = rough::ScanOptions().max_filled;
    std::vector<rough::Index> filled = {}; ///< the filled points, once they are
};
/// The keywords fill and max_filled.
Filling filling_from(Keywords& keywords);
/// The surface that a caller gives: a Profile or Surface, or an array of one or two dimensions (mm) and a
/// spacing. NaN and masked points are missing: they are filled, or refused; those at the ends of a line are
/// left out. `where` begins the messages.
rough::Profile surface_from(const py::object& heights, const Spacing& spacing, const std::string& where,
                            Filling& filling);
/// States the effect of filled points on the contact as a Python warning, if there are any.
void warn_of_filling(const rough::Profile& surface, const Filling& filling, const rough::Model& model);
/// A Surface if it is 2-D, else a Profile.
py::object as_python(rough::Profile surface);

/// While it lives, Ctrl-C sets `stop` for C++ work of the main thread, and raises no KeyboardInterrupt. In
/// other threads it has no effect.
class Interruptible {
  public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    bool requested() const { return holds_ && stop_; } ///< whether Ctrl-C was pressed
    void rethrow() const;                              ///< throws Python's KeyboardInterrupt if it was
    std::atomic<bool>& stop() { return stop_; }        ///< for budgets; others may set it, too

  private:
    std::atomic<bool> stop_ = false;
    void (*before_)(int) = nullptr;
    bool holds_ = false;
};

/// Calls Python from C++ work. An exception ends the work and is rethrown after it.
class Callback {
  public:
    explicit Callback(std::atomic<bool>& stop) : stop_(stop) {}
    /// Calls with the interpreter's lock. An exception is kept and stops the work; further calls do nothing.
    template <class Call>
    void operator()(Call call) {
        const py::gil_scoped_acquire lock;
        if (error_) return;
        try {
            call();
        } catch (const py::cast_error&) {
            error_ = std::make_exception_ptr(
                rough::InputError("a function of yours returned values of a wrong type; return numbers"));
        } catch (...) {
            error_ = std::current_exception();
        }
        if (error_) stop_ = true;
    }
    /// Returns work(), which runs without the interpreter's lock. Rethrows a kept exception instead.
    template <class Work>
    auto unlocked(Work work) const {
        std::invoke_result_t<Work> result;
        try {
            const py::gil_scoped_release unlocked;
            result = work();
        } catch (const std::exception&) {
            rethrow();
            throw;
        }
        rethrow();
        return result;
    }
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    std::atomic<bool>& stop_;
    std::exception_ptr error_;
};

} // namespace rugosa::python

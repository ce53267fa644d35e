#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"

#include <pybind11/numpy.h>

namespace rugosa::python {

using rough::Profile;
using namespace py::literals;

Filling filling_from(Keywords& keywords) {
    Filling filling;
    filling.fill = keywords.take<bool>("fill", filling.fill);
    filling.max_filled = keywords.take<double>("max_filled", filling.max_filled);
    return filling;
}

RealArray array_from(const py::object& given, const std::string& where) {
    std::string kind;
    try {
        const py::object array = py::module_::import("numpy").attr("asanyarray")(given);
        kind = array.attr("dtype").attr("kind").cast<std::string>();
        if (rough::is_in(" b i u f O ", kind)) {
            const py::object real = array.attr("astype")("float64", "copy"_a = false);
            return RealArray(py::hasattr(real, "filled") ? real.attr("filled")(std::nan("")) : real);
        }
    } catch (const py::error_already_set&) { // rows of different lengths, other objects
    }
    rough::refuse(where, ": ", kind == "c" ? "complex numbers" : "no array of numbers",
                  "; give real numbers, in rows of one length");
}

Eigen::VectorXd numbers_from(const py::object& given, const std::string& where) {
    const RealArray array = array_from(given, where);
    if (array.ndim() != 1) rough::refuse(where, ": an array of ", array.ndim(), " dimensions; give one dimension");
    return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

std::optional<Eigen::VectorXd> Keywords::take_numbers(const std::string& name) {
    const auto given = take<py::object>(name);
    return given ? std::optional(numbers_from(*given, where_ + ": " + name)) : std::nullopt;
}

void warn_of_filling(const Profile& surface, const Filling& filling, const rough::Model& model) {
    if (filling.filled.empty()) return;
    const std::string note = app::fill_note(surface, filling.filled, model);
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
}

namespace {

/// Fills the missing points of a surface. Leaves those at the ends of a line out.
Profile without_holes(Profile surface, const std::string& where, Filling& filling) {
    rough::MissingPoints missing = missing_points(surface);
    if (!missing) return surface;
    if (!filling.fill) rough::refuse(where, ": ", in_words(missing, surface.is_2d()), "; give fill=True to fill them");
    const auto measured = [&](rough::Index i) { return !std::isnan(surface.heights[i]); };
    rough::Index first = 0, end = surface.nodes();
    while (!surface.is_2d() && first < end && !measured(first)) ++first;
    while (!surface.is_2d() && end > first && !measured(end - 1)) --end;
    if (end - first < surface.nodes() && end > first) {
        surface.heights = surface.heights.segment(first, end - first).eval();
        missing = missing_points(surface);
    }
    filling.filled = missing.nodes;
    expect_fillable(missing, filling.max_filled, surface.is_2d(), where + ": max_filled");
    return filled(std::move(surface), missing);
}

py::dict in_dictionary(const rough::SurfaceParameters& parameters) {
    py::dict all;
    for (const rough::SurfaceParameter& one : parameters.rows)
        all[py::str(one.name == "rms curvature" ? "rms_curvature" : one.name)] = one.value;
    return all;
}

/// A Profile from one spacing, or a Surface from one or two.
template <class Shape, class Distance>
Shape shape_from(const py::object& heights, const Distance& spacing, bool fill, double max_filled) {
    const bool is_map = std::is_same_v<Shape, Surface>;
    const char* const name = is_map ? "Surface" : "Profile";
    Filling filling{fill, max_filled};
    Shape shape{surface_from(heights, OneOrTwo(spacing), name, filling)};
    if (shape.is_2d() != is_map)
        rough::refuse(name, ": the heights have ", is_map ? "1 dimension; give two" : "2 dimensions; give one");
    return shape;
}

Profile row_of(const Surface& surface, rough::Index row) {
    if (row < 0 || row >= surface.rows)
        throw py::index_error(rough::line_of("row: ", row, " is out of range (0 to ", surface.rows - 1, ")"));
    const rough::Index columns = surface.shape().columns;
    return {surface.heights.segment(row * columns, columns), surface.spacing};
}

/// The options of a scan that a map has, too.
std::vector<app::Setting> map_options() {
    std::vector<app::Setting> options = app::scan_settings();
    std::erase_if(options, [](const app::Setting& option) { return option.name == "row"; });
    return options;
}

Surface read_surface(const std::filesystem::path& file, const py::kwargs& options) {
    const auto settings = Keywords(options, "read").only(app::joined({{app::map_setting()}, map_options()}));
    return {app::surface_from(settings.with({{"surface", file.string()}}, app::scan_settings())).measured};
}

py::tuple read_profile(const std::filesystem::path& file, const py::kwargs& options) {
    const auto settings = Keywords(options, "read").only(app::scan_settings());
    app::Source source = app::scan_from(file, settings, 0);
    return py::make_tuple(std::move(source.measured), std::move(source.account));
}

} // namespace

Profile surface_from(const py::object& heights, const Spacing& spacing, const std::string& where, Filling& filling) {
    if (const bool map = py::isinstance<Surface>(heights); map || py::isinstance<Profile>(heights)) {
        if (spacing) throw py::type_error(where + ": a Profile or Surface has a spacing; leave spacing out");
        return map ? heights.cast<const Surface&>() : heights.cast<const Profile&>();
    }
    const RealArray array = array_from(heights, where);
    if (array.ndim() != 1 && array.ndim() != 2)
        rough::refuse(where, ": the heights have ", array.ndim(), " dimensions; give one or two dimensions");
    if (!spacing) throw py::type_error(where + ": spacing is missing; give the distance of the nodes, mm");
    if (array.ndim() == 1 && spacing->index() == 1)
        throw py::type_error(where + ": two spacings for heights along a line; give one");
    const double* one = std::get_if<double>(&*spacing);
    const auto [along, across] = one ? std::pair(*one, *one) : std::get<1>(*spacing);
    if (!(along > 0 && across > 0))
        rough::refuse(where, ": spacing ", along > 0 ? across : along, " is out of range (above 0)");
    Profile surface{Eigen::Map<const Eigen::VectorXd>(array.data(), array.size()), along};
    if (array.ndim() == 2) {
        if (array.shape(0) < 2 || array.shape(1) < 2)
            rough::refuse(where, ": a map of ", array.shape(0), " x ", array.shape(1), " heights; give at least 2 x 2");
        surface.rows = array.shape(0);
        surface.row_spacing = across;
    }
    return without_holes(std::move(surface), where, filling);
}

py::object as_python(Profile surface) {
    return surface.is_2d() ? py::cast(Surface{std::move(surface)}) : py::cast(std::move(surface));
}

void add_profile(py::module_& module) {
    py::class_<Profile>(module, "Profile", R"(Heights on an even grid (mm).

>>> import numpy, rugosa
>>> x = numpy.arange(512) / 512
>>> wave = rugosa.Profile(0.01 * numpy.cos(2 * numpy.pi * x), 1 / 512)
>>> round(wave.roughness()['Pq'], 6)
0.007071
)")
        .def(py::init(&shape_from<Profile, double>), "heights"_a, "spacing"_a, "fill"_a = false,
             "max_filled"_a = rough::ScanOptions().max_filled,
             "heights: N numbers, mm; spacing: their distance, mm. NaN and masked points are missing; fill: "
             "whether they are interpolated linearly, at most the share max_filled.")
        .def_readonly("heights", &Profile::heights, "N heights, mm: a read-only view.")
        .def_readonly("spacing", &Profile::spacing, "Distance of the nodes, mm.")
        .def_property_readonly("nodes", &Profile::nodes, "Number of nodes.")
        .def(
            "roughness", [](const Profile& profile) { return in_dictionary(roughness(profile)); },
            "Pa, Pq, Pz, ... (ISO 21920-2; heights in mm), spectral moments and bandwidth.")
        .def(
            "spectrum",
            [](const Profile& profile) {
                rough::Spectrum s = continuous_spectrum(profile);
                return py::make_tuple(std::move(s.wave_number), std::move(s.density));
            },
            "(q in rad/mm, C(q) in mm^3): the one-sided power spectral density.")
        .def("__len__", &Profile::nodes)
        .def("__repr__", [](const Profile& p) {
            return rough::line_of("<rugosa.Profile of ", p.nodes(), " nodes, ", p.spacing, " mm apart>");
        });
    py::class_<Surface>(module, "Surface",
                        R"(Heights on a 2-D grid (mm): a row along x, y grows from row to row.

>>> import numpy, rugosa
>>> surface = rugosa.Surface(numpy.random.default_rng(1).random((32, 48)), 0.01)
>>> surface.nodes, surface.heights.shape
((48, 32), (32, 48))
)")
        .def(py::init(&shape_from<Surface, OneOrTwo>), "heights"_a, "spacing"_a, "fill"_a = false,
             "max_filled"_a = rough::ScanOptions().max_filled,
             "heights: N_y x N_x numbers, mm; spacing: their distance, mm, or those along x and y. NaN and "
             "masked points are missing; fill: whether they are filled by Laplace's equation, at most the "
             "share max_filled.")
        .def_property_readonly(
            "heights",
            [](const py::object& self) {
                const auto& surface = self.cast<const Surface&>();
                const auto [columns, rows] = surface.shape();
                py::array_t<double> heights({rows, columns}, surface.heights.data(), self);
                heights.attr("flags").attr("writeable") = false;
                return heights;
            },
            "N_y x N_x heights, mm: a read-only view.")
        .def_property_readonly(
            "spacing", [](const Surface& s) { return std::pair(s.spacing, s.row_spacing); },
            "Distances of the nodes along x and y, mm.")
        .def_property_readonly(
            "nodes", [](const Surface& s) { return std::pair(s.shape().columns, s.rows); },
            "Numbers of nodes along x and y.")
        .def(
            "roughness",
            [](const Surface& surface, bool periodic) { return in_dictionary(areal_parameters(surface, periodic)); },
            "periodic"_a = false,
            "Sa, Sq, Sdq, Sal, Str, ... (ISO 25178-2, lengths in mm) about the mean plane. periodic: "
            "whether\n"
            "the surface repeats.")
        .def("row", &row_of, "row"_a, "One row as a Profile, counted from 0.")
        .def("__repr__", [](const Surface& s) {
            return rough::line_of("<rugosa.Surface of ", s.shape().columns, " x ", s.rows, " nodes, ", s.spacing, " x ",
                                  s.row_spacing, " mm apart>");
        });
    module.def("read_surface", &read_surface, "file"_a,
               documented("Reads a map: X3P, SDF, SUR, GSF, GWY, columns x, y, height, or a text matrix with "
                          "its spacing (a pair along x and y).",
                          map_options())
                   .c_str());
    module.def(
        "read_profile", &read_profile, "file"_a,
        documented("Reads a measured scan: (Profile, how it was read and changed, in words).", app::scan_settings())
            .c_str());
}

} // namespace rugosa::python

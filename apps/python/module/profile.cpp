#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/map.hpp"

#include <pybind11/numpy.h>

namespace rugosa::python {

using rough::Profile;

Profile surface_from(const py::object& heights, const Spacing& spacing, const std::string& of) {
    if (const bool map = py::isinstance<Surface>(heights); map || py::isinstance<Profile>(heights)) {
        if (spacing)
            throw py::type_error(of + ": spacing given with a surface, which has its own");
        return map ? heights.cast<const Surface&>() : heights.cast<const Profile&>();
    }
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(heights);
    if (!array)
        throw py::error_already_set();
    if (array.ndim() != 1 && array.ndim() != 2)
        throw rough::InputError(of + ": heights of " + std::to_string(array.ndim()) +
                                " dimensions given, expected one or two");
    if (!spacing)
        throw py::type_error(of + ": spacing is missing, expected the distance of the nodes, mm");
    if (array.ndim() == 1 && spacing->index() == 1)
        throw py::type_error(of + ": two spacings given with heights along a line, expected one");
    const auto [along, across] = both(*spacing);
    for (const double distance : {along, across})
        if (!(distance > 0))
            throw rough::InputError(of + ": spacing " + rough::line_of(distance) +
                                    " given, expected above 0");
    Profile surface{Eigen::Map<const Eigen::VectorXd>(array.data(), array.size()), along};
    if (array.ndim() == 2) {
        if (array.shape(0) < 2 || array.shape(1) < 2)
            throw rough::InputError(of + ": a map of " + std::to_string(array.shape(0)) + " x " +
                                    std::to_string(array.shape(1)) +
                                    " heights given, expected 2 x 2 at least");
        surface.rows = array.shape(0);
        surface.row_spacing = across;
    }
    return surface;
}

Profile profile_from(const py::object& heights, const Spacing& spacing, const std::string& of) {
    Profile profile = surface_from(heights, spacing, of);
    if (profile.is_2d())
        throw rough::InputError(of + ": heights of 2 dimensions given, expected one");
    return profile;
}

py::object as_python(Profile surface) {
    return surface.is_2d() ? py::cast(Surface{std::move(surface)}) : py::cast(std::move(surface));
}

namespace {

py::dict in_dictionary(const rough::SurfaceParameters& parameters) {
    py::dict all;
    for (const rough::SurfaceParameter& one : parameters.rows)
        all[py::str(one.name == "rms curvature" ? "rms_curvature" : one.name)] = one.value;
    return all;
}

/// The options of a scan that a map has, too.
std::vector<app::Setting> map_options() {
    std::vector<app::Setting> options = app::scan_settings();
    std::erase_if(options, [](const app::Setting& option) {
        return option.name == "row" || option.name == "fill" || option.name == "outliers";
    });
    return options;
}

} // namespace

void add_profile(py::module_& module) {
    py::class_<Profile>(module, "Profile",
                        "Heights on an even grid (mm).\n\n"
                        ">>> import numpy, rugosa\n"
                        ">>> x = numpy.arange(512) / 512\n"
                        ">>> wave = rugosa.Profile(0.01 * numpy.cos(2 * numpy.pi * x), 1 / 512)\n"
                        ">>> round(wave.roughness()['Pq'], 6)\n"
                        "0.007071\n")
        .def(py::init([](const py::object& heights, double spacing) {
                 return profile_from(heights, OneOrTwo<double>(spacing), "Profile");
             }),
             py::arg("heights"), py::arg("spacing"), "heights: N numbers, mm; spacing: their distance, mm.")
        .def_property_readonly(
            "heights", [](const Profile& p) -> const Eigen::VectorXd& { return p.heights; },
            py::return_value_policy::reference_internal, "N heights, mm: a read-only view.")
        .def_readonly("spacing", &Profile::spacing, "Distance of the nodes, mm.")
        .def_property_readonly("nodes", &Profile::nodes, "How many.")
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
            return "<rugosa.Profile of " + std::to_string(p.nodes()) + " nodes, " +
                   rough::line_of(p.spacing) + " mm apart>";
        });
    py::class_<Surface>(module, "Surface",
                        "Heights over an area (mm): a row along x, y grows from row to row.\n\n"
                        ">>> import numpy, rugosa\n"
                        ">>> surface = rugosa.Surface(numpy.random.default_rng(1).random((32, 48)), 0.01)\n"
                        ">>> surface.nodes, surface.heights.shape\n"
                        "((48, 32), (32, 48))\n")
        .def(py::init([](const py::object& heights, const OneOrTwo<double>& spacing) {
                 Surface surface{surface_from(heights, spacing, "Surface")};
                 if (!surface.is_2d())
                     throw rough::InputError("Surface: heights of 1 dimension given, expected two");
                 return surface;
             }),
             py::arg("heights"), py::arg("spacing"),
             "heights: N_y x N_x numbers, mm; spacing: their distance, mm, or those along x and y.")
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
            "How many along x and y.")
        .def(
            "roughness",
            [](const Surface& surface, bool periodic) {
                return in_dictionary(areal_parameters(surface, periodic));
            },
            py::arg("periodic") = false,
            "Sa, Sq, Sdq, Sal, Str, ... (ISO 25178-2; lengths in mm) about the mean plane; periodic: it "
            "repeats.")
        .def(
            "row",
            [](const Surface& s, rough::Index row) {
                if (row < 0 || row >= s.rows)
                    throw py::index_error("row " + std::to_string(row) + " given, expected 0 to " +
                                          std::to_string(s.rows - 1));
                const rough::Index columns = s.shape().columns;
                return Profile{s.heights.segment(row * columns, columns), s.spacing};
            },
            py::arg("row"), "One row as a Profile, counted from 0.")
        .def("__repr__", [](const Surface& s) {
            return "<rugosa.Surface of " + std::to_string(s.shape().columns) + " x " +
                   std::to_string(s.rows) + " nodes, " + rough::line_of(s.spacing) + " x " +
                   rough::line_of(s.row_spacing) + " mm apart>";
        });
    module.def(
        "read_surface",
        [](const std::filesystem::path& file, const py::kwargs& options) {
            Keywords keywords(options, "read");
            app::Settings settings = keywords.settings(app::joined({app::area_settings(), map_options()}));
            keywords.expect_none_left();
            if (!settings.given("detrend"))
                settings = settings.with({{"detrend", "none"}});
            return Surface{app::surface_from(settings.with({{"surface", file.string()}})).heights};
        },
        py::arg("file"),
        documented("A measured area: X3P, SDF, SUR, GSF, columns x, y, height, or a text matrix with its "
                   "spacing (a pair along x and y); detrend is none unless it is given.",
                   map_options())
            .c_str());
    module.def(
        "read_profile",
        [](const std::filesystem::path& file, const py::kwargs& options) {
            Keywords keywords(options, "read");
            const app::Settings settings = keywords.settings(app::scan_settings());
            keywords.expect_none_left();
            rough::Source source = app::scan_from(file, settings, 0);
            return py::make_tuple(std::move(source.measured), std::move(source.account));
        },
        py::arg("file"),
        documented("(Profile, what was read and done to it in words) of a measured scan.",
                   app::scan_settings())
            .c_str());
}

} // namespace rugosa::python

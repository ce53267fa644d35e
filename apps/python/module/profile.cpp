#include "apps/python/module/python.hpp"
#include "apps/report/profile_page.hpp"

namespace rugosa::python {

using rough::Profile;

Profile profile_from(const py::object& heights, std::optional<double> spacing, const std::string& of) {
    Profile profile;
    if (py::isinstance<Profile>(heights)) {
        if (spacing)
            throw py::type_error(of + ": spacing given with a Profile, which has its own");
        return heights.cast<const Profile&>();
    }
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(heights);
    if (!array)
        throw py::error_already_set();
    if (array.ndim() != 1)
        throw rough::InputError(of + ": heights of " + std::to_string(array.ndim()) +
                                " dimensions given, expected one");
    if (!spacing)
        throw py::type_error(of + ": spacing is missing, expected the distance of the nodes, mm");
    if (!(*spacing > 0))
        throw rough::InputError(of + ": spacing " + std::to_string(*spacing) + " given, expected above 0");
    profile.heights = Eigen::Map<const Eigen::VectorXd>(array.data(), array.shape(0));
    profile.spacing = *spacing;
    return profile;
}

namespace {

py::dict parameters_of(const Profile& profile) {
    const rough::Roughness r = roughness(profile);
    py::dict all;
    for (const app::Parameter& one : app::parameters(r, false))
        all[py::str(one.name)] = one.value;
    for (const auto& [name, value] : {std::pair{"rms_curvature", r.rms_curvature},
                                      {"m0", r.m0},
                                      {"m2", r.m2},
                                      {"m4", r.m4},
                                      {"bandwidth", r.bandwidth}})
        all[name] = value;
    return all;
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
                 return profile_from(heights, spacing, "Profile");
             }),
             py::arg("heights"), py::arg("spacing"), "heights: N numbers, mm; spacing: their distance, mm.")
        .def_property_readonly(
            "heights", [](const Profile& p) -> const Eigen::VectorXd& { return p.heights; },
            py::return_value_policy::reference_internal, "N heights, mm: a read-only view.")
        .def_readonly("spacing", &Profile::spacing, "Distance of the nodes, mm.")
        .def_property_readonly("nodes", &Profile::nodes, "How many.")
        .def("roughness", &parameters_of,
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
    module.def(
        "read_profile",
        [](const std::filesystem::path& file, const std::string& unit, double spacing,
           const std::string& detrend, bool fill, rough::Index row) {
            rough::ScanOptions options;
            options.unit = unit;
            options.spacing = spacing;
            options.detrend = rough::detrend_named(detrend, "detrend");
            options.fill = fill;
            options.row = row;
            rough::Source source = rough::open_scan(file, options);
            return py::make_tuple(std::move(source.measured), std::move(source.account));
        },
        py::arg("file"), py::kw_only(), py::arg("unit") = "", py::arg("spacing") = 0.0,
        py::arg("detrend") = "line", py::arg("fill") = false, py::arg("row") = 0,
        "(Profile, what was read and done to it in words) of a measured scan.");
}

} // namespace rugosa::python

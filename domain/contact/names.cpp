#include "domain/contact/names.hpp"

#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

#include <algorithm>

namespace rough {

namespace {

template <typename Kind>
Kind named(const std::string& name, const std::vector<std::string>& names, const std::string& where) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
        return static_cast<Kind>(found - names.begin());
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i)
        all += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    throw InputError(where + ": '" + name + "' given, expected " + all);
}

} // namespace

const std::vector<std::string>& kernel_names() {
    static const std::vector<std::string> names{"free", "periodic", "strip"};
    return names;
}

const std::string& name_of(Kernel kernel) { return kernel_names()[static_cast<std::size_t>(kernel)]; }

Kernel kernel_named(const std::string& name, const std::string& where) {
    return named<Kernel>(name, kernel_names(), where);
}

const std::vector<std::string>& solver_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const ContactSolver& solver : contact_solvers)
            all.emplace_back(solver.name);
        return all;
    }();
    return names;
}

const std::string& name_of(Solver solver) { return solver_names()[static_cast<std::size_t>(solver)]; }

Solver solver_named(const std::string& name, const std::string& where) {
    return named<Solver>(name, solver_names(), where);
}

bool is_direct(Solver solver) { return row_of(solver).direct; }

} // namespace rough

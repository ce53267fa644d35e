#include "domain/contact/names.hpp"

#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

#include <algorithm>

namespace rough {

const std::vector<std::string>& kernel_names() {
    static const std::vector<std::string> names{"free", "periodic", "strip"};
    return names;
}

const std::string& name_of(Kernel kernel) { return kernel_names()[static_cast<std::size_t>(kernel)]; }

Kernel kernel_named(const std::string& name, const std::string& where) {
    const auto& names = kernel_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InputError(where + ": '" + name + "' is unknown; choose free, periodic or strip");
    return static_cast<Kernel>(found - names.begin());
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

bool is_direct(Solver solver) { return row_of(solver).direct; }

} // namespace rough

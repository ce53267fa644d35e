#include "domain/contact/stepped.hpp"

#include "domain/contact/solvers/choice.hpp"

namespace rough {

SteppedContact::SteppedContact(const Profile& profile, const Body& body, std::vector<double> displacements,
                               const ContactOptions& options)
    : displacements_(std::move(displacements)), options_(options),
      problem_(make_problem(profile, body, displacements_)), contact_(problem_, options_) {}

void SteppedContact::press() {
    const std::size_t next = steps_.size();
    steps_.push_back(load_step(problem_, displacements_[next], contact_.press(problem_.approach[next])));
}

bool SteppedContact::is_own_choice() const {
    return options_.solver == Solver::nested || (options_.solver == Solver::automatic &&
                                                 choose_solver(problem_, options_).solver == Solver::nested);
}

} // namespace rough

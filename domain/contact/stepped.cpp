#include "domain/contact/stepped.hpp"

#include "domain/contact/solvers/choice.hpp"
#include "domain/contact/solvers/nested.hpp"
#include "domain/errors.hpp"

namespace rough {

struct SteppedContact::Parts {
    ContactProblem problem;
    NestedContact contact;

    Parts(ContactProblem asked, const ContactOptions& options)
        : problem(std::move(asked)), contact(problem, options) {}
};

SteppedContact::SteppedContact(const Profile& profile, const Body& body, std::vector<double> displacements,
                               const ContactOptions& options)
    : displacements_(std::move(displacements)), options_(options),
      parts_(std::make_unique<Parts>(make_problem(profile, body, displacements_), options_)) {
    if (body.yields())
        refuse("hardness ", body.hardness,
               " MPa was given, none is expected: contact is nested without one only");
}

SteppedContact::~SteppedContact() = default;

void SteppedContact::press() {
    const std::size_t next = steps_.size();
    const ContactProblem& problem = parts_->problem;
    steps_.push_back(load_step(problem, displacements_[next], parts_->contact.press(problem.approach[next])));
}

bool SteppedContact::is_own_choice() const {
    return options_.solver == Solver::nested ||
           (options_.solver == Solver::automatic &&
            choose_solver(parts_->problem, options_).solver == Solver::nested);
}

} // namespace rough

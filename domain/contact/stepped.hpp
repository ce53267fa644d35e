#pragma once

#include "domain/contact/solve.hpp"

#include <memory>

namespace rough {

/// A profile pressed one load step after the other, to be left as soon as enough is known of its curve. By
/// the nested factor: bit for bit what solve_contact gives with Solver::nested.
class SteppedContact {
  public:
    /// `displacements` in mm, increasing, > 0. Throws InputError as solve_contact does.
    SteppedContact(const Profile& profile, const Body& body, std::vector<double> displacements,
                   const ContactOptions& options);
    SteppedContact(const SteppedContact&) = delete;
    SteppedContact& operator=(const SteppedContact&) = delete;
    ~SteppedContact();

    /// Whether every displacement is solved.
    bool done() const { return steps_.size() == displacements_.size(); }
    /// Solves the next one. Throws NotConverged.
    void press();
    const std::vector<LoadStep>& steps() const { return steps_; }               ///< solved so far
    const std::vector<double>& displacements() const { return displacements_; } ///< all of them, mm
    /// Whether solve_contact would take the nested factor for this curve.
    bool is_own_choice() const;

  private:
    std::vector<double> displacements_;
    ContactOptions options_;
    struct Parts;
    std::unique_ptr<Parts> parts_;
    std::vector<LoadStep> steps_;
};

} // namespace rough

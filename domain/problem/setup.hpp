#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/problem/limits.hpp"
#include "domain/problem/phases.hpp"
#include "domain/target/target.hpp"

#include <optional>

namespace rough {

/// From here on an answer is called found, where nothing else is asked for.
constexpr double default_required_similarity = 0.99;

/// Errors in the heights of the surfaces that are made of a design. The answer has to survive them.
struct MakingErrors {
    double noise = 0;        ///< rms of Gaussian height noise, mm: 95 % of its draws are to hold; 0: none
    double noise_length = 0; ///< its correlation length, mm; 0: L/60
    double tilt = 0;         ///< over the length, mm, either way; 0: none

    bool any() const { return noise > 0 || tilt > 0; } ///< given
};

/// What a design is asked for. What is left at 0 is filled in where a search begins (`completed`): K at a
/// target is found by search({.targets = {read_target("target.csv")}}).
struct DesignSetup {
    Model model = {};                 ///< grid, body, load steps, contact options
    std::vector<Target> targets = {}; ///< at least one; the first shapes the starts
    /// MPa: every genome is rescaled to it at its last load step (Eq. 11). Without it amplitude is a gene
    /// like another, and load steps end where the targets do.
    std::optional<double> max_pressure = {};
    std::optional<double> threshold = {};  ///< parts `low` from `high`, in x; the middle of the first target
    GeneBounds bounds = {};                ///< of the genes
    std::optional<PhaseReach> phases = {}; ///< phases alone may move, and so far
    MakingLimits limits = {};              ///< of what can be made; shortest_wave 0: 8 node distances
    /// The measured profile whose own response the targets are: in other load steps they are others.
    std::optional<Profile> like = {};
    /// The similarity, verified, from which on a search may end and an answer is called found.
    double required_similarity = default_required_similarity;
    /// Of each chromosome of a genome that is drawn, M. 0: 1, as a line's collapse to one cosine; on an area,
    /// where they are directions, 8.
    int ridges = 0;
    MakingErrors errors = {}; ///< that an answer is to survive
};

/// The bounds with lambda's, where they were left at 0, filled in: a quarter of the length (mm) to four times
/// it.
GeneBounds completed(GeneBounds bounds, double length);

/// The set-up with what was left at 0 filled in: the model, and where genes other than phases may move the
/// bounds and the shortest wave, 8 node distances. Throws InputError on a model without a solution, under 16
/// nodes a side, a shortest wave under a node distance or above the longest, or an accuracy or a strip with
/// an area.
DesignSetup completed(DesignSetup setup);

/// Throws InputError on no targets, a target beyond max_pressure, targets that the set-up cannot load
/// together, or a threshold that leaves no point below or above it.
void validate(const DesignSetup& setup);

/// The points of the first target up to the threshold (MPa or mm), or those from it on.
std::vector<Index> points_of_half(const DesignSetup& setup, bool high);

/// The same set-up solved throughout, whatever accuracy its model allows.
DesignSetup exactly(DesignSetup setup);

/// The set-up as answers are reported under: solved throughout, to nine digits of a similarity by whatever
/// solver on grids whose finer one has up to 16385 nodes, to the solver's tolerance on larger ones and on
/// areas.
DesignSetup as_reported(DesignSetup searched);

} // namespace rough

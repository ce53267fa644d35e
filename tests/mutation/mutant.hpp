#pragma once

#include <atomic>
#include <cstdlib>
#include <fstream>

/// The number of the active mutant. 0: none; -1: none, and the file RUGOSA_MUTANTS_REACHED gets the reached
/// ones.
inline const int rugosa_tried = std::getenv("RUGOSA_MUTANT") ? std::atoi(std::getenv("RUGOSA_MUTANT")) : 0;

/// Writes a mutant's number when it is reached for the first time. Returns false.
inline bool rugosa_reached(int id) {
    static std::atomic<bool> seen[1 << 14];
    if (!seen[id].exchange(true))
        std::ofstream(std::getenv("RUGOSA_MUTANTS_REACHED"), std::ios::app) << std::to_string(id) + "\n";
    return false;
}

/// Whether this mutant is active.
inline bool rugosa_mutant(int id) { return id == rugosa_tried || (rugosa_tried < 0 && rugosa_reached(id)); }

#pragma once

#include <atomic>
#include <cstdlib>
#include <fstream>

/// The break that is tried, 0 for none; -1 writes to RUGOSA_MUTANTS_REACHED which breaks a run comes by.
inline const int rugosa_tried = std::getenv("RUGOSA_MUTANT") ? std::atoi(std::getenv("RUGOSA_MUTANT")) : 0;

/// Writes a break's number when it is first come by; says false, for none is tried.
inline bool rugosa_reached(int id) {
    static std::atomic<bool> seen[1 << 14];
    if (!seen[id].exchange(true))
        std::ofstream(std::getenv("RUGOSA_MUTANTS_REACHED"), std::ios::app) << std::to_string(id) + "\n";
    return false;
}

/// Whether this break is the one that is tried.
inline bool rugosa_mutant(int id) { return id == rugosa_tried || (rugosa_tried < 0 && rugosa_reached(id)); }

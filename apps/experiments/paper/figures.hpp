#pragma once

#include "apps/experiments/paper/fractal_study.hpp"
#include "apps/experiments/paper/ridge_study.hpp"
#include "apps/experiments/paper/run.hpp"
#include "apps/report/page.hpp"

/// The paper's figures, each from data to a picture with its caption.
namespace app {

Figure chromosomes_figure(std::uint64_t seed);               ///< 1
Figure ridges_figure(const std::vector<RidgeCount>& counts); ///< 2
Figure fractal_figure(const FractalStudy& study);            ///< 3
Figure parts_figure(const PaperRun& run);                    ///< 4
Figure pairs_figure(const PaperRun& run);                    ///< 5
Figure database_figure(const PaperRun& run);                 ///< 6
Figure stages_figure(const PaperRun& run);                   ///< 7
Figure thresholds_figure(const PaperRun& run);               ///< 8
Figure answers_figure(const PaperRun& run);                  ///< 9
Figure profiles_figure(const PaperRun& run);                 ///< 10
Figure spectra_figure(const PaperRun& run);                  ///< 11
Figure convergence_figure(const PaperRun& run);              ///< ours: every variant's way

} // namespace app

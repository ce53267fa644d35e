#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// A similarity that falls by more than this in finer load steps is not settled.
constexpr double settled = 0.005;

/// Whether an answer's similarity falls by no more than `settled` in the steps that are to confirm it
/// (Judgement::confirming): a search may fit the curve to fewer. True where nobody asked.
bool is_confirmed(const Answer& answer);

/// Aims again at the targets less what finer grids and steps change of the latest answer (allowing_for), four
/// times on a line, twice on an area, as long as one in two rounds (area: each) is better, confirmed ones
/// before others; no more where a confirmed one is worth `enough`. On a line the best answer is confirmed, by
/// 16 times the steps. `options` says what may be spent; the first round may take `took` seconds.
SearchResult aimed_again(SearchResult result, const SearchOptions& options, const std::string& name,
                         const std::vector<ga::Observer<Genome>>& observers, double enough, double took);

} // namespace rough

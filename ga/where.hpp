#pragma once

#include "ga/individual.hpp"
#include "ga/random.hpp"

#include <optional>

namespace ga {

/// Where a run stands: the path of the stage, its random streams, its generation. Streams are keyed by the
/// seed, the path without the variant's own name, the generation and an index, and by nothing else.
template <class G>
class Where {
  public:
    /// At the root. `variant` is the first word of every path, `seed` that of every stream.
    Where(const std::string& variant, std::uint64_t seed) {
        const std::uint64_t key = fold(0, seed);
        places_.push_back({Name(variant), 0, key, key, {}});
    }

    /// Random numbers for the index-th piece of work of the stage that runs, in this generation.
    Stream stream(std::size_t index) const { return Stream(fold(places_.back().key, index)); }

    /// The enclosing blocks, then the stage's name with its ordinal among equal names.
    std::string path() const {
        std::string path;
        for (const Place& place : places_) {
            path += (path.empty() ? "" : "/") + place.name.text();
            if (place.ordinal > 0)
                path += "." + std::to_string(place.ordinal);
        }
        return path;
    }
    /// Of each enclosing block of generations, outermost first, from 0.
    std::vector<std::size_t> generations() const {
        std::vector<std::size_t> generations;
        for (const Place& place : places_)
            if (place.generation)
                generations.push_back(*place.generation);
        return generations;
    }
    /// Of the innermost block of generations, from 0; 0 outside any.
    std::size_t generation() const {
        for (auto place = places_.rbegin(); place != places_.rend(); ++place)
            if (place->generation)
                return *place->generation;
        return 0;
    }
    /// The best of the population at the start of the innermost generation, as many as `elite` and `plus`
    /// read.
    const Population<G>& generation_start() const { return *starts_.back(); }

    /// Stands on a place of the pipeline while it lives. Ordinal 0 is not shown.
    class Scope {
      public:
        /// Enters the place of that name.
        Scope(Where& where, Name name, std::size_t ordinal) : where_(where) {
            const std::uint64_t key = fold(fold(where.places_.back().inner, name.text()), ordinal);
            where.places_.push_back({name, ordinal, key, key, {}});
        }
        Scope(const Scope&) = delete;
        ~Scope() { where_.places_.pop_back(); }

      private:
        Where& where_;
    };
    /// Counts a pass through the block that runs while it lives: stages inside draw other random numbers in
    /// each.
    class Round {
      public:
        /// Begins pass `number`, from 0.
        Round(Where& where, std::size_t number) : where_(where) {
            Place& place = where.places_.back();
            place.generation = number;
            place.inner = fold(place.key, number);
        }
        Round(const Round&) = delete;
        ~Round() {
            where_.places_.back().generation.reset();
            where_.places_.back().inner = where_.places_.back().key;
        }

      private:
        Where& where_;
    };
    /// A round whose stages may read what is kept of its start.
    class Generation : Round {
      public:
        /// `start`, which must outlive it, is what stages may read.
        Generation(Where& where, std::size_t number, const Population<G>& start)
            : Round(where, number), where_(where) {
            where.starts_.push_back(&start);
        }
        ~Generation() { where_.starts_.pop_back(); }

      private:
        Where& where_;
    };

  private:
    struct Place {
        Name name;
        std::size_t ordinal;
        std::uint64_t key;   ///< of the stage's own random numbers
        std::uint64_t inner; ///< of the stages inside it
        std::optional<std::size_t> generation;
    };

    std::vector<Place> places_;
    std::vector<const Population<G>*> starts_;
};

} // namespace ga

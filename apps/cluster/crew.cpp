#include "apps/cluster/crew.hpp"

#include "apps/cluster/foreman.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/ranks.hpp"
#include "apps/cluster/serve.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/build.hpp"
#include "domain/text/words.hpp"

namespace app::crew {

namespace {

std::unique_ptr<Foreman>& foreman() {
    static std::unique_ptr<Foreman> one; // none where there are no other ranks
    return one;
}

void take_patience(Words& words) {
    const std::string flag = "--patience";
    const auto found = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
        return word == flag || word.starts_with(flag + "=");
    });
    if (found == words.end())
        return;
    const bool joined = *found != flag;
    if (!joined && found + 1 == words.end())
        throw rough::InputError(flag + ": given without a value, expected seconds");
    const std::string given = joined ? found->substr(flag.size() + 1) : *(found + 1);
    patience = rough::number_from(given, flag);
    if (!(patience >= 0.1 && patience <= 1e6))
        throw rough::InputError(flag + ": " + given + " given, expected 0.1 to 1e6 seconds");
    words.erase(found, found + (joined ? 1 : 2));
}

} // namespace

std::string introduction(const Words& words) {
    const rough::Build build = rough::build();
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + word;
    return framed({RUGOSA_VERSION, build.compiler + " " + build.flags, build.vectors, line});
}

std::string difference(const std::string& one, const std::string& other) {
    const auto own = unframed(one), theirs = unframed(other);
    const char* const names[] = {"version", "build", "vectors (RUGOSA_VECTORS)", "words"};
    for (std::size_t i = 0; i < own.size(); ++i)
        if (i >= theirs.size() || own[i] != theirs[i])
            return std::string(names[i]) + " '" + (i < theirs.size() ? theirs[i] : "") + "', expected '" +
                   own[i] + "' as rank 0 has";
    return "";
}

void join(Words& words) {
    ranks::join();
    if (ranks::own() > 0) {
        try {
            take_patience(words);
        } catch (const rough::InputError&) { // rank 0 says so
        }
        serve(introduction(words));
    }
    if (ranks::count() > 1)
        foreman() = std::make_unique<Foreman>(ranks::count());
    take_patience(words);
    if (foreman())
        foreman()->meet(introduction(words));
}

int leave(int code) {
    if (!foreman()) {
        ranks::leave(farewell(), code);
        return code;
    }
    const int last = foreman()->leave(code);
    foreman().reset();
    return last;
}

bool is_alone() { return !foreman(); }
bool is_worth(const std::string& kind, std::size_t tasks, int threads) {
    return foreman() && foreman()->is_worth(kind, tasks, threads);
}
void hand_out(const Errand& errand) { foreman()->hand_out(errand); }

} // namespace app::crew

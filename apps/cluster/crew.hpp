#pragma once

#include "apps/commands/commands.hpp"

#include <functional>
#include <optional>
#include <string>

/// Several ranks at one run: rank 0 is the program, with its files, its clock and all it decides; the others
/// do the tasks that it hands out, and know nothing else of the run.
namespace app::crew {

/// Tasks of one kind for whoever of the ranks has time, this one too.
struct Errand {
    std::string kind;                                 ///< of kinds()
    std::string setting;                              ///< what its tasks have in common
    int threads = 0;                                  ///< of each rank; 0: all that it has
    std::size_t count = 0;                            ///< tasks, as far as is known
    std::function<std::optional<std::string>()> next; ///< the next task; nothing after the last
    /// An answer, by its task's place in their order; they come in any. On the thread that hands out.
    std::function<void(std::size_t task, const std::string& answer)> take;
    std::function<bool()> ended = [] { return false; }; ///< no answer is wanted any more
};

/// Errand::next of so many tasks, each as its place says. One object serves one errand.
template <class Task>
auto one_after_another(std::size_t count, Task task) {
    return [count, task, next = std::size_t{0}]() mutable -> std::optional<std::string> {
        return next < count ? std::optional<std::string>(task(next++)) : std::nullopt;
    };
}

/// First of all in every rank. Takes --patience out of the words. In rank 0 it returns once all the others
/// are known to be the same program with the same words, or throws rough::InputError; in the others it
/// serves, and never returns.
void join(Words& words);
/// Last of all: dismisses the others. Gives the exit code.
int leave(int code);

bool is_alone(); ///< there are no other ranks
/// Whether so many tasks take longer than talking about them.
bool is_worth(const std::string& kind, std::size_t tasks, int threads);
/// Until every task is answered, the errand has ended, or somebody has asked the program to stop; a rank that
/// is silent for too long is such a one. Throws rough::InputError where a task threw.
void hand_out(const Errand& errand);

/// Why two ranks cannot work together; empty where they can. Each says of itself what it is.
std::string difference(const std::string& one, const std::string& other);
/// What this program would say of itself: version, build, processor's vectors, words.
std::string introduction(const Words& words);

} // namespace app::crew

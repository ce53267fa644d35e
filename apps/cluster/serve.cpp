#include "apps/cluster/serve.hpp"

#include "apps/cluster/frame.hpp"
#include "apps/cluster/hands.hpp"
#include "apps/cluster/ranks.hpp"
#include "apps/cluster/talk.hpp"
#include "apps/cluster/watch.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"
#include "ga/base/parallel.hpp"

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <unistd.h>

namespace app::crew {

namespace {

/// "host, process 4711"
std::string own_place() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return std::string(name) + ", process " + std::to_string(::getpid());
}

/// As a launcher asks, also where rank 0 has ended with a line of its own.
volatile std::sig_atomic_t asked_to_end = 0;

} // namespace

void serve(const std::string& introduction) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, [](int) { asked_to_end = 1; }); // rank 0 decides
    ranks::send(0, hello, framed({own_place(), number_bytes(ga::thread_count(0)), introduction}));
    const std::jthread watching = watch();
    Hands hands;
    std::shared_ptr<const Assignment> of;
    ga::Stopwatch told;
    Silence silence;
    const auto tell = [&](Word word, const std::string& bytes) {
        ranks::send(0, word, bytes);
        told = ga::Stopwatch();
    };
    for (Pause pause;;) {
        const auto messages = ranks::arrived();
        for (const ranks::Message& message : messages)
            if (message.word == setting) {
                auto parts = unframed(message.bytes);
                of = std::make_shared<const Assignment>(Assignment{parts.at(0), parts.at(1)});
            } else if (message.word == chunk) {
                auto parts = unframed(message.bytes);
                hands.give({number_of<std::uint64_t>(parts.at(0)),
                            number_of<int>(parts.at(1)),
                            of,
                            {parts.begin() + 2, parts.end()}});
            } else if (message.word == drop) {
                hands.drop();
            } else if (message.word == roll) {
                tell(alive, "");
            } else if (message.word == end) {
                hands.drop();
                tell(bye, "");
            } else if (message.word == part) {
                ranks::leave(farewell(), 0);
                std::_Exit(0); // what is under way is not waited for
            }
        bool moved = !messages.empty();
        if (moved)
            silence.broken();
        if (ranks::own() == 1 && silence.too_long(patience_with_rank_0())) {
            if (!asked_to_end)
                std::cerr << error_mark() << "rank 0 has not answered for "
                          << readable(patience_with_rank_0())
                          << " s, the run ends without it; what has checkpoints goes on with --resume\n"
                          << std::flush;
            ranks::send(0, end, ""); // should it wake up, it need not say so too
            ranks::end_all(farewell(), exit_interrupted);
        }
        for (auto done = hands.done(); done; done = hands.done()) {
            std::vector<std::string> parts{number_bytes(done->id), number_bytes(done->seconds), done->error};
            parts.insert(parts.end(), done->answers.begin(), done->answers.end());
            tell(answers, framed(parts));
            moved = true;
        }
        if (hands.has() > 0 && told.seconds() > interval())
            tell(alive, "");
        if (moved)
            pause.begin_anew();
        else
            hands.wait(pause.next());
    }
}

} // namespace app::crew

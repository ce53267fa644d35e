#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/experiments/experiment.hpp"
#include "apps/report/render.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <malloc.h>
#include <new>
#include <unistd.h>

namespace {

int dispatch(app::Words words) {
    app::parse_verbosity(words);
    const std::string first = words.empty() ? "" : words[0];
    if (first == "help" && words.size() > 1) return run_part(app::commands(), {words[1], "--help"});
    if (first == "--help" || first == "-h" || first == "help") {
        std::string text = app::builtin_files().at("rugosa.txt");
        boost::replace_all(text, "{version}", RUGOSA_VERSION);
        boost::replace_all(text, "{subcommands}", app::listed(app::commands(), 12));
        std::cout << text;
        return 0;
    }
    if (first == "--version") {
        std::cout << "rugosa " RUGOSA_VERSION "\n";
        return 0;
    }
    return run_part(app::commands(), words);
}

/// Prints an error, with the program's name in red if stderr is a terminal and NO_COLOR is not set.
void complain(const std::string& message) {
    const bool is_red = isatty(STDERR_FILENO) && !std::getenv("NO_COLOR");
    std::cerr << (is_red ? "\033[31mrugosa:\033[0m " : "rugosa: ") << app::printable(message) << "\n";
}

/// Prints the message of the exception that is handled now and returns its exit code.
int report_exception() {
    try {
        throw;
    } catch (const rough::NotConverged& error) {
        complain(error.what());
        return 3;
    } catch (const rough::InputError& error) {
        complain(error.what());
    } catch (const ga::UsageError& error) {
        complain(error.what());
    } catch (const std::bad_alloc&) {
        complain("out of memory; use fewer nodes, a smaller population or --solver active-set");
    } catch (const std::length_error&) {
        complain("out of memory: no machine holds this much; use fewer nodes or a smaller population");
    } catch (const std::filesystem::filesystem_error& error) {
        complain(error.path1().string() + ": " + error.code().message() + "; name a file or folder that can be used");
    } catch (const std::system_error& error) { // no thread could be started
        complain(std::string("the system refused: ") + error.what());
    } catch (const nlohmann::json::exception&) {
        complain("a file of results has other values than this version writes; make the results again");
    } catch (const std::exception& error) {
        complain(std::string("a fault of the program: ") + error.what() + "; report it with the command");
    }
    return 2;
}

/// Ends the program on an exception that no caller can catch, with the same message and exit code.
[[noreturn]] void end_at_once() { std::_Exit(std::current_exception() ? report_exception() : 2); }

/// Before all other initialisation, which may lack memory.
[[gnu::constructor(101)]] void handle_failures() { std::set_terminate(end_at_once); }

/// Flushes standard output. Output that could not be written, as on a full disk, is an error.
int flushed(int code) {
    std::cout.flush();
    if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout) return code;
    complain(std::string("standard output: cannot be written") +
             (errno ? std::string(" (") + std::strerror(errno) + ")" : "") + "; make room on the disk");
    return code == 0 ? 2 : code;
}

int run(app::Words words) {
    try {
        app::cluster::Kinds kinds{{"designs", app::designs_under}, {"responses", app::responses_under}};
        for (const app::Experiment& experiment : app::experiments())
            if (experiment.work) kinds.emplace(experiment.kind, experiment.work);
        if (app::cluster::join(std::move(kinds))) return 0;
        return flushed(dispatch(std::move(words)));
    } catch (...) {
        return report_exception();
    }
}

/// Starts the program once more with a short wait of OpenMP's threads for each other, unless the user has
/// chosen one. libgomp reads it before main. Its usual wait occupies a core, so that two curves on two
/// threads each take several times as long as on one.
void shorten_waits(char** values) {
    if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
    std::error_code unknown;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    ::setenv("GOMP_SPINCOUNT", "1000", 1);
    if (!unknown) ::execv(self.c_str(), values); // returns if it fails; then the waits stay long
}

} // namespace

int main(int count, char** values) {
    shorten_waits(values);
    std::signal(SIGPIPE, SIG_IGN); // the work continues without a reader
    std::signal(SIGXFSZ, SIG_IGN); // writing to a file that may not grow fails, but does not end the program
    // Each contact solution frees megabytes. Returning them to the system takes longer than the solution.
    mallopt(M_TRIM_THRESHOLD, 1 << 29);
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    const int code = run({values + 1, values + count});
    app::cluster::leave(code);
    return code;
}

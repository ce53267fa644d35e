#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace app {

/// Starts a program without a shell, these descriptors its standard streams, in a process group of its own so
/// that all of it can be ended, SIGPIPE as the system has it. Gives 0, or the error.
int start_process(pid_t& process, std::vector<std::string> words, int in, int out, int err);

/// Whether a process ends within so many seconds; `status` is as waitpid has it then.
bool process_ended_within(double seconds, pid_t process, int& status);

} // namespace app

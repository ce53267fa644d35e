#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace app {

/// Starts a program without a shell, with these descriptors as its standard streams. It leads a process
/// group, so that its children can be killed too, and SIGPIPE has the default action. Returns 0 or an error
/// number.
int start_process(pid_t& process, std::vector<std::string> words, int in, int out, int err);

/// Whether a process ends within a time. If it does, `status` is that of waitpid.
bool process_ended_within(double seconds, pid_t process, int& status);

} // namespace app

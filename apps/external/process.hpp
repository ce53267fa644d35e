#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace app {

/// Starts a program without a shell, with these descriptors as its standard streams, in `folder` ("": the current one).
/// It leads a process group, so that its children can be killed too, and SIGPIPE has the default action. A supervisor,
/// another process, kills the group when this process has ended, even by SIGKILL. Returns 0 or an error number.
int start_process(pid_t& process, std::vector<std::string> words, int in, int out, int err,
                  const std::filesystem::path& folder = {});

/// Kills the group of a process, ended or not, e.g. by SIGTERM; the supervisor forgets it after SIGKILL.
void end_group(pid_t process, int signal);

/// Whether a process ends within a time. If it does, `status` is that of waitpid.
bool process_ended_within(double seconds, pid_t process, int& status);

/// The last line of a program's messages that has more than blanks and the marks under a place.
std::string last_line(const std::string& messages);

} // namespace app

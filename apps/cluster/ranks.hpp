#pragma once

#include <string>
#include <vector>

/// The processes that a launcher of MPI (mpirun, srun) has started together: one where there was none, or
/// where the program was built without. All that touches MPI is in ranks.cpp. Safe to call from any thread.
namespace app::ranks {

/// What one rank tells another.
struct Message {
    int rank = 0; ///< who says it
    int word = 0; ///< what kind of message it is, as those who talk have agreed
    std::string bytes;
};

void join(); ///< before all else
int count();
int own(); ///< from 0

/// Returns at once: a rank that takes nothing in holds nobody up.
void send(int to, int word, std::string bytes);
/// Whole messages that have come, those of a rank in their order. Does not wait.
std::vector<Message> arrived();

/// Whether what runs in MPI comes back within so many seconds, in which this process was not suspended. Open
/// MPI does not where a rank is stopped as it writes to memory that both share: the reader waits for the
/// rest.
bool responds(double seconds);

/// Of what this rank has sent and received.
struct Traffic {
    std::size_t messages = 0, bytes = 0;
};
Traffic traffic();

///@{
/// Where MPI takes longer than `seconds`, since another rank is gone, the process ends with `code` by itself.
void leave(double seconds, int code);                ///< by all ranks together, once all is sent
[[noreturn]] void end_all(double seconds, int code); ///< by one, while the others stay: they are ended
///@}

} // namespace app::ranks

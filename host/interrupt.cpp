#include "host/interrupt.h"

#include <csignal>

namespace clucida::host {
namespace {

// Signal handlers can reach nothing but what is static.
volatile std::sig_atomic_t flag = 0;

void handle(int signal)
{
    flag = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

void catch_interrupts()
{
    std::signal(SIGINT, handle);
    std::signal(SIGTERM, handle);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted()
{
    return flag != 0;
}

} // namespace clucida::host

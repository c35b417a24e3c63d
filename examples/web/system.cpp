// SPDX-License-Identifier: MIT
// Calls of Linux that emscripten does not have. Random bytes are the browser's; there are no signals.
#include <cerrno>
#include <csignal>
#include <pthread.h>
#include <unistd.h>

#include <sys/eventfd.h>
#include <sys/random.h>

extern "C" {

ssize_t getrandom(void* bytes, size_t count, unsigned /*flags*/) {
    return getentropy(bytes, count) == 0 ? static_cast<ssize_t>(count) : -1;
}

// Readable never, as nobody ends a wait for input here: the end of a pipe of which nobody writes the other.
int eventfd(unsigned /*value*/, int /*flags*/) {
    int ends[2];
    return pipe(ends) == 0 ? ends[0] : -1;
}

int pthread_kill(pthread_t /*thread*/, int /*signal*/) {
    return ENOSYS;
}
}

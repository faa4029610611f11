#pragma once

namespace surge {

/// Makes the threads of a parallel loop that have to wait for others leave the processor to
/// somebody else within about 50 microseconds.
///
/// GCC's OpenMP library lets them spin for some milliseconds first, which costs nothing on an idle
/// machine. With one other busy process, though, a thread that was put aside is waited for by
/// threads that spin in its place, at every barrier: two threads took thirty times as long as one.
/// The library reads how long to spin from the environment before main() begins, so the program
/// starts itself again with GOMP_SPINCOUNT set. To be called first thing, with main()'s own
/// arguments. Does nothing where the user has said how to wait (OMP_WAIT_POLICY, GOMP_SPINCOUNT),
/// nor where the program cannot be started again.
void wait_passively(char** arguments);

}  // namespace surge

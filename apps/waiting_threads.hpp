#pragma once

/// Lets threads that wait for others give way to other programs within a fraction of a millisecond. As OpenMP's library
/// comes, they hold on to their processors for milliseconds: where another program wants one of these, at every loop,
/// and steps take tens of times longer. It looks at its environment only when it is loaded, so the program begins once
/// more, with the same words, and before it calls MPI. Does nothing if the environment has OMP_WAIT_POLICY or
/// GOMP_SPINCOUNT already.
void limit_spin_waiting(char** words);

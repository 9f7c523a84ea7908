"""How the threads of C++ wait for each other: for a fraction of a millisecond, then they give way to other programs, as those of `jostle run` do.

OpenMP's library looks at the environment when it is loaded. By itself it waits for milliseconds, which makes steps tens of times
longer where another program wants one of the processors.
"""

import os

if not {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"} & os.environ.keys():
    os.environ["GOMP_SPINCOUNT"] = "10000"

"""Measures the overhead of a call from Python. PYTHONPATH=.build/python python3 tests/benchmarks/python_calls.py

Most of the time of a curve of 4 nodes is overhead, so this time is an upper bound of the overhead.
"""

import time

import numpy
import rugosa


def median_microseconds(call, times):
    taken = []
    for _ in range(times):
        begin = time.perf_counter()
        call()
        taken.append(time.perf_counter() - begin)
    return 1e6 * sorted(taken)[times // 2]


least = numpy.array([0, 1e-3, 0, 2e-3])
usual = numpy.cumsum(numpy.random.default_rng(1).normal(0, 1e-4, 512))
overhead = median_microseconds(lambda: rugosa.contact(least, 0.1, steps=2, kernel="free", modulus=2.0), 2000)
curve = median_microseconds(lambda: rugosa.contact(usual, 0.004), 500)
print(f"4 nodes, 2 steps: {overhead:.1f} us; 512 nodes, 20 steps: {curve:.0f} us, {curve / (curve - overhead):.3f} times "
      "its own work at most")

#!/usr/bin/env python3
"""The Ward sum of bench_kernel as one writes it with numpy arrays, on one core, and the kernel's rate
beside it in the same run.

usage: bench_numpy.py BENCH_KERNEL       the program that the build made

Prints a table: M facet-samples/s, and their ratio. Fails when the two sums disagree.
"""
import os
import subprocess
import sys
import time

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
try:
    import numpy as np
except ImportError:
    sys.exit("bench_numpy.py: numpy is not installed")

# As in bench_kernel.c.
STEPS, STEP_DEG, PHASE_DEG = 24 * 32, 0.5, 60.0
RHO_D, RHO_S, ALPHA_X, ALPHA_Y = 0.1, 0.3, 0.1, 0.2
FACETS = (72, 1000, 10000, 100000)
# Pairs of a facet and a step that are worked on together: arrays of them stay in the cache.
BLOCK = 10_000
ROUNDS = 5


def facets(n):
    """Unit normals, tangents and bitangents (n x 3) of the golden spiral, and the area of each."""
    j = np.arange(n)
    z = 1 - (2 * j + 1) / n
    across = np.sqrt(1 - z * z)
    angle = 2.39996322972865332 * j  # golden angle, rad
    normal = np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=1)
    tangent = np.stack([-normal[:, 1], normal[:, 0], np.zeros(n)], axis=1)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    return normal, tangent, np.cross(normal, tangent), 1.0 / n


def turned(vector):
    """The vector as the turning body sees it, step by step (Rodrigues)."""
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    angle = np.radians(STEP_DEG * np.arange(STEPS))[:, None]
    return (vector * np.cos(angle) + np.cross(axis, vector) * np.sin(angle)
            + axis * (axis @ vector) * (1 - np.cos(angle)))


def ward_sum(body, sun, observer):
    """Sum of f ci cr area over the facets at every step, m^2/sr."""
    normal, tangent, bitangent, area = body
    ci, cr = sun @ normal.T, observer @ normal.T
    h = sun + observer
    h /= np.linalg.norm(h, axis=1)[:, None]
    x, y, z = h @ tangent.T / ALPHA_X, h @ bitangent.T / ALPHA_Y, h @ normal.T
    lit = (ci > 0) & (cr > 0)
    w = np.where(lit, ci * cr, 0.0)
    # Outside of lit facets 1 + z may vanish; w makes the term 0 there.
    lobe = np.exp(-2 * (x * x + y * y) / np.where(lit, 1 + z, 1.0))
    g = RHO_D / np.pi * w + RHO_S / (4 * np.pi * ALPHA_X * ALPHA_Y) * np.sqrt(w) * lobe
    return g.sum(axis=1) * area


def measure(n):
    """(M facet-samples/s, mean sum) of numpy."""
    body = facets(n)
    phase = np.radians(PHASE_DEG)
    sun = turned(np.array([np.sin(phase), 0, np.cos(phase)]))
    observer = turned(np.array([0.0, 0, 1]))
    block = max(1, BLOCK // n)
    least = np.inf
    for _ in range(ROUNDS):
        start = time.process_time()
        total = sum(ward_sum(body, sun[k:k + block], observer[k:k + block]).sum()
                    for k in range(0, STEPS, block))
        least = min(least, time.process_time() - start)
    return n * STEPS / least * 1e-6, total / STEPS


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("model      facets    kernel   numpy  kernel/numpy")
    for n in FACETS:
        rate, mean = measure(n)
        line = subprocess.run([sys.argv[1], "ward", str(n), "coherent"], check=True,
                              stdout=subprocess.PIPE, text=True).stdout.splitlines()[1].split()
        kernel, kernel_mean = float(line[3]), float(line[8])
        if not abs(mean - kernel_mean) <= 1e-9 * kernel_mean:
            sys.exit(f"bench_numpy.py: {n} facets: numpy {mean!r}, kernel {kernel_mean!r}")
        print(f"{'ward':9s} {n:7d} {kernel:9.0f} {rate:7.1f} {kernel / rate:13.1f}", flush=True)


if __name__ == "__main__":
    main()

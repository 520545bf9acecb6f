#!/usr/bin/env python3
"""Interpolated shadows and those by rays against exact ones, on the bodies of tests/data/shadows.

usage: bench_shadow_ways.py GLINT

For each body and setting: the rms and the greatest difference of flux ratios, as fractions of their
mean over a turn of 360 deg in 3600 rows, and how many times as fast as exact shadows the whole run
of the program was (processor time, one thread). docs/physics.md has the table.
"""
import csv
import math
import pathlib
import resource
import subprocess
import sys

BODIES = pathlib.Path(__file__).parent.parent / "tests" / "data" / "shadows"
SETTINGS = [("interpolated", "shadow_step_deg", step) for step in (0.25, 0.5, 1, 2, 5)] + [
    ("rays", "rays_per_facet", n) for n in (16, 64, 256)
]


def run(glint, path, way, *settings):
    """Flux ratios of all rows, and the processor time of the run in s."""
    command = [glint, "run", "--quiet", "--threads", "1", path]
    for setting in (f'satellite.self_shadows="{way}"', *settings):
        command += ["--set", setting]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    table = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    rows = csv.DictReader(line for line in table.splitlines() if not line.startswith("#"))
    return [float(row["flux_ratio_V"]) for row in rows], after.ru_utime - before.ru_utime


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: bench_shadow_ways.py GLINT")
    glint = sys.argv[1]
    print("body       way           setting        rms       most  times as fast")
    for path in sorted(BODIES.glob("*.toml")):
        exact, exact_s = run(glint, path, "exact")
        mean = sum(exact) / len(exact)
        for way, key, value in SETTINGS:
            got, took_s = run(glint, path, way, f"satellite.{key}={value}")
            off = [abs(a - b) / mean for a, b in zip(got, exact)]
            rms = math.sqrt(sum(x * x for x in off) / len(off))
            print(f"{path.stem:10} {way:13} {value:7g} {rms:10.1e} {max(off):10.1e} "
                  f"{exact_s / took_s:14.2f}", flush=True)


if __name__ == "__main__":
    main()

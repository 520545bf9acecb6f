#!/usr/bin/python3
"""Tables as astropy reads them: units, empty cells, the scenario in the header.

usage: test_ecsv.py PROGRAM FOLDER    FOLDER: with endtoend/iss-vienna.toml
Exits with 77 where astropy is not installed.
"""
import csv
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from astropy import units
    from astropy.table import Table
except ImportError as error:
    print(f"SKIPPED: tables read by astropy: {error}")
    sys.exit(77)

program, data = sys.argv[1:3]
scenario = os.path.join(data, "endtoend", "iss-vienna.toml")
failures = 0


def check(condition, message):
    global failures
    if not condition:
        failures += 1
        print("FAILED:", message)


def run(path, *settings):
    """The table of a scenario, as astropy reads it, and its bytes."""
    sets = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "table.csv")
        subprocess.run([program, "run", path, "--quiet", "-o", out, *sets], check=True)
        with open(out, "rb") as file:
            text = file.read().decode("utf-8")
        return Table.read(out, format="ascii.ecsv"), text


def plain_rows(text):
    """The cells, as a plain CSV reader sees them that skips comments."""
    lines = [line for line in text.split("\n") if line and not line.startswith("#")]
    return list(csv.DictReader(lines))


def check_values():
    table, text = run(scenario, "observer.min_elevation_deg=5", 'photometry.bands=["V", "B"]')
    rows = plain_rows(text)
    check(len(table) == len(rows) == 109, f"{len(table)} rows")
    check(table.colnames == list(rows[0]), "names of the columns")
    wanted = {"t_s": "s", "mag_V": "mag", "mag_B": "mag", "range_km": "km",
              "phase_angle_deg": "deg", "azimuth_deg": "deg", "elevation_deg": "deg",
              "sun_elevation_deg": "deg"}
    for name in table.colnames:
        unit = units.Unit(wanted[name]) if name in wanted else None
        check(table[name].unit == unit, f"{name} has the unit {table[name].unit}")
        check(table[name].info.description, f"{name} has no description")
        text_column = name in ("utc", "flags")
        check((table[name].dtype.kind in "US") == text_column, f"type of {name}")
        if text_column:
            check([str(cell) for cell in table[name]] == [row[name] for row in rows], name)
            continue
        cells = [row[name] for row in rows]
        masked = np.ma.getmaskarray(np.ma.asarray(table[name]))
        check(list(masked) == [cell == "" for cell in cells], f"empty cells of {name}")
        same = all(float(cell) == value for cell, value in zip(cells, table[name]) if cell)
        check(same, f"numbers of {name}")
    dark = np.ma.getmaskarray(np.ma.asarray(table["mag_V"]))
    check(0 < dark.sum() < len(table), "some magnitudes are empty, and some are not")
    check(np.all(np.asarray(table["flux_ratio_V"])[dark] == 0), "dark rows have a flux ratio of 0")


def check_meta():
    settings = ["observer.min_elevation_deg=5", "title='a \"quoted\" title'"]
    table, _ = run(scenario, *settings)
    meta = table.meta
    with open(scenario, encoding="utf-8") as file:
        lines = file.read().split("\n")
    check(meta["scenario"] == lines[:-1], "the scenario in the header")
    check(meta["set"] == settings, f"what was set: {meta['set']}")
    check(meta["title"] == 'a "quoted" title', "the title")
    check(meta["zero_point_V"].startswith("apparent magnitude of the Sun -26.76 (vega"), "zero point")
    for key in ("glint_version", "scenario_hash", "time_scale", "dut1_s", "orbit", "light_time",
                "aberration", "self_shadows", "solar_disc", "earthshine", "not_modelled"):
        check(isinstance(meta[key], str) and meta[key], f"{key} in the header")


def check_wild_letters():
    """A scenario with letters that YAML or a reader of lines might trip over."""
    head = (
        'title = "quotes \\" \' backslash \\\\ escape \\u001b next line \\u0085 \u0085 \u2028"\n'
        "# tab \t colon: - dash # {a: [b]} %ECSV &a *b !c |d >e @f `g ~ \u00e9 \u2029 \ufeff \u0080\n"
        "# \U0001f6f0 \ufffd\n"
        "   \n")
    body = """[geometry]
sweep = { phase_deg = [0, 120, 40], plane = "xz" }
[materials.true]
brdf = "lambert"
rho = 0.5
[[component]]
name = "null"
[[component.plate]]
size_m = [1, 1]
normal = [0, 0, 1]
tangent = [1, 0, 0]
material = "true"
[output]
shares = "both"
"""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "wild.toml")
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(head + body)
        table, text = run(path)
        check(table.meta["scenario"] == (head + body).split("\n")[:-1], "wild letters")
        check("utc" not in table.colnames, "given directions have no UTC")
        check("share_component_null" in table.colnames, "names of the shares")
        check(len(plain_rows(text)) == len(table) == 4, "rows of the wild scenario")


check_values()
check_meta()
check_wild_letters()
print(f"{failures} failures")
sys.exit(failures > 0)

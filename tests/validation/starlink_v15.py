#!/usr/bin/env python3
"""Starlink satellites of version 1.5: glint against the sky, and against a published study.

usage: starlink_v15.py PROGRAM WHAT [PAGE]
  formulas   glint's geometry and flux against formulas.py; takes no reference data
  study      the study's 1173 observations with the study's assumptions: its published numbers
  cases      single geometries that were computed with the study's own software
  sky        some of the observations through orbit, attitude and site, against formulas.py
  steps      what each piece of physics changes; with PAGE, holds the table there to the numbers

The study is Fankhauser, Tyson and Askari 2023, Astronomical Journal 166, 59. Its observations and
measurements are read from the folder that GLINT_REFERENCE_DIR names; where they are not, the exit
status is 77. It is 1 where anything lies outside of its tolerance.
"""
import concurrent.futures
import csv
import datetime
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is written beside the sources
import formulas  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
MATERIALS = HERE.parent.parent / "scenarios" / "materials" / "starlink.toml"
MODELS = "inferred", "laboratory", "measured"
BODY_COLUMNS = "sun_x", "sun_y", "sun_z", "obs_x", "obs_y", "obs_z", "range_km"
# Mount Lemmon: latitude and longitude as the observations' file gives them, the height of the
# mountain's observatory in m.
SITE = 32.4434, -110.7881, 2791.0

failures = 0


def check(what, value, limit):
    """Prints a deviation beside its limit, and remembers where it is above. NaN is above."""
    global failures
    good = value <= limit
    failures += not good
    print(f"{'' if good else 'FAILED: '}{what}: {value:.2g}, at most {limit:.2g}")


def largest(values):
    """The largest of some deviations; NaN if any of them is, where max would depend on the order."""
    values = list(values)
    return math.nan if any(map(math.isnan, values)) else max(values)


def relative(value, wanted):
    return abs(value / wanted - 1) if wanted else abs(value)


# ------------------------------------------------------------------------------------- reference data

def reference_folder():
    folder = pathlib.Path(os.environ.get("GLINT_REFERENCE_DIR", "")) / "validation" / "starlink_v15"
    if "GLINT_REFERENCE_DIR" not in os.environ or not folder.is_dir():
        print("SKIPPED: Starlink of version 1.5: GLINT_REFERENCE_DIR names no folder with "
              "validation/starlink_v15")
        sys.exit(77)
    return folder


def read_table(path, names=None):
    """The rows of a CSV file as dictionaries; lines that begin with # are skipped."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    return list(csv.DictReader(lines, fieldnames=names))


class Observation:
    """One magnitude, with where satellite and Sun stood in the site's sky."""

    def __init__(self, row, sun):
        self.time = datetime.datetime.fromisoformat(row["observation_time"])
        self.height_m = 1e3 * float(row["satellite_height"])
        self.altitude_deg = float(row["satellite_altitude"])
        self.azimuth_deg = float(row["satellite_azimuth"])
        self.magnitude = float(row["ab_magnitude"])
        self.sun_deg = sun and (float(sun["altitude"]), float(sun["azimuth"]))


def read_observations(folder):
    rows = read_table(folder / "pomenis_observations.csv")
    suns = read_table(folder / "pomenis_sun_altaz.csv", ("altitude", "azimuth"))
    if len(rows) != len(suns):
        raise ValueError(f"{len(rows)} observations, but {len(suns)} places of the Sun")
    return [Observation(row, sun) for row, sun in zip(rows, suns)]


# -------------------------------------------------------------------------------------------- running

class Workshop:
    """A folder for the time of the script, with the scenarios and all that they name."""

    def __init__(self, program, folder=None):
        self.program = os.path.abspath(program)
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="glint-validation-"))
        for path in (HERE / "starlink_v15").glob("*.toml"):
            shutil.copy(path, self.place)
        shutil.copy(MATERIALS, self.place)
        if folder:
            shutil.copy(folder / "chassis_brdf.csv", self.place)
            shutil.copy(folder / "solar_array_brdf.csv", self.place)
        else:
            self.leave_out_measured()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.place)

    def leave_out_measured(self):
        """Without the measurements, the model without the description that takes them."""
        path = self.place / "models.toml"
        tables = path.read_text(encoding="utf-8").split("\n\n")
        kept = [t for t in tables if 'brdf = "table"' not in t and 'name = "measured-' not in t]
        path.write_text("\n\n".join(kept) + "\n", encoding="utf-8")

    def run(self, scenario, *settings):
        """The rows of a run; what it says goes to standard error."""
        words = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([self.program, "run", "--quiet", "--threads", "1",
                               scenario, *words],
                              check=True, cwd=self.place, stdout=subprocess.PIPE, encoding="utf-8")
        lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
        return list(csv.DictReader(lines))

    def unmeasured(self, scenario):
        """What the summary of a run says of angles between which nothing was measured."""
        done = subprocess.run([self.program, "run", scenario, "-o", os.devnull], check=True,
                              cwd=self.place, stderr=subprocess.PIPE, encoding="utf-8")
        return [line for line in done.stderr.splitlines() if line.startswith("unmeasured")]

    def run_directions(self, geometries):
        """The rows of a run over (sun_body, observer_body, range_m)."""
        with open(self.place / "directions.csv", "w", encoding="utf-8") as file:
            print(*BODY_COLUMNS, sep=",", file=file)
            for sun, observer, range_m in geometries:
                print(*sun, *observer, range_m / 1e3, sep=",", file=file)
        return self.run("directions.toml")

    def place_satellite(self, name, o):
        """Writes the ephemeris of a satellite that rests where it was observed. Nothing in the run
        depends on its velocity: the attitude follows nadir and Sun."""
        position_m, _ = formulas.satellite_position(SITE, o.height_m, o.altitude_deg, o.azimuth_deg)
        epoch = o.time.strftime("%d %b %Y %H:%M:%S.0")
        row = " ".join(repr(v / 1e3) for v in position_m)
        (self.place / name).write_text(
            "stk.v.11.0\nBEGIN Ephemeris\nNumberOfEphemerisPoints 2\n"
            f"ScenarioEpoch {epoch}\nInterpolationMethod Lagrange\nInterpolationSamplesM1 1\n"
            "CentralBody Earth\nCoordinateSystem Fixed\nDistanceUnit Kilometers\n"
            f"EphemerisTimePos\n-10 {row}\n10 {row}\nEND Ephemeris\n", encoding="utf-8")

    def run_sky(self, observations, *settings):
        """One row for each observation, each of its own run."""
        def one(numbered):
            k, o = numbered
            name = f"position-{k}.e"
            if not (self.place / name).exists():
                self.place_satellite(name, o)
            time = o.time.isoformat() + "Z"
            return self.run("sky.toml", f"time.start={time}", f"time.end={time}",
                            f'orbit.stk="{name}"', *settings)[0]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            return list(pool.map(one, enumerate(observations)))


def model_flux(row, model):
    """The flux ratio of one of the descriptions that stand side by side."""
    total = float(row["flux_ratio_V"])
    if not total:
        return 0.0
    return total * sum(float(row[f"share_component_{model}-{part}"]) for part in ("chassis", "array"))


# -------------------------------------------------------------------------------------------- formulas

# Places of satellites in the sky of SITE: UTC, height in m, altitude and azimuth in deg.
SKY = [("2022-03-21T03:00:00", 550e3, 35.0, 250.0), ("2022-03-21T03:10:00", 545e3, 80.0, 10.0),
       ("2022-06-21T11:00:00", 550e3, 25.0, 40.0), ("2022-06-21T03:40:00", 400e3, 50.0, 120.0),
       ("2022-09-05T12:30:00", 560e3, 60.0, 200.0), ("2022-12-20T13:15:00", 550e3, 30.0, 90.0)]
# In the study's frame: how far the observer stands from below the satellite, in deg seen from the
# Earth's centre, across the plane of the Sun and within it, and the angle past the terminator in deg.
FRAME = [(across, along, past) for across, along in ((0, 0), (0, -10), (5, -5), (-8, -12), (15, 5))
         for past in (-20, 0, 12, 22)]


def frame_observer(across_deg, along_deg):
    """Place of an observer in the study's frame, in m."""
    direction = formulas.unit((math.tan(math.radians(across_deg)),
                               math.tan(math.radians(along_deg)), 1.0))
    return tuple(formulas.EARTH_STUDY_M * v for v in direction)


# Irradiance in W/m^2 at an observer straight below a satellite 550 km high, as the study's software
# prints it: model, angle past the terminator in deg.
SPOTS = [("laboratory", 10, 3.79697e-11), ("inferred", 10, 8.44916e-11),
         ("laboratory", 20, 7.78284e-11), ("inferred", 20, 1.66492e-10)]


def check_spots(shop):
    rows = shop.run_directions([formulas.study_frame(550e3, past, frame_observer(0, 0))[:3]
                                for _, past, _ in SPOTS])
    check(f"flux in {len(SPOTS)} geometries of the study's software, relative", largest(
        relative(formulas.IRRADIANCE_STUDY_W_M2 * model_flux(row, model), flux_w_m2)
        for row, (model, _, flux_w_m2) in zip(rows, SPOTS)), 3e-6)


def check_formulas(program):
    geometries = [formulas.study_frame(550e3, past, frame_observer(across, along))[:3]
                  for across, along, past in FRAME]
    with Workshop(program) as shop:
        rows = shop.run_directions(geometries)
        for model in MODELS[:2]:
            check(f"flux of {model} in {len(rows)} given geometries, relative", largest(
                relative(model_flux(row, model), formulas.flux_ratio(model, *geometry))
                for row, geometry in zip(rows, geometries)), 1e-11)
        check_spots(shop)
        check_sky(shop, [Observation({"observation_time": time, "satellite_height": height_m / 1e3,
                                      "satellite_altitude": altitude_deg,
                                      "satellite_azimuth": azimuth_deg, "ab_magnitude": "nan"}, None)
                         for time, height_m, altitude_deg, azimuth_deg in SKY])


def sky_expectation(o):
    """Sun and observer in the body frame, range in m and flux ratio of `inferred` by the formulas.
    The Sun stands where the data have it, else where the Almanac's formulas put it."""
    sun = formulas.sun_fixed(o.time)
    if o.sun_deg:
        sun = formulas.to_fixed(formulas.horizontal(*o.sun_deg), formulas.geodetic_axes(*SITE[:2]))
    geometry = formulas.sky_geometry(SITE, o.height_m, o.altitude_deg, o.azimuth_deg, sun)
    flux = formulas.flux_ratio("inferred", *geometry) / formulas.sun_distance_au(o.time)**2
    return *geometry, flux


def check_sky(shop, observations):
    """Holds glint's geometry and flux of observations to the formulas. The limits are what the Sun's
    place is good for: 0.01 deg by the Almanac's formulas, and 0.001 deg in the data, whose Earth turns
    by the measured UT1 where glint's turns by UTC."""
    sun_deg = 1e-3 if observations[0].sun_deg else 0.015
    rows = shop.run_sky(observations)
    found = {"place in the sky, deg": [], "range, m": [], "phase angle, deg": [],
             "flux of inferred, relative": [], "elevation of the Sun, deg": []}
    for o, row in zip(observations, rows):
        sun, observer, range_m, flux = sky_expectation(o)
        seen = formulas.horizontal(float(row["elevation_deg"]), float(row["azimuth_deg"]))
        wanted = formulas.horizontal(o.altitude_deg, o.azimuth_deg)
        found["place in the sky, deg"].append(formulas.angle_deg(seen, wanted))
        found["range, m"].append(abs(1e3 * float(row["range_km"]) - range_m))
        found["phase angle, deg"].append(
            abs(float(row["phase_angle_deg"]) - formulas.angle_deg(sun, observer)))
        if float(row["sunlit_fraction"]) == 1:
            found["flux of inferred, relative"].append(relative(model_flux(row, "inferred"), flux))
        if o.sun_deg:
            found["elevation of the Sun, deg"].append(
                abs(float(row["sun_elevation_deg"]) - o.sun_deg[0]))
    # The light of a surface goes with the sine of the Sun's small angle to it: a factor of 20.
    limits = 1e-9, 1e-4, sun_deg, 20 * math.radians(sun_deg), sun_deg
    print(f"{len(rows)} observations through orbit, attitude and site, "
          f"{len(found['flux of inferred, relative'])} of them with flux:")
    for (name, values), limit in zip(found.items(), limits):
        if values:
            check("    " + name, largest(values), limit)
    return rows


# --------------------------------------------------------------------------------------- the study

# What the study and its software say of the observations: r, chi2, rms. The digits of the laboratory
# model are those that were published.
PUBLISHED = {"inferred": (("r", 0.6829, 5e-5), ("chi2", 0.1362, 5e-5), ("rms", 0.7615, 5e-5)),
             "laboratory": (("r", 0.69, 5e-3), ("chi2", 0.22, 5e-3), ("rms", 0.974, 5e-4))}


def study_geometries(observations):
    return [formulas.study_geometry(o.height_m, o.altitude_deg, o.azimuth_deg, *o.sun_deg)
            for o in observations]


def table_row(step, model, s):
    """A row of a table in Markdown."""
    return (f"| {step} | {model} | {s['r']:.4f} | {s['chi2']:.4f} | {s['rms']:.4f} "
            f"| {s['mean']:+.4f} | {s['scatter']:.4f} |")


def study_magnitudes(rows, geometries, model):
    """The study has no light within its shadow, and glint knows of none with given directions."""
    return [formulas.study_magnitude(0.0 if dark else model_flux(row, model))
            for row, (*_, dark) in zip(rows, geometries)]


def check_study(program):
    folder = reference_folder()
    observations = read_observations(folder)
    observed = [o.magnitude for o in observations]
    geometries = study_geometries(observations)
    with Workshop(program, folder) as shop:
        rows = shop.run_directions([g[:3] for g in geometries])
        print(*shop.unmeasured("directions.toml"), sep="\n")
    mean = sum(observed) / len(observed)
    rms = math.sqrt(sum((o - mean)**2 for o in observed) / len(observed))
    print(f"rms of the observed magnitudes about their mean: {rms:.4f}")
    for model, published in PUBLISHED.items():
        calculated = study_magnitudes(rows, geometries, model)
        found = formulas.statistics(calculated, observed)
        for name, value, limit in published:
            check(f"{model}, {len(observed)} observations: {name} = {found[name]:.5f}, published "
                  f"{value}, difference", abs(found[name] - value), limit)
        check(f"{model}: flux against the formulas, relative", largest(
            relative(model_flux(row, model), formulas.flux_ratio(model, *g[:3]))
            for row, g in zip(rows, geometries)), 1e-11)
    sunlit = [k for k, g in enumerate(geometries) if not g[3]]
    calculated = study_magnitudes(rows, geometries, "inferred")
    found = formulas.statistics([calculated[k] for k in sunlit], [observed[k] for k in sunlit])
    check(f"inferred, the {len(sunlit)} outside of the shadow: rms = {found['rms']:.5f}, published "
          "0.748, difference", abs(found["rms"] - 0.748), 5e-4)


# Every so many observations go through orbit, attitude and site in `sky`, each with a run of its own.
SKY_STRIDE = 20


def check_sky_sample(program):
    folder = reference_folder()
    with Workshop(program, folder) as shop:
        shop.leave_out_measured()
        check_sky(shop, read_observations(folder)[::SKY_STRIDE])


def check_cases(program):
    folder = reference_folder()
    cases = read_table(folder / "starlink_v1p5_satframe_cases.csv")
    geometries = [formulas.study_frame(
        float(c["sat_height_m"]), float(c["apt_deg"]),
        tuple(float(c[f"obs_{axis}_m"]) for axis in "xyz")) for c in cases]
    with Workshop(program, folder) as shop:
        rows = shop.run_directions([g[:3] for g in geometries])
    for model, column in (("inferred", "flux_inferred_sun"), ("laboratory", "flux_lab_sun")):
        deviations, lit = [], 0
        for case, row, (*_, dark) in zip(cases, rows, geometries):
            wanted_w_m2 = float(case[column])
            flux_w_m2 = formulas.IRRADIANCE_STUDY_W_M2 * model_flux(row, model) * (not dark)
            deviations.append(relative(flux_w_m2, wanted_w_m2))
            lit += wanted_w_m2 > 0
        check(f"{model}: flux in {len(cases)} geometries, {lit} of them lit, relative",
              largest(deviations), 1e-6)


# ------------------------------------------------------------------------------------------- the steps

SUN_V_AB = -26.77  # magnitude of the Sun in V, AB: Willmer 2018, Astrophysical Journal Supplement 236, 47
# Areas of chassis and array in m^2: of the study's code, and of its description of the surfaces.
AREAS_CODE, AREAS_TEXT = (3.65, 22.0), (3.64, 22.68)
DISC = 'photometry.solar_disc="uniform"'
EARTH_LAMBERT = "photometry.earthshine={ albedo = 0.3 }"
# The study's vegetation: Phong's model as fitted to it there.
EARTH_VEGETATION = 'photometry.earthshine={ brdf = "phong", rho_d = 0.53, rho_s = 0.28, n = 7.31 }'


def hard_shadow_magnitude(row, model):
    """As if the satellite saw all of the Sun or nothing: all where more than half of it is seen."""
    fraction = float(row["sunlit_fraction"])
    return formulas.study_magnitude(model_flux(row, model) / fraction if fraction > 0.5 else 0.0)


def magnitude(row, model):
    return formulas.study_magnitude(model_flux(row, model))


def text_areas_magnitude(row, model):
    """With the other areas; those of `inferred` are 1 m^2 each."""
    if model == "inferred":
        return magnitude(row, model)
    flux = float(row["flux_ratio_V"])
    return formulas.study_magnitude(sum(
        flux * float(row[f"share_component_{model}-{part}"] or 0) * text_m2 / code_m2
        for part, code_m2, text_m2 in zip(("chassis", "array"), AREAS_CODE, AREAS_TEXT)))


def v_magnitude(row, model):
    """With the Sun's own magnitude in V in place of 1360 W/m^2 at 532 nm."""
    return formulas.magnitude(model_flux(row, model), SUN_V_AB)


def tables_of_steps(program):
    """The lines of two tables: of all steps, and of the residuals by the Sun's incidence."""
    folder = reference_folder()
    observations = read_observations(folder)
    observed = [o.magnitude for o in observations]
    geometries = study_geometries(observations)
    steps = ["| step | description | R | chi^2 | RMS | mean | scatter |", "|---|---|---|---|---|---|---|"]

    def add_step(step, rule, rows):
        for model in MODELS:
            calculated = [rule(row, model) for row in rows]
            steps.append(table_row(step, model, formulas.statistics(calculated, observed)))

    with Workshop(program, folder) as shop:
        rows = shop.run_directions([g[:3] for g in geometries])
        for row, (*_, dark) in zip(rows, geometries):
            row["flux_ratio_V"] = "0" if dark else row["flux_ratio_V"]
        add_step("0 the study", magnitude, rows)
        rows = shop.run_sky(observations)
        add_step("1 real Earth and Sun", hard_shadow_magnitude, rows)
        add_step("2 penumbra", magnitude, rows)
        sunlight = shop.run_sky(observations, DISC)
        add_step("3 finite Sun", magnitude, sunlight)
        rows = shop.run_sky(observations, DISC, EARTH_LAMBERT)
        add_step("4 earthshine", magnitude, rows)
        add_step("5 earthshine, vegetation", magnitude,
                 shop.run_sky(observations, DISC, EARTH_VEGETATION))
    add_step("6 areas of the text", text_areas_magnitude, rows)
    add_step("7 the Sun in V", v_magnitude, rows)
    angles = by_incidence({"the Sun": sunlight, "Sun and Earth": rows}, geometries, observed)
    return {"steps": steps, "angles": angles}


INCIDENCES_DEG = (0, 70), (70, 75), (75, 80), (80, 85), (85, 90)


def by_incidence(lights, geometries, observed):
    """Mean and rms of each description where the Sun stands so far from the chassis's normal."""
    lines = ["| incidence, deg | rows | light of | inferred | laboratory | measured |",
             "|---|---|---|---|---|---|"]
    for low_deg, high_deg in INCIDENCES_DEG:
        inside = [k for k, (sun, *_) in enumerate(geometries)
                  if low_deg <= formulas.angle_deg(sun, formulas.CHASSIS_NORMAL) < high_deg]
        for light, rows in lights.items():
            found = [formulas.statistics([magnitude(rows[k], model) for k in inside],
                                         [observed[k] for k in inside]) for model in MODELS]
            cells = " | ".join(f"{f['mean']:+.2f}, {f['rms']:.2f}" for f in found)
            lines.append(f"| {low_deg} to {high_deg} | {len(inside)} | {light} | {cells} |")
    return lines


def make_steps(program, page=None):
    """Prints the tables; with a page, also holds those there to them."""
    for name, lines in tables_of_steps(program).items():
        print(*lines, "", sep="\n")
        if page:
            text = pathlib.Path(page).read_text(encoding="utf-8")
            written = text.split(f"<!-- begin {name} -->\n")[1].split("\n<!-- end -->")[0]
            written = written.split("\n")
            check(f"lines of {name} in {page} that say something else",
                  sum(a != b for a, b in zip(lines, written)) + abs(len(lines) - len(written)), 0)


def main():
    commands = {"formulas": check_formulas, "study": check_study, "cases": check_cases,
                "sky": check_sky_sample, "steps": make_steps}
    words = sys.argv[1:]
    if len(words) not in (2, 3) or words[1] not in commands or (len(words) == 3
                                                                and words[1] != "steps"):
        print(__doc__, file=sys.stderr)
        return 2
    commands[words[1]](words[0], *words[2:])
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

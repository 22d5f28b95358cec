# SPDX-License-Identifier: GPL-3.0-or-later
"""What disturbances of a test do to the law that is identified, before and after: a page.

    identification.py PROGRAM FABRIC > docs/verification/identification.md
    identification.py PROGRAM FABRIC PAGE      # answers 1 if some of its tables are others

Curves of the law in FABRIC with noise and one disturbance each are identified by least squares
alone, here in NumPy, and by `plyform identify` without and with the option that corrects them.
Leaves with 77 when NumPy is missing.
"""

import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

try:
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

program, fabric = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
page = Path(sys.argv[3]) if len(sys.argv) > 3 else None

K = np.array([0.37044, 0.84105, 1.03113])  # N mm, of FABRIC
CELLS = 0.0625  # 1/mm2
STIFFNESS = 46000.0  # N per yarn
YARNS, GAUGE = 25, 200.0
CURVES = 20
#: Noise of the load and of its largest value.
NOISE = {"careful": (0.003, 0.0005), "common": (0.01, 0.002)}

HEAD = "# Identification from disturbed curves\n\n" + " ".join([
    "Made by `tests/python/identification.py PROGRAM cases/fabrics/glass_plain_weave.toml`, and",
    "held by a test that makes some of it. Each curve is of the law of the glass weave",
    "([fabrics.md](../users/fabrics.md) has it,",
    "[identify.md](../users/identify.md#what-a-machine-adds) the options), 61 rows up to 55 degrees or 1 % of strain, with noise and one",
    "disturbance; 20 curves a line with other noise, ten of the weave whose yarns stick. Wrong by: largest deviation of the law from",
    "5 to 55 degrees, of yarns that of the stiffness; median of the curves, and the worst.",
    "Before: least squares alone, which look for no disturbance. Refused,",
    "warned: what `plyform identify` says without the option, in words that name the disturbance",
    "and its size; told that it is not known: warned that the curve does not show whether it is",
    "there; not seen: only the line on how far the law would move tells of it. After: with the",
    "option. Measured angles scatter by 0.1 degrees. A load zero too low is refused in the strip",
    "where the first load is below -2 % of the largest."]) + "\n\n"


def torque(law, g):
    """Of coefficients k1, k3 ..., or of rows of degrees and N mm: core/model/monotone_curve.hpp."""
    if law.ndim == 1:
        return sum(k * g**(2 * n + 1) for n, k in enumerate(law))
    x, y = np.radians(law[:, 0]), law[:, 1]
    h, s = np.diff(x), np.diff(y) / np.diff(x)
    m = np.empty(len(x))
    m[0] = s[0]
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    safe = np.maximum(s, 1e-300)
    m[1:-1] = np.where((s[1:] > 0) & (s[:-1] > 0),
                       (w1 + w2) / (w1 / safe[:-1] + w2 / safe[1:]), 0.0)
    end = ((2 * h[-1] + h[-2]) * s[-1] - h[-1] * s[-2]) / (h[-1] + h[-2]) if len(s) > 1 else s[-1]
    m[-1] = np.clip(end, 0.0, 3 * s[-1])
    i = np.clip(np.searchsorted(x, g, side="right") - 1, 0, len(h) - 1)
    t = (np.minimum(g, x[-1]) - x[i]) / h[i]
    rise = t * t * (3 - 2 * t)
    return (1 - rise) * y[i] + rise * y[i + 1] + h[i] * t * (1 - t) * (
        (1 - t) * m[i] - t * m[i + 1]) + m[-1] * np.maximum(g - x[-1], 0.0)


@dataclass(eq=False)
class Shear:
    """Equations (40), (41): D, areas sheared as a whole and by half."""
    name: str
    options: list
    diagonal: float
    whole: float
    half: float
    law: np.ndarray = field(default_factory=lambda: K)
    first: float = 0.0  # degrees, of the first row

    def angle(self, extension):
        e = extension / self.diagonal
        return np.arcsin(e * (2 + e))

    def extension(self, angle):
        return self.diagonal * (np.sqrt(1 + np.sin(angle)) - 1)

    def columns(self, extension):
        g = self.angle(extension)
        rate = 2 * (1 + extension / self.diagonal) / (self.diagonal * np.cos(g))
        return np.stack([CELLS * rate * (self.whole * g**n + 0.5 * self.half * (g / 2)**n)
                         for n in (1, 3, 5)], axis=1)

    def curve(self, first=0.0):
        """61 rows from an extension to the one of 55 degrees, mm and N."""
        first = first + self.extension(np.radians(self.first))
        x = np.linspace(first, self.extension(np.radians(55)), 61)
        g = self.angle(x)
        rate = 2 * (1 + x / self.diagonal) / (self.diagonal * np.cos(g))
        return x, CELLS * rate * (self.whole * torque(self.law, g)
                                  + 0.5 * self.half * torque(self.law, g / 2))

    def plain(self, x, y):
        """Least squares and nothing else: weights 1 / max(load, a tenth of the largest)."""
        a, fitted = self.columns(np.maximum(x, 0.0)), y
        for _ in range(30):
            weight = 1 / np.maximum(fitted, 0.1 * y.max())
            k = np.linalg.lstsq(a * weight[:, None], y * weight, rcond=None)[0]
            fitted = a @ k
        return k

    def wrong(self, law):
        g = np.radians(np.arange(5.0, 55.1, 0.5))
        return np.abs(torque(law, g) / torque(self.law, g) - 1).max()

    def law_in(self, file):
        """Coefficients, or a table of angles and torques."""
        shear = tomllib.loads(file.read_text())["shear"]
        return np.array(shear["polynomial"] if "polynomial" in shear else shear["table"])


@dataclass
class Tension:
    name: str = "warp"
    options: list = field(default_factory=lambda: ["--yarns", str(YARNS), "--gauge-length",
                                                   str(GAUGE)])

    def curve(self, first=0.0):
        x = np.linspace(first, 2.0, 61)
        return x, YARNS * STIFFNESS * x / GAUGE

    def plain(self, x, y):
        fitted = y
        for _ in range(30):
            weight = 1 / np.maximum(fitted, 0.1 * y.max())
            k = (weight**2 * x * y).sum() / (weight**2 * x * x).sum()
            fitted = k * x
        return k * GAUGE / YARNS

    def wrong(self, k):
        return abs(k / STIFFNESS - 1)

    def law_in(self, file):
        warp = tomllib.loads(file.read_text())["warp"]
        return warp["stiffness"] if "stiffness" in warp else np.nan


BIAS = Shear("bias", ["--length", "300", "--width", "100"], 200.0, 15000.0, 10000.0)
FRAME = Shear("frame", ["--side", "200"], 200 * np.sqrt(2), 40000.0, 0.0)
WARP = Tension()
#: A weave whose yarns stick up to 0.3 N mm, overcome within a degree, and then turn as the glass
#: weave's do.
_g = np.concatenate([np.arange(0.0, 1.0, 0.125), np.arange(1.0, 60.0, 0.5)])
_s = 0.5 * np.minimum(_g, 1.0) * (3 - np.minimum(_g, 1.0)**2)
STICKING = np.stack([_g, 0.3 * _s + torque(K, np.radians(_g))], axis=1)
STUCK = Shear("bias", ["--length", "300", "--width", "100"], 200.0, 15000.0, 10000.0, STICKING)
LATE = Shear("frame", ["--side", "200"], 200 * np.sqrt(2), 40000.0, 0.0, first=5.0)
STUCK_LATE = Shear("frame", ["--side", "200"], 200 * np.sqrt(2), 40000.0, 0.0, STICKING, 5.0)
#: Tests of which less is asked: laws that no polynomial follows, rows that hide the zero.
MORE = (STUCK, LATE, STUCK_LATE)


@dataclass
class Disturbance:
    title: str
    #: test and its undisturbed curve -> x, y, columns of the file by name
    make: callable
    remedy: list
    #: Word of the message that finds it; None: nothing is to be found.
    word: object = None
    base: tuple = ("--compliance", "0")
    #: The warning of what the curve does not show names it.
    unknown: str = ""


def shifted(test, by):
    """A curve whose displacement was set to zero at the extension `by`; below 0: slack before."""
    if by >= 0:
        x, y = test.curve(by)
        return x - by, y
    x, y = test.curve()
    return np.concatenate([[0.0], x - by]), np.concatenate([[0.0], y])


def sudden(x, by):
    return x + by * (x > 0.6 * x.max())


def lines(test):
    """Disturbances of a test: title, x and y before noise, remedy, word of the message."""
    x, y = test.curve()
    short = 0.1 if test is WARP else 1.0
    soft = 0.0001 if test is WARP else 0.02
    found = [
        Disturbance("none", lambda: (x, y), ["--compliance", "0"]),
        Disturbance("load zero 2 % of the largest load too high", lambda: (x, y + 0.02 * y.max()),
                    ["--zero", "fit"], "load zero"),
        Disturbance("load zero 2 % too low", lambda: (x, y - 0.02 * y.max()), ["--zero", "fit"],
                    "load zero"),
        Disturbance(f"displacement zero set {short:g} mm late", lambda: shifted(test, short),
                    ["--toe", "fit"], "too late", unknown="displacement zero"),
        Disturbance(f"slack of {short:g} mm", lambda: shifted(test, -short), ["--toe", "fit"],
                    "slack", unknown="displacement zero"),
        Disturbance("the same, its size known", lambda: shifted(test, -short),
                    ["--toe", f"{short:g}"], "slack", unknown="displacement zero"),
        Disturbance(f"compliance of {soft:g} mm/N", lambda: (x + soft * y, y),
                    ["--compliance", f"{soft:g}"], "compliance", ())]
    if test in (LATE, STUCK_LATE):
        return found[:2]
    if test is STUCK:  # which hides where it began: fit finds no displacement zero
        found[3].remedy = [f"--toe=-{short:g}"]
        del found[4]
        found[4].title = f"slack of {short:g} mm"
    if test is not WARP:
        found += [
            Disturbance("slip of 5 mm, growing with the extension",
                        lambda: (x * (1 + 5 / x.max()), y), ["--angle-column", "gamma_deg"],
                        "too large", (), "slip in the clamps that goes on"),
            Disturbance("slip of 5 mm at once", lambda: (sudden(x, 5.0), y), ["--slip", "fit"],
                        "a slip of")]
    found.append(Disturbance("load in kN, taken for N: a thousandth", lambda: (x, y / 1000),
                             ["--y-unit", "kN"], "no fabric's"))
    return found


@dataclass
class Outcome:
    plain: float
    refused: bool
    found: bool
    after: float
    noticed: bool
    told: bool


def identify(test, file, options, output):
    """Exit code, what is printed, and the law; None if it is refused."""
    call = [program, "identify", test.name, file, *test.options, "--fabric", fabric, "-o", output,
            *options]
    done = subprocess.run(list(map(str, call)), capture_output=True, text=True, check=False)
    assert done.returncode in (0, 2), done.stderr
    law = test.law_in(output) if done.returncode == 0 else None
    return done.returncode, done.stderr, law


def write(file, columns):
    np.savetxt(file, np.stack(list(columns.values()), axis=1), delimiter=",",
               header=",".join(columns), comments="", fmt="%.9g")


def outcome(test, case, noise, seed, folder):
    random = np.random.RandomState(seed)
    x, y = case.make()
    y = y * (1 + noise[0] * random.randn(len(y))) + noise[1] * y.max() * random.randn(len(y))
    columns = {"displacement_mm": x, "force" if "kN" in case.title else "force_N": y}
    file, output = folder / "curve.csv", folder / "law.toml"
    write(file, columns)
    plain = test.plain(x, y)
    code, text, law = identify(test, file, case.base, output)
    if law is not None and np.shape(law) == np.shape(plain) and not np.isnan(np.sum(law)) \
            and x.min() >= 0:
        assert np.allclose(law, plain, rtol=1e-3), (case.title, law, plain)
    if "--angle-column" in case.remedy:
        true = np.degrees(test.angle(test.curve()[0]))
        columns = {**columns, "gamma_deg": true + 0.1 * random.randn(len(true))}
        write(file, columns)
    remedy = case.remedy if "--compliance" in case.remedy or "--angle-column" in case.remedy \
        else [*case.remedy, "--compliance", "0"]
    _, after_text, after = identify(test, file, remedy, output)
    assert after is not None or test in MORE, (case.title, after_text)
    words = [case.word or "the rows show"] + (["must not be below 0"] if y.min() < 0 else [])
    return Outcome(test.wrong(plain), code == 2, any(word in text for word in words),
                   np.nan if after is None else test.wrong(after), "the rows show" in text,
                   f"{case.unknown} (" in text)


def percent(share):
    return f"{100 * share:.0f} %" if share >= 0.095 else f"{100 * share:.2g} %"


def counts(outcomes, case):
    other = sum(o.refused and not o.found for o in outcomes)
    refused = sum(o.refused for o in outcomes) - other
    warned = sum(o.found and not o.refused for o in outcomes)
    if case.word is None:
        return "nothing" if not any(o.noticed for o in outcomes) else \
            f"{sum(o.noticed for o in outcomes)} false alarms"
    parts = [f"{n} {word}" for n, word in ((refused, "refused"), (warned, "warned"),
                                           (other, "refused as no law, for nothing named")) if n]
    told = sum(o.told and not o.found for o in outcomes) if case.unknown else 0
    if told:
        parts.append(f"{told} told that it is not known")
    silent = len(outcomes) - refused - warned - told - other
    if silent:
        parts.append(f"{silent} not seen")
    return ", ".join(parts)


def table(test, noise, folder):
    curves = CURVES // 2 if test in MORE else CURVES
    text = f"| disturbance | law wrong by, before | `plyform identify`, of {curves} | option " \
        "| law wrong by, after; worst |\n|---|---|---|---|---|\n"
    for case in lines(test):
        outcomes = [outcome(test, case, noise, seed, folder) for seed in range(curves)]
        assert test in MORE or not any(o.refused and not o.found for o in outcomes), case.title
        plain = np.median([o.plain for o in outcomes])
        after = [o.after for o in outcomes if not np.isnan(o.after)]
        lost = f"; {curves - len(after)} refused" if len(after) < curves else ""
        text += f"| {case.title} | {percent(plain)} | {counts(outcomes, case)} " \
            f"| {'' if case.word is None else '`' + ' '.join(case.remedy) + '`'} " \
            f"| {percent(np.median(after))}; {percent(max(after))}{lost} |\n"
    return text


def own_file(folder):
    """The file that `plyform theory frame` writes, with an angle in its second column."""
    file, output = folder / "theory.csv", folder / "law.toml"
    subprocess.run([program, "theory", "frame", "--side", "200", "--fabric", fabric, "--to", "55",
                    "-o", file], check=True, capture_output=True)
    rows = np.loadtxt(file, delimiter=",", skiprows=1)
    before = FRAME.plain(rows[:, 0], rows[:, 1])
    _, _, law = identify(FRAME, file, ["--compliance", "0"], output)
    _, named, refused = identify(FRAME, file, ["--y-column", "shear_deg"], output)
    assert refused is None and "shear_deg" in named
    return "`theory frame` writes displacement, shear angle and load. With the second column " \
        f"taken for the load, k1 = {before[0]:.3f}; `identify frame` takes force_N by its " \
        f"header, k1 = {law[0]:.3f} for {K[0]:.3f}, and refuses `--y-column shear_deg`:\n\n" \
        f"    {named.splitlines()[-1].split('error: ')[1]}\n"


def specimens(folder, count, sets):
    """Limits of confidence: how often they hold the law that the curves were made from."""
    random = np.random.RandomState(7)
    held, widths = 0, []
    x, y = BIAS.curve()
    for _ in range(sets):
        files = []
        for n in range(count):
            factor = 1.0 if count == 1 else 1 + 0.05 * random.randn()
            noisy = y * factor * (1 + 0.01 * random.randn(61)) \
                + 0.002 * y.max() * random.randn(61)
            files.append(folder / f"specimen{n}.csv")
            write(files[-1], {"displacement_mm": x, "force_N": noisy})
        call = [program, "identify", "bias", *files, *BIAS.options, "--fabric", fabric, "-o",
                folder / "law.toml", "--compliance", "0"]
        done = subprocess.run(list(map(str, call)), capture_output=True, text=True, check=True)
        law = BIAS.law_in(folder / "law.toml")
        line = next(s for s in done.stdout.splitlines() if "95 % limits" in s)
        limit = float(line.split("k1 +- ")[1].split(",")[0])
        widths.append(limit / K[0])
        held += abs(law[0] - K[0]) <= limit
    return held / sets, np.median(widths)


def make_page(tables=None):
    """The page, or of it these tables of a noise and a test, without what follows them."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = HEAD
        for word, noise in NOISE.items():
            text += f"## {word.capitalize()} noise: {100 * noise[0]:g} % of the load and " \
                f"{100 * noise[1]:g} % of the largest load\n\n"
            for title, test in (("Bias-extension test, 300 x 100 mm", BIAS),
                                ("Picture frame, 200 mm", FRAME),
                                ("Strip of 25 warp yarns, 200 mm", WARP),
                                ("Bias-extension test of a weave whose yarns stick: a static "
                                 "torque of 0.3 N mm within 1 degree before the glass weave's "
                                 "(before: the polynomial)", STUCK),
                                ("Picture frame of the glass weave whose rows begin at 5 degrees",
                                 LATE),
                                ("The same of the weave whose yarns stick", STUCK_LATE)):
                if tables is None or (word, test) in tables:
                    text += f"{title}:\n\n{table(test, noise, folder)}\n"
        text += f"## Columns\n\n{own_file(folder)}\n"
        if tables is not None:
            return text
        text += "## Limits of confidence\n\nHow often the 95 % limits of k1 held the k1 that the " \
            "bias curves were made from, common noise; five specimens differ by 5 % (standard " \
            "deviation):\n\n| specimens | sets of curves | held | median of the limits |\n" \
            "|---|---|---|---|\n"
        for count, sets in ((1, 100), (5, 40)):
            held, width = specimens(folder, count, sets)
            text += f"| {count} | {sets} | {percent(held)} | +- {percent(width)} |\n"
    return text


if page is None:
    sys.stdout.write(make_page())
else:  # what takes a minute: tables that hold a law found with and without a static torque
    made = make_page([("careful", BIAS), ("careful", STUCK_LATE), ("common", LATE)])
    stands = page.read_text(encoding="utf-8").splitlines()
    stale = [line for line in made.splitlines() if line not in stands]
    if stale:
        sys.exit("\n".join([*stale, f"{page} is stale: make it anew"]))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Another program's two plies over a hemisphere: as its file says, and as plyform would."""

import numpy as np
from measured_work import CASES, Run, Work, number, plt, table

FOLDER = CASES / "two_ply_hemisphere"
PLIES = {"ply0": "0°/90°", "ply45": "±45°"}
AS_IT_SAYS = {"duration": 0.05, "damping": 500.0}


def draw_in(result: Run, ply: str) -> tuple:
    """How far the middle of a side and the corner have come nearer to the axis, mm; and how far the
    rim has risen."""
    _, before, now, _ = result.ply(ply)
    reach = before[:, :2].max(axis=0)
    ways = []
    for place in ((reach[0], 0.0), (reach[0], reach[1])):
        node = np.argmin(np.hypot(before[:, 0] - place[0], before[:, 1] - place[1]))
        ways.append(np.hypot(*before[node, :2]) - np.hypot(*now[node, :2]))
    rim = (before[:, 0] > reach[0] - 1e-6) | (before[:, 1] > reach[1] - 1e-6)
    return (*ways, float((now - before)[rim, 2].max()))


def largest(result: Run, ply: str) -> float:
    return result.summary["plies"][list(PLIES).index(ply)]["max_shear_deg"]


def apart(result: Run, base: Run) -> str:
    """Rms difference of shear angles on the same mesh, both plies."""
    shears = [(result.ply(ply)[3], base.ply(ply)[3]) for ply in PLIES]
    if any(len(a) != len(b) for a, b in shears):
        return ""
    difference = np.concatenate([np.abs(a) - np.abs(b) for a, b in shears])
    return f"{np.sqrt(np.mean(difference**2)):.1f}°"


def row(words: str, result: Run, base: Run) -> list:
    punch = next(t for t in result.summary["tools"] if t["name"] == "punch")["force_N"]
    energy = result.summary["energy"]
    dissipated = energy["damping"] / energy["external"]
    held = [draw_in(result, ply) for ply in PLIES]
    return [words, *(f"{largest(result, ply):.0f}°" for ply in PLIES),
            "" if result is base else apart(result, base), f"{number(punch, 2)} N",
            *(f"{side:.0f}, {corner:.0f} mm" for side, corner, _ in held),
            f"{max(rise for _, _, rise in held):.0f} mm",
            f"{100 * dissipated:.0f} %",
            f"{100 * energy['kinetic'] / energy['external']:.1f} %"]


def part(work: Work) -> str:
    text = "## Two plies over a hemisphere, another program's example\n\n" \
        "An input of COMFOR ([case and how it is read]" \
        "(../../cases/two_ply_hemisphere/README.md)) has two plies, a punch and a die, and no " \
        "results. It is the other way round here: not whether the answers agree, but what the " \
        "settings of such a file do to an answer. It has no blank-holder, no friction and no " \
        "bending, a damping of all motion and, read in N, mm and s, 10 000 times the mass of " \
        "cloth. A quarter is modelled.\n\n"
    if work.cheap:
        now = allowed(work, "two_ply_as", FOLDER / "case.toml")
        work.holds(largest(now, "ply0"), 0.05, "Two plies", ["as its file says"], 1)
        return text

    def run(name, case="case.toml", **changes):
        return allowed(work, f"two_ply_{name}", FOLDER / case, **changes)

    base = run("as")
    slow = run("slow", solver__duration=5.0)
    own = run("own", "with_holder.toml")
    rows = [row("as its file says", base, base),
            row("without its damping", run("undamped", solver__mass_damping=0), base),
            row("ten times slower", run("slower", solver__duration=0.5), base),
            row("hundred times slower", slow, base),
            row("friction 0.2", run("friction", contact__friction=0.2), base),
            row("contact a fifth as stiff", run("contact", contact__stiffness=0.02), base),
            row("elements of 4 mm", run("fine", blanks__quarter__element_size=4), base),
            row("as plyform would: `with_holder.toml`", own, base)]
    picture = draw(work, [(base, "as its file says"), (slow, "hundred times slower"),
                          (own, "blank-holder and friction")])
    energy = base.summary["energy"]
    text += table(["", *(f"largest shear, {angles}" for angles in PLIES.values()),
                   "rms from the first", "punch",
                   *(f"draw-in of {angles}: side, corner" for angles in PLIES.values()),
                   "rim risen", "work damped", "kinetic"], rows)
    return text + f"\n![Shear angles of both plies from above]({picture})\n\n" \
        f"**In that file inertia and damping are the blank-holder.** Of the punch's work " \
        f"{100 * energy['damping'] / energy['external']:.0f} % goes into the damping of motion " \
        f"and {100 * energy['shear'] / energy['external']:.0f} % into shear; what resists being " \
        "drawn in is that damping on the flange. Slower, nothing holds it: the plies follow the " \
        f"punch by tilting and folding, the largest angle falls from {largest(base, 'ply0'):.0f} " \
        f"to {largest(slow, 'ply0'):.0f} degrees and the rim rises. So that field is one of a " \
        "speed, not of a process, whatever units the file is in (all of it keeps its ratios). " \
        "A holder and friction give angles of the " \
        f"same size ({largest(own, 'ply0'):.0f} and {largest(own, 'ply45'):.0f} degrees) by what " \
        "a press has and whatever the speed, but at other places: nearer to the pole, and spread " \
        "evenly. Contact settings and friction matter little beside that.\n"


def allowed(work: Work, name: str, case, **changes) -> Run:
    """A run that may end as doubtful: with the example's own mesh it must."""
    folder = work.folder / name
    sets = [part for key, value in changes.items()
            for part in ("--set", f"{key.replace('__', '.')}={value}")]
    done = work.call("run", case, "-o", folder, *sets)
    result = Run(folder)
    assert result.summary["status"] in ("done", "doubtful"), done.stderr
    return result


def draw(work: Work, runs: list) -> str:
    figure, axes = plt.subplots(2, len(runs), figsize=(11, 7), sharex=True, sharey=True)
    for column, (result, words) in enumerate(runs):
        for axis, (ply, angles) in zip(axes[:, column], PLIES.items()):
            triangles, _, now, shear = result.ply(ply)
            field = axis.tripcolor(now[:, 0], now[:, 1], triangles, np.abs(shear), vmin=0, vmax=25,
                                   cmap="viridis")
            axis.set(aspect="equal", title=f"{words}, {angles}")
            axis.title.set_fontsize(9)
    figure.colorbar(field, ax=axes, shrink=0.7, label="shear angle (degrees)")
    name = "measured_two_ply.png"
    figure.savefig(work.pictures / name, dpi=80, bbox_inches="tight")
    plt.close(figure)
    return name

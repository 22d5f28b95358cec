# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run shows of itself when it is asked: live_picture_test.py TOOLS PROGRAM CASES. It is there
between the states, is what the run looks like, goes away, and changes nothing; so does the fast run before it
that looks where small elements are needed."""

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pushed_ply import pushed_ply

try:
    import h5py
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

FROM_SCENE = ("mesh = \"alternating\"\nelement_size = 12.0", "element_size = 30.0\nmesh_from = \"scene\"")
TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(TOOLS))
from workbench.project.arrays import unpacked  # noqa: E402


def formed(out: Path, asks: bool, change: tuple[str, str] = ("", "")) -> list[bytes]:
    """Runs a case; the pictures that it has drawn."""
    case = out.with_suffix(".toml")
    case.write_text(pushed_ply(CASES / "fabrics", 300.0, 12.0, 0.3, 24).replace(*change))
    run = subprocess.Popen([PROGRAM, "run", case, "-o", out, "--threads", "2"],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found: list[bytes] = []
    while run.poll() is None:
        if asks and (out / "progress.json").exists():
            (out / "picture.ask").touch()
            try:
                content = (out / "picture.bin").read_bytes()
            except FileNotFoundError:
                content = b""
            if content and content != (found or [b""])[-1]:
                found.append(content)
        time.sleep(0.02)
    assert run.returncode == 0, run.returncode
    (out / "picture.ask").unlink(missing_ok=True)  # asked for when it had just ended
    return found


def check(content: bytes, results: h5py.File) -> int:
    """The step. Nodes are about where they are between the states before and after."""
    header, arrays = unpacked(content)
    ply, = header["plies"]
    x = np.frombuffer(arrays, "<f4", ply["x"]["count"], ply["x"]["at"]).reshape(-1, 3)
    shear = np.frombuffer(arrays, "<f4", ply["field"]["count"], ply["field"]["at"])
    fixed = results["plies/ply"]
    assert x.shape == fixed["x0"].shape and shear.shape == fixed["triangles"].shape[:1]
    assert [tool["name"] for tool in header["tools"]] == ["punch", "die"]
    times = results["time_s"][()]
    after = int(np.searchsorted(times, header["time_s"]).clip(1, len(times) - 1))
    ends = [results[f"frames/{k:06d}/plies/ply/x"][()] for k in (after - 1, after)]
    share = (header["time_s"] - times[after - 1]) / (times[after] - times[after - 1])
    between = (1.0 - share) * ends[0] + share * ends[1]
    away = np.abs(x - between).max()
    assert away < 2.0 * np.abs(ends[1] - ends[0]).max() + 0.1, (header["step"], share, away)  # plies swing
    strokes = results["stroke_mm"][()]
    assert strokes[after - 1] <= header["stroke_mm"] <= strokes[after], (header["step"], header["stroke_mm"])
    assert abs(header["tools"][0]["shift"][2] + header["stroke_mm"]) < 1e-6 and 0.0 <= header["stroke_mm"] <= 40.0
    assert float(np.abs(shear).max()) < 60.0
    return header["step"]


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        watched, alone = Path(folder) / "watched", Path(folder) / "alone"
        pictures = formed(watched, True)
        formed(alone, False)
        assert len(pictures) >= 3, len(pictures)
        with h5py.File(watched / "results.h5") as results:
            steps = [check(content, results) for content in pictures]
        assert steps == sorted(set(steps)), steps
        print(f"{len(steps)} pictures, steps {steps[0]} to {steps[-1]}")
        assert sorted(p.name for p in watched.iterdir()) == sorted(p.name for p in alone.iterdir()), \
            sorted(p.name for p in watched.iterdir())
        for name in ("results.h5", "history.csv"):
            assert (watched / name).read_bytes() == (alone / name).read_bytes(), name
        shutil.rmtree(watched)
        check_scout(Path(folder))


def check_scout(folder: Path) -> None:
    watched, alone = folder / "scouted", folder / "scouted_alone"
    headers = [unpacked(content) for content in formed(watched, True, FROM_SCENE)]
    formed(alone, False, FROM_SCENE)
    scouts = [one for one in headers if one[0].get("scouting")]
    assert scouts and len(scouts) < len(headers), (len(scouts), len(headers))
    assert all("scouting" not in header for header, _ in headers[len(scouts):])
    for header, arrays in scouts:
        for body, places in ((header["plies"][0], "x0"), (header["tools"][0], "x"), (header["tools"][1], "x")):
            x = np.frombuffer(arrays, "<f4", body[places]["count"], body[places]["at"])
            triangles = np.frombuffer(arrays, "<u4", body["triangles"]["count"], body["triangles"]["at"])
            assert body["triangles"]["type"] == "u4" and triangles.max() == len(x) // 3 - 1, body["name"]
        ply = header["plies"][0]
        assert ply["x"]["count"] == ply["x0"]["count"] and 3 * ply["field"]["count"] == ply["triangles"]["count"]
    print(f"{len(scouts)} pictures of the run that looks where small elements are needed")
    for name in ("results.h5", "history.csv", "mesh_sizes.txt"):
        assert (watched / name).read_bytes() == (alone / name).read_bytes(), name
    assert sorted(p.name for p in watched.iterdir()) == sorted(p.name for p in alone.iterdir())


if __name__ == "__main__":
    main()

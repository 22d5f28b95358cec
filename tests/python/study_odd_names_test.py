# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies whose program, tools, files and results lie in folders of odd names; runs that are killed;
jobs of Slurm in every state.

    study_odd_names_test.py TOOLS_FOLDER CASES_FOLDER PLYFORM
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import study_scene
from study_scene import TESTS, TOOLS, Scene, check_all

ODD = "it's $(touch ran) `touch ran` $HOME {a} {{b}} \"c\" & ; # %s \\ é"
FAKE_SLURM = {
    "scontrol": '#!/bin/sh\n[ -z "$STATE" ] && { echo "$SAID" >&2; exit 1; }\n'
                'echo "JobId=$3 JobState=$STATE Reason=None"\n',
    "sacct": '#!/bin/sh\n[ -z "$LATER" ] || echo "$LATER"\n',
    # runs the job at once; what it prints is its number
    "sbatch": '#!/bin/sh\nfor last; do :; done\nsh "$last" >"$SLURM_LOG" 2>&1 </dev/null\necho 7\n',
    "scancel": "#!/bin/sh\n"}


def start(scene, *words, tools=TOOLS, env=None):
    """In a process of its own, called from the scene's folder."""
    done = subprocess.run([sys.executable, tools / "study", *scene.words(*words)], check=False,
                          capture_output=True, text=True, cwd=scene.folder,
                          env={**os.environ, **(env or {})})
    assert "Traceback" not in done.stderr, done
    return done


def check_odd_folders(folder: Path) -> None:
    """38: of the tools, of the study and of its results: no shell reads a name, and all runs end."""
    there = folder / ODD
    there.mkdir()
    for name in ("base", "studies", "plotting"):
        shutil.copytree(TOOLS / name, there / "tools" / name)
    for name in ("study", "area_means.py", "compare.py"):
        shutil.copy(TOOLS / name, there / "tools" / name)
    scene = Scene(there / ODD)
    done = start(scene, tools=there / "tools")
    assert done.returncode == 0 and len(scene.calls()) == 4, (
        done, (scene.results / "snakemake.log").read_text(encoding="utf-8"))
    assert not list(folder.rglob("ran")), list(folder.rglob("ran"))


def check_killed(folder: Path) -> None:
    """42: which run was ended by which signal."""
    scene = Scene(folder / "killed")
    program = scene.program.read_text(encoding="utf-8").replace("os.abort()", "os.kill(os.getpid(), 9)")
    scene.program.write_text(program, encoding="utf-8")
    scene.order({f"contact.friction={f}": "fail" for f in (0.1, 0.2, 0.3, 0.4)})
    scene.write(study_scene.FRICTION.replace("[0.1, 0.2, 0.3, 0.4]", "[0.3]").replace(
        "case = ", 'method = "grid"\ncase = '))
    done = start(scene)
    assert done.returncode == 1 and "no run has ended: runs/" in done.stderr and \
        "was ended by SIGKILL from outside" in done.stderr, done
    assert "friction=0.3" in done.stderr, done
    done = start(scene, "--table")
    assert "ended by SIGKILL" in done.stderr, done
    scene.order({})
    assert start(scene).returncode == 0
    scene.order({"contact.friction=0.1": "fail"})
    scene.write(study_scene.FRICTION)
    done = start(scene)
    assert done.returncode == 1 and "1 of 4 runs is without results" in done.stderr and \
        "ended by SIGKILL" in done.stderr, done


def fake_slurm(folder: Path) -> dict:
    folder.mkdir()
    for name, text in FAKE_SLURM.items():
        (folder / name).write_text(text, encoding="utf-8")
        (folder / name).chmod(0o755)
    return {"PATH": f"{folder}:{os.environ['PATH']}", "SLURM_LOG": str(folder / "log")}


STATES = {"COMPLETED": "success", "PENDING": "running", "RUNNING": "running", "COMPLETING": "running",
          "CONFIGURING": "running", "SUSPENDED": "running", "REQUEUED": "running",
          **dict.fromkeys(("FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "BOOT_FAIL", "DEADLINE",
                           "OUT_OF_MEMORY", "PREEMPTED", "LAUNCH_FAILED", "RECONFIG_FAIL", "REVOKED",
                           "STOPPED", "SPECIAL_EXIT", "REQUEUE_HOLD", "SOMETHING_NEW"), "failed")}


def check_slurm(folder: Path) -> None:
    """44: every state, and jobs that nobody knows any more; and a study through the profile."""
    env, program = fake_slurm(folder / "slurm"), TOOLS / "studies/profiles/slurm/status.sh"

    def status(state="", later="", said="slurm_load_jobs error: Invalid job id specified"):
        done = subprocess.run([program, "7"], capture_output=True, text=True, check=True, cwd=folder,
                              env={**os.environ, **env, "STATE": state, "LATER": later, "SAID": said})
        word = done.stdout.strip()
        assert bool(done.stderr) == (word == "failed"), done  # says why
        return word, done.stderr
    for state, word in STATES.items():
        assert status(state)[0] == word and status(later=state)[0] == word, state
    assert status(later="CANCELLED by 1000")[0] == "failed"
    assert "neither scontrol nor sacct" in status()[1] and status(said="")[0] == "failed"
    away = "slurm_load_jobs error: Unable to contact slurm controller (connect failure)"
    assert status(said=away)[0] == "running"  # while it is started anew
    mark = folder / ".slurm_silent_7"
    os.utime(mark, (0, 0))
    assert status(said=away)[0] == "failed" and not mark.exists()
    scene = Scene(folder / "by_slurm")
    done = start(scene, "--profile", "slurm", env={**env, "STATE": "COMPLETED"})
    assert done.returncode == 0 and len(scene.calls()) == 4, (
        done, (scene.results / "snakemake.log").read_text(encoding="utf-8"))
    scene.results = folder / "quotes ' $(touch ran)"
    done = start(scene, "--profile", "slurm", env=env)
    assert done.returncode == 1 and "must have a name without" in done.stderr, done


def check_versions(folder: Path) -> None:
    """Snakemake 8 needs a plugin for the profile of Slurm: said before anything is run."""
    scene, fake = Scene(folder / "versions"), folder / "fake"
    fake.mkdir()
    (fake / "snakemake").write_text('#!/bin/sh\necho "${VERSION}"\n', encoding="utf-8")
    (fake / "snakemake").chmod(0o755)
    env = {"PATH": f"{fake}:{os.environ['PATH']}"}
    for version, told in (("8.20.1", "calls Slurm by a plugin"), ("9.1.0", "calls Slurm by a plugin"),
                          ("6.15.5", "too old"), ("?", "says nothing that can be read")):
        done = start(scene, "--profile", "slurm", env={**env, "VERSION": version})
        assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") <= 3, done
    assert (TOOLS / "studies/profiles/slurm/config.v8+.yaml").is_file()


if __name__ == "__main__":
    assert TESTS.is_dir()
    check_all(check_odd_folders, check_killed, check_slurm, check_versions)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands of the workbench: studio_processes_test.py TOOLS. Begun, queued, stopped, found again."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, sys.argv[1])
from workbench.project.events import Events  # noqa: E402
from workbench.processes.processes import MOST_ENDED, Processes  # noqa: E402
from workbench.project.project import Project, Refused  # noqa: E402

PYTHON = sys.executable
KEPT = ["-c", "import signal, sys, time\n"
        "def end(number, frame):\n    print('asked', number, flush=True); sys.exit(130)\n"
        "signal.signal(signal.SIGINT, end)\nprint('ready', flush=True)\ntime.sleep(60)"]
DEAF = ["-c", "import signal, time\nfor s in (signal.SIGINT, signal.SIGTERM): signal.signal(s, signal.SIG_IGN)\n"
        "print('ready', flush=True)\ntime.sleep(60)"]


class Told(Events):
    def __init__(self):
        super().__init__()
        self.sent = []

    def send(self, kind, **what):
        self.sent.append({"kind": kind, **what})


def opened(folder, at_once=1):
    return Processes(Project.opened(Path(folder)), Told(), at_once)


def until(true, seconds=20.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if found := true():
            return found
        time.sleep(0.02)
    raise AssertionError("it has not come about")


def state(processes, record, *wanted):
    def there():
        processes.look()
        now = processes.record(record["id"])
        return now if now["state"] in wanted else None
    return until(there)


def refused(act, code):
    try:
        act()
    except Refused as problem:
        assert problem.code == code, problem.code
        return
    raise AssertionError("it was not refused")


def ends(folder):
    """What a command returns, prints and leaves."""
    processes = opened(folder)
    good = processes.begin("run", "good", [PYTHON, "-c", "print('one'); print('two')"], Path(folder), {"a": 1})
    bad = processes.begin("run", "bad", [PYTHON, "-c", "import sys; print('why', file=sys.stderr); sys.exit(3)"],
                          Path(folder))
    none = processes.begin("mesh", "none", ["./there/is/none"], Path(folder))
    done = state(processes, good, "done", "failed")
    assert done["state"] == "done" and done["code"] == 0 and done["about"] == {"a": 1}, done
    assert done["ended"] >= done["begun"] >= done["queued"], done
    assert processes.log(good["id"]) == "one\ntwo\n"
    failed = state(processes, bad, "done", "failed")
    assert (failed["state"], failed["code"]) == ("failed", 3) and processes.log(bad["id"]) == "why\n", failed
    absent = state(processes, none, "done", "failed")
    assert absent["state"] == "failed" and "cannot be started: No such file" in absent["error"], absent
    assert [r["words"] for r in processes.records("run")] == ["good", "bad"]
    words = {(e["record"]["words"], e["record"]["state"], e["last"]) for e in processes.events.sent}
    assert ("good", "done", "two") in words, words
    processes.forget(good["id"])
    refused(lambda: processes.record(good["id"]), 404)
    assert not list(Path(folder).glob(f".plyform/processes/*{good['id']}*"))
    again = opened(folder)
    assert again.begin("run", "next", [PYTHON, "-c", ""], Path(folder))["id"] == "000004"
    for number in ("../x", "1" * 10, "²", ""):
        refused(lambda: again.record(number), 404)


def in_order(folder):
    """One at a time; order changed, one taken out; two at a time."""
    processes = opened(folder)
    out = Path(folder) / "order"
    def waits(word):
        return processes.begin("run", word, [PYTHON, "-c", f"open({str(out)!r}, 'a').write({word!r})\n"
                                             f"import time\ntime.sleep(0.5)"], Path(folder), queue=True)
    a, b, c, d = (waits(word) for word in "abcd")
    assert processes.record(a["id"])["state"] in ("starting", "running")
    assert [r["words"] for r in processes.waiting()] == ["b", "c", "d"]
    processes.move(d["id"], 0)
    assert [r["words"] for r in processes.waiting()] == ["d", "b", "c"]
    assert processes.stop(b["id"])["state"] == "stopped"
    refused(lambda: processes.move(b["id"], 0), 409)
    refused(lambda: processes.move(a["id"], 0), 409)
    assert [r["words"] for r in opened(folder).waiting()] == ["d", "c"]
    refused(lambda: processes.forget(c["id"]), 409)
    for record in (a, d, c):
        state(processes, record, "done")
    assert out.read_text() == "adc", out.read_text()
    assert processes.record(b["id"])["ended"] > 0 and not processes.log(b["id"])
    two = opened(folder, at_once=2)
    three = [two.begin("run", word, [PYTHON, *KEPT], Path(folder), queue=True) for word in "xyz"]
    state(two, three[1], "running")
    assert [two.record(r["id"])["state"] == "queued" for r in three] == [False, False, True]
    for record in three[::-1]:
        two.stop(record["id"])
    for record in three:
        state(two, record, "stopped")


def stops(folder):
    """As Ctrl-C, with all that the command has started; harder when asked again."""
    processes = opened(folder)
    script = f"import subprocess, sys\np = subprocess.Popen([sys.executable] + {KEPT!r})\n" \
             "try: p.wait()\nexcept KeyboardInterrupt: p.wait(); sys.exit(9)"
    one = processes.begin("study", "one", [PYTHON, "-c", script], Path(folder))
    until(lambda: "ready" in processes.log(one["id"]))
    processes.stop(one["id"])
    ended = state(processes, one, "stopped")
    assert ended["code"] == 9 and "asked 2" in processes.log(one["id"]), ended
    assert processes.stop(one["id"]) == ended  # nothing
    deaf = processes.begin("run", "deaf", [PYTHON, *DEAF], Path(folder))
    until(lambda: "ready" in processes.log(deaf["id"]))
    for _ in range(2):
        processes.stop(deaf["id"])
    time.sleep(0.5)
    assert processes.record(deaf["id"])["state"] == "running"
    processes.stop(deaf["id"])
    assert state(processes, deaf, "stopped")["code"] == -signal.SIGKILL
    for _ in range(10):  # in any moment of the start
        early = processes.begin("run", "early", [PYTHON, *KEPT], Path(folder))
        processes.stop(early["id"])
        assert state(processes, early, "stopped", "done", "lost")["state"] == "stopped"
    late = processes.begin("run", "late", [PYTHON, "-c", ""], Path(folder))
    until(lambda: (Path(folder) / f".plyform/processes/{late['id']}.end").exists())
    assert processes.stop(late["id"])["state"] == "done"


BEGINS = """import sys, time
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from workbench.project.events import Events
from workbench.processes.processes import Processes
from workbench.project.project import Project
processes = Processes(Project.opened(Path(sys.argv[2])), Events())
for word in "ab":
    processes.begin("run", word, [sys.executable, "-c", "import time\\ntime.sleep(2)\\nprint('end')"],
                    Path(sys.argv[2]), queue=True)
print("begun", flush=True)
time.sleep(60)
"""


def found_again(folder):
    """By another workbench, after the first was killed; what was killed itself is lost."""
    first = subprocess.Popen([PYTHON, "-c", BEGINS, sys.argv[1], str(folder)], stdout=subprocess.PIPE, text=True)
    assert first.stdout.readline() == "begun\n"
    first.kill()
    first.wait()
    first.stdout.close()
    processes = opened(folder)
    a, b = processes.records()
    assert a["state"] in ("starting", "running") and b["state"] == "queued", (a, b)
    assert state(processes, a, "done")["code"] == 0 and processes.log(a["id"]) == "end\n"
    assert state(processes, b, "done")["code"] == 0
    killed = processes.begin("run", "killed", [PYTHON, *KEPT], Path(folder))
    now = state(processes, killed, "running")
    launcher = int(Path(f"/proc/{now['pid']}/stat").read_text().rpartition(")")[2].split()[1])
    os.kill(launcher, signal.SIGKILL)
    time.sleep(0.2)
    assert processes.record(killed["id"])["state"] == "running"  # the command goes on
    os.kill(now["pid"], signal.SIGKILL)
    assert state(processes, killed, "lost")["state"] == "lost"
    processes.forget(killed["id"])


def damaged(folder):
    """Files that nobody of us has written hide no other."""
    processes = opened(folder)
    one = processes.begin("run", "one", [PYTHON, "-c", ""], Path(folder))
    state(processes, one, "done")
    own = Path(folder) / ".plyform/processes"
    good = json.loads((own / f"{one['id']}.json").read_text())
    for k, text in enumerate(("", "[]", "{", "{}", '{"id": 3}', json.dumps({**good, "command": 1}), "\xff")):
        (own / f"{100 + k:06d}.json").write_bytes(text.encode("latin-1"))
    (own / "²³.json").write_text("{}")
    processes.look()
    assert [r["id"] for r in processes.records()] == [one["id"]]
    (own / f"{one['id']}.end").write_text("[")
    state(opened(folder), one, "lost")


def many_at_a_time(folder):
    """Looks, stops and begins of many threads: each command is started once, and ends once."""
    processes = opened(folder, at_once=3)
    out = Path(folder) / "count"
    script = f"open({str(out)!r}, 'a').write('x')"
    def work():
        for _ in range(4):
            processes.begin("run", "w", [PYTHON, "-c", script], Path(folder), queue=True)
            processes.look()
    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    until(lambda: processes.look() or all(r["state"] == "done" for r in processes.records()), 60)
    assert len(processes.records()) == 16 and out.read_text() == 16 * "x"


def old_ones_go(folder):
    """Of each kind but runs; those that go on stay."""
    processes = opened(folder)
    live = processes.begin("report", "goes on", [PYTHON, *DEAF], folder)["id"]
    for kind in ("run", "report"):
        for number in range(MOST_ENDED + 3):
            record = processes.kept.new({"kind": kind, "words": "", "command": ["true"], "cwd": folder, "about": {},
                                         "queued": 1.0, "in_queue": False, "launched": True})
            (processes.kept.folder / f"{record['id']}.end").write_text('{"code": 0, "ended": 2.0}')
    first = processes.records("report")[1]["id"]
    last = processes.begin("report", "one more", ["true"], folder)["id"]
    kept = [one["id"] for one in processes.records("report")]
    assert len(kept) == MOST_ENDED + 1 and live in kept and last in kept and first not in kept, len(kept)
    assert len(processes.records("run")) == MOST_ENDED + 3
    assert not list(processes.kept.folder.glob(f"{first}.*"))
    for _ in range(3):
        processes.stop(live)
    end = time.monotonic() + 20
    while any(processes.record(number)["state"] in ("starting", "running") for number in (live, last)):
        assert time.monotonic() < end
        time.sleep(0.05)


def main():
    for check in (ends, in_order, stops, found_again, damaged, many_at_a_time, old_ones_go):
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as state:
            os.environ["XDG_STATE_HOME"] = state
            begin = time.monotonic()
            check(folder)
            print(f"{check.__name__}: {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Two tabs, an editor and a running server change one file: studio_together_test.py TOOLS PROGRAM [SEEDS]. In
random order, with tabs that do not know yet what the others have done: nothing is lost that was not asked about.
A tab asks the server as the page does (web/page/upon.js, web/setup/case_file.js); the page itself is tried by
studio_setup_together_test.py."""

import os
import random
import sys
import tempfile
import threading
import tomllib
from pathlib import Path

from studio_server import Server  # skips

sys.path.insert(0, sys.argv[1])
from workbench.cases.merge import merged  # noqa: E402
from workbench.project.project import Changed, Project  # noqa: E402

TOOLS, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SEEDS = int(sys.argv[3]) if len(sys.argv) > 3 else 200
OPS = 9  # of each seed
TEXT = """# Two plies between two tools.
title = "together"

[blanks.sheet]
size = [200.0, 200.0]
element_size = 8.0

[[ply]]
name = "lower"
blank = "sheet"
angle = 0.0

[[ply]]
name = "upper"
blank = "sheet"
angle = 90.0

[[tool]]
name = "punch"
radius = 40.0
stroke = 30.0
motion = "driven"

[[tool]]
name = "die"
radius = 50.0

[[load]]
between = ["lower", "upper"]
vacuum = 0.1

[contact]
friction = 0.2

[[contact.pair]]
between = ["punch", "upper"]
friction = 0.1
"""
NUMBERS = ["ply.0.angle", "ply.1.angle", "tool.0.radius", "tool.0.stroke", "tool.1.radius", "blanks.sheet.element_size",
           "contact.friction", "contact.pair.0.friction", "load.0.vacuum", "solver.duration", "tool.1.position"]
NAMES = ["punch", "die", "lower", "upper"]


class Names:
    """Who is who, whatever it is called by now."""

    def __init__(self):
        self.known = {name: name for name in NAMES}

    def flat(self, text):
        """Values by keys, items by who they are; comments by the item that they stand in, as a copy has them too."""
        found, waiting, place = {}, [((), tomllib.loads(text))], ()
        for line in text.splitlines():
            if line.startswith("["):
                place = (line.strip("[] "),)
            elif line.startswith("name = ") and len(place) == 1:
                place = (*place, self.who({"name": line.split('"')[1]}, 0))
            elif line.startswith("#"):
                found[(*place, "#", line.strip())] = True
        while waiting:
            path, value = waiting.pop()
            if isinstance(value, dict):
                waiting += [((*path, key), part) for key, part in value.items()
                            if not (key == "name" and part in self.known)]
            elif isinstance(value, list):
                waiting += [((*path, self.who(part, k)), part) for k, part in enumerate(value)]
            else:
                found[path] = self.known.get(value, value)
        return found

    def who(self, item, number):
        name = item.get("name") if isinstance(item, dict) else None
        return self.known.get(name, name) if name else number


def changes(before, after):
    return {key: after.get(key) for key in {*before, *after} if before.get(key) != after.get(key)}


class World:
    def __init__(self, server, seed):
        self.server, self.random, self.names = server, random.Random(seed), Names()
        self.name, self.count, self.asked, self.kept = f"c{seed}.toml", 0, 0, 0
        self.path = server.folder / self.name
        self.path.write_text(TEXT)
        self.tabs = [Tab(self), Tab(self)]

    def number(self):
        """None like another."""
        self.count += 1
        return 1000.0 + self.count

    def written(self):
        return self.path.read_text()

    def editor(self):
        """Writes a number, a comment or a name of a tool, by a file of its own or in place."""
        text, lines = self.written(), self.written().split("\n")
        numbers = [k for k, line in enumerate(lines) if line.split(" = ")[0] in ("angle", "radius", "stroke", "friction")]
        if self.random.random() < 0.3:
            lines.insert(self.random.choice(numbers), f"# by the editor, {self.number()}")
        else:
            at = self.random.choice(numbers)
            lines[at] = f"{lines[at].split(' = ')[0]} = {self.number()}"
        after = "\n".join(lines)
        assert tomllib.loads(after) and after != text
        if self.random.random() < 0.5:
            part = self.path.with_suffix(".part")
            part.write_text(after)
            os.replace(part, self.path)
        else:
            self.path.write_text(after)

    def step(self):
        if self.random.random() < 0.25:
            self.editor()
        else:
            tab = self.random.choice(self.tabs)
            self.random.choice([tab.edit, tab.edit, tab.edit, tab.type, tab.type, tab.save, tab.undo, tab.rename, tab.copy])()
        for tab in self.tabs:
            if self.random.random() < 0.4:  # it has heard of the change
                tab.look()


class Tab:
    def __init__(self, world):
        self.world, self.draft, self.own = world, None, []
        self.look()

    def look(self):
        self.shown = self.world.server.get("api/case", path=self.world.name)

    def change(self, base, make, intended, lines=False):
        """As madeUpon; what it may change and what not is held against the file. Whether it is done."""
        world, before, asked = self.world, self.world.written(), False
        wish = {"version": base["version"] or ""}
        while True:
            status, said = make(wish)
            if status == 200:
                break
            assert status == 409, (status, said)
            if "now" in said and "base" not in wish:
                wish["base"] = base["text"]
                continue
            assert world.written() == before, "refused, and written in spite of that"
            if "now" in said:
                self.shown = said["now"]
            lost = any(one.get("lost") for one in said.get("clashes", []))
            if lost or not said.get("clashes") or world.random.random() < 0.5:
                return None
            asked, world.asked = True, world.asked + 1
            wish = {"version": said["now"]["version"], "base": base["text"], "over": True}
        self.held(before, base["text"], intended, asked, lines)
        self.shown = said
        if said["text"] != before:
            self.own.append((before, said["text"], said["version"]))
        world.kept += "base" in wish
        return said

    def held(self, before, base, intended, asked, lines):
        """Nothing but what was intended has changed, and that only from what this tab has been shown, or has been
        told in a question."""
        flat, seen, after = (self.world.names.flat(text) for text in (before, base, self.world.written()))
        done = changes(flat, after)
        if asked and lines:  # the question showed the lines that went
            return
        assert set(done) <= set(intended), (done, intended)
        for key, value in done.items():
            assert value == intended[key], (key, value, intended)
            assert asked or seen.get(key) == flat.get(key), f"{key} = {flat.get(key)} is lost without a question"
        assert asked or all(after.get(key) == value for key, value in intended.items()), (intended, done)

    def patch(self, base, edits, intended):
        world = self.world
        return self.change(base, lambda wish: world.server.call("PATCH", "api/case", {**wish, "edits": edits},
                                                                query={"path": world.name}), intended)

    def put(self, base, text):
        world = self.world
        intended = changes(world.names.flat(base["text"]), world.names.flat(text))
        return self.change(base, lambda wish: world.server.call("PUT", "api/case", {**wish, "text": text},
                                                                query={"path": world.name}), intended, True)

    def edit(self):
        """A number in a form."""
        key, value = self.world.random.choice(NUMBERS), self.world.number()
        tree, path = tomllib.loads(self.shown["text"]), []
        for part in key.split("."):
            items = isinstance(tree, list)
            path.append(self.world.names.who(tree[int(part)], int(part)) if items else part)
            tree = tree[int(part)] if items else tree.get(part, {})
        self.patch(self.shown, [{"op": "set", "key": key, "value": value}], {tuple(path): value})

    def type(self):
        """In the text, half of the time over what has been typed and not been saved."""
        text = self.draft[0] if self.draft else self.shown["text"]
        base = self.draft[1] if self.draft else self.shown
        lines = text.split("\n")
        places = [k for k, line in enumerate(lines) if line.split(" = ")[0] in ("angle", "radius", "friction", "vacuum")]
        at = self.world.random.choice(places)
        if self.world.random.random() < 0.5:
            lines[at] = f"{lines[at].split(' = ')[0]} = {self.world.number()}"
        else:
            lines.insert(at, f"# typed, {self.world.number()}")
        self.draft = "\n".join(lines), base
        if self.world.random.random() < 0.5:
            self.save()

    def save(self):
        if not self.draft:
            return
        text, base = self.draft
        if self.put(base, text) or self.world.random.random() < 0.5:  # else it stays, not saved
            self.draft = None

    def undo(self):
        """Of the last change of this tab; what others have done since stays."""
        if not self.own:
            return
        before, after, version = self.own[-1]
        flat = self.world.names.flat
        if self.shown["version"] == version:
            there, intended = self.world.written(), changes(flat(after), flat(before))
            status, said = self.world.server.call("POST", "api/case/undo", {"version": version}, query={
                "path": self.world.name})
            if status == 200 and said["text"] == before:
                assert changes(flat(there), flat(self.world.written())) == intended
                self.shown = said
                self.own.pop()
                return
            assert status == 409, (status, said)
        own = list(self.own)
        if self.put({"text": after, "version": version}, before):
            self.own = own[:-1]

    def rename(self):
        tool, name = self.world.random.choice(("ply", "tool")), f"renamed{self.world.count}x"
        self.world.count += 1
        items = tomllib.loads(self.shown["text"])[tool]
        number = self.world.random.randrange(2)
        known, old = self.world.names.known, items[number]["name"]
        known[name] = known.setdefault(old, old)  # for what is held against the file
        said = self.patch(self.shown, [{"op": "rename", "key": f"{tool}.{number}", "name": name}], {})
        if said is None:
            known.pop(name)
            return
        assert f'"{old}"' not in said["text"], said["text"]
        self.own.clear()  # it would be another name in them

    def copy(self):
        """A copy of a ply, which moves those behind it."""
        items = tomllib.loads(self.shown["text"])["ply"]
        if len(items) > 3:
            return
        number = self.world.random.randrange(len(items))
        world, before = self.world, self.world.written()
        make = {"edits": [{"op": "copy", "key": f"ply.{number}"}], "version": self.shown["version"],
                "base": self.shown["text"]}
        status, said = world.server.call("PATCH", "api/case", make, query={"path": world.name})
        assert status in (200, 409), said
        done = changes(world.names.flat(before), world.names.flat(world.written()))
        assert all(key[0] == "ply" and key[1] not in NAMES for key in done), done
        assert (status == 200) == bool(done)
        self.shown = said if status == 200 else said["now"]


def interleavings(server):
    asked, kept = 0, 0
    for seed in range(SEEDS):
        world = World(server, seed)
        for number in range(OPS):
            try:
                world.step()
            except AssertionError:
                print(f"seed {seed}, operation {number}:\n{world.written()}", flush=True)
                raise
        asked, kept = asked + world.asked, kept + world.kept
    print(f"{SEEDS} interleavings of {OPS} operations: {kept} changes put together with those of others, {asked} taken "
          "after a question", flush=True)
    assert kept > SEEDS // 2 and asked > SEEDS // 25, (kept, asked)


def at_once(server):
    """Two tabs that never look: each number of each of them is there at the end."""
    path = server.folder / "at_once.toml"
    path.write_text(TEXT)
    begun = server.get("api/case", path=path.name)
    wrong = []

    def work(key, count=40):
        for k in range(count):
            edits = [{"op": "set", "key": f"solver.{key}_{k}", "value": k}]
            status, said = server.call("PATCH", "api/case", {"edits": edits, "version": begun["version"],
                                                             "base": begun["text"]}, query={"path": path.name})
            if status != 200:
                wrong.append(said)
    threads = [threading.Thread(target=work, args=(key,)) for key in ("a", "b", "c")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong, wrong[:2]
    assert len(tomllib.loads(path.read_text())["solver"]) == 120


def studies(server):
    """The same of a study, by its form and by its text; two of one name at once."""
    (server.folder / "case.toml").write_text(TEXT)
    made = []
    threads = [threading.Thread(target=lambda: made.append(server.call("POST", "api/studies", {
        "name": "one", "case": "case.toml"})[0])) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(made) == [200, *[409] * 5], made
    path = "studies/one.toml"
    seen = server.get("api/study", path=path)
    base = {"path": path, "version": seen["version"], "base": seen["text"]}
    assert server.call("PUT", "api/study", {**base, "plan": {"title": "by a"}})[0] == 200
    assert server.call("PUT", "api/study", {**base, "plan": {"figures": {"f": "mesh.elements"}}})[0] == 200
    status, said = server.call("PUT", "api/study", {**base, "plan": {"title": "by b"}})
    assert status == 409 and "by a" in said["clashes"][0]["now"], said
    typed = seen["text"].replace("# Runs of one case", "# Some runs of one case")
    assert server.call("PUT", "api/study/text", {**base, "text": typed})[0] == 200
    after = (server.folder / path).read_text()
    assert 'title = "by a"' in after and "mesh.elements" in after and "# Some runs" in after, after
    assert server.call("PUT", "api/study", {**base, "plan": {"title": "by b"}, "over": True})[0] == 409  # of what was shown
    now = server.get("api/study", path=path)["version"]
    assert server.call("PUT", "api/study", {**base, "version": now, "plan": {"title": "by b"}, "over": True})[0] == 200
    assert 'title = "by b"' in (server.folder / path).read_text()


def merging():
    """Lines against a choice of each line by itself, where both can be told from the text before."""
    draw = random.Random(1)
    clashes = 0
    for _ in range(2000):
        base = [f"{draw.randrange(3)} {k}" for k in range(draw.randrange(1, 12))]
        own, other = ([draw.choice((line, line, line, None, f"{side} {k}")) for k, line in enumerate(base)]
                      for side in ("mine", "theirs"))
        text, mine, theirs = ("".join(f"{line}\n" for line in lines if line) for lines in (base, own, other))
        both = any(a != b != line != a for a, b, line in zip(own, other, base))
        try:
            found = merged(text, mine, theirs)
        except Changed:
            clashes += 1
            continue
        assert not both, (base, own, other)
        wanted = [a if a != line else b for a, b, line in zip(own, other, base)]
        assert found == "".join(f"{line}\n" for line in wanted if line), (base, own, other, found)
    assert 500 < clashes < 1900, clashes
    assert merged("a\nb\n", "a\nc\n", "a\nd\n", over=True) == "a\nc\n"
    assert merged("a\nb\nc\n", "a\nB\nc\n", "a\nb\nnew\nc\n", over=True) == "a\nB\nnew\nc\n"  # touching


def written_in_between():
    """By another program, between a look at the file and the write of the workbench."""
    with tempfile.TemporaryDirectory() as place:
        project = Project.opened(Path(place) / "folder")
        path = project.root / "a.toml"
        for there, expected in ((b"theirs", b"seen"), (None, b"seen"), (b"theirs", None)):
            path.unlink(missing_ok=True)
            if there is not None:
                path.write_bytes(there)
            try:
                project.write(path, b"mine", expected)
                raise AssertionError(f"{there} is lost")
            except Changed:
                assert (path.read_bytes() if path.exists() else None) == there
        project.write(path, b"mine", b"theirs")
        assert path.read_bytes() == b"mine" and sorted(os.listdir(project.root)) == [".plyform", "a.toml"]


def main():
    merging()
    written_in_between()
    with Server(TOOLS, PROGRAM) as server:
        studies(server)
        at_once(server)
        interleavings(server)


if __name__ == "__main__":
    main()

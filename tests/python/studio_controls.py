# SPDX-License-Identifier: GPL-3.0-or-later
"""Which controls of the workbench tests see, and which they use: a hook in the page writes both down. A
control is named by its id, its data attributes or its accessible name, numbers and names of the user being
left out; the boxes of the set-up's form, which is made from the table of keys, by their kind.

With PLYFORM_CONTROLS=FOLDER each test writes FOLDER/NAME.json, e.g. runs.started.json, setup.forms.json.

    studio_controls.py FOLDER NAME...     what none of these tests has used, of what they have seen

Leaves with 1 when there is any, with 77 when a test has written nothing.
"""

import atexit
import json
import os
import re
import sys
from pathlib import Path

HOOK = """
(() => {
  if (window !== window.top) return; // reports have tests of their own
  const kept = window.plyform_controls = { seen: {}, used: {} };
  const CONTROL = "button, input, select, textarea, summary, a[href], [role=slider], [data-handle], circle.picked";
  const plain = (text) => text.trim().replace(/[\\w.-]+\\/[\\w./-]+|\\b[\\w-]+\\.toml\\b/g, "FILE")
    .replace(/\\b\\w+(\\.[\\w#]+)+/g, "KEY").replace(/\\d+/g, "#");
  const kind = (e) => (e.matches("select.way") ? "which of several keys" : e.type || e.tagName.toLowerCase());
  function nameOf(e) {
    const data = e.dataset;
    if (data.key !== undefined && e.closest(".fields")) {
      const list = e.closest("[data-list]");
      return `form: ${list ? `${list.className} ` : ""}${kind(e)}${/[a-z]/.test(data.part || "")
        ? ` ${plain(data.part)}` : ""}`;
    }
    if (e.id) return `#${plain(e.id).replace(/^limit-.*-(at_\\w+)$/, "limit-NAME-$1")
      .replace(/^figure-(?!(name|path|add)$).*/, "figure-NAME")}`;
    if (e.closest("[data-run]")) return `${e.tagName.toLowerCase()} of a run`;
    for (const name of ["act", "add", "dial", "handle", "item", "view", "folder", "name", "key", "panel", "study"]) {
      if (data[name] === undefined) continue;
      const word = name === "act" || name === "view" || name === "handle" ? plain(data[name].split(" ")[0])
        : name === "add" && !e.closest(".fields") ? data[name] : "";
      return `${e.tagName.toLowerCase()}[${name}${word ? `=${word}` : ""}]`;
    }
    if (e.matches("circle.point")) return "point of a chart";
    const words = e.getAttribute("aria-label") || e.textContent || e.title || e.type;
    return `${e.tagName.toLowerCase()} ${plain(e.closest(".fields legend") ? words.replace(/\\S+$/, "KEY") : words)}`;
  }
  function placeOf(e) {
    const dialogue = e.closest("dialog");
    const panel = e.closest("main > section");
    return dialogue ? dialogue.id : panel ? panel.id.replace("panel-", "") : "page";
  }
  const word = (e) => `${placeOf(e)}: ${nameOf(e)}`;
  function scan() {
    waiting = false;
    for (const e of document.querySelectorAll(CONTROL)) {
      if (e.getClientRects().length && !e.disabled && !e.closest(".CodeMirror")) kept.seen[word(e)] = 1;
    }
  }
  let waiting = false;
  function soon() {
    if (waiting) return;
    waiting = true;
    setTimeout(scan, 250);
  }
  function use(event) {
    const e = event.target.closest && event.target.closest(CONTROL);
    if (!e || e.closest(".CodeMirror")) return;
    const typed = e.matches("select, textarea, input:not([type=checkbox]):not([type=radio])");
    // the driver itself chooses of lists by events that are not trusted
    if (!(event.isTrusted || e.matches("select")) || typed !== (event.type === "input" || event.type === "change")) return;
    kept.used[word(e)] = (kept.used[word(e)] || 0) + 1;
    kept.seen[word(e)] = 1;
  }
  kept.scan = scan;
  for (const kind of ["click", "input", "change"]) window.addEventListener(kind, use, true);
  new MutationObserver(soon).observe(document, { childList: true, subtree: true, attributes: true,
    attributeFilter: ["hidden", "disabled", "open"] });
})();
"""
TAKE = """const kept = window.plyform_controls; if (!kept) return null; if (document.body) kept.scan();
const { seen, used } = kept; Object.assign(kept, { seen: {}, used: {} }); return { seen, used };"""

SEEN, USED = set(), {}


class Controls:
    """Of one browser: what is written down in a page is taken before it goes."""

    def __init__(self, driver):
        self.driver = driver
        driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": HOOK})
        for name in ("get", "refresh", "close"):
            setattr(driver, name, self.after_taking(getattr(driver, name)))

    def after_taking(self, act):
        def acting(*arguments):
            self.take()
            return act(*arguments)
        return acting

    def take(self):
        self.driver.switch_to.default_content()
        found = self.driver.execute_script(TAKE)
        if found:
            SEEN.update(found["seen"])
            for word, count in found["used"].items():
                USED[word] = USED.get(word, 0) + count

    def close(self):
        try:
            self.take()
        except Exception as problem:  # of a test that has failed: its own words count
            print("controls:", problem, file=sys.stderr)


def written_to():
    """The file of this test; None where none is asked for."""
    folder = os.environ.get("PLYFORM_CONTROLS")
    name = Path(sys.argv[0]).stem.removeprefix("studio_").removesuffix("_test").replace("_", ".")
    part = [f".{word}" for word in sys.argv[1:2] if re.fullmatch("[a-z]+", word)]
    return Path(folder) / f"{name}{''.join(part)}.json" if folder else None


def write():
    if file := written_to():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps({"seen": sorted(SEEN), "used": USED}, indent=1), encoding="utf-8")


def main():
    folder, *names = sys.argv[1:]
    files = [Path(folder) / f"{name}.json" for name in names]
    missing = [file.name for file in files if not file.is_file()]
    if missing:
        print("SKIPPED: not written:", ", ".join(missing))
        sys.exit(77)
    found = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    seen = set().union(*(one["seen"] for one in found))
    used = set().union(*(one["used"] for one in found))
    print(f"{len(seen)} controls seen, {len(used)} of them used")
    for word in sorted(seen - used):
        print("never used:", word)
    sys.exit(1 if seen - used else 0)


if __name__ == "__main__":
    main()
else:
    if file_ := written_to():
        file_.unlink(missing_ok=True)
    atexit.register(write)

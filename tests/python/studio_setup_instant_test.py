# SPDX-License-Identifier: GPL-3.0-or-later
"""The instant shear beside the scene by a hand in Chromium: it follows a ply that is turned, ends where the
hand ends, is what the program itself says, and leaves nothing that computes. Says how long pictures took.

    studio_setup_instant_test.py TOOLS PROGRAM CASES [PICTURES]
"""

import json
import re
import subprocess
import tempfile
import time
from pathlib import Path

from selenium.webdriver.common.action_chains import ActionChains
from studio_page import SetupPage as Page
from studio_setup import PROGRAM, go_through

DIAL = '[data-dial="ply.1.angle"]'
# When the dial was last turned and when the picture was last drawn, ms.
CLOCK = """
  document.addEventListener("pointermove", (event) => {
    if (event.buttons && event.target.closest("[data-dial]")) window.turned_ms = performance.now();
  }, true);
  new MutationObserver(() => { window.drawn_ms = performance.now(); }).observe(
    document.querySelector("#instant-picture"), { attributes: true });
"""
FIFTY = """
  const dial = document.querySelector(arguments[0]), box = dial.getBoundingClientRect();
  const at = (degrees) => ({ bubbles: true, pointerId: 1, buttons: 1,
    clientX: box.x + box.width / 2 + 15 * Math.cos(degrees * Math.PI / 180),
    clientY: box.y + box.height / 2 - 15 * Math.sin(degrees * Math.PI / 180) });
  dial.setPointerCapture = () => {};
  dial.dispatchEvent(new PointerEvent("pointerdown", at(0)));
  for (let k = 1; k <= 50; ++k) setTimeout(() => dial.dispatchEvent(new PointerEvent("pointermove", at(k))), 20 * k);
"""


def shown(page: Page) -> dict:
    return dict(page.js("return {...document.querySelector('#instant-picture').dataset}"))


def angle(page: Page) -> float:
    """As the dial's box has it."""
    return float(page.value("ply.1.angle"))


def opens(page: Page) -> None:
    page.press("#instant-open")
    page.until(lambda: shown(page).get("drawn"), "plies are formed")
    looked_ahead(page)
    assert re.search(r"shear angles to \d.*° \(99 %\), known to some \d+°", page.text("#instant-words"))


def looked_ahead(page: Page) -> None:
    """Nothing else computes any more."""
    page.when("return plyform_setup.answer && plyform_setup.answer.outlook")


def follows_a_hand(page: Page) -> None:
    """While the dial is held, and by the time that it takes."""
    page.item("ply.1")
    page.until(lambda: page.near(DIAL))
    before = page.tree()["ply"][1]["angle"]
    hand = ActionChains(page.driver).move_to_element_with_offset(page.find(DIAL), 14, 0).click_and_hold()
    hand.perform()
    page.js(CLOCK)
    for x, y in ((10, -10), (4, -14), (-8, -12)):
        ActionChains(page.driver).move_to_element_with_offset(page.find(DIAL), x, y).perform()
        page.until(lambda: float(shown(page).get("value") or "nan") == angle(page), "the picture is of this angle")
        print(f"from a turn to {angle(page):g} degrees to its picture: "
              f"{page.js('return window.drawn_ms - window.turned_ms') / 1000:.2f} s", flush=True)
        assert page.tree()["ply"][1]["angle"] == before
    held = angle(page)
    is_the_programs(page, held)
    ActionChains(page.driver).release().perform()
    page.until(lambda: page.tree()["ply"][1]["angle"] == held, "the hand's end is written")
    page.until(lambda: shown(page)["value"] == "", "the picture is of the case")


def is_the_programs(page: Page, degrees: float) -> None:
    """The 99 % quantile in words is that of a run."""
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([PROGRAM, "run", page.file, "--accuracy", "instant", "--set", f"ply.1.angle={degrees:g}",
                        "-o", scratch], check=True, capture_output=True)
        ply = json.loads((Path(scratch) / "summary.json").read_text())["plies"][1]
    said = float(re.search(r"shear angles to ([\d.]+)°", page.text("#instant-words"))[1])
    assert page.text("#instant-words").startswith(f"at {degrees:g}: {ply['name']}"), page.text("#instant-words")
    assert abs(said - ply["p99_shear_deg"]) < 0.051, (said, ply)


def fifty_quick_turns(page: Page) -> None:
    """The last one is drawn, and then nothing goes on."""
    looked_ahead(page)
    before = int(shown(page)["drawn"])
    page.js(FIFTY, DIAL)
    page.until(lambda: angle(page) == 50 and shown(page).get("value") == "50", "the last turn is drawn")
    print(f"{int(shown(page)['drawn']) - before} pictures of 50 turns", flush=True)
    assert int(shown(page)["drawn"]) - before < 50
    worked = readers_time(page)
    time.sleep(1.0)
    assert readers_time(page) - worked < 0.3, "it goes on"


def readers_time(page: Page) -> float:
    """s of processor time of all readers of cases."""
    total = 0.0
    for place in Path("/proc").glob("[0-9]*"):
        try:
            words = (place / "cmdline").read_bytes().split(b"\0")
            if b"reader.py" in b" ".join(words) and str(page.server.process.pid) in parents_of(place):
                fields = (place / "stat").read_text().rpartition(")")[2].split()
                total += (int(fields[11]) + int(fields[12])) / 100.0
        except OSError:
            pass
    return total


def parents_of(place: Path) -> list[str]:
    found = []
    while place.name not in ("0", "1"):
        place = Path("/proc") / (place / "stat").read_text().rpartition(")")[2].split()[1]
        found.append(place.name)
    return found


def refuses(page: Page) -> None:
    """What is formed by pressure says so."""
    text = page.written()
    page.write_text(text + '\n[[load]]\nname = "air"\nkind = "pressure"\nply = "bottom"\nside = "above"\n'
                    'pressure = [[0.0, 0.0], [1.0, 0.01]]\n')
    page.until(lambda: "no instant shear" in page.text("#instant-words"), "it says why")
    assert "pressure" in page.text("#instant-words"), page.text("#instant-words")
    page.press("#undo")
    page.until(lambda: "shear angles to" in page.text("#instant-words"), "plies are formed again")


def closes(page: Page) -> None:
    """And asks for nothing any more; opened again, it is of the case, of which one click makes a run."""
    page.press("#instant-close")
    page.until(lambda: not page.find(".instant").is_displayed())
    drawn = shown(page)["drawn"]
    page.key("ply.1.angle", "20")
    page.until(lambda: page.tree()["ply"][1]["angle"] == 20)
    time.sleep(0.5)
    assert shown(page)["drawn"] == drawn
    page.press("#instant-open")
    page.until(lambda: shown(page)["drawn"] != drawn, "it is drawn anew")
    page.press("#instant-run")
    page.until(lambda: page.js("return location.hash").startswith("#runs/"), "the run is shown")
    page.until(lambda: [run["state"] for run in page.server.get("api/runs")] in (["done"], ["doubtful"]), "it has ended")


go_through([opens, follows_a_hand, fifty_quick_turns, refuses, closes])

# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the workbench in headless Chromium, by clicks and keys, for the tests. Imported, it ends
the test with 77 when anything is missing."""

import base64
import os
import time
import tomllib

from report_browser import Browser
from selenium.common.exceptions import (ElementClickInterceptedException, ElementNotInteractableException,
                                        JavascriptException, NoSuchElementException, NoSuchFrameException,
                                        NoSuchWindowException, StaleElementReferenceException)
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from studio_controls import Controls

PATIENCE = 120.0  # s
PASSING = (NoSuchElementException, StaleElementReferenceException, ElementClickInterceptedException,
           ElementNotInteractableException, JavascriptException, NoSuchFrameException, NoSuchWindowException,
           KeyError, IndexError, TypeError, tomllib.TOMLDecodeError)
# Whether an answer may draw the page anew: of a change that was sent, or of a look, unless that takes long: at the
# scene, or at a run that goes on. What the page does with an answer takes it a moment.
ASKING = """
(() => {
  if (window !== window.top) return;
  const ask = window.fetch;
  let [changes, looks, since] = [0, 0, 0];
  window.plyform_asking = () => changes > 0 || (looks > 0 && performance.now() - since < 300);
  const heard = (change) => setTimeout(() => { if (change) --changes; else --looks; }, 20);
  window.fetch = (...wish) => {
    const change = Boolean(wish[1] && wish[1].method && wish[1].method !== "GET");
    if (!change && !looks) since = performance.now();
    if (change) ++changes;
    else ++looks;
    const answer = ask(...wish);
    answer.then((response) => response.clone().arrayBuffer()).then(() => heard(change), () => heard(change));
    return answer;
  };
})();
"""


class Page(Browser):
    """With PLYFORM_SLOW_PAGE=N a browser N times slower than this machine's, to find what asks too soon."""

    def __init__(self, *arguments, **more):
        super().__init__(*arguments, **more)
        self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": ASKING})
        if slow := os.environ.get("PLYFORM_SLOW_PAGE"):
            self.driver.execute_cdp_cmd("Emulation.setCPUThrottlingRate", {"rate": float(slow)})
        self.controls = Controls(self.driver)

    def __exit__(self, *what):
        self.controls.close()
        super().__exit__(*what)

    def go(self, server, rest=""):
        """Opens #REST of a server's page, as an address that is typed."""
        self.driver.get("about:blank")
        self.driver.get(f"{server.address}#{rest}")
        self.until(lambda: self.js("return Boolean(document.documentElement.dataset.ready)"), "the page is ready")

    def settle(self):
        """Pages of the workbench say themselves when they are done: see until."""

    def until(self, condition, words="it holds", seconds=PATIENCE):
        """Waits until it is true; what the page redraws meanwhile is asked again."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            passing = None
            try:
                value = condition()
                if value:
                    return value
            except PASSING as problem:
                passing = problem
            time.sleep(0.05)
        self.driver.switch_to.default_content()
        raise AssertionError(f"waited {seconds} s in vain until {words}; the page says: {self.text('#trouble')!r}, "
                             f"{self.texts('dialog .words')}, {self.errors()}") from passing

    def when(self, script, *arguments, seconds=PATIENCE):
        """The value of a script as soon as it is true."""
        return self.until(lambda: self.js(script, *arguments), f"{script} {arguments}", seconds)

    def find(self, selector):
        """The element as soon as there is one."""
        return self.until(lambda: self.seen(selector), f"{selector} is there")

    def seen(self, selector):
        """The element; None where there is none."""
        found = self.driver.find_elements(By.CSS_SELECTOR, selector)
        return found[0] if found else None

    def text(self, selector):
        return self.js("const e = document.querySelector(arguments[0]); return e ? e.textContent : ''", selector)

    def texts(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)", selector)

    def near(self, selector):
        """The element, brought to where it is seen, in one question; None while it is missing, hidden or off,
        or while an answer may draw it anew."""
        return self.js("const e = document.querySelector(arguments[0]); "
                       "if (!e || (window.plyform_asking && window.plyform_asking())) return null;"
                       "e.scrollIntoView({block: 'center'});"
                       "return e.getClientRects().length && !e.matches(':disabled') ? e : null", selector)

    def press(self, selector):
        """A click, when what is clicked is there and not off."""
        def act():
            place = self.near(selector)
            if place:
                place.click()
            return place
        self.until(act, f"{selector} can be clicked")

    def type(self, selector, text):
        """Replaces what stands in a field, and leaves it."""
        def act():
            place = self.near(selector)
            if place:
                place.send_keys(Keys.CONTROL, "a" + Keys.NULL + (text or Keys.BACKSPACE) + Keys.TAB)
            return place
        self.until(act, f"{selector} takes {text}")

    def pick(self, selector, value):
        """Chooses of a list."""
        def act():
            place = self.near(selector)
            found = place and [option for option in place.find_elements(By.CSS_SELECTOR, "option")
                               if option.get_attribute("value") == value]
            if found:
                found[0].click()
            return found
        self.until(act, f"{selector} has {value}")

    def slide(self, selector, value):
        """Brings a slider there; the last step is that of a key."""
        def act():
            place = self.near(selector)
            if not place:
                return False
            step = float(place.get_attribute("step") or 1)
            low = value <= float(place.get_attribute("min") or 0)
            self.js("arguments[0].value = arguments[1]", place, str(value + step if low else value - step))
            place.send_keys(Keys.ARROW_LEFT if low else Keys.ARROW_RIGHT)
            return True
        self.until(act, f"{selector} slides to {value}")

    def give(self, selector, *files):
        """Files chosen in an input of files."""
        self.find(selector).send_keys("\n".join(map(str, files)))

    def into_report(self, seconds=PATIENCE):
        """Into the frame of the report, once it is drawn."""
        def drawn():
            self.driver.switch_to.default_content()
            self.driver.switch_to.frame("report-frame")
            return self.js("return document.documentElement.dataset.ready")
        assert self.until(drawn, "the report is drawn", seconds) != "failed", self.errors()

    def picture(self, view="plyform_setup.area.view"):
        return self.js(f"const s = {view}.stage; s.draw(); return s.canvas.toDataURL()")


class SetupPage(Page):
    """The panel of the set-up, beside the file that it changes."""

    def __init__(self, server, file, *arguments):
        super().__init__(*arguments)
        self.server, self.file = server, file

    def open(self, place):
        self.go(self.server, place.lstrip("#"))
        self.until(lambda: self.js("return Boolean(window.plyform_setup && plyform_setup.main && "
                                   "plyform_setup.main.tree)"), "the case is shown")

    def written(self):
        return self.file.read_text(encoding="utf-8")

    def tree(self):
        return tomllib.loads(self.written())

    def item(self, key):
        self.press(f'[data-item="{key}"] button.item')
        self.until(lambda: self.js("return plyform_setup.chosen") == key, f"{key} is chosen")

    def value(self, key, part=""):
        return self.find(of_key(key, part)).get_attribute("value")

    def key(self, key, text, part=""):
        """Types a value into the box of a key, and leaves it."""
        def act():
            box = self.near(of_key(key, part))
            if box:
                box.click()
                box.send_keys(Keys.CONTROL, "a" + Keys.NULL + (text or Keys.DELETE) + Keys.TAB)
            return box
        self.until(act, f"{key} takes {text}")

    def choose(self, key, value, part=""):
        self.pick(of_key(key, part), value)

    def write_text(self, text):
        """Replaces the text in the editor as typing does."""
        self.js("const m = plyform_setup.editor.mirror;"
                "m.replaceRange(arguments[0], {line: 0, ch: 0}, {line: m.lineCount(), ch: 0}, '+input')", text)

    def drop(self, name, content):
        """A file dropped onto the page."""
        self.js("""
          const [name, text] = arguments, room = new DataTransfer();
          const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
          room.items.add(new File([bytes], name));
          document.getElementById("panel-setup").dispatchEvent(new DragEvent("drop",
            { dataTransfer: room, bubbles: true, cancelable: true }));""", name, base64.b64encode(content).decode())

    def changes_picture(self, act):
        before = self.picture()
        act()
        self.until(lambda: self.picture() != before, "the picture is another")

    def click_node(self, ply, corner, inwards=0.0):
        """A corner of a ply's outline, moved towards the middle by a share of the way."""
        x, y = self.js("""
          const [at, corner, inwards] = arguments, view = plyform_setup.area.view, list = view.bodies.plies;
          const mesh = list[at < 0 ? list.length + at : at], x = mesh.ply.flat, T = window.THREE;
          const box = new T.Box3().setFromArray(x), z = box.max.z;
          const from = [[box.min.x, box.min.y], [box.max.x, box.min.y]][corner];
          const point = new T.Vector3(from[0], from[1], z).lerp(box.getCenter(new T.Vector3()), inwards);
          const p = view.stage.pixelOf(view.bodies, point); return [p.x, p.y];""", ply, corner, inwards)
        self.click_at(x, y)


def of_key(key, part=""):
    return f'[data-key="{key}"][data-part="{part}"]'

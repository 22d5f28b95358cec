# SPDX-License-Identifier: GPL-3.0-or-later
"""A set-up page in Chromium as its tests use it: by clicks and keys, beside the file that it changes."""

import base64
import time
import tomllib

from selenium.common.exceptions import NoSuchElementException, StaleElementReferenceException
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


class Page:
    def __init__(self, browser, server, file):
        self.browser, self.server, self.file = browser, server, file
        self.driver, self.js = browser.driver, browser.js

    def open(self, place):
        self.driver.get(self.server.address + place)
        self.until(lambda: self.js("return Boolean(window.plyform_setup && plyform_setup.main && "
                                   "plyform_setup.main.tree)"), 60)

    def until(self, holds, seconds=60):
        """Waits for something to hold."""
        end = time.monotonic() + seconds
        while True:
            try:
                if holds():
                    return
            except (KeyError, IndexError, StaleElementReferenceException, tomllib.TOMLDecodeError):
                pass
            if time.monotonic() > end:
                raise AssertionError(f"not within {seconds} s; the page says "
                                     f"{self.words('#trouble')!r}; {self.browser.errors()}")
            time.sleep(0.05)

    def text(self):
        return self.file.read_text(encoding="utf-8")

    def tree(self):
        return tomllib.loads(self.text())

    def find(self, selector):
        try:
            return self.driver.find_element(By.CSS_SELECTOR, selector)
        except NoSuchElementException:
            return None

    def words(self, selector):
        return self.js("const e = document.querySelector(arguments[0]); return e ? e.textContent : ''", selector)

    def again(self, act):
        """Parts of the page are made anew after each change: once more, if that came between."""
        for _ in range(20):
            try:
                return act()
            except StaleElementReferenceException:
                time.sleep(0.1)
        return act()

    def click(self, selector):
        def act():
            self.until(lambda: self.find(selector) is not None and self.find(selector).is_enabled())
            place = self.find(selector)
            self.js("arguments[0].scrollIntoView({block: 'center'})", place)
            place.click()
        self.again(act)

    def item(self, key):
        self.click(f'[data-item="{key}"] button.item')
        self.until(lambda: self.js("return plyform_setup.chosen") == key)

    def control(self, key, part=""):
        return self.find(f'[data-key="{key}"][data-part="{part}"]')

    def value(self, key, part=""):
        return self.control(key, part).get_attribute("value")

    def type(self, key, text, part=""):
        """Types a value into a box, and leaves it."""
        def act():
            self.until(lambda: self.control(key, part) is not None)
            self.enter(self.control(key, part), text)
        self.again(act)

    def enter(self, box, text):
        self.js("arguments[0].scrollIntoView({block: 'center'})", box)
        box.click()
        box.send_keys(Keys.CONTROL, "a")
        box.send_keys(Keys.DELETE if text == "" else text)
        box.send_keys(Keys.TAB)

    def type_id(self, name, text):
        self.until(lambda: self.find(f"#{name}") is not None)
        box = self.driver.find_element(By.ID, name)
        box.send_keys(Keys.CONTROL, "a")
        box.send_keys(text)

    def pick(self, select, value):
        self.js("const e = arguments[0]; e.value = arguments[1];"
                "e.dispatchEvent(new Event('change', {bubbles: true}));", select, value)

    def choose(self, key, value, part=""):
        self.until(lambda: self.control(key, part) is not None)
        self.pick(self.control(key, part), value)

    def choose_id(self, name, value):
        self.until(lambda: self.find(f"#{name}") is not None)
        self.until(lambda: self.find(f'#{name} option[value="{value}"]') is not None)
        self.pick(self.driver.find_element(By.ID, name), value)

    def slide(self, name, value):
        self.js("const e = document.getElementById(arguments[0]); e.value = arguments[1];"
                "e.dispatchEvent(new Event('input', {bubbles: true}));", name, str(value))

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

    def picture(self):
        return self.js("const s = plyform_setup.area.view.stage; s.draw(); return s.canvas.toDataURL()")

    def changes_picture(self, act):
        before = self.picture()
        act()
        assert self.picture() != before

    def click_node(self, ply, corner, inwards=0.0):
        """A corner of a ply's outline, moved towards the middle by a share of the way."""
        x, y = self.js("""
          const [at, corner, inwards] = arguments, view = plyform_setup.area.view, list = view.bodies.plies;
          const mesh = list[at < 0 ? list.length + at : at], x = mesh.ply.flat, T = window.THREE;
          const box = new T.Box3().setFromArray(x), z = box.max.z;
          const from = [[box.min.x, box.min.y], [box.max.x, box.min.y]][corner];
          const point = new T.Vector3(from[0], from[1], z).lerp(box.getCenter(new T.Vector3()), inwards);
          const p = view.stage.pixelOf(view.bodies, point); return [p.x, p.y];""", ply, corner, inwards)
        for kind in ("mousePressed", "mouseReleased"):
            self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
                "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1,
                "buttons": 1 if kind == "mousePressed" else 0})

# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the workbench in headless Chromium, by clicks and keys. Imported, it ends the test with
77 when anything is missing."""

import time

from report_browser import Browser
from selenium.common.exceptions import (ElementClickInterceptedException, NoSuchElementException,
                                        StaleElementReferenceException)
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

PATIENCE = 60.0  # s


class Page(Browser):
    def go(self, server, rest):
        """Opens #REST of a server's page, as an address that is typed."""
        self.driver.get("about:blank")
        self.driver.get(f"{server.address}#{rest}")
        self.until(lambda: self.js("return Boolean(document.documentElement.dataset.ready)"), "the page is ready")

    def settle(self):
        """Pages of the workbench say themselves when they are done: see until."""

    def until(self, condition, words):
        """Waits until it is true; what the page redraws meanwhile is asked again."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                value = condition()
                if value:
                    return value
            except (NoSuchElementException, StaleElementReferenceException, ElementClickInterceptedException):
                pass
            time.sleep(0.05)
        raise AssertionError(f"waited in vain until {words}; the page says: {self.text('#trouble')!r}, {self.errors()}")

    def text(self, selector):
        return self.js("const e = document.querySelector(arguments[0]); return e ? e.textContent : ''", selector)

    def texts(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)", selector)

    def press(self, selector):
        """A click, when what is clicked is there and not off."""
        def act():
            place = self.find(selector)
            self.js("arguments[0].scrollIntoView({block: 'center'})", place)
            if not place.is_enabled() or not place.is_displayed():
                return False
            place.click()
            return True
        self.until(act, f"{selector} can be clicked")

    def type(self, selector, text):
        """Replaces what stands in a field, and leaves it."""
        def act():
            place = self.find(selector)
            self.js("arguments[0].scrollIntoView({block: 'center'})", place)
            place.send_keys(Keys.CONTROL, "a")
            place.send_keys(Keys.BACKSPACE if not text else text)
            place.send_keys(Keys.TAB)
            return True
        self.until(act, f"{selector} takes {text}")

    def pick(self, selector, value):
        """Chooses of a list."""
        def act():
            place = self.find(selector)
            options = place.find_elements(By.CSS_SELECTOR, "option")
            found = [option for option in options if option.get_attribute("value") == value]
            if found:
                found[0].click()
            return found
        self.until(act, f"{selector} has {value}")

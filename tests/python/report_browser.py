# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a report in headless Chromium, for the tests: what it shows, says and asks of a network.
Imported, it ends the test with 77 when anything that reports or their tests need is missing."""

import base64
import json
import socket
import sys
import time
from pathlib import Path

DRIVER = "/usr/bin/chromedriver"
try:
    import h5py  # noqa: F401, tools/report needs it
    import jinja2  # noqa: F401
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)
if not Path(DRIVER).is_file() or not Path("/usr/share/javascript/three/three.min.js").is_file():
    print("SKIPPED: chromium-driver or libjs-three is not installed")
    sys.exit(77)

SWITCHES = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
            "--force-device-scale-factor=1", "--disable-background-networking",
            "--disable-component-update", "--no-first-run"]

try:
    socket.getaddrinfo("localhost", None)
except OSError:
    print("SKIPPED: this system does not know the name localhost, by which the driver finds "
          "Chromium: add the line 127.0.0.1 localhost to /etc/hosts")
    sys.exit(77)


class Browser:
    def __init__(self, width=1280, height=720, language="en-US"):
        options = webdriver.ChromeOptions()
        for switch in [*SWITCHES, f"--window-size={width},{height}", f"--lang={language}"]:
            options.add_argument(switch)
        options.add_experimental_option("prefs", {"intl.accept_languages": language})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.driver.set_script_timeout(60)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        self.driver.execute_cdp_cmd("Network.enable", {})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def open(self, path: Path):
        """Milliseconds until the first picture, as the page itself has measured them."""
        self.driver.get(path.resolve().as_uri())
        end = time.monotonic() + 60
        while time.monotonic() < end:
            ready = self.js("return document.documentElement.dataset.ready")
            if ready:
                assert ready != "failed", self.errors()
                return int(self.js('return document.documentElement.dataset.picture'))
            time.sleep(0.02)
        raise AssertionError(f"no picture in 60 s: {self.errors()}")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, *arguments):
        """The value of a promise, e.g. wait("plyform_report.change({state: 0})")."""
        return self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1];"
            f"Promise.resolve(({script})).then((v) => done(v === undefined ? null : v),"
            "(e) => done('failed: ' + e.message))", *arguments)

    def settle(self):
        """Until what was asked for is drawn."""
        self.wait("plyform_report.busy.then(() => new Promise((go) => "
                  "requestAnimationFrame(() => requestAnimationFrame(() => go()))))")

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def choose(self, id_, value):
        """Chooses of a list as a reader does: the value, then its event."""
        self.js("const e = document.getElementById(arguments[0]); e.value = arguments[1];"
                "e.dispatchEvent(new Event('input', {bubbles: true}));"
                "e.dispatchEvent(new Event('change', {bubbles: true}));", id_, str(value))
        self.settle()

    def click(self, selector):
        self.js("arguments[0].scrollIntoView({block: 'center'})", self.find(selector))
        self.find(selector).click()
        self.settle()

    def click_at(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
                "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1,
                "buttons": 1 if kind == "mousePressed" else 0})
        self.settle()

    def picture(self):
        """The canvas, drawn now, as text: pictures that differ have other texts."""
        self.settle()
        return self.js("plyform_report.stage.draw();"
                       "return document.getElementById('canvas').toDataURL()")

    def screenshot(self, path, whole=False):
        shot = self.driver.execute_cdp_cmd("Page.captureScreenshot", {
            "format": "png", "captureBeyondViewport": whole})
        Path(path).write_bytes(base64.b64decode(shot["data"]))

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING")]

    def requests(self):
        """Addresses asked for since the start that are neither the file nor within it."""
        asked = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                asked.append(message["params"]["request"]["url"])
        return asked


TURN = """(async () => {
  const { stage } = plyform_report, begin = performance.now(), first = stage.frames;
  while (performance.now() - begin < 3000) {
    stage.camera.turn(2, 0);
    await new Promise((go) => requestAnimationFrame(go));
  }
  return (stage.frames - first) / (performance.now() - begin) * 1000;
})()"""


def main():
    """report_browser.py REPORT.html [PICTURE.png]: how fast it is, and what a reader sees first."""
    with Browser(1280, 720) as browser:
        first = browser.open(Path(sys.argv[1]))
        time.sleep(1.0)
        print(f"first picture after {first} ms, {browser.wait(TURN):.0f} pictures a second while "
              "it turns, 1280 x 720, drawn by the processor")
    if len(sys.argv) == 2:
        return
    with Browser(1280, 1010) as browser:
        browser.open(Path(sys.argv[1]))
        time.sleep(2.0)  # it is drawn once more, with smooth edges
        browser.screenshot(sys.argv[2])


if __name__ == "__main__":
    main()

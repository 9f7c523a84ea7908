"""Debian's Chromium without a window, as the tests of pages drive it. WebGL is done in software."""

import io
import json
import tempfile
import time

import numpy as np
from matplotlib import image
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

OPTIONS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
           "--disable-background-networking", "--disable-component-update", "--hide-scrollbars")
WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-3d-apis",)
SECONDS = 30.0


class Browser:
    def __init__(self, folder, *more):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for word in (*OPTIONS, *more, f"--user-data-dir={tempfile.mkdtemp(dir=folder)}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(SECONDS)

    def close(self):
        self.driver.quit()

    def open(self, path, width=1000, height=800):
        """A page from the disk; returns when its programs have begun."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
        self.driver.get(f"file://{path.resolve()}")
        self.wait("return document.documentElement.dataset.ready === 'yes'")

    def run(self, program, *arguments):
        return self.driver.execute_script(program, *arguments)

    def wait(self, program, *arguments):
        """Until the program answers with something that is true, which is returned."""
        end = time.monotonic() + SECONDS
        while not (answer := self.run(program, *arguments)):
            assert time.monotonic() < end, f"waited too long for: {program}"
            time.sleep(0.02)
        return answer

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def pixels(self, selector):
        """(height, width, 3) of an element as it is seen, 0 to 1."""
        return image.imread(io.BytesIO(self.find(selector).screenshot_as_png))[:, :, :3]

    def errors(self):
        """What the page complained of since it was last asked."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def requested(self):
        """Addresses that the page asked for since it was last asked, but itself."""
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [message["params"]["request"]["url"] for message in messages if message["method"] == "Network.requestWillBeSent"]


def differing(first, second, by=0.06):
    """The share of the pixels that differ."""
    return float(np.mean(np.abs(first - second).max(axis=2) > by))


def painted(pixels, by=0.06):
    """(height, width): which pixels are not of the background, the colour of a corner."""
    return np.abs(pixels - pixels[0, 0]).max(axis=2) > by

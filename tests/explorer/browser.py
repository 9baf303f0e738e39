"""Chromium and Firefox, as the tests of the page use them."""
import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.actions.action_builder import ActionBuilder
except ImportError:
    webdriver = None


def missing():
    """A sentence about what is missing; None: all is there."""
    if webdriver is None:
        return "no module selenium (Debian: python3-selenium)"
    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if not shutil.which(program):
            return f"no {program} (Debian: {package})"
    return None


def wrapped(script):
    return ("const done = arguments[arguments.length - 1], args = [...arguments].slice(0, -1);"
            "(async () => {" + script + "})().then((value) => done({value}), (error) => done({error: String(error.stack || error)}));")


def value_of(answer):
    if "error" in answer:
        raise RuntimeError(answer["error"])
    return answer.get("value")


class Firefox:
    """By its own protocol, Marionette: messages of JSON, each behind its length. Debian has no geckodriver, which Selenium needs."""

    def __init__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.last = 0
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        (Path(self.folder.name) / "user.js").write_text(f'user_pref("marionette.port", {port});\n')
        self.program = subprocess.Popen(["firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", self.folder.name],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(600):
            try:
                self.socket = socket.create_connection(("127.0.0.1", port))
                break
            except OSError:
                time.sleep(0.1)
        self.answers = self.socket.makefile("rb")
        self._answer()  # its name
        self._call("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {"timeouts": {"script": 240000}}}})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.program.terminate()
        self.program.wait()
        self.folder.cleanup()

    def _answer(self):
        length = b""
        while (byte := self.answers.read(1)) not in (b":", b""):
            length += byte
        return json.loads(self.answers.read(int(length)))

    def _call(self, name, parameters):
        self.last += 1
        text = json.dumps([0, self.last, name, parameters]).encode()
        self.socket.sendall(b"%d:%b" % (len(text), text))
        _, _, error, result = self._answer()
        if error:
            raise RuntimeError(error["message"])
        return result

    def open(self, address):
        self._call("WebDriver:Navigate", {"url": address})

    def run(self, script, *arguments):
        """As Browser.run."""
        answer = self._call("WebDriver:ExecuteAsyncScript", {"script": wrapped(script), "args": list(arguments), "newSandbox": False, "sandbox": None})
        return value_of(answer["value"])


class Browser:
    """Chromium without a window, by Selenium."""

    def __init__(self, width=1560, height=980):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", f"--window-size={width},{height}"):
            options.add_argument(word)
        options.add_experimental_option("prefs", {"download.default_directory": self.folder.name, "download.prompt_for_download": False,
                                                  "profile.default_content_setting_values.automatic_downloads": 1})
        options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
        self.driver.set_script_timeout(240)
        self.open, self.command = self.driver.get, self.driver.execute_cdp_cmd

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        self.folder.cleanup()

    def run(self, script, *arguments):
        """The value of an async function's body; `args` are the arguments."""
        return value_of(self.driver.execute_async_script(wrapped(script), *arguments))

    def requests(self):
        """Addresses that were asked for since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def complaints(self):
        """Errors and refusals of the page since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def resize(self, width, height):
        self.command("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def dark(self, on):
        self.command("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if on else "light"}]})

    def drag(self, start, end):
        """The left button, pressed at a point of the window, moved and released."""
        actions = ActionBuilder(self.driver)
        actions.pointer_action.move_to_location(round(start[0]), round(start[1])).pointer_down().move_to_location(round(end[0]), round(end[1])).pointer_up()
        actions.perform()

    def picture(self, path):
        whole = self.command("Page.captureScreenshot", {"format": "png", "captureBeyondViewport": True})
        Path(path).write_bytes(base64.b64decode(whole["data"]))

    def downloaded(self, name):
        """Text of a file that the page gave, once it is there."""
        file = Path(self.folder.name) / name
        for _ in range(100):
            if file.exists() and file.stat().st_size > 0:
                return file.read_text()
            time.sleep(0.1)
        raise RuntimeError(f"{name} was not downloaded")

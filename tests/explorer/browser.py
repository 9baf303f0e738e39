"""Chromium without a window, through chromedriver (W3C WebDriver), and Firefox: standard library only."""
import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path


def missing():
    """A sentence about the program that is missing; None: both are there."""
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


def free_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


class Firefox:
    """By its own protocol, Marionette: messages of JSON, each behind its length."""

    def __init__(self):
        port, self.last = free_port(), 0
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
    def __init__(self, width=1560, height=980):
        port = free_port()
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.url, self.session = f"http://127.0.0.1:{port}", ""
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                     f"--window-size={width},{height}",
                     f"--user-data-dir={self.folder.name}/profile"]
        options = {"args": arguments, "prefs": {"download.default_directory": self.folder.name, "download.prompt_for_download": False,
                                                "profile.default_content_setting_values.automatic_downloads": 1}}
        self._wait_for_driver()
        made = self._call("POST", "/session", {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options, "timeouts": {"script": 240000},
                                                                               "goog:loggingPrefs": {"performance": "ALL", "browser": "ALL"}}}})
        self.session = f"/session/{made['sessionId']}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()
            self.folder.cleanup()

    def _wait_for_driver(self):
        for _ in range(300):
            try:
                return self._call("GET", "/status")
            except OSError:
                time.sleep(0.1)
        raise RuntimeError("chromedriver does not answer")

    def _call(self, method, path, body=None):
        data = json.dumps(body if body is not None else {}).encode() if method == "POST" else None
        request = urllib.request.Request(self.url + self.session + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=300) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def open(self, address):
        self._call("POST", "/url", {"url": address})

    def run(self, script, *arguments):
        """The value of an async function's body; `args` are the arguments."""
        return value_of(self._call("POST", "/execute/async", {"script": wrapped(script), "args": list(arguments)}))

    def log(self, kind):
        return self._call("POST", "/se/log", {"type": kind})

    def requests(self):
        """Addresses that were asked for since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.log("performance")]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def complaints(self):
        """Errors and refusals of the page since the last call."""
        return [entry["message"] for entry in self.log("browser") if entry["level"] == "SEVERE"]

    def resize(self, width, height):
        self.command("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def dark(self, on):
        self.command("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if on else "light"}]})

    def command(self, name, parameters):
        """One command of the DevTools protocol."""
        return self._call("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def drag(self, start, end):
        """The left button, pressed at a point of the window, moved and released."""
        pointer = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
            {"type": "pointerMove", "duration": 0, "x": round(start[0]), "y": round(start[1])}, {"type": "pointerDown", "button": 0},
            {"type": "pointerMove", "duration": 100, "x": round(end[0]), "y": round(end[1])}, {"type": "pointerUp", "button": 0}]}
        self._call("POST", "/actions", {"actions": [pointer]})

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

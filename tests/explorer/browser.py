"""Chromium without a window, by Selenium, as the test of the page uses it."""
import json
import shutil
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


class Browser:
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
        self.open = self.driver.get

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        self.folder.cleanup()

    def run(self, script, *arguments):
        """The value of an async function's body; `args` are the arguments."""
        answer = self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1], args = [...arguments].slice(0, -1);"
            "(async () => {" + script + "})().then((value) => done({value}), (error) => done({error: String(error.stack || error)}));", *arguments)
        if "error" in answer:
            raise RuntimeError(answer["error"])
        return answer.get("value")

    def requests(self):
        """Addresses that were asked for since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def complaints(self):
        """Errors and refusals of the page since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def drag(self, start, end):
        """The left button, pressed at a point of the window, moved and released."""
        actions = ActionBuilder(self.driver)
        actions.pointer_action.move_to_location(round(start[0]), round(start[1])).pointer_down().move_to_location(round(end[0]), round(end[1])).pointer_up()
        actions.perform()

    def downloaded(self, name):
        """Text of a file that the page gave, once it is there."""
        file = Path(self.folder.name) / name
        for _ in range(100):
            if file.exists() and file.stat().st_size > 0:
                return file.read_text()
            time.sleep(0.1)
        raise RuntimeError(f"{name} was not downloaded")

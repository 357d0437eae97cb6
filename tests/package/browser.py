#!/usr/bin/env python3
"""Loads a page of `macula report` in headless Chromium, without a network, and fails where the page
says anything on the console, throws, or asks for anything but itself.

browser.py PAGE [--screenshots FOLDER] [--chromium PROGRAM]

With --screenshots it writes desktop.png, dark.png, phone.png and print.pdf. It also presses the
viewer's keys and checks that the page fits a phone. Exit code: 0, 1 (what is wrong is printed),
77 (no Chromium here).
"""
import argparse
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 60


class Browser:
    """Chromium behind its debugging pipe: JSON messages that end with a NUL."""

    def __init__(self, program, profile):
        to_read, self.to_write = os.pipe()
        self.from_read, from_write = os.pipe()
        # Descriptors 3 and 4 in the child, whatever numbers the pipes have here.
        command = f'exec "$0" "$@" 3<&{to_read} 4>&{from_write}'
        # As root, Chromium starts without its sandbox alone; the page is a local file of ours.
        flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
                 "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
                 "--disable-component-update", "--disable-sync", "--hide-scrollbars",
                 "--proxy-server=127.0.0.1:1", f"--user-data-dir={profile}", "about:blank"]
        self.log = open(pathlib.Path(profile) / "log", "w+", encoding="utf-8", errors="replace")
        self.process = subprocess.Popen(["bash", "-c", command, program, *flags],
                                        pass_fds=(to_read, from_write), stdin=subprocess.DEVNULL,
                                        stdout=self.log, stderr=self.log)
        os.close(to_read)
        os.close(from_write)
        self.rest = b""
        self.events = []
        self.number = 0
        self.session = None

    def message(self):
        end = time.monotonic() + PATIENCE_S
        while b"\0" not in self.rest:
            ready, _, _ = select.select([self.from_read], [], [], max(0, end - time.monotonic()))
            piece = os.read(self.from_read, 1 << 20) if ready else b""
            if not piece:
                self.log.seek(0)
                raise RuntimeError("Chromium did not answer; it said:\n" + self.log.read()[-2000:])
            self.rest += piece
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        text = json.dumps(request).encode() + b"\0"
        while text:
            text = text[os.write(self.to_write, text):]
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def open_page(self):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target,
                                 flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def load(self, url):
        self.call("Page.navigate", url=url)
        end = time.monotonic() + PATIENCE_S
        while not any(e.get("method") == "Page.loadEventFired" for e in self.events):
            if time.monotonic() > end:
                raise RuntimeError("the page did not load")
            self.call("Runtime.evaluate", expression="0")
            time.sleep(0.05)

    def size(self, width, height, scale=1, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=scale, mobile=phone)
        self.evaluate("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))")
        time.sleep(0.2)

    def close(self):
        self.process.kill()
        self.process.wait()
        self.log.close()


def complaints(events, url):
    """What the page said or asked for that it should not have."""
    found = []
    for event in events:
        method, parameters = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            found.append("exception: " + details.get("exception", {}).get(
                "description", details.get("text", "")))
        elif method == "Runtime.consoleAPICalled":
            said = [a.get("value", a.get("description")) for a in parameters["args"]]
            found.append(f"console.{parameters['type']}: {said}")
        elif method == "Log.entryAdded":
            found.append(f"{parameters['entry']['level']}: {parameters['entry']['text']}")
        elif method == "Network.requestWillBeSent":
            asked = parameters["request"]["url"]
            if asked != url and not asked.startswith("data:"):
                found.append("it asked for " + asked[:200])
    return found


def check_page(browser):
    """What a person would find: the parts are there, all pictures are whole, keys flip them."""
    found = []
    expect = [
        ("document.querySelectorAll('main h2').length >= 2", "there is no part for a scene"),
        ("document.querySelectorAll('figure svg path').length > 0", "no plot was drawn"),
        ("document.querySelectorAll('.viewer').length > 0", "there is no viewer of pictures"),
        ("[...document.images].every(i => i.complete && i.naturalWidth > 0)",
         "a picture is broken"),
        ("![...document.querySelectorAll('main svg *, main td')].some(e => "
         "/NaN|undefined/.test(e.outerHTML))", "there is a NaN or an undefined in the page"),
    ]
    press = ("(k => document.dispatchEvent(new KeyboardEvent('keydown', {key: k, bubbles: true})))")
    shown = ("[...(document.querySelector('.viewer .stage')?.children || [])]"
             ".findIndex(s => s.classList.contains('shown'))")
    for key, index in (("1", 0), ("3", 2), ("2", 1)):
        expect.append((f"({press}('{key}'), {shown} === {index})",
                       f"key {key} does not show picture {index}"))
    for expression, problem in expect:
        if browser.evaluate(expression) is not True:
            found.append(problem)
    return found


def screenshot(browser, path):
    data = browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                        fromSurface=True)["data"]
    path.write_bytes(base64.b64decode(data))


def views(browser, folder):
    """Screenshots; what does not fit a phone."""
    browser.size(1280, 900)
    if folder:
        screenshot(browser, folder / "desktop.png")
        browser.call("Emulation.setEmulatedMedia",
                     features=[{"name": "prefers-color-scheme", "value": "dark"}])
        screenshot(browser, folder / "dark.png")
        browser.call("Emulation.setEmulatedMedia", features=[])
        pdf = browser.call("Page.printToPDF", printBackground=True, preferCSSPageSize=True)
        (folder / "print.pdf").write_bytes(base64.b64decode(pdf["data"]))
    browser.size(390, 844, 2, True)
    wide = browser.evaluate("document.documentElement.scrollWidth")
    if folder:
        screenshot(browser, folder / "phone.png")
    return [] if wide <= 390 else [f"at a phone's 390 pixels the page is {wide} wide"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path)
    parser.add_argument("--chromium", default=shutil.which("chromium"))
    options = parser.parse_args()
    if not options.chromium:
        print("browser: skipped: there is no chromium here")
        return 77
    if options.screenshots:
        options.screenshots.mkdir(parents=True, exist_ok=True)
    url = options.page.resolve(strict=True).as_uri()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(options.chromium, profile)
        try:
            browser.open_page()
            browser.load(url)
            found = check_page(browser) + views(browser, options.screenshots)
            found = complaints(browser.events, url) + found
        finally:
            browser.close()
    for problem in found:
        print(f"browser: {options.page}: {problem}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

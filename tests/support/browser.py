# SPDX-License-Identifier: MIT
"""A headless Chromium for the tests of pages.

Needs Debian's chromium and nothing else: it is spoken to over a pipe, in its DevTools protocol.
"""
import base64
import fcntl
import json
import os
import re
import select
import subprocess
import tempfile
import time

PATIENCE = 60  # seconds, for anything


class Browser:
    """One tab of a headless Chromium; file descriptors 3 and 4 are where it expects the pipe."""

    def __init__(self, profile):
        theirs, self.out = os.pipe()
        self.inward, back = os.pipe()
        high = [fcntl.fcntl(fd, fcntl.F_DUPFD, 10) for fd in (theirs, back)]

        def connect():
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        program = os.environ.get("CHROMIUM", "chromium")
        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
             "--disable-dev-shm-usage", "--disable-background-networking",
             "--force-color-profile=srgb", "--enable-unsafe-swiftshader",
             "--remote-debugging-pipe", f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=connect, close_fds=False, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        for fd in (theirs, back, *high):
            os.close(fd)
        self.buffer, self.events, self.sent, self.session = b"", [], 0, None
        self.url = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target,
                                 flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.out)
        os.close(self.inward)

    def receive(self, deadline):
        while b"\0" not in self.buffer:
            if not select.select([self.inward], [], [], max(0, deadline - time.monotonic()))[0]:
                raise TimeoutError("chromium did not answer")
            more = os.read(self.inward, 1 << 16)
            if not more:
                raise ConnectionError("chromium ended")
            self.buffer += more
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **params):
        self.sent += 1
        message = {"id": self.sent, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while (answer := self.receive(deadline)).get("id") != self.sent:
            self.events.append(answer)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise RuntimeError(details.get("exception", {}).get("description", details["text"]))
        return answer["result"].get("value")

    def resize(self, width, height=900, is_phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=is_phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=is_phone)

    def scheme(self, name):
        """`light` or `dark`."""
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": name}])

    def open(self, url):
        self.url = url
        self.call("Page.navigate", url=url)
        deadline = time.monotonic() + PATIENCE
        while not self.value("document.readyState === 'complete'"
                             " && location.href !== 'about:blank'"):
            if time.monotonic() > deadline:
                raise TimeoutError("the page did not load")
            time.sleep(0.05)

    def mouse(self, kind, place, held=False):
        self.call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1],
                  button="none" if kind == "mouseMoved" and not held else "left",
                  buttons=int(held), clickCount=1)

    def touch(self, kind, *places):
        """`kind` as in the protocol: touchStart, touchMove, touchEnd."""
        self.call("Input.dispatchTouchEvent", type=kind,
                  touchPoints=[dict(x=x, y=y) for x, y in places])

    def wheel(self, place, distance):
        """Down and to the right."""
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=place[0], y=place[1],
                  deltaX=distance, deltaY=distance)

    def press(self, key, shift=False, code=""):
        """`key` and `code` as in KeyboardEvent."""
        text = {"text": key} if len(key) == 1 else {}
        number = {" ": 32, "ArrowLeft": 37, "ArrowRight": 39}.get(key, ord(key[0].upper()))
        common = dict(key=key, code=code, windowsVirtualKeyCode=number,
                      modifiers=8 if shift else 0)
        self.call("Input.dispatchKeyEvent", type="keyDown", **text, **common)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def screenshot(self, x, y, width, height):
        """A PNG of a part of the window."""
        left, top = self.value("[scrollX, scrollY]")
        clip = dict(x=x + left, y=y + top, width=width, height=height, scale=1)
        return base64.b64decode(self.call("Page.captureScreenshot", clip=clip)["data"])

    def click(self, element):
        """Where the mouse finds it, so that what is covered or hidden is not clicked."""
        place = self.value(f"""(() => {{ const e = {element};
            e.scrollIntoView({{block: 'center'}}); const box = e.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]; }})()""")
        self.mouse("mousePressed", place)
        self.mouse("mouseReleased", place)

    def complaints(self, allowed=("data:",)):
        """What was asked of the network, but for addresses that begin as allowed, and what the
        console says."""
        for event in self.events:
            params = event.get("params", {})
            if event["method"] == "Network.requestWillBeSent":
                url = params["request"]["url"]
                if not url.startswith(allowed) and url != self.url:
                    yield f"asked the network for {url[:120]}"
            elif event["method"] == "Runtime.exceptionThrown":
                details = params["exceptionDetails"]
                yield "exception: " + details.get("exception", {}).get("description",
                                                                       details["text"])
            elif event["method"] == "Runtime.consoleAPICalled":
                words = [str(one.get("value", one["type"])) for one in params["args"]]
                yield f"console: {params['type']} {' '.join(words)}"
            elif event["method"] == "Log.entryAdded" and params["entry"]["level"] != "verbose":
                yield f"log: {params['entry']['text']}"


def own_data(page, pattern):
    """As Python reads it from the file, not as the page's script understands it."""
    found = re.findall(pattern, page.read_text(encoding="utf-8"), re.S)
    if len(found) != 1:
        raise ValueError(f"{len(found)} scripts with data")
    return json.loads(found[0])


def failures_of(page, width, pattern, make_check, is_ready="true"):
    """What `make_check(browser, data).all()` finds in a page, and what the browser complains of."""
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            browser = Browser(profile)
            try:
                browser.resize(width)
                check = make_check(browser, own_data(page, pattern))
                browser.open(page.resolve().as_uri())
                if not browser.value(is_ready):
                    return ["the page did not become ready", *browser.complaints()]
                try:
                    check.all()
                except (RuntimeError, ValueError, LookupError, TypeError) as error:
                    check.failures.append(f"stopped: {type(error).__name__}: {error}")
                return check.failures + list(browser.complaints())
            finally:
                browser.close()
    except (OSError, RuntimeError, ValueError) as error:
        return [f"{type(error).__name__}: {error}"]

# SPDX-License-Identifier: MIT
"""A visit to the page in a browser of its own."""
import contextlib
import functools
import http.server
import json
import subprocess
import tempfile
import threading
import time
import zlib
from base64 import b64decode, urlsafe_b64encode

import png
from browser import PATIENCE, Browser

# Chromium says so of itself where it has no GPU and shows any canvas of WebGL.
OF_CHROMIUM = "GPU stall due to ReadPixels"


def native(programs, name, *arguments):
    return subprocess.run([programs / name, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600)


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def copyfile(self, *files):
        with contextlib.suppress(ConnectionError):  # the page loads another one
            super().copyfile(*files)


def has_colours(picture):
    rows = png.decode(picture[0]).rows
    return len({row[i:i + 3] for row in rows for i in range(0, len(row), 3)}) > 2


class Visit:
    """Failures are sentences."""

    def __init__(self, origin, programs, folder):
        self.origin, self.programs, self.folder = origin, programs, folder
        self.failures, self.opened, self.files = [], 0, ""

    @staticmethod
    @contextlib.contextmanager
    def server(folder):
        serve = functools.partial(Handler, directory=str(folder))
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), serve)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()

    def __enter__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.browser = Browser(self.profile.name)
        self.browser.resize(1280)
        return self

    def __exit__(self, *_):
        self.browser.close()
        self.profile.cleanup()

    def attempt(self, check, *arguments):
        try:
            return check(self, *arguments)
        except (OSError, RuntimeError, ValueError, LookupError, TypeError) as error:
            self.failures.append(f"stopped: {type(error).__name__}: {error}")

    def all_failures(self):
        allowed = (self.origin, f"blob:{self.origin}", "data:", "blob:null/", *self.files)
        self.attempt(lambda visit: visit.expect(
            not visit.browser.value("'executed' in window"), "markup is executed"))
        complaints = [c for c in self.browser.complaints(allowed) if OF_CHROMIUM not in c]
        return self.failures + complaints

    def expect(self, holds, words):
        if not holds:
            self.failures.append(words)

    def until(self, condition, words):
        deadline = time.monotonic() + PATIENCE
        while not (holds := condition()) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.expect(holds, f"waited in vain: {words}")

    def wait(self, condition, words):
        def holds():
            try:
                return self.browser.value(condition)
            except RuntimeError as error:
                if "navigated" not in str(error):  # a page that loads another one is asked again
                    raise
        self.until(holds, words)

    def wait_setting(self, setting, words):
        self.wait(f"setting === '{setting}'", f"{words}: {setting}")

    def wait_picture(self, is_right, words):
        self.until(lambda: is_right(self.picture()), words)

    def still_picture(self):
        """Once nothing moves."""
        def is_still():
            before = self.picture()
            self.sleep(0.5)
            return self.picture() == before
        self.until(is_still, "a still picture")
        return self.picture()

    def sleep(self, seconds):
        time.sleep(seconds)

    def open(self, link, page="play.html", address=None):
        self.opened += 1
        if address:
            self.files = (address.rsplit("/", 1)[0],)
        self.browser.open(f"{address or self.origin + page}?{self.opened}#{link}")

    def play(self, *place):
        """Opens it and waits for a picture."""
        self.open(*place)
        self.wait_picture(has_colours, f"a picture of {place}")
        problem = self.text("problem")
        self.expect(problem == "", f"{place}: {problem}")

    def text(self, element):
        return self.browser.value(f"document.querySelector('#{element}').textContent")

    def picture(self, scale=0.25):
        """A PNG of the lower three quarters of the canvas, without the line, and its place."""
        x, y, width, height = self.browser.value("""(() => {
            const box = document.querySelector('#canvas').getBoundingClientRect();
            return [box.x + scrollX + 3, box.y + scrollY + box.height / 4, box.width - 6,
                    box.height * 3 / 4 - 3].map(Math.round); })()""")
        clip = dict(x=x, y=y, width=width, height=height, scale=scale)
        return b64decode(self.browser.call("Page.captureScreenshot", clip=clip)["data"]), (x, y)

    def knob(self):
        """Where the slider of the jump has its knob, the only square of ink."""
        data, (left, top) = self.picture(scale=1)
        shot, ink, side = png.decode(data), bytes((40, 44, 52)), 5
        for y in range(shot.height - side, shot.height // 2, -1):
            x = shot.rows[y].find(ink * side) // 3
            if x > 0 and all(row[3 * x:3 * (x + side)] == ink * side
                             for row in shot.rows[y - side:y]):
                scroll = self.browser.value("[scrollX, scrollY]")
                return [left + x + side // 2 - scroll[0], top + y - side // 2 - scroll[1]]
        raise LookupError("the slider has no knob")

    def click(self, element):
        self.browser.click(f"find('{element}')")

    def tap(self, element):
        place = self.browser.value(f"""(() => {{ const e = {element};
            e.scrollIntoView({{block: 'center'}}); const box = e.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]; }})()""")
        self.browser.touch("touchStart", place)
        self.browser.touch("touchEnd")

    def type(self, text, element="text"):
        self.browser.value(f"find('{element}').select()")
        self.browser.call("Input.insertText", text=text)

    def fill(self, element, text):
        self.type(text, element)
        self.browser.value("document.activeElement.blur()")

    def choose(self, element, value):
        self.wait(f"[...find('{element}').options].some(one => one.value === '{value}')",
                  f"the choice of {value}")
        self.browser.value(f"""(() => {{ const e = find('{element}');
            e.value = '{value}'; e.dispatchEvent(new Event('change')); }})()""")

    def run(self, *arguments):
        return self.browser.value(f"runOiler({json.dumps(arguments)}, {{}}).result")

    def give_file(self, path):
        chooser = self.browser.call("Runtime.evaluate", expression="find('file')")["result"]
        self.browser.call("DOM.setFileInputFiles", files=[str(path)],
                          objectId=chooser["objectId"])

    def drop_file(self, path):
        data = dict(items=[], files=[str(path)], dragOperationsMask=1)
        for kind in ("dragEnter", "dragOver", "drop"):
            self.browser.call("Input.dispatchDragEvent", type=kind, x=200, y=200, data=data)

    def download(self, click, name):
        self.browser.call("Browser.setDownloadBehavior", behavior="allow",
                          downloadPath=str(self.folder))
        click()
        file = self.folder / name
        self.until(file.exists, f"the download of {name}")
        return file

    def deflated(self, data):
        packer = zlib.compressobj(wbits=-15)
        return urlsafe_b64encode(packer.compress(data) + packer.flush()).decode().rstrip("=")

    def before_scripts(self, script):
        self.browser.call("Page.addScriptToEvaluateOnNewDocument", source=script)

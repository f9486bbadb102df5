"""Debian's chromium without a screen, driven over its debugging protocol."""

import base64
import contextlib
import json
import pathlib
import shutil
import subprocess
import tempfile
import time
import urllib.request

from websockets.sync.client import connect

CHROMIUM = shutil.which("chromium")
# The page itself is drawn without SwiftShader: only the picture in it needs it.
WITH_PICTURE = ["--use-angle=swiftshader-webgl", "--enable-unsafe-swiftshader"]
# Keys by which the browser itself does something.
CODES = {"Escape": 27, "Tab": 9, "Enter": 13, "ArrowLeft": 37, "ArrowRight": 39}
SHIFT = 8
WITHOUT_PICTURE = ["--disable-gpu", "--disable-3d-apis"]


class PageError(AssertionError):
    """What was asked of the page ended in an exception, as it does while it loads itself or builds what is asked for."""


class Browser:
    """One page in a browser of its own; what its console says and what it asks for is kept until it is forgotten."""

    def __init__(self, width=1280, height=720, flags=WITH_PICTURE):
        assert CHROMIUM, "chromium is missing: dependencies/debian_tests.txt lists it"
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="surefoot-browser-"))
        command = [CHROMIUM, "--headless=new", "--no-sandbox", "--no-first-run", "--disable-extensions",
                   "--disable-background-networking", "--disable-component-update", "--hide-scrollbars",
                   "--remote-debugging-port=0", f"--user-data-dir={self.folder}", f"--window-size={width},{height}",
                   *flags, "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.console, self.requests, self.count = [], [], 0
        self.open_things = contextlib.ExitStack()
        # Without pings: while nobody reads, as in tests with another page, what the page says keeps their answers back.
        self.socket = self.open_things.enter_context(connect(self.page_address(), max_size=None, compression=None, ping_interval=None))
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height)

    def page_address(self):
        port_file = self.folder / "DevToolsActivePort"
        wait_for(lambda: port_file.exists() and port_file.read_text().count("\n") >= 1, "chromium to listen", 30)
        port = port_file.read_text().splitlines()[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list") as answer:
            return next(page["webSocketDebuggerUrl"] for page in json.load(answer) if page["type"] == "page")

    def call(self, method, **params):
        return self.answer(self.ask(method, **params))

    def ask(self, method, **params):
        """Sends a call; its number."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": params}))
        return self.count

    def answer(self, number):
        """What came back of a call; of those before it nothing is kept."""
        while True:
            message = json.loads(self.socket.recv(timeout=60))
            if message.get("id", 0) in range(1, number + 1):
                if "error" in message:
                    raise PageError(message["error"])
            if message.get("id") == number:
                return message["result"]
            self.hear(message)

    def hear(self, message):
        method, params = message.get("method"), message.get("params", {})
        if method == "Runtime.consoleAPICalled":
            text = " ".join(str(part.get("value", part.get("description", ""))) for part in params["args"])
            self.console.append((params["type"], text))
        elif method == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.console.append(("error", details.get("exception", {}).get("description", details["text"])))
        elif method == "Log.entryAdded":
            self.console.append((params["entry"]["level"], params["entry"]["text"]))
        elif method == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])

    def run(self, script):
        """The value of a JavaScript expression; promises are waited for."""
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise PageError(details.get("exception", {}).get("description", details["text"]), script)
        return result["result"].get("value")

    def wait(self, script, seconds=20):
        return wait_for(lambda: self.run(script), script, seconds)

    def resize(self, width, height, scale=1, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def prefer(self, theme):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": theme}])

    def forget(self):
        """Begins anew to keep what the page says and asks for: what another page did is not its own."""
        self.console.clear()
        self.requests.clear()

    def open(self, address):
        self.call("Page.navigate", url=address)

    def click(self, selector):
        x, y = self.middle(selector)
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def mouse(self, kind, x, y, button="left", modifiers=0):
        buttons = {"left": 1, "right": 2}[button]
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1, modifiers=modifiers)

    def stroke(self, begin, end, **how):
        """The mouse goes down at one place, to another in steps, and up."""
        self.mouse("mousePressed", *begin, **how)
        for step in range(1, 7):
            self.mouse("mouseMoved", *(a + step / 6 * (b - a) for a, b in zip(begin, end)), **how)
        self.mouse("mouseReleased", *end, **how)

    def wheel(self, x, y, down):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=down)

    def touch(self, *fingers):
        """Each finger goes down at the first of its points, to the others, and up, all at the same time."""
        for k, points in enumerate(zip(*fingers)):
            self.call("Input.dispatchTouchEvent", type="touchMove" if k else "touchStart",
                      touchPoints=[{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(points)])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def tap(self, selector):
        """With a finger; up is sent at once, so that a busy page makes no long press of it."""
        x, y = self.middle(selector)
        self.ask("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def middle(self, selector):
        return self.run(f"(() => {{ const b = document.querySelector({selector!r}).getBoundingClientRect();"
                        "return [b.x + b.width / 2, b.y + b.height / 2]; })()")

    def press(self, key, text=None, modifiers=0):
        code = {"windowsVirtualKeyCode": CODES[key]} if key in CODES else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=text or (key if len(key) == 1 else ""), modifiers=modifiers, **code)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, modifiers=modifiers, **code)

    def screenshot(self, path=None):
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path is not None:
            pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
            pathlib.Path(path).write_bytes(data)
        return data

    def close(self):
        self.open_things.close()
        self.process.terminate()
        self.process.wait(timeout=20)
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def wait_for(condition, what, seconds=20):
    """The condition's first value that counts as true; a page that can't answer yet is asked again."""
    end, error = time.monotonic() + seconds, None
    while time.monotonic() < end:
        try:
            if value := condition():
                return value
            error = None
        except PageError as said:
            error = said
        time.sleep(0.05)
    raise AssertionError(f"waited {seconds} s for {what}" + (f"; the page says {error}" if error else ""))

"""A page without a browser: what the viewer's page says and hears (viewer/README.md)."""

import contextlib
import http.client
import json
import re
import signal
import struct
import subprocess
import threading
import time

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from program import served

# A run that does not end by itself, with many levels.
LONG = ["--set", "duration=1000", "--set", "stack=terrain_adaptation"]
# A call of one.
WALK = ["run", "walk_flat_ideal", "--view", "--set", "duration=600", "--set", "stack=terrain_adaptation"]


class Served:
    """The program while it serves a page on this machine."""

    def __init__(self, *arguments, port=0, waits=False):
        self.process = subprocess.Popen(served(arguments, waits, port), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.errors = ""
        for line in self.process.stderr:
            self.errors += line
            if link := re.search(r"http://(127\.0\.0\.1):(\d+)/#token=(\S+)", line):
                break
        else:
            raise AssertionError(f"no link: {self.errors}")
        self.link, self.host, self.port, self.token = link[0], link[1], int(link[2]), link[3]
        # What else it writes must not fill the pipe.
        self.readers = [threading.Thread(target=self._read, args=(name,)) for name in ("stdout", "stderr")]
        self.output = ""
        for reader in self.readers:
            reader.start()

    def _read(self, name):
        for line in getattr(self.process, name):
            if name == "stdout":
                self.output += line
            else:
                self.errors += line

    @property
    def address(self):
        """The link without its token."""
        return f"http://{self.host}:{self.port}/"

    def get(self, path, headers=(), method="GET"):
        """Status, headers and body of an answer."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=30)
        with contextlib.closing(connection):
            connection.request(method, path, headers=dict(headers))
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()

    def session(self, is_it=lambda session: True, seconds=60):
        """As soon as it is the one."""
        end = time.monotonic() + seconds
        while not is_it(session := json.loads(self.get("/api/session")[2])):
            assert time.monotonic() < end, session
            time.sleep(0.05)
        return session

    def summarised(self):
        """The session of a log once all of it was read."""
        return self.session(lambda session: session["summarised"] == session["ticks"])

    def frames(self, query):
        return Frames(self.session(), [self.get(f"/api/frames?{query}")[2]])

    def page(self, **options):
        return Page(self, **options)

    def end(self):
        """^C; its exit code."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(timeout=30)
        for reader in self.readers:
            reader.join()
        return code

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
            self.process.wait(timeout=60)
        for reader in self.readers:
            reader.join()


class Refused(Exception):
    """Of an upgrade, with the status."""


class Closed(ConnectionError):
    """By the program, with its reason."""


class Page:
    """A WebSocket to a served run."""

    def __init__(self, served, token=None, origin=None):
        self.token = served.token if token is None else token
        name = f"{served.host}:{served.port}"
        options = {"compression": None, "max_size": None, "ping_interval": None, "proxy": None, "close_timeout": 1}
        try:
            self.open_things = contextlib.ExitStack()
            self.socket = self.open_things.enter_context(connect(f"ws://{name}/api/live", origin=origin or f"http://{name}", **options))
        except InvalidStatus as refused:
            raise Refused(refused.response.status_code) from None
        self.id, self.blocks, self.texts = 0, [], []

    def hear(self):
        """The next message, which is also kept: a dict, or the bytes of a block."""
        try:
            content = self.socket.recv(timeout=20)
        except ConnectionClosed as closed:
            raise Closed(closed.rcvd.reason if closed.rcvd else "without a reason") from None
        kept = self.blocks if isinstance(content, bytes) else self.texts
        kept.append(content if isinstance(content, bytes) else json.loads(content))
        return kept[-1]

    def hear_for(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.hear()

    def drawn(self):
        """As a page says that has drawn the robot."""
        self.socket.send(json.dumps({"type": "drawn"}))

    def ask(self, type, **members):
        """Sends a command; the reply."""
        self.id += 1
        message = {"type": type, "id": self.id, **members}
        if self.token:
            message["token"] = self.token
        self.socket.send(json.dumps(message))
        return self.wait(lambda heard: heard.get("type") == "reply" and heard["id"] == self.id)

    def do(self, type, **members):
        reply = self.ask(type, **members)
        assert reply["ok"], reply

    def wait(self, is_it, seconds=30):
        """The next text that is the one."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            heard = self.hear()
            if isinstance(heard, dict) and is_it(heard):
                return heard
        raise AssertionError(f"not heard within {seconds} s: {self.texts[-5:]}")

    def change(self, words="", seconds=30):
        """The text of the next change from outside with these words."""
        texts = lambda heard: [one["text"] for one in heard.get("events", []) if isinstance(one, dict) and one["kind"] == "change" and words in one["text"]]  # noqa: E731
        return texts(self.wait(lambda heard: texts(heard) != [], seconds))[0]

    def status(self, is_it=lambda status: True, seconds=30):
        return self.wait(lambda heard: heard["type"] == "status" and is_it(heard), seconds)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.open_things.close()


class Frames:
    """The frames of blocks, by the channels of a session."""

    def __init__(self, session, blocks):
        self.channels = {channel["name"]: channel for channel in session["channels"]}
        self.ticks, self.times, self.floats, self.generations = [], [], [], []
        self.active, self.blocking = [], []
        self.dropped = 0
        for block in blocks:
            magic, count, self.dropped, generation = struct.unpack_from("<4s3I", block)
            assert magic == b"SFV1"
            place = 16
            for _ in range(count):
                size, tick, when = struct.unpack_from("<IId", block, place)
                assert size % 8 == 0
                self.ticks.append(tick)
                self.times.append(when)
                self.generations.append(generation)
                self.floats.append(struct.unpack_from(f"<{session['frame_floats']}f", block, place + 16))
                rows = place + 16 + 4 * session["frame_floats"]
                active, blocking = struct.unpack_from("<HH", block, rows)
                self.active.append([struct.unpack_from("<BbHf", block, rows + 4 + 8 * i) for i in range(active)])
                rows += 4 + 8 * active
                self.blocking.append([struct.unpack_from("<BBHf", block, rows + 8 * i) for i in range(blocking)])
                place += size
            assert place == len(block)

    def of(self, name):
        """All values of a channel; tuples where it has several numbers."""
        channel = self.channels[name]
        begin, size = channel["offset"], channel["size"]
        return [frame[begin] if size == 1 else frame[begin : begin + size] for frame in self.floats]

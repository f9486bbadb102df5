"""A page without a browser: what the viewer's page says and hears (docs/view_protocol.md)."""

import base64
import contextlib
import http.client
import json
import os
import re
import signal
import socket
import struct
import subprocess
import threading
import time

from program import served

# A run that does not end by itself, with many levels.
LONG = ["--set", "duration=1000", "--set", "stack=terrain_adaptation"]


class Served:
    """The program while it serves a page on this machine."""

    def __init__(self, *arguments, waits=False):
        self.process = subprocess.Popen(served(arguments, waits), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.errors = ""
        for line in self.process.stderr:
            self.errors += line
            if link := re.search(r"http://(127\.0\.0\.1):(\d+)/#token=(\S+)", line):
                break
        else:
            raise AssertionError(f"no link: {self.errors}")
        self.host, self.port, self.token = link[1], int(link[2]), link[3]
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

    def get(self, path, headers=(), method="GET"):
        """Status, headers and body of an answer."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=30)
        with contextlib.closing(connection):
            connection.request(method, path, headers=dict(headers))
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()

    def session(self):
        return json.loads(self.get("/api/session")[2])

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
            self.process.kill()
            self.process.wait()
        for reader in self.readers:
            reader.join()


class Refused(Exception):
    """Of an upgrade, with the status."""


class Closed(ConnectionError):
    """By the program, with its reason."""


class Page:
    """A WebSocket to a served run."""

    def __init__(self, served, token=None, origin=None, host=None):
        self.token = served.token if token is None else token
        self.socket = socket.create_connection((served.host, served.port), timeout=20)
        name = f"{served.host}:{served.port}"
        self.socket.sendall(
            f"GET /api/live HTTP/1.1\r\nHost: {host or name}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Origin: {origin or 'http://' + name}\r\nSec-WebSocket-Version: 13\r\n"
            f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}\r\n\r\n".encode()
        )
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.bytes += self._some()
        head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        status = int(head.split()[1])
        if status != 101:
            raise Refused(status)
        self.id = 0
        self.blocks, self.texts = [], []

    def _some(self):
        some = self.socket.recv(1 << 16)
        if not some:
            raise ConnectionError("the program closed the connection")
        return some

    def _take(self, count):
        while len(self.bytes) < count:
            self.bytes += self._some()
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def hear(self):
        """The next message, which is also kept: a dict, or the bytes of a block."""
        while True:
            first, length = self._take(2)
            if length == 126:
                (length,) = struct.unpack(">H", self._take(2))
            elif length == 127:
                (length,) = struct.unpack(">Q", self._take(8))
            content = self._take(length)
            kind = first & 15
            if kind == 8:
                raise Closed(content[2:].decode())
            if kind == 9:
                self.send_bytes(10, content)
            if kind == 1:
                self.texts.append(json.loads(content))
                return self.texts[-1]
            if kind == 2:
                self.blocks.append(content)
                return content

    def send_bytes(self, kind, content):
        mask = os.urandom(4)
        head = bytes([128 | kind])
        if len(content) < 126:
            head += bytes([128 | len(content)])
        elif len(content) < 1 << 16:
            head += bytes([128 | 126]) + struct.pack(">H", len(content))
        else:
            head += bytes([128 | 127]) + struct.pack(">Q", len(content))
        self.socket.sendall(head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(content)))

    def drawn(self):
        """As a page says that has drawn the robot."""
        self.send_bytes(1, json.dumps({"type": "drawn"}).encode())

    def ask(self, type, **members):
        """Sends a command; the reply."""
        self.id += 1
        message = {"type": type, "id": self.id, **members}
        if self.token:
            message["token"] = self.token
        self.send_bytes(1, json.dumps(message).encode())
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

    def close(self):
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


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

"""The program's viewer: started, its link read, stopped."""

import json
import queue
import re
import subprocess
import threading
import urllib.request

from program import served

LINK = re.compile(r"http://127\.0\.0\.1:(\d+)/(?:#token=(\S+))?")


class Viewer:
    """`surefoot run … --view` or `surefoot replay …` until it is closed."""

    def __init__(self, *arguments, port=0, cwd=None, waits=False):
        command = served(arguments, waits, port)
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=cwd)
        self.lines, self.said = queue.Queue(), []
        threading.Thread(target=self.listen, daemon=True).start()
        self.link = self.read_link()
        found = LINK.search(self.link)
        self.host, self.port, self.token = "127.0.0.1", int(found[1]), found[2]

    def listen(self):
        for line in self.process.stdout:
            self.lines.put(line)
        self.lines.put(None)

    def read_link(self):
        while True:
            line = self.lines.get(timeout=60)
            assert line is not None, "the program ended without a link:\n" + "".join(self.said)
            self.said.append(line)
            if found := LINK.search(line):
                return found[0]

    @property
    def address(self):
        """The link without its token."""
        return f"http://127.0.0.1:{self.port}/"

    def json(self, path):
        with urllib.request.urlopen(self.address + path) as answer:
            return json.load(answer)

    def close(self):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait(timeout=60)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

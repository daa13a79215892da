"""The server, and a page's side of a session, for tests."""
import os
import re
import signal
import subprocess
import threading
import time
import urllib.error
import urllib.request

from web_socket import WebSocket

PROGRAM = os.environ["ELVIS_PROGRAM"]


class Server:
    """`elvis serve`, which has to end well."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "serve", *arguments, "--port", "0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.errors = []
        self.reader = threading.Thread(target=lambda: self.errors.extend(self.process.stderr), daemon=True)
        self.reader.start()
        self.url = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]{48})", self.url)
        if not found:
            self.process.kill()
            raise AssertionError(f"no address but {self.url!r}: {''.join(self.errors)}")
        self.port, self.token = int(found[1]), found[2]

    def get(self, path):
        """Status, headers and body."""
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=30) as answer:
                return answer.status, dict(answer.headers), answer.read()
        except urllib.error.HTTPError as error:
            return error.code, dict(error.headers), error.read()

    def socket(self, token=None, session="", headers=()):
        return WebSocket(self.port, f"/any/prefix/session?token={token or self.token}&session={session}", headers)

    def page(self, session="", size=None):
        return Page(self.socket(session=session), size)

    def memory(self):
        """Mebibytes that it holds."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmRSS:\s+(\d+)", status.read())[1]) / 1024

    def stop(self):
        """Ctrl-C; returns the exit status."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            status = self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            status = self.process.wait()
        self.reader.join(5)
        self.process.stdout.close()
        self.process.stderr.close()
        return status


class Page:
    """What a page does, without a browser."""

    def __init__(self, socket, size=None):
        self.socket = socket
        self.frames = []
        self.images = {}
        self.confirms = True
        self.state = None
        self.number = 0
        hello = self.wait(lambda m: m["type"] == "hello")
        self.session, self.volume = hello["session"], hello["volume"]
        self.wait(lambda m: m["type"] == "state")
        if size:
            self.tell(type="resize", width=size[0], height=size[1])

    def tell(self, **message):
        self.socket.send(message)

    def receive(self):
        message, data = self.socket.receive()
        if data is not None:
            message["bytes"] = data
        if message["type"] == "state":
            self.state = message
        elif message["type"] == "frame":
            self.frames.append(message)
            if self.confirms:
                self.tell(type="shown", frame=message["frame"])
        return message

    def wait(self, is_wanted, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            message = self.receive()
            if is_wanted(message):
                return message
        raise AssertionError("what was waited for has not come")

    def ask(self, **message):
        """The answer, or the error."""
        self.number += 1
        self.tell(id=self.number, **message)
        return self.wait(lambda m: m.get("id") == self.number)

    def exact(self):
        """The pixel-exact frame of the newest state."""
        return self.wait(lambda m: m["type"] == "frame" and m["stage"] == "exact" and m["revision"] >= self.state["revision"])

    def close(self):
        self.socket.close()

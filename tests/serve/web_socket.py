"""A small client of web sockets (RFC 6455), of the standard library alone."""
import base64
import json
import os
import socket
import struct


class Refused(Exception):
    """The server answered with something else than a web socket."""

    def __init__(self, status, text):
        super().__init__(f"{status}: {text}")
        self.status = status


class Closed(Exception):
    """The server has ended the connection."""


def connect(port, timeout=60):
    return socket.create_connection(("127.0.0.1", port), timeout)


class WebSocket:
    def __init__(self, port, target, headers=(), host=None):
        self.socket = connect(port)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # As browsers do: movements must not wait.
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {target} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13", *headers, "", ""]
        self.socket.sendall("\r\n".join(lines).encode())
        self.file = self.socket.makefile("rb")
        status = int(self.file.readline().split()[1])
        length = 0
        while (line := self.file.readline().strip()):
            name, _, value = line.partition(b":")
            length = int(value) if name.lower() == b"content-length" else length
        if status != 101:
            text = self.file.read(length).decode()
            self.close()
            raise Refused(status, text)

    def close(self):
        self.file.close()
        self.socket.close()

    def send_frame(self, opcode, payload, is_last=True):
        mask = os.urandom(4)
        n = len(payload)
        head = bytes([(0x80 if is_last else 0) | opcode])
        if n < 126:
            head += bytes([0x80 | n])
        elif n < 65536:
            head += bytes([0x80 | 126]) + struct.pack(">H", n)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", n)
        masked = (int.from_bytes(payload, "little") ^ int.from_bytes((mask * (n // 4 + 1))[:n], "little")).to_bytes(n, "little")
        self.socket.sendall(head + mask + masked)

    def send(self, message):
        self.send_frame(1, json.dumps(message).encode())

    def read_exactly(self, n):
        data = self.file.read(n)
        if data is None or len(data) < n:
            raise Closed()
        return data

    def receive(self):
        """(JSON, bytes), of which one may be None."""
        while True:
            first, second = self.read_exactly(2)
            n = second & 127
            if n == 126:
                n, = struct.unpack(">H", self.read_exactly(2))
            elif n == 127:
                n, = struct.unpack(">Q", self.read_exactly(8))
            payload = self.read_exactly(n)
            opcode = first & 15
            if opcode == 8:
                raise Closed()
            if opcode == 9:
                self.send_frame(10, payload)
            elif opcode == 1:
                return json.loads(payload), None
            elif opcode == 2:
                length, = struct.unpack("<I", payload[:4])
                return json.loads(payload[4:4 + length]), payload[4 + length:]

"""A client of web sockets (RFC 6455), of the standard library alone."""

import base64
import json
import os
import socket
import struct
import threading
from typing import Any

_TEXT, _CLOSE, _PING, _PONG = 1, 8, 9, 10


class WebSocket:
    """A connection to a server on this machine. Messages are JSON; one thread receives, any may send."""

    def __init__(self, port: int, target: str, timeout: float = 60) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._sending = threading.Lock()
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        self._file = self._socket.makefile("rb")
        status = self._file.readline().decode("latin-1").strip()
        while self._file.readline().strip():
            pass
        if " 101" not in status:
            self.close()
            raise ConnectionError(f"the server refuses the connection: {status or 'no answer'}")
        self._socket.settimeout(None)

    def send(self, message: dict[str, Any]) -> None:
        """Raises OSError if the connection has ended."""
        self._send(_TEXT, json.dumps(message).encode())

    def receive(self) -> dict[str, Any]:
        """The next message. Raises EOFError or OSError if the connection has ended."""
        text = b""
        while True:
            first, second = self._read(2)
            length = second & 127
            if length > 125:
                length, = struct.unpack(">H" if length == 126 else ">Q", self._read(2 if length == 126 else 8))
            payload = self._read(length)
            kind = first & 15
            if kind == _CLOSE:
                raise EOFError("the server has ended the connection")
            if kind == _PING:
                self._send(_PONG, payload)
            elif kind in (0, _TEXT):
                text += payload
                if first & 128:
                    return json.loads(text)

    def close(self) -> None:
        """Also ends a receive() in another thread."""
        try:
            self._socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self._socket.close()

    def _send(self, kind: int, payload: bytes) -> None:
        length = len(payload)
        size = (bytes([0x80 | length]) if length < 126 else
                bytes([0x80 | 126]) + struct.pack(">H", length) if length < 65536 else
                bytes([0x80 | 127]) + struct.pack(">Q", length))
        mask = os.urandom(4)
        masked = int.from_bytes(payload, "little") ^ int.from_bytes((mask * (length // 4 + 1))[:length], "little")
        with self._sending:
            self._socket.sendall(bytes([0x80 | kind]) + size + mask + masked.to_bytes(length, "little"))

    def _read(self, n: int) -> bytes:
        data = self._file.read(n)
        if len(data) < n:
            raise EOFError("the server has ended the connection")
        return data

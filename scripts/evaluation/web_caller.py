"""What people on the Web say to a gateway, over bare sockets: calls to /api/v1 and lines of the live channel. Each may come from an address of this
computer of its own (127.0.0.2, 127.0.0.3 …), which the gateway takes for another caller."""
import http.client
import json
import os
import socket
import struct
import threading
import time


def uuid7():
    """An id as the page makes it."""
    now, random = int(time.time() * 1000), os.urandom(10).hex()
    head = f"{now:012x}"
    return f"{head[:8]}-{head[8:]}-7{random[:3]}-8{random[3:6]}-{random[6:18]}"


def frame_of(text):
    """A client's text frame; masked with zeros, which leaves the text as it is."""
    payload = text.encode()
    if len(payload) < 126:
        return bytes([0x81, 0x80 | len(payload)]) + bytes(4) + payload
    return bytes([0x81, 0xFE]) + struct.pack(">H", len(payload)) + bytes(4) + payload


def upgrade_of(path, cookie="", host="localhost"):
    return (f"GET {path} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            f"Sec-WebSocket-Version: 13\r\n{f'Cookie: {cookie}' + chr(13) + chr(10) if cookie else ''}\r\n").encode()


class Caller:
    """Somebody with a browser: keeps the cookie of a login."""

    def __init__(self, port, address="127.0.0.1", timeout=10.0):
        self.port, self.address, self.timeout = port, address, timeout
        self.cookie = self.csrf = ""

    def get(self, path):
        """Status and bytes."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=self.timeout, source_address=(self.address, 0))
        try:
            connection.request("GET", path)
            reply = connection.getresponse()
            return reply.status, reply.read()
        finally:
            connection.close()

    def call(self, method, path, body=None):
        """Status, document and seconds. 0: no answer came."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=self.timeout, source_address=(self.address, 0))
        headers = {"Cookie": self.cookie, "Docent-Csrf": self.csrf}
        if body is not None:
            headers["Content-Type"] = "application/json"
        begin = time.monotonic()
        try:
            connection.request(method, "/api/v1" + path, None if body is None else json.dumps(body), headers)
            reply = connection.getresponse()
            document = json.loads(reply.read())
        except (OSError, http.client.HTTPException, ValueError):
            return 0, {}, time.monotonic() - begin
        finally:
            connection.close()
        if reply.getheader("Set-Cookie"):
            self.cookie = reply.getheader("Set-Cookie").split(";")[0]
        if isinstance(document, dict) and "csrf" in document:
            self.csrf = document["csrf"]
        return reply.status, document, time.monotonic() - begin


class Line:
    """A WebSocket: the newest message of each type, and when each answer came. `heard`, if given, is told each message as it comes."""

    def __init__(self, port, path="/live", address="127.0.0.1", cookie="", timeout=5.0, heard=None):
        self.newest, self.answers, self.heard = {}, {}, heard
        self.is_open, self.changed, self.said = False, threading.Condition(), threading.Lock()
        self.socket = socket.create_connection(("127.0.0.1", port), timeout, (address, 0))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.sendall(upgrade_of(path, cookie))
        self.rest = b""
        while b"\r\n\r\n" not in self.rest:
            more = self.socket.recv(4096)
            if not more:
                break
            self.rest += more
        head, _, self.rest = self.rest.partition(b"\r\n\r\n")
        if not head.startswith(b"HTTP/1.1 101"):
            self.socket.close()
            raise ConnectionError(f"{path}: {head[:60].decode(errors='replace')}")
        self.socket.settimeout(None)
        self.is_open = True
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        try:
            while True:
                kind, payload = self.next_frame()
                if kind == 8:
                    break
                if kind == 9:
                    with self.said:
                        self.socket.sendall(bytes([0x8A, 0x80 | len(payload)]) + bytes(4) + payload)
                elif kind == 1:
                    self.take(json.loads(payload))
        except (OSError, ValueError):
            pass
        with self.changed:
            self.is_open = False
            self.changed.notify_all()

    def next_frame(self):
        head = self.bytes(2)
        length = head[1] & 0x7F
        if length >= 126:
            length = int.from_bytes(self.bytes(2 if length == 126 else 8), "big")
        return head[0] & 0x0F, self.bytes(length)

    def bytes(self, count):
        while len(self.rest) < count:
            more = self.socket.recv(1 << 18)
            if not more:
                raise OSError("closed")
            self.rest += more
        taken, self.rest = self.rest[:count], self.rest[count:]
        return taken

    def take(self, message):
        now = time.monotonic()
        with self.changed:
            self.newest[message["type"]] = message
            if message["type"] in ("ack", "refused"):
                self.answers[message["id"]] = (now, message)
            self.changed.notify_all()
        if self.heard:
            self.heard(now, message)

    def say(self, message):
        """When it was said. OSError: the line is gone."""
        with self.said:
            now = time.monotonic()
            self.socket.sendall(frame_of(json.dumps(message)))
        return now

    def wait(self, wanted, seconds):
        """Until `wanted(self)` is true; what it gave then, or None."""
        end = time.monotonic() + seconds
        with self.changed:
            while True:
                found = wanted(self)
                if found or not self.is_open or time.monotonic() >= end:
                    return found or None
                self.changed.wait(end - time.monotonic())

    def answer_to(self, message_id, seconds):
        """(when, answer), or None."""
        return self.wait(lambda line: line.answers.get(message_id), seconds)

    def close(self):
        try:
            self.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self.socket.close()

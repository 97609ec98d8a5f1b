"""How a stranger talks to a gateway: HTTP and WebSocket by bare sockets, so that every header can be a lie; and the far gateway's line as whoever
holds its key can speak it."""
import base64
import json
import os
import socket
import struct
import subprocess
import time

HOST = "127.0.0.1"
PATIENCE = 8.0  # [s]


class Answer:
    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    def json(self):
        try:
            found = json.loads(self.body)
        except ValueError:
            return {}
        return found if isinstance(found, dict) else {}

    def cookie(self):
        return self.headers.get("set-cookie", "").split(";")[0]


def head_of(method, target, headers):
    lines = [f"{method} {target} HTTP/1.1", *(f"{name}: {value}" for name, value in headers.items() if value is not None)]
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def receive_head(connection):
    """Status, headers by small name, and what has come beyond them."""
    data = b""
    while b"\r\n\r\n" not in data:
        more = connection.recv(65536)
        if not more:
            return 0, {}, b""
        data += more
    head, _, rest = data.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    headers = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}
    return int(lines[0].split()[1]), headers, rest


def http(port, method, target, headers=None, body=None):
    """One call. A header of None is left out; Host is 127.0.0.1:PORT unless said otherwise. Status 0: the connection was closed."""
    all_headers = {"Host": f"{HOST}:{port}", "Connection": "close", **(headers or {})}
    if body is not None:
        all_headers["Content-Length"] = str(len(body))
    try:
        with socket.create_connection((HOST, port), timeout=PATIENCE) as connection:
            connection.sendall(head_of(method, target, all_headers) + (body or b""))
            status, received, rest = receive_head(connection)
            while more := connection.recv(65536):
                rest += more
    except ConnectionError:
        return Answer(0, {}, b"")
    return Answer(status, received, rest)


class Frames:
    """WebSocket frames over `read` and `write` of bytes. Messages and the close code as they come."""

    def __init__(self, rest=b""):
        self.buffer = rest
        self.closed = None  # the code, once it is

    def frame(self, payload, opcode=1):
        length = bytes([0x80 | len(payload)]) if len(payload) < 126 else bytes([0xFE]) + struct.pack(">H", len(payload))
        return bytes([0x80 | opcode]) + length + bytes(4) + payload  # a mask of zeros leaves the payload as it is

    def take(self):
        """The next frame that is whole: (opcode, payload), or None."""
        if len(self.buffer) < 2:
            return None
        length, head = self.buffer[1] & 0x7F, 2
        if length == 126:
            head = 4
        elif length == 127:
            head = 10
        if len(self.buffer) < head:
            return None
        if head > 2:
            length = int.from_bytes(self.buffer[2:head], "big")
        if len(self.buffer) < head + length:
            return None
        found = self.buffer[0] & 0x0F, self.buffer[head:head + length]
        self.buffer = self.buffer[head + length:]
        return found


class Socket:
    """A WebSocket. `status` is 101 where it was opened, else what was answered; 0: nothing was."""

    def __init__(self, port, target, headers=None):
        self.frames = Frames()
        self.connection = socket.create_connection((HOST, port), timeout=PATIENCE)
        opening = {"Host": f"{HOST}:{port}", "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                   "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), **(headers or {})}
        try:
            self.connection.sendall(head_of("GET", target, opening))
            self.status, _, rest = receive_head(self.connection)
        except OSError:
            self.status, rest = 0, b""
        self.frames.buffer = rest
        self.newest = {}

    @property
    def is_open(self):
        return self.status == 101 and self.frames.closed is None

    def say(self, message):
        self._send(self.frames.frame(json.dumps(message).encode()))

    def _send(self, data):
        try:
            self.connection.sendall(data)
        except OSError:
            self.frames.closed = self.frames.closed or 1006

    def read(self, until):
        """Reads until `until(opcode, message)` or the end of the connection. Whether it came to it."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.frames.closed is None:
            found = self.frames.take()
            if found is None:
                self._receive(end)
                continue
            opcode, payload = found
            if opcode == 8:
                self.frames.closed = int.from_bytes(payload[:2], "big") or 1005
                return False
            message = json.loads(payload) if opcode == 1 else {}
            if opcode == 1:
                self.newest[message.get("type")] = message
            if until(opcode, message):
                return True
        return False

    def _receive(self, end):
        self.connection.settimeout(max(0.01, end - time.monotonic()))
        try:
            more = self.connection.recv(65536)
        except TimeoutError:
            return
        except OSError:
            more = b""
        if more:
            self.frames.buffer += more
        else:
            self.frames.closed = 1006

    def settle(self):
        """Until all that was said before has been read at the other end, or the connection is closed. Whether it still is open."""
        self._send(self.frames.frame(b"settled", opcode=9))
        return self.read(lambda opcode, _: opcode == 10)

    def ask(self, message):
        """The answer to a message that has an id: ack, refused; None: closed."""
        self.say(message)
        self.read(lambda opcode, said: opcode == 1 and said.get("id") == message["id"] and said["type"] in ("ack", "refused"))
        answer = self.newest.get("ack") if self.newest.get("ack", {}).get("id") == message["id"] else self.newest.get("refused")
        return answer if answer and answer["id"] == message["id"] else None

    def close(self):
        self.connection.close()


class KeyHolder:
    """Whoever holds the key of the far gateway's line and speaks it themselves: envelopes of their own making. `is_in`: the door let them in."""

    def __init__(self, port, key):
        words = ["openssl", "s_client", "-connect", f"{HOST}:{port}", "-tls1_3", "-ciphersuites", "TLS_AES_128_GCM_SHA256", "-psk_identity", "docent",
                 "-psk", key.encode().hex(), "-quiet", "-no_ign_eof"]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, bufsize=0)
        self.frames = Frames()
        self.calls = 0
        opening = {"Host": "museum", "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                   "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode()}
        os.set_blocking(self.process.stdout.fileno(), False)
        self._write(head_of("GET", "/uplink", opening))
        self.is_in = self._head()

    def _write(self, data):
        try:
            self.process.stdin.write(data)
        except OSError:
            self.frames.closed = 1006

    def _more(self):
        more = self.process.stdout.read(65536)
        if more is None:
            time.sleep(0.002)
        elif more:
            self.frames.buffer += more
        else:
            self.frames.closed = 1006

    def _head(self):
        end = time.monotonic() + PATIENCE
        while b"\r\n\r\n" not in self.frames.buffer and self.frames.closed is None and time.monotonic() < end:
            self._more()
        head, _, self.frames.buffer = self.frames.buffer.partition(b"\r\n\r\n")
        return b" 101 " in head.split(b"\r\n")[0]

    def envelope(self, head, rest=b""):
        self._write(self.frames.frame(json.dumps(head).encode() + b"\n" + rest, opcode=2))

    def wait(self, wanted):
        """The envelope (head, rest) that `wanted(head, rest)`; None: it did not come."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.frames.closed is None:
            found = self.frames.take()
            if found is None:
                self._more()
                continue
            if found[0] != 2:
                continue
            head, _, rest = found[1].partition(b"\n")
            head = json.loads(head)
            if wanted(head, rest):
                return head, rest
        return None

    def call(self, method, target, token="", csrf="", body=b"", **more):
        self.calls += 1
        number = self.calls
        self.envelope({"is": "call", "n": number, "method": method, "target": target, "token": token, "csrf": csrf, "address": HOST, "json": True,
                       "ours": True, "far": False, **more}, body)
        found = self.wait(lambda head, _: head.get("is") == "reply" and head.get("n") == number)
        return Answer(found[0]["status"], {"set-cookie": found[0].get("cookie", "")}, found[1]) if found else Answer(0, {}, b"")

    def close(self):
        self.process.kill()
        self.process.wait()

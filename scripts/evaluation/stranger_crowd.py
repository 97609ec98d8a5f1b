"""A crowd that means harm, as a program: thousands of sockets on one thread that wish, vote, post, guess passwords, send bodies drop by drop, or never
read, from one address and from many. It runs until its standard input ends, then prints what became of it, as JSON."""
import collections
import heapq
import json
import random
import selectors
import socket
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from evaluation.web_caller import frame_of, upgrade_of, uuid7  # noqa: E402

KINDS = {"wisher": 0.4, "voter": 0.28, "never reads": 0.1, "slow body": 0.1, "poster": 0.06, "guesser": 0.06}  # shares of all sockets
PERIOD = {"wisher": 0.5, "voter": 0.5, "never reads": 5.0, "slow body": 0.5, "poster": 1.0, "guesser": 1.0}  # [s] between two words
COMING = 400  # a second
MOST = 1 << 18  # [bytes] read at a time


class Stranger:
    """One socket. What it hears is read as far as it has to be: what kind of answer it is."""

    def __init__(self, crowd, kind, address):
        self.crowd, self.kind, self.address = crowd, kind, address
        self.is_line = kind in ("wisher", "voter", "never reads")
        self.socket, self.rest, self.skip, self.to_send, self.is_up, self.number = None, b"", 0, b"", False, 0
        self.cookie = self.csrf = ""
        self.comes_again = 0.0

    def connect(self):
        self.rest, self.skip, self.to_send, self.is_up = b"", 0, b"", not self.is_line
        if self.kind == "slow body":
            self.number = 0
        self.socket = socket.socket()
        self.socket.setblocking(False)
        if self.kind == "never reads":
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        try:
            self.socket.bind((self.address, 0))
            self.socket.connect(("127.0.0.1", self.crowd.port))
        except BlockingIOError:
            pass
        except OSError:
            self.crowd.count["cannot connect"] += 1
            return self.leave()
        self.crowd.selector.register(self.socket, selectors.EVENT_READ | selectors.EVENT_WRITE, self)
        if self.is_line:
            self.send(upgrade_of("/live" if self.kind == "never reads" else "/live?thin"))
        return None

    def leave(self):
        if self.socket is None:
            return
        try:
            self.crowd.selector.unregister(self.socket)
        except (KeyError, ValueError):
            pass
        self.socket.close()
        self.socket, self.comes_again = None, time.monotonic() + 1.0

    def send(self, data):
        self.to_send += data
        self.flush()

    def flush(self):
        if not self.to_send or self.socket is None:
            return
        try:
            sent = self.socket.send(self.to_send)
        except BlockingIOError:
            return
        except OSError:
            if self.to_send:
                self.leave()
            return
        self.to_send = self.to_send[sent:]

    def ready(self, events):
        if events & selectors.EVENT_WRITE:
            self.flush()
            if self.socket is not None and not self.to_send:
                self.crowd.selector.modify(self.socket, selectors.EVENT_READ, self)
        if events & selectors.EVENT_READ and self.socket is not None:
            try:
                data = self.socket.recv(MOST)
            except BlockingIOError:
                return
            except OSError:
                data = b""
            if not data:
                self.crowd.count[f"{self.kind} closed"] += 1
                return self.leave()
            self.hear(data)
        return None

    def hear(self, data):
        if self.skip >= len(data):
            self.skip -= len(data)
            return
        self.rest += data[self.skip:]
        self.skip = 0
        if not self.is_line:
            return self.hear_http()
        if not self.is_up:
            head, end, rest = self.rest.partition(b"\r\n\r\n")
            if not end:
                return None
            if not head.startswith(b"HTTP/1.1 101"):
                self.crowd.count[f"{self.kind} {head[9:12].decode(errors='replace')}"] += 1
                return self.leave()
            self.is_up, self.rest = True, rest
            if self.kind == "never reads":
                self.crowd.selector.unregister(self.socket)  # and hears nothing more
                return None
        while self.socket is not None and self.hear_frame():
            pass
        return None

    def hear_frame(self):
        rest = self.rest
        if len(rest) < 2:
            return False
        length, begin = rest[1] & 0x7F, 2
        if length >= 126:
            begin = 4 if length == 126 else 10
            if len(rest) < begin:
                return False
            length = int.from_bytes(rest[2:begin], "big")
        kind = rest[0] & 0x0F
        have = len(rest) - begin
        if have < length and (have < 160 or kind != 1):
            return False
        if kind == 1:
            self.sort(rest[begin:begin + min(length, 160)])
        elif kind == 9:
            self.send(bytes([0x8A, 0x80 | length]) + bytes(4) + rest[begin:begin + length])
        elif kind == 8:
            self.crowd.count[f"{self.kind} sent off"] += 1
            self.leave()
            return False
        if have < length:
            self.skip, self.rest = length - have, b""
            return False
        self.rest = rest[begin + length:]
        return True

    def sort(self, text):
        if b'"type":"ack"' in text:
            self.crowd.count[f"{self.kind} taken"] += 1
        elif b'"type":"refused"' in text or b'"type":"error"' in text:
            word = text.partition(b'"word":"')[2].partition(b'"')[0].decode(errors="replace")
            self.crowd.count[f"{self.kind} refused: {word}"] += 1
        else:
            self.crowd.count["values"] += 1

    def hear_http(self):
        head, end, rest = self.rest.partition(b"\r\n\r\n")
        if not end:
            return None
        lower = head.lower()
        at = lower.find(b"content-length:")
        length = int(lower[at + 15:].split(b"\r\n", 1)[0]) if at >= 0 else 0
        if len(rest) < length:
            return None
        self.rest = rest[length:]
        status = head[9:12].decode(errors="replace")
        self.crowd.count[f"{self.kind} {status}"] += 1
        if b"set-cookie:" in lower:
            self.cookie = head[lower.find(b"set-cookie:") + 11:].split(b";", 1)[0].strip().decode()
        if b'"csrf":"' in rest[:length]:
            self.csrf = rest.partition(b'"csrf":"')[2].partition(b'"')[0].decode() or self.csrf
        if b"connection: close" in lower or status in ("408", "413", "503"):
            return self.leave()
        return None

    def speak(self):
        """One word; whoever is not there comes again."""
        crowd = self.crowd
        if self.socket is None:
            return self.connect() if time.monotonic() >= self.comes_again else None
        if self.to_send and not self.is_line and self.kind != "slow body":
            return None
        if self.is_up:
            crowd.count[f"{self.kind} said"] += 1
            getattr(self, "be_" + self.kind.replace(" ", "_"))()
        return None

    def be_wisher(self):
        self.send(frame_of(f'{{"type":"request","id":"{uuid7()}","kind":"exhibit","target":"{self.crowd.draw.choice(self.crowd.exhibits)}",'
                           f'"viewpoint":-1,"name":"Nobody","language":"en"}}'))

    def be_voter(self):
        self.send(frame_of(f'{{"type":"vote","id":"{uuid7()}","voter":"{uuid7()}","tour":"{self.crowd.draw.choice(self.crowd.tours)}"}}'))

    def be_never_reads(self):
        self.send(frame_of(f'{{"type":"vote","id":"{uuid7()}","voter":"{uuid7()}","tour":"{self.crowd.draw.choice(self.crowd.tours)}"}}'))

    def be_slow_body(self):
        if self.number == 0:
            museum = self.crowd.draw.random() < 0.5
            method, path, length = ("PUT", "/museum", 900000) if museum else ("POST", "/forum", 16000)
            self.send(f"{method} /api/v1{path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {length}\r\n\r\n{{".encode())
        else:
            self.send(b" ")
        self.number += 1

    def post(self, method, path, body):
        text = json.dumps(body) if body is not None else ""
        kind = "Content-Type: application/json\r\n" if text else ""
        self.send(f"{method} /api/v1{path} HTTP/1.1\r\nHost: localhost\r\nCookie: {self.cookie}\r\nDocent-Csrf: {self.csrf}\r\n{kind}"
                  f"Content-Length: {len(text)}\r\n\r\n{text}".encode())

    def be_poster(self):
        self.number += 1
        if not self.cookie or self.number % 20 == 0:
            self.cookie = self.csrf = ""
            self.post("POST", "/visitor", {"name": f"Eve {self.crowd.draw.randrange(10 ** 6)}"})
        elif self.number % 3 == 0:
            self.post("GET", "/forum", None)
        elif self.number % 3 == 1 and self.crowd.posts:
            self.post("POST", f"/posts/{self.crowd.draw.choice(self.crowd.posts)}/report", None)
        else:
            self.post("POST", "/forum", {"id": uuid7(), "title": "Buy", "text": "Buy now. " * 100})

    def be_guesser(self):
        name = self.crowd.account if self.crowd.draw.random() < 0.7 else f"nobody{self.crowd.draw.randrange(1000)}"
        self.post("POST", "/login", {"name": name, "password": f"guess number {self.crowd.draw.randrange(10 ** 9)}"})


class Crowd:
    def __init__(self, wish):
        self.port, self.exhibits, self.tours, self.posts, self.account = wish["port"], wish["exhibits"], wish["tours"], wish.get("posts", []), wish["account"]
        self.draw = random.Random(wish.get("seed", 1))
        self.selector, self.timers, self.order = selectors.EpollSelector(), [], 0
        self.count = collections.Counter()
        self.open_samples = []
        kinds = [kind for kind, share in KINDS.items() for _ in range(round(share * wish["sockets"]))]
        self.draw.shuffle(kinds)
        # Half of them from one address, the others from all.
        self.strangers = [Stranger(self, kind, wish["addresses"][0] if i % 2 else wish["addresses"][1 + (i // 2) % max(1, len(wish["addresses"]) - 1)]
                                   if len(wish["addresses"]) > 1 else wish["addresses"][0]) for i, kind in enumerate(kinds)]
        for i, stranger in enumerate(self.strangers):
            self.later(i / COMING, stranger)

    def later(self, seconds, stranger):
        self.order += 1
        heapq.heappush(self.timers, (time.monotonic() + seconds, self.order, stranger))

    def run(self):
        self.selector.register(sys.stdin.fileno(), selectors.EVENT_READ, None)
        next_sample = time.monotonic() + 2.0
        while True:
            now = time.monotonic()
            while self.timers and self.timers[0][0] <= now:
                stranger = heapq.heappop(self.timers)[2]
                stranger.speak()
                self.later(PERIOD[stranger.kind] * self.draw.uniform(0.8, 1.2), stranger)
            if now >= next_sample:
                next_sample = now + 1.0
                self.open_samples.append(sum(stranger.socket is not None for stranger in self.strangers))
            wait = max(0.0, min(0.05, self.timers[0][0] - now if self.timers else 0.05))
            for key, events in self.selector.select(wait):
                if key.data is None:
                    return
                key.data.ready(events)

    def report(self):
        return {"sockets": len(self.strangers), "addresses": len({stranger.address for stranger in self.strangers}),
                "open": sorted(self.open_samples)[len(self.open_samples) // 2] if self.open_samples else 0, "count": dict(sorted(self.count.items()))}


if __name__ == "__main__":
    crowd = Crowd(json.loads(sys.argv[1]))
    crowd.run()
    print(json.dumps(crowd.report()), flush=True)
